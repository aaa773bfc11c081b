#include "bench/fused_cube.h"

#include "spirv/fused_cube.h"

#include <vector>

namespace tyndall::bench {
namespace {

constexpr gpu::Buffer::Options kTexels{.texels = true};

shared::Features features() {
    shared::Features f;
    f.workgroup_size = 64;
    return f;
}

} // namespace

FusedCube::FusedCube(const gpu::Context& context, std::uint32_t size)
    : context_(context), unused_(context, "unused", 1024, kTexels),
      film_(context, "fused film", std::uint64_t{size} * size * shared::FILM_TEXELS * 16, kTexels),
      descriptors_(context, {{&unused_, &unused_, &unused_, &film_, &unused_}, &unused_, &unused_},
                   sizeof(push_)),
      stage_(context, descriptors_, "fused_cube", fused_cube_spirv, features()),
      commands_(context) {
    push_.width = push_.full_width = size;
    push_.pixel_count = size * size;
}

void FusedCube::render(std::uint32_t samples, std::uint32_t seed) {
    push_.seed = {seed, 0};
    push_.end_sample = samples;
    commands_.begin();
    commands_.bind(descriptors_, std::as_bytes(std::span(&push_, 1)));
    commands_.dispatch(stage_, push_.pixel_count);
    commands_.barrier();
    commands_.submit();
    commands_.wait();
}

double FusedCube::read_mean() const {
    std::vector<glm::vec4> texels(std::size_t{push_.pixel_count} * shared::FILM_TEXELS);
    gpu::download(context_, film_, 0, std::as_writable_bytes(std::span(texels)));
    double sum = 0, weight = 0;
    for (std::size_t i = 0; i < texels.size(); i += shared::FILM_TEXELS) {
        sum += static_cast<double>(texels[i].x);
        weight += static_cast<double>(texels[i].w);
    }
    return sum / weight;
}

} // namespace tyndall::bench
