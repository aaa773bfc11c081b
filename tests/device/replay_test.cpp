// A replay tells of the very path that was rendered, and device and reference tell the same.
#include "device/test_scenes.h"

#include "reference/reference.h"
#include "render/replay.h"
#include "support/materials.h"
#include "support/volumes.h"

namespace tyndall::device_test {
namespace {

using namespace support;
using Kind = PathEvent::Kind;

class ReplayTest : public DeviceTest {};

struct PathName {
    int x, y;
    std::uint32_t sample;
};
const std::vector<PathName> kPaths{{8, 8, 0}, {5, 11, 1}, {12, 6, 2}, {3, 9, 3}, {9, 4, 4}};

Replay reference_replay(const Scene& scene, const PathName& path) {
    return reference::ReferenceRenderer(scene).replay(path.x, path.y, path.sample);
}

Replay device_replay(const Scene& scene, const PathName& path) {
    return replay_path(context(), scene, path.x, path.y, path.sample);
}

std::string tell(const Replay& replay) {
    std::string text;
    for (const PathEvent& event : replay.events)
        text +=
            std::to_string(event.event) + ':' + std::to_string(static_cast<int>(event.kind)) + ' ';
    return text;
}

/// The cloud of a busy scene on voxels, hot.
Scene grid_scene(const Rgb& sigma_s) {
    Scene scene = busy_scene();
    const Lattice lattice{{-0.75, -0.75, -0.75}, {0.75, 0.75, 0.75}, {9, 12, 10}};
    GridDensity density =
        lattice.density([](const glm::ivec3& v) { return (v.x * v.y + 3 * v.z) % 7 / 3.0; }, 4);
    density.temperature = lattice.grid([](const glm::ivec3& v) { return 250.0 * v.y; });
    Medium& cloud = scene.media[1];
    cloud.density = density;
    cloud.world_from_medium = translation({1, 0.8, -0.25});
    cloud.sigma_s = sigma_s;
    cloud.emission = Rgb(0.02);
    return scene;
}

Scene atmosphere_scene() {
    Scene scene = busy_scene();
    scene.media[0].density = ExponentialDensity{
        .is_spherical = true, .origin = {0, -20, 0}, .radius = 20, .scale_height = 1};
    return scene;
}

Scene glass_scene() {
    Scene scene = busy_scene();
    scene.shapes[2].material = add_dielectric(scene, Rgb(1.5), 0.2);
    scene.shapes[3].material = add_dielectric(scene, Rgb(1.45, 1.5, 1.6));
    add_light(scene, PointLight{Rgb(3), {-1, 2, -1}});
    return scene;
}

/// The film of one sample has what the replay says, to the last bit.
void expect_rendered(const Scene& scene, const PathName& path, const Replay& replay) {
    const auto film = render_sums(scene, path.sample, path.sample + 1);
    const auto pixel = static_cast<std::size_t>(path.y * scene.film.width + path.x);
    EXPECT_EQ(replay.sum, film[pixel]);
    EXPECT_EQ(replay.mishaps, 0);
    ASSERT_GE(replay.events.size(), 2);
    EXPECT_EQ(replay.event_count, replay.events.size());
    EXPECT_EQ(replay.events.front().kind, Kind::camera);
    EXPECT_GE(replay.events.back().kind, Kind::escape); // or another end
    const Rgb told = replay.sum.w * replay.events.back().radiance;
    EXPECT_EQ(told, Rgb(replay.sum));
}

TEST_F(ReplayTest, TellsWhatIsRenderedAndAgreesWithTheReference) {
    Scene region = plain_scene();
    region.media[0].sigma_s = {0.5, 2, 8};
    add_light(region, PointLight{Rgb(3), {0.2, 0.3, -0.4}});
    int same = 0, all = 0, events = 0;
    for (const Scene& scene :
         {busy_scene(), region, grid_scene({1, 3, 9}), atmosphere_scene(), glass_scene()}) {
        for (const PathName& path : kPaths) {
            const Replay device = device_replay(scene, path);
            const Replay reference = reference_replay(scene, path);
            ++all;
            same += are_same(device, reference);
            events += static_cast<int>(reference.events.size());
            if (!are_same(device, reference))
                std::printf("path %d: event %zu of\n  %s and\n  %s\n", all,
                            first_difference(device, reference), tell(device).c_str(),
                            tell(reference).c_str());
        }
        expect_rendered(scene, kPaths[0], device_replay(scene, kPaths[0]));
    }
    EXPECT_GE(same, all - 2); // rounding may decide otherwise, but seldom
    EXPECT_GT(events, 8 * all);
}

/// The control: where the device has another medium, they part at the first flight through it.
TEST_F(ReplayTest, ShowsWhereTheyPart) {
    const Scene right = plain_scene();
    Scene wrong = right;
    wrong.media[0].sigma_s *= 1.2;
    int told = 0;
    for (const PathName& path : kPaths) {
        const Replay reference = reference_replay(right, path);
        const Replay device = device_replay(wrong, path);
        const auto collision =
            std::find_if(reference.events.begin(), reference.events.end(),
                         [](const PathEvent& e) { return e.kind == Kind::collision; });
        if (collision == reference.events.end()) continue;
        EXPECT_EQ(first_difference(device, reference),
                  static_cast<std::size_t>(collision - reference.events.begin()));
        ++told;
    }
    EXPECT_GE(told, 2);
}

TEST_F(ReplayTest, CountsWhatItHasNoRoomFor) {
    const Scene scene = busy_scene();
    const Replay whole = device_replay(scene, kPaths[0]);
    const Replay part = replay_path(context(), scene, kPaths[0].x, kPaths[0].y, 0, 3);
    EXPECT_EQ(part.events.size(), 3);
    EXPECT_EQ(part.event_count, whole.event_count);
    EXPECT_EQ(part.sum, whole.sum);
}

} // namespace
} // namespace tyndall::device_test
