#include "render/replay.h"

#include "render/renderer.h"
#include "shared/event_records.h"
#include "shared/random.h"

#include <algorithm>
#include <tuple>

namespace tyndall {
namespace {

using namespace shared;

static_assert(EVENT_KIND_COUNT == static_cast<std::uint32_t>(PathEvent::Kind::lost) + 1);

/// Shapes in the order of their records: those of the world, then those of definitions.
std::vector<const Shape*> record_shapes(const Scene& scene) {
    std::vector<const Shape*> shapes;
    for (const Shape& shape : scene.shapes)
        shapes.push_back(&shape);
    for (const ObjectDefinition& object : scene.objects)
        for (const Shape& shape : object.shapes)
            shapes.push_back(&shape);
    return shapes;
}

/// Media are followed by copies for instances.
int scene_medium(const Scene& scene, std::uint32_t record) {
    return record == VACUUM ? -1 : static_cast<int>(record % scene.media.size());
}

std::uint32_t event_of(const EventRecord& record) {
    return record.event & ~EVENT_PASSING;
}

/// Order within an event: light on the way comes first, and light at the end arrives after the path
/// has gone on, or ended.
int rank(const EventRecord& record) {
    const std::uint32_t kind = record.kind_and_medium >> 16;
    if (record.event & EVENT_PASSING) return -1;
    return kind < EVENT_LIGHT ? 0 : kind == EVENT_LIGHT ? 1 : 2;
}

/// Puts a log into the order of events, and gives an end the light that arrived after it.
void sort_events(std::vector<EventRecord>& log) {
    std::stable_sort(log.begin(), log.end(), [](const EventRecord& a, const EventRecord& b) {
        return std::tuple(event_of(a), rank(a)) < std::tuple(event_of(b), rank(b));
    });
    for (std::size_t i = 1; i < log.size(); ++i)
        if (rank(log[i]) == 2 && rank(log[i - 1]) == 1 && log[i].event == log[i - 1].event)
            log[i].radiance = log[i - 1].radiance;
}

} // namespace

Replay replay_path(const gpu::Context& context, const Scene& scene, int x, int y,
                   std::uint32_t sample, std::uint32_t capacity) {
    Scene pixel = scene;
    pixel.film.bounds = {x, x + 1, y, y + 1};
    Renderer renderer(context, pixel, {.slots = 64, .log_capacity = capacity});
    renderer.render(sample, sample + 1);
    EventLog log = renderer.wavefront().read_log();
    sort_events(log.events);
    const glm::dvec3 camera(scene.camera.world_from_camera[3]);
    Replay replay{.camera = camera, .event_count = log.count, .sum = renderer.read_sums()[0]};
    for (std::size_t kind = 0; kind < HEALTH_COUNT; ++kind)
        replay.mishaps |= (renderer.health()[kind] > 0 ? 1u : 0u) << kind;
    const std::vector<const Shape*> shapes = record_shapes(scene);
    for (const EventRecord& record : log.events)
        replay.events.push_back({.kind = static_cast<PathEvent::Kind>(record.kind_and_medium >> 16),
                                 .event = event_of(record),
                                 .position = camera + glm::dvec3(record.position),
                                 .direction = record.direction,
                                 .medium = scene_medium(scene, record.kind_and_medium & 0xFFFFu),
                                 .throughput = record.throughput,
                                 .radiance = record.radiance,
                                 .shape = record.shape == NONE ? nullptr : shapes[record.shape]});
    return replay;
}

} // namespace tyndall
