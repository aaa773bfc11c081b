#include "render/wavefront.h"

#include "core/error.h"
#include "spirv/cross_interface.h"
#include "spirv/next_sample.h"
#include "spirv/schedule.h"
#include "spirv/shade_conductor.h"
#include "spirv/shade_dielectric.h"
#include "spirv/shade_surface.h"
#include "spirv/shade_volume.h"
#include "spirv/trace_segment.h"
#include "spirv/trace_shadow.h"
#include "spirv/track_medium.h"
#include "spirv/update_film.h"
#include "spirv/walk_region.h"

#include <algorithm>
#include <cstddef>
#include <fmt/format.h>

namespace tyndall {
namespace {

using namespace shared;

/// Batches in flight at once: enough work for every path, bounded memory.
std::uint32_t batch_window(std::uint32_t pixels) {
    constexpr std::uint32_t wanted_items = 1u << 21;
    return std::clamp<std::uint32_t>(wanted_items / pixels, 2, BATCH_WINDOW_MAX);
}

Tuning choose_tuning(const gpu::Context& context, const shared::Features& features, Tuning tuning) {
    const bool is_cpu = context.info().type == "cpu";
    const bool has_hierarchy = features.geometry == GEOMETRY_BVH;
    if (tuning.workgroup_size == 0) tuning.workgroup_size = 64;
    if (tuning.slots == 0) tuning.slots = is_cpu ? (has_hierarchy ? 16384 : 4096) : 1u << 18;
    if (tuning.run_length == 0) tuning.run_length = has_hierarchy ? 64 : 256;
    tuning.workgroup_size =
        std::min(tuning.workgroup_size, context.limits().maxComputeWorkGroupInvocations);
    const std::uint64_t most =
        std::uint64_t{context.limits().maxComputeWorkGroupCount[0]} * tuning.workgroup_size;
    tuning.slots = static_cast<std::uint32_t>(std::min<std::uint64_t>(tuning.slots, most));
    return tuning;
}

} // namespace

Wavefront::Wavefront(const gpu::Context& context, const SceneTables& tables, const Effects& effects,
                     const Tuning& tuning)
    : context_(&context), features_(effects.features),
      tuning_(choose_tuning(context, effects.features, tuning)), push_(tables.push),
      table_bytes_(tables.bytes) {
    push_.slot_count = tuning_.slots;
    push_.run_length = tuning_.run_length;
    push_.window = batch_window(push_.pixel_count);
    const bool has_hierarchy = features_.geometry == GEOMETRY_BVH;
    const std::uint64_t pixels = push_.pixel_count;
    const gpu::Buffer::Options texels{.texels = true};
    scene_ = {context, "scene", tables.texels.size() * 16, texels};
    paths_ = {context, "paths", std::uint64_t{tuning_.slots} * PATH_GROUPS * 16, texels};
    batches_ = {context, "batches", pixels * push_.window * 16, texels};
    film_ = {context, "film", pixels * FILM_TEXELS * 16, texels};
    control_ = {context, "control", sizeof(Control), {.indirect = true}};
    queues_ = {
        context, "queues", has_hierarchy ? std::uint64_t{tuning_.slots} * QUEUE_COUNT * 4 : 16, {}};
    const VkFormat voxel_format =
        tables.voxels.is_half ? VK_FORMAT_R16G16B16A16_SFLOAT : VK_FORMAT_R32G32B32A32_SFLOAT;
    voxels_ = {context,
               "voxels",
               tables.voxels.bytes.size(),
               {.texels = true, .texel_format = voxel_format}};
    gpu::upload(context, scene_, std::as_bytes(std::span(tables.texels)));
    gpu::upload(context, voxels_, tables.voxels.bytes);

    descriptors_.emplace(
        context,
        gpu::Bindings{{&scene_, &paths_, &batches_, &film_, &voxels_}, &control_, &queues_},
        static_cast<std::uint32_t>(sizeof(push_)));
    features_.workgroup_size = tuning_.workgroup_size;
    features_.storage_fallback = descriptors_->storage_fallback();
    features_.primitives = tables.primitives;
    features_.emitters = tables.emitters;
    features_.voxels_are_half = tables.voxels.is_half;

    build_stages(effects);
}

void Wavefront::build_stages(const Effects& effects) {
    const auto make = [&](const char* name, std::span<const std::uint32_t> spirv) {
        return std::optional<gpu::Stage>(std::in_place, *context_, *descriptors_, name, spirv,
                                         features_);
    };
    const auto has_queue = [&](std::uint32_t queue) {
        return features_.surface_queues >> queue & 1u;
    };
    schedule_ = make("schedule", schedule_spirv);
    update_film_ = make("update_film", update_film_spirv);
    if (features_.geometry != GEOMETRY_BVH) {
        walk_region_ = make("walk_region", walk_region_spirv);
        return;
    }
    trace_segment_ = make("trace_segment", trace_segment_spirv);
    next_sample_ = make("next_sample", next_sample_spirv);
    if (features_.densities & DENSITY_BITS_TRACKED)
        track_medium_ = make("track_medium", track_medium_spirv);
    if (features_.has_scattering) shade_volume_ = make("shade_volume", shade_volume_spirv);
    if (has_queue(QUEUE_SURFACE)) shade_surface_ = make("shade_surface", shade_surface_spirv);
    features_.is_rough = 0;
    if (has_queue(QUEUE_DIELECTRIC))
        shade_dielectric_ = make("shade_dielectric", shade_dielectric_spirv);
    if (has_queue(QUEUE_CONDUCTOR))
        shade_conductor_ = make("shade_conductor", shade_conductor_spirv);
    features_.is_rough = 1;
    if (has_queue(QUEUE_ROUGH_DIELECTRIC))
        shade_rough_dielectric_ = make("shade_rough_dielectric", shade_dielectric_spirv);
    if (has_queue(QUEUE_ROUGH_CONDUCTOR))
        shade_rough_conductor_ = make("shade_rough_conductor", shade_conductor_spirv);
    if (features_.has_interfaces) cross_interface_ = make("cross_interface", cross_interface_spirv);
    if (effects.samples_lights) trace_shadow_ = make("trace_shadow", trace_shadow_spirv);
}

void Wavefront::begin_epoch(std::uint32_t first_batch, std::uint32_t batch_count,
                            std::uint32_t first_sample, std::uint32_t end_sample, bool clear_film) {
    push_.first_batch = first_batch;
    push_.batch_count = batch_count;
    push_.first_sample = first_sample;
    push_.end_sample = end_sample;
    gpu::Commands commands(*context_);
    commands.begin();
    commands.fill_zero(paths_);
    commands.fill_zero(control_);
    if (clear_film) commands.fill_zero(film_);
    commands.barrier();
    commands.bind(*descriptors_, std::as_bytes(std::span(&push_, 1)));
    commands.dispatch(*schedule_, 1); // makes the first tickets due
    commands.barrier();
    commands.submit();
    commands.wait();
}

/// This list is the renderer.
void Wavefront::record_rounds(gpu::Commands& commands, std::uint32_t rounds,
                              const gpu::Timestamps& clock) const {
    commands.bind(*descriptors_, std::as_bytes(std::span(&push_, 1)));
    commands.reset(clock);
    for (std::uint32_t round = 0; round < rounds; ++round) {
        std::uint32_t mark = 0;
        const auto end_stage = [&] {
            commands.barrier();
            if (round == 0) commands.mark(clock, ++mark);
        };
        const auto run = [&](const std::optional<gpu::Stage>& stage, std::uint32_t invocations) {
            if (!stage) return;
            commands.dispatch(*stage, invocations);
            end_stage();
        };
        const auto run_indirect = [&](const std::optional<gpu::Stage>& stage,
                                      std::uint64_t arguments) {
            if (!stage) return;
            commands.dispatch_indirect(*stage, control_, arguments);
            end_stage();
        };
        const auto drain = [&](std::uint32_t queue, const std::optional<gpu::Stage>& stage) {
            run_indirect(stage, offsetof(Control, queue_dispatch) + queue * sizeof(DispatchSize));
        };
        if (round == 0) commands.mark(clock, 0);

        run(walk_region_, push_.slot_count);

        run(trace_segment_, push_.slot_count);
        drain(QUEUE_TRACK, track_medium_);
        drain(QUEUE_VOLUME, shade_volume_);
        drain(QUEUE_SURFACE, shade_surface_);
        drain(QUEUE_DIELECTRIC, shade_dielectric_);
        drain(QUEUE_ROUGH_DIELECTRIC, shade_rough_dielectric_);
        drain(QUEUE_CONDUCTOR, shade_conductor_);
        drain(QUEUE_ROUGH_CONDUCTOR, shade_rough_conductor_);
        drain(QUEUE_INTERFACE, cross_interface_);
        drain(QUEUE_SHADOW, trace_shadow_);
        drain(QUEUE_ENDED, next_sample_);

        run(schedule_, 1);
        run_indirect(update_film_, offsetof(Control, fold_dispatch));
    }
}

void Wavefront::record_readback(gpu::Commands& commands, const gpu::Buffer& to) const {
    commands.copy(control_, 0, to, 0, sizeof(Control));
    commands.barrier();
}

Control Wavefront::read_control() const {
    Control control;
    gpu::download(*context_, control_, 0, std::as_writable_bytes(std::span(&control, 1)));
    return control;
}

void Wavefront::read_film(std::uint32_t first, std::uint32_t count,
                          std::vector<glm::vec4>& texels) const {
    texels.resize(std::size_t{count} * FILM_TEXELS);
    gpu::download(*context_, film_, std::uint64_t{first} * FILM_TEXELS * 16,
                  std::as_writable_bytes(std::span(texels)));
}

std::vector<std::pair<std::string, std::uint64_t>> Wavefront::memory() const {
    auto bytes = table_bytes_;
    if (features_.densities & DENSITY_BIT_GRID) bytes.emplace_back("voxels", voxels_.bytes());
    bytes.emplace_back("paths in flight", paths_.bytes());
    bytes.emplace_back("batches in flight", batches_.bytes());
    bytes.emplace_back("film", film_.bytes());
    bytes.emplace_back("queues", queues_.bytes());
    return bytes;
}

std::vector<std::string> Wavefront::stage_names() const {
    std::vector<std::string> names;
    for (const auto* stage :
         {&walk_region_, &trace_segment_, &track_medium_, &shade_volume_, &shade_surface_,
          &shade_dielectric_, &shade_rough_dielectric_, &shade_conductor_, &shade_rough_conductor_,
          &cross_interface_, &trace_shadow_, &next_sample_, &schedule_, &update_film_})
        if (*stage) names.push_back((*stage)->name());
    return names;
}

} // namespace tyndall
