#include "cli/options.h"

#include "core/error.h"
#include "gpu/context.h"
#include "reference/reference.h"
#include "render/replay.h"
#include "shared/health.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>

namespace tyndall::cli {
namespace {

constexpr std::array<const char*, 11> kKindNames{"camera",
                                                 "null collision",
                                                 "collision",
                                                 "surface",
                                                 "interface",
                                                 "light sampled",
                                                 "escapes",
                                                 "ends: roulette",
                                                 "ends: depth limit",
                                                 "ends: absorbed",
                                                 "ends: event limit or no direction"};

/// The path to replay.
struct PathName {
    int x, y;
    std::uint32_t sample;
};

PathName parse_path(const std::string& text, const Film& film) {
    long long x = 0, y = 0, sample = 0;
    int end = 0;
    const int read = std::sscanf(text.c_str(), "%lld,%lld,%lld%n", &x, &y, &sample, &end);
    if (read != 3 || text.size() != static_cast<std::size_t>(end))
        throw Error(ExitStatus::bad_input,
                    fmt::format("--replay \"{}\" is not of the form X,Y,SAMPLE", text));
    if (x < 0 || x >= film.width || y < 0 || y >= film.height || sample < 0 || sample > 0x7FFFFFFE)
        throw Error(ExitStatus::bad_input,
                    fmt::format("--replay {}: the picture has {} x {} pixels", text, film.width,
                                film.height));
    return {static_cast<int>(x), static_cast<int>(y), static_cast<std::uint32_t>(sample)};
}

std::string text_of(const glm::dvec3& v) {
    return fmt::format("{:<10.5g} {:<10.5g} {:<10.5g}", v.x, v.y, v.z);
}

/// Kind, medium, and place in the scene file.
std::string what(const Scene& scene, const PathEvent& event) {
    std::string text = kKindNames[static_cast<std::size_t>(event.kind)];
    if (event.medium >= 0) text += fmt::format(" in \"{}\"", scene.media[event.medium].name);
    if (!event.shape) return text;
    text += fmt::format(", shape {}", to_string(event.shape->where));
    const SourceLocation& material = scene.materials[event.shape->material].where;
    if (event.kind == PathEvent::Kind::surface && material.line > 0)
        text += fmt::format(", material {}", to_string(material));
    return text;
}

void print_event(const Scene& scene, const PathEvent* device, const PathEvent* reference,
                 bool differs) {
    const PathEvent& event = reference ? *reference : *device;
    const bool is_other = device && reference && device->kind != reference->kind;
    std::printf("%5u  %s%s\n", event.event, what(scene, event).c_str(),
                differs ? "   <-- DIFFERENT" : "");
    for (const auto& [letter, of] : {std::pair('D', device), std::pair('R', reference)})
        if (of)
            std::printf("     %c %s %s %s %s%s\n", letter, text_of(of->position).c_str(),
                        text_of(of->direction).c_str(), text_of(of->throughput).c_str(),
                        text_of(of->radiance).c_str(), is_other ? what(scene, *of).c_str() : "");
        else if (differs)
            std::printf("     %c -\n", letter);
}

std::string mishap_names(std::uint32_t mishaps) {
    std::string names;
    for (std::size_t kind = 0; kind < shared::kHealthNames.size(); ++kind)
        if (mishaps >> kind & 1u)
            names += std::string(names.empty() ? "" : ", ") + shared::kHealthNames[kind];
    return names.empty() ? "none" : names;
}

void print_end(char letter, const Replay& replay) {
    std::printf("sum  %c %s weight %g, %llu events, mishaps: %s\n", letter,
                text_of(Rgb(replay.sum)).c_str(), replay.sum.w,
                static_cast<unsigned long long>(replay.event_count),
                mishap_names(replay.mishaps).c_str());
    if (replay.event_count > replay.events.size())
        std::printf("      the last %llu events are not shown\n",
                    static_cast<unsigned long long>(replay.event_count - replay.events.size()));
}

/// The events of both; without a device, those of the reference alone.
void print_replays(const Scene& scene, const Replay& device, const Replay& reference,
                   std::size_t difference) {
    std::puts("event  what happened\n       position, direction, throughput (of a light: what it "
              "adds), radiance so far");
    const auto at = [](const Replay& replay, std::size_t i) {
        return i < replay.events.size() ? &replay.events[i] : nullptr;
    };
    const std::size_t count = std::max(device.events.size(), reference.events.size());
    for (std::size_t i = 0; i < count; ++i)
        print_event(scene, at(device, i), at(reference, i), i == difference);
    print_end('R', reference);
}

} // namespace

int run_replay(const RenderOptions& options) {
    const Scene scene = load_scene(options.scene, options.quiet);
    const PathName path = parse_path(options.replay, scene.film);
    const Replay reference =
        reference::ReferenceRenderer(scene).replay(path.x, path.y, path.sample);
    std::printf("%s, pixel %d,%d, sample %u\n", scene.filename.c_str(), path.x, path.y,
                path.sample);
    if (options.device.device == "reference") {
        print_replays(scene, {}, reference, reference.events.size());
        return static_cast<int>(ExitStatus::done);
    }
    const gpu::Context context(
        {.device = options.device.device, .validate = options.device.validate});
    const Replay device = replay_path(context, scene, path.x, path.y, path.sample);
    std::printf("D: %s   R: the reference, in double precision\n", context.info().name.c_str());
    const std::size_t difference = first_difference(device, reference);
    print_replays(scene, device, reference, difference);
    print_end('D', device);
    const bool is_same = are_same(device, reference);
    std::puts(is_same ? "the same path, up to rounding" : "DIFFERENT paths");
    return static_cast<int>(is_same ? ExitStatus::done : ExitStatus::failed);
}

} // namespace tyndall::cli
