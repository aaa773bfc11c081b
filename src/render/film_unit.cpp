#include "render/film_unit.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

double largest(const Rgb& c) {
    return std::max({c.r, c.g, c.b});
}

struct Brightness {
    double operator()(const InfiniteLight& light) const { return largest(light.radiance); }
    double operator()(const DistantLight& light) const { return largest(light.irradiance); }
    double operator()(const PointLight& light) const { return largest(light.intensity); }
    double operator()(const SpotLight& light) const { return largest(light.intensity); }
};

double emission(const Medium& medium) {
    double most = largest(medium.emission);
    const auto* grid = std::get_if<GridDensity>(&medium.density);
    if (!grid) return most;
    if (grid->emission_scale) most *= grid->emission_scale->max();
    if (grid->emission[0])
        most *= std::max(
            {grid->emission[0]->max(), grid->emission[1]->max(), grid->emission[2]->max()});
    return most;
}

} // namespace

double film_unit(const Scene& scene) {
    double most = 0;
    for (const Light& light : scene.lights)
        most = std::max(most, std::visit(Brightness{}, light.emitter));
    for (const AreaLight& light : scene.area_lights)
        most = std::max({most, largest(light.radiance), largest(light.power_radiance)});
    for (const Medium& medium : scene.media)
        most = std::max(most, emission(medium));
    most *= scene.camera.shutter_seconds * scene.film.iso / 100;
    // Errors are squared twice, and summed: 2^30 is far from the ends of the range.
    if (!(most > 0) || !std::isfinite(most) || (most > 0x1p-30 && most < 0x1p30)) return 1;
    return std::exp2(std::clamp(-std::floor(std::log2(most)), -126.0, 126.0));
}

} // namespace tyndall
