#include "reference/reference.h"

#include "reference/camera.h"
#include "reference/walk.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>

namespace tyndall::reference {
namespace {

constexpr int tile_size = 4;

bool is_finite(const Rgb& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

} // namespace

struct ReferenceRenderer::Parts {
    const Scene& scene;
    PathCamera camera;
    Geometry geometry;
    Lights lights;
    PathTracer tracer;
    std::mutex health_mutex;
    shared::Health health;

    explicit Parts(const Scene& s)
        : scene(s), camera(s), geometry(s, camera.position()),
          lights(s, geometry, camera.position()), tracer(s, geometry, lights) {}

    glm::dvec4 sample(int x, int y, std::uint32_t index, PathReport& report) const;
    void count_mishaps(const PathReport& report, int x, int y, std::uint32_t index);
    void render_tile(int tile, std::uint32_t first, std::uint32_t count, PixelSums& sums);

    int tiles_across() const { return (scene.film.bounds.width() + tile_size - 1) / tile_size; }
    int tile_count() const {
        return tiles_across() * ((scene.film.bounds.height() + tile_size - 1) / tile_size);
    }
};

/// Counts what went wrong with a path.
void ReferenceRenderer::Parts::count_mishaps(const PathReport& report, int x, int y,
                                             std::uint32_t index) {
    if (report.mishaps == 0) return;
    const std::scoped_lock lock(health_mutex);
    for (int kind = 0; kind < shared::HEALTH_COUNT; ++kind) {
        if ((report.mishaps >> kind & 1u) == 0) continue;
        shared::Mishap& mishap = health.kinds[static_cast<std::size_t>(kind)];
        if (mishap.count++ > 0) continue;
        mishap.x = static_cast<std::uint32_t>(x);
        mishap.y = static_cast<std::uint32_t>(y);
        mishap.sample = index;
    }
    health.worst_majorant_ratio = std::max(health.worst_majorant_ratio, report.majorant_ratio);
    health.lost_throughput += (report.lost.x + report.lost.y + report.lost.z) / 3;
}

/// One path: (filter weight * radiance, filter weight).
glm::dvec4 ReferenceRenderer::Parts::sample(int x, int y, std::uint32_t index,
                                            PathReport& report) const {
    const Film& film = scene.film;
    const glm::uvec2 seed(static_cast<std::uint32_t>(scene.seed),
                          static_cast<std::uint32_t>(scene.seed >> 32));
    const auto column = static_cast<std::uint32_t>(x), row = static_cast<std::uint32_t>(y);
    const std::uint32_t pixel = scene.sampler == Sampler::zsobol
                                    ? shared::morton_code(column, row)
                                    : row * static_cast<std::uint32_t>(film.width) + column;
    const RandomPath random{seed, pixel, index, scene.sampler, scene.zsobol_bits()};
    const CameraSample camera_sample = camera.sample(x, y, random);
    // The imaging ratio, then pbrt's clamp, which keeps the colour.
    Rgb radiance = tracer.radiance(camera_sample.ray, random, report) *
                   (scene.camera.shutter_seconds * film.iso / 100);
    report.note(shared::HEALTH_NONFINITE, !is_finite(radiance));
    report.note(shared::HEALTH_NEGATIVE,
                is_finite(radiance) && std::min({radiance.x, radiance.y, radiance.z}) < 0);
    if (report.is_dropped()) radiance = Rgb(0);
    const double largest = std::max({radiance.x, radiance.y, radiance.z});
    if (largest > film.max_component_value) radiance *= film.max_component_value / largest;
    return {camera_sample.weight * radiance, camera_sample.weight};
}

void ReferenceRenderer::Parts::render_tile(int tile, std::uint32_t first, std::uint32_t count,
                                           PixelSums& sums) {
    const PixelBounds& bounds = scene.film.bounds;
    const int x0 = bounds.x0 + tile % tiles_across() * tile_size;
    const int y0 = bounds.y0 + tile / tiles_across() * tile_size;
    for (int y = y0; y < std::min(y0 + tile_size, bounds.y1); ++y) {
        for (int x = x0; x < std::min(x0 + tile_size, bounds.x1); ++x) {
            glm::dvec4 sum(0);
            for (std::uint32_t i = first; i < first + count; ++i) {
                PathReport report;
                sum += sample(x, y, i, report);
                count_mishaps(report, x, y, i);
            }
            sums[static_cast<std::size_t>((y - bounds.y0) * bounds.width() + x - bounds.x0)] = sum;
        }
    }
}

ReferenceRenderer::ReferenceRenderer(const Scene& scene) : parts_(std::make_unique<Parts>(scene)) {}
ReferenceRenderer::~ReferenceRenderer() = default;

PixelSums ReferenceRenderer::render(std::uint32_t first_sample, std::uint32_t sample_count,
                                    const std::function<bool(double)>& keep_going) {
    const PixelBounds& bounds = parts_->scene.film.bounds;
    PixelSums sums(static_cast<std::size_t>(bounds.width()) *
                   static_cast<std::size_t>(bounds.height()));
    const int tile_count = parts_->tile_count();
    std::atomic<int> next_tile{0};
    std::atomic<bool> stopped{false};
    const auto work = [&](const std::function<bool(double)>& ask) {
        for (int tile; !stopped && (tile = next_tile++) < tile_count;) {
            parts_->render_tile(tile, first_sample, sample_count, sums);
            if (ask && !ask(std::min(1.0, static_cast<double>(next_tile) / tile_count)))
                stopped = true;
        }
    };
    {
        std::vector<std::jthread> helpers;
        for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i)
            helpers.emplace_back(work, nullptr);
        work(keep_going);
    }
    return stopped ? PixelSums{} : sums;
}

Replay ReferenceRenderer::replay(int x, int y, std::uint32_t sample) const {
    Replay replay{.camera = parts_->camera.position()};
    PathReport report{.replay = &replay};
    replay.sum = parts_->sample(x, y, sample, report);
    replay.mishaps = report.mishaps;
    return replay;
}

shared::Health ReferenceRenderer::health() const {
    const std::scoped_lock lock(parts_->health_mutex);
    return parts_->health;
}

} // namespace tyndall::reference
