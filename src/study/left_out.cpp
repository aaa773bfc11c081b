// What a scene has and a picture could do without: each effect, left out.
#include "render/effects.h"
#include "shared/records.h"
#include "study/techniques.h"

#include <algorithm>

namespace tyndall::study {
namespace {

Rgb grey(const Rgb& c) {
    return Rgb((c.r + c.g + c.b) / 3);
}

/// What was scattered is absorbed; what is emitted stays.
void stop_scattering(Scene& scene) {
    for (Medium& m : scene.media) {
        const Rgb sigma_t = m.sigma_a + m.sigma_s;
        for (int c = 0; c < 3; ++c)
            if (sigma_t[c] > 0) m.emission[c] *= m.sigma_a[c] / sigma_t[c];
        m.sigma_a = sigma_t;
        m.sigma_s = Rgb(0);
    }
}

void make_media_grey(Scene& scene) {
    for (Medium& m : scene.media) {
        m.sigma_a = grey(m.sigma_a);
        m.sigma_s = grey(m.sigma_s);
    }
}

void stop_emission(Scene& scene) {
    for (Medium& m : scene.media) {
        m.emission = Rgb(0);
        if (auto* grid = std::get_if<GridDensity>(&m.density)) grid->temperature = nullptr;
    }
}

void remove_lights(Scene& scene, bool infinite) {
    std::erase_if(scene.lights, [=](const Light& light) {
        return std::holds_alternative<InfiniteLight>(light.emitter) == infinite;
    });
    if (infinite) return;
    for (AreaLight& light : scene.area_lights)
        light.radiance = light.power_radiance = Rgb(0);
    for (Shape& shape : scene.shapes)
        shape.area_light = -1;
}

void remove_surfaces(Scene& scene) {
    const auto is_surface = [&](const Shape& shape) {
        return scene.materials[static_cast<std::size_t>(shape.material)].kind !=
                   Material::Kind::interface &&
               shape.area_light < 0;
    };
    std::erase_if(scene.shapes, is_surface);
    for (ObjectDefinition& object : scene.objects)
        std::erase_if(object.shapes, is_surface);
}

void make_isotropic(Scene& scene) {
    for (Medium& m : scene.media)
        m.phases = {PhaseFunction{}};
}

} // namespace

void list_left_out(const Scene& scene, std::vector<Technique>& techniques) {
    const shared::Features f = compute_effects(scene).features;
    const auto offer = [&](bool makes_sense, const char* name, const char* title,
                           std::function<void(Scene&)> apply) {
        if (makes_sense)
            techniques.push_back({.name = std::string("without-") + name,
                                  .title = title,
                                  .family = Family::without,
                                  .apply = std::move(apply)});
    };
    const bool has_surfaces = f.surface_queues & ~(1u << shared::QUEUE_INTERFACE);
    offer(f.has_media && (has_surfaces || f.has_environment), "media", "media",
          [](Scene& s) { s.integrator.kind = Integrator::Kind::path; });
    offer(f.has_scattering && !f.has_rgb_grids, "scattering", "scattering in media",
          stop_scattering);
    offer(f.has_emission && (f.lights & ~shared::LIGHTS_VOXELS || f.has_environment), "emission",
          "emission of media", stop_emission);
    offer(f.has_media && f.is_chromatic && !f.has_rgb_grids, "colour", "colour of media",
          make_media_grey);
    offer(f.phases != 0, "phase-function", "direction of scattering (isotropic instead)",
          make_isotropic);
    offer(f.has_environment && f.lights, "environment", "light from infinity all around",
          [](Scene& s) { remove_lights(s, true); });
    offer(f.has_environment && f.lights, "sampled-lights", "lights other than that at infinity",
          [](Scene& s) { remove_lights(s, false); });
    offer(f.has_media && has_surfaces && (f.lights || f.has_environment), "surfaces",
          "surfaces that do not emit", remove_surfaces);
    offer(f.has_lens, "lens", "depth of field", [](Scene& s) { s.camera.lens_radius = 0; });
}

} // namespace tyndall::study
