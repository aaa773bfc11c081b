// Layers by scattering order (--aov orders).
#include "cli/orders.h"

#include "device/device_test.h"
#include "device/test_scenes.h"

#include <cmath>

namespace tyndall::device_test {
namespace {

class OrdersTest : public DeviceTest {};

std::vector<Rgb> layer(const Image& image, const std::string& name) {
    std::vector<Rgb> colors;
    const std::size_t first = image.channel_index(name + ".R").value();
    for (std::size_t i = 0; i < image.pixels.size(); i += image.channels.size())
        colors.emplace_back(image.pixels[i + first], image.pixels[i + first + 1],
                            image.pixels[i + first + 2]);
    return colors;
}

Image with_orders(const Scene& scene, const std::string& device, std::uint32_t samples) {
    Image film = render(scene, samples);
    // With the layer, as the context of the tests: entry points are those of the process.
    film = *cli::with_orders(film, scene, {.device = device, .validate = true}, samples,
                             [] { return false; });
    return film;
}

std::vector<Rgb> up_to(Scene scene, int depth, std::uint32_t samples) {
    scene.integrator.max_depth = depth;
    return colors_of(render(scene, samples));
}

/// Both have a hierarchy, or not; they emit, and scatter at surfaces and in media.
std::vector<Scene> scenes() {
    Scene glowing = plain_scene();
    glowing.media[0].emission = Rgb(0.5, 1, 2);
    return {busy_scene(), glowing};
}

TEST_F(OrdersTest, SumToTheImage) {
    for (const Scene& scene : scenes()) {
        const Image film = with_orders(scene, "", 4);
        std::vector<Rgb> sum(film.pixels.size() / film.channels.size(), Rgb(0));
        double rest = 0;
        for (const char* name : {"order0", "order1", "order2", "order3", "order4+"}) {
            const auto colors = layer(film, name);
            for (std::size_t i = 0; i < sum.size(); ++i) {
                sum[i] += colors[i];
                rest += name == std::string("order4+") ? colors[i].g : 0;
                EXPECT_GE(colors[i].g, -1e-6);
            }
        }
        const auto whole = colors_of(film);
        for (std::size_t i = 0; i < sum.size(); ++i)
            EXPECT_LT(glm::length(sum[i] - whole[i]), 1e-6 * (glm::length(whole[i]) + 1e-3)) << i;
        EXPECT_GT(rest, 0) << "no teeth: there is nothing beyond order 3";
    }
}

TEST_F(OrdersTest, AreDifferencesOfRendersWithFewerEvents) {
    for (const Scene& scene : scenes()) {
        const Image film = with_orders(scene, "", 4);
        const auto none = up_to(scene, 0, 4), once = up_to(scene, 1, 4);
        const auto order0 = layer(film, "order0"), order1 = layer(film, "order1");
        EXPECT_EQ(order0, none);
        for (std::size_t i = 0; i < none.size(); ++i)
            EXPECT_LT(glm::length(order1[i] - (once[i] - none[i])), 1e-6);
        EXPECT_NE(order1, layer(film, "order2")); // the control
    }
}

TEST_F(OrdersTest, AreThoseOfTheReference) {
    const Scene scene = plain_scene();
    const Image device = with_orders(scene, "", 4), reference = with_orders(scene, "reference", 4);
    for (const char* name : {"order0", "order1", "order2", "order3"}) {
        const auto a = layer(device, name), b = layer(reference, name);
        int equal = 0, bright = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            if (!(b[i].g > 1e-3)) continue;
            ++bright;
            equal += std::abs(a[i].g - b[i].g) < 1e-3 * b[i].g;
        }
        EXPECT_GT(bright, 30) << name;
        EXPECT_GE(equal, 0.97 * bright) << name; // in the rest, rounding decides between two ways
    }
}

} // namespace
} // namespace tyndall::device_test
