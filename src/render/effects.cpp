#include "render/effects.h"

#include "core/error.h"
#include "render/phase_tables.h"
#include "scene/contacts.h"
#include "scene/emitting_voxels.h"
#include "scene/light_candidates.h"
#include "shared/records.h"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <limits>

namespace tyndall {
namespace {

using namespace shared;

bool is_grey(const Rgb& c) {
    return c.r == c.g && c.g == c.b;
}
bool is_black(const Rgb& c) {
    return c.r == 0 && c.g == 0 && c.b == 0;
}

/// Marching finds lights in no other way.
bool samples_lights(const Integrator& integrator) {
    return integrator.samples_lights || integrator.kind == Integrator::Kind::singlescatter;
}

/// Collects effects and remembers what called for each.
class Collector {
  public:
    explicit Collector(const Scene& scene) : scene_(scene) {}

    Effects collect();

  private:
    void add(std::string name, bool on, std::string called_for) {
        effects_.list.push_back(
            {std::move(name), on ? "yes" : "no", on ? std::move(called_for) : ""});
    }
    void add_value(std::string name, std::string value, std::string called_for = "") {
        effects_.list.push_back({std::move(name), std::move(value), std::move(called_for)});
    }
    void each_shape(const std::function<void(const Shape&)>& visit) const {
        for (const Shape& shape : scene_.shapes)
            visit(shape);
        for (const ObjectInstance& instance : scene_.instances)
            for (const Shape& shape : scene_.objects[instance.object].shapes)
                visit(shape);
    }
    bool has_queue(std::uint32_t queue) const {
        return effects_.features.surface_queues >> queue & 1u;
    }
    void collect_material(const Material& material);
    void collect_geometry();
    void collect_density(const Medium& medium, const std::string& by);
    void collect_phases(const Medium& medium, const std::string& by);
    void tell_phases();
    void collect_media();
    void check_can_be_found(const Light& light) const;
    void collect_lights();
    void collect_camera();
    bool is_all_grey() const;

    const Scene& scene_;
    Effects effects_;
    bool has_isotropic_phases_ = false;
    std::string emitter_by_, phases_by_, dispersion_by_, grid_by_, atmosphere_by_, temperature_by_,
        closed_by_, thin_by_; ///< thin: a homogeneous medium that scatters
};

std::string place(const char* what, const SourceLocation& where) {
    const std::string text = to_string(where);
    return text.empty() ? what : fmt::format("{} at {}", what, text);
}

/// What the material of a shape calls for, beyond its stage.
void Collector::collect_material(const Material& material) {
    shared::Features& f = effects_.features;
    if (material.kind == Material::Kind::thin_dielectric) f.has_thin_panes = 1;
    const bool is_dielectric = material.kind == Material::Kind::dielectric ||
                               material.kind == Material::Kind::thin_dielectric;
    if (is_dielectric && !is_grey(material.eta))
        f.has_dispersion = 1, dispersion_by_ = place("material", material.where);
}

void Collector::collect_geometry() {
    shared::Features& f = effects_.features;
    effects_.region = find_region(scene_);
    f.has_thin_panes = f.has_dispersion = 0;
    f.surface_queues = f.has_interfaces = f.has_emitters = f.has_shading_normals = 0;
    std::string normals_by;
    std::array<std::string, QUEUE_COUNT> surface_by;
    each_shape([&](const Shape& shape) {
        const auto* mesh = std::get_if<Mesh>(&shape.geometry);
        if (mesh && !mesh->normals.empty())
            f.has_shading_normals = 1, normals_by = place("mesh", shape.where);
        const std::uint32_t queue = queue_of(scene_.materials[shape.material]);
        f.surface_queues |= 1u << queue, surface_by[queue] = place("shape", shape.where);
        collect_material(scene_.materials[shape.material]);
        if (shape.area_light >= 0) f.has_emitters = 1, emitter_by_ = place("shape", shape.where);
    });
    f.has_interfaces = has_queue(QUEUE_INTERFACE);
    const int around = scene_.camera.medium;
    const bool is_empty = scene_.integrator.kind != Integrator::Kind::singlescatter &&
                          scene_.shapes.empty() && scene_.instances.empty() &&
                          (around < 0 || scene_.media[around].is_homogeneous());
    f.geometry = effects_.region ? effects_.region->geometry
                 : is_empty      ? GEOMETRY_NONE
                                 : GEOMETRY_BVH;
    constexpr std::array<const char*, 4> names{"nothing", "one box", "one ellipsoid", "hierarchy"};
    add_value("geometry", names[f.geometry]);
    add("interfaces", f.has_interfaces, surface_by[QUEUE_INTERFACE]);
    add("diffuse surfaces", has_queue(QUEUE_SURFACE), surface_by[QUEUE_SURFACE]);
    add("smooth dielectrics", has_queue(QUEUE_DIELECTRIC), surface_by[QUEUE_DIELECTRIC]);
    add("rough dielectrics", has_queue(QUEUE_ROUGH_DIELECTRIC), surface_by[QUEUE_ROUGH_DIELECTRIC]);
    add("smooth metal", has_queue(QUEUE_CONDUCTOR), surface_by[QUEUE_CONDUCTOR]);
    add("rough metal", has_queue(QUEUE_ROUGH_CONDUCTOR), surface_by[QUEUE_ROUGH_CONDUCTOR]);
    add("dispersion", f.has_dispersion, dispersion_by_);
    add("emitting surfaces", f.has_emitters, emitter_by_);
    add("shading normals", f.has_shading_normals, normals_by);
    const Shape* contact = f.has_interfaces ? find_contact(scene_) : nullptr;
    f.has_contacts = contact != nullptr;
    add("boundaries in touch", f.has_contacts, contact ? place("shape", contact->where) : "");
    add("instances", !scene_.instances.empty(),
        scene_.instances.empty() ? "" : place("instance", scene_.instances.back().where));
}

/// What the density of a medium calls for.
void Collector::collect_density(const Medium& medium, const std::string& by) {
    shared::Features& f = effects_.features;
    bool is_tracked = false;
    if (const auto* exponential = std::get_if<ExponentialDensity>(&medium.density)) {
        f.densities |= exponential->is_spherical ? DENSITY_BIT_SPHERE : DENSITY_BIT_PLANE;
        is_tracked = exponential->is_spherical;
        atmosphere_by_ = by;
    }
    if (const auto* grid = std::get_if<GridDensity>(&medium.density)) {
        f.densities |= DENSITY_BIT_GRID;
        is_tracked = true;
        grid_by_ = by;
        if (!grid->density) {
            // Coefficients by voxel and channel: taken for chromatic without looking at each voxel.
            f.has_rgb_grids = 1;
            if (scene_.integrator.kind == Integrator::Kind::volpath)
                f.is_chromatic |= f.has_scattering | f.is_analog;
        }
        if (grid->temperature) f.has_temperature = 1, temperature_by_ = by;
    }
    if (!is_tracked) f.has_closed_media = 1, closed_by_ = by;
}

/// What the phase functions of a medium that scatters call for.
void Collector::collect_phases(const Medium& medium, const std::string& by) {
    shared::Features& f = effects_.features;
    for (const PhaseFunction& phase : medium.phases) {
        if (phase.kind == PhaseFunction::Kind::henyey_greenstein && phase.g == 0)
            has_isotropic_phases_ = true;
        else
            f.phases |= 1u << phase_kind(phase.kind), phases_by_ = by;
    }
    if (medium.phases.size() > 1) f.has_mixtures = 1, phases_by_ = by;
    if (is_chromatic(medium.phases)) f.has_chromatic_phases = 1;
    if (has_delta(medium.phases)) f.has_delta_phases = 1;
}

void Collector::tell_phases() {
    shared::Features& f = effects_.features;
    // Isotropic scattering beside other kinds is a Henyey-Greenstein function with g = 0.
    if (has_isotropic_phases_ && (f.phases || f.has_mixtures))
        f.phases |= PHASE_BIT_HENYEY_GREENSTEIN;
    constexpr std::array<const char*, 4> names{"Henyey-Greenstein", "Schlick", "Rayleigh",
                                               "Lorenz-Mie"};
    std::string value;
    for (std::size_t kind = 0; kind < names.size(); ++kind)
        if (f.phases >> kind & 1u) value += (value.empty() ? "" : ", ") + std::string(names[kind]);
    if (value.empty()) value = f.has_scattering ? "isotropic" : "no";
    add_value("phase functions", value, phases_by_);
    add("mixtures of phases", f.has_mixtures, phases_by_);
    add("chromatic phases", f.has_chromatic_phases, phases_by_);
    add("delta phases", f.has_delta_phases, phases_by_);
}

void Collector::collect_media() {
    shared::Features& f = effects_.features;
    f.densities = f.has_rgb_grids = f.has_temperature = f.has_closed_media = 0;
    f.has_media = f.has_scattering = f.has_emission = f.is_analog = 0;
    f.phases = f.has_mixtures = f.has_chromatic_phases = f.has_delta_phases = 0;
    f.is_chromatic =
        f.has_dispersion; // a path that is dispersed goes on in the channel of its hero
    std::string media_by, scattering_by, emission_by, analog_by, chromatic_by = dispersion_by_;
    std::vector<bool> used(scene_.media.size(), false);
    const auto use = [&](int medium) {
        if (medium >= 0) used[medium] = true;
    };
    use(scene_.camera.medium);
    each_shape([&](const Shape& shape) {
        if (!shape.media.is_transition()) return;
        use(shape.media.inside);
        use(shape.media.outside);
    });
    const bool wanted = scene_.integrator.kind != Integrator::Kind::path;
    const bool marches = scene_.integrator.kind == Integrator::Kind::singlescatter;
    for (std::size_t i = 0; wanted && i < scene_.media.size(); ++i) {
        if (!used[i]) continue;
        const Medium& m = scene_.media[i];
        const std::string by = place(fmt::format("medium \"{}\"", m.name).c_str(), m.where);
        f.has_media = 1, media_by = by;
        if (!is_black(m.sigma_s)) {
            f.has_scattering = 1, scattering_by = by;
            collect_phases(m, by);
            if (m.is_homogeneous()) thin_by_ = by;
            if ((!is_grey(m.sigma_s) && !marches) || is_chromatic(m.phases))
                f.is_chromatic = 1, chromatic_by = by;
        }
        if (scene_.integrator.absorption == Integrator::Absorption::analog && !marches &&
            !is_black(m.sigma_a)) {
            f.is_analog = 1, analog_by = by;
            if (!is_grey(m.sigma_a)) f.is_chromatic = 1, chromatic_by = by;
        }
        if (!is_black(m.emission) && !is_black(m.sigma_a)) f.has_emission = 1, emission_by = by;
        collect_density(m, by);
    }
    if (marches && (f.has_scattering || f.densities & DENSITY_BITS_TRACKED))
        f.march = MARCH_UNIFORM + static_cast<std::uint32_t>(scene_.integrator.placement);
    f.marches_shadows = scene_.integrator.transmittance == Integrator::Transmittance::marched &&
                        f.densities & DENSITY_BITS_TRACKED;
    effects_.has_camera_medium = f.has_media && scene_.camera.medium >= 0;
    add("media", f.has_media, media_by);
    add("scattering", f.has_scattering, scattering_by);
    add_value("absorption", f.is_analog ? "analog" : "expected", analog_by);
    add("emission of media", f.has_emission, emission_by);
    tell_phases();
    add("spectral MIS", f.is_chromatic, chromatic_by);
    add("media in closed form", f.has_closed_media, closed_by_);
    add("grids", f.densities & DENSITY_BIT_GRID, grid_by_);
    add("black body emission", f.has_temperature, temperature_by_);
    add("exponential atmospheres", f.densities & (DENSITY_BIT_PLANE | DENSITY_BIT_SPHERE),
        atmosphere_by_);
    add_value("transmittance", f.marches_shadows ? "marched" : "unbiased");
    constexpr std::array<const char*, 4> steps{"none", "uniform", "jittered", "equiangular"};
    add_value("marching", steps[f.march], f.march ? "Integrator \"singlescatter\"" : "");
}

/// Nothing runs into a light without a surface.
void Collector::check_can_be_found(const Light& light) const {
    if (samples_lights(scene_.integrator)) return;
    const char* kind = std::holds_alternative<DistantLight>(light.emitter) ? "distant"
                       : std::holds_alternative<PointLight>(light.emitter) ? "point"
                                                                           : "spot";
    throw SceneError(
        {fmt::format("{}: error: nothing finds a {} light without light sampling "
                     "(expected \"bool lightsampling\" true, or lights with a surface)",
                     to_string(light.where), kind)});
}

void Collector::collect_lights() {
    shared::Features& f = effects_.features;
    f.lights =
        (f.has_emitters ? LIGHTS_AREA : 0) | (emitting_grids(scene_).empty() ? 0 : LIGHTS_VOXELS);
    std::string environment_by, distant_by, point_by, spot_by;
    for (const Light& light : scene_.lights) {
        const std::string by = place("light", light.where);
        if (const auto* infinite = std::get_if<InfiniteLight>(&light.emitter)) {
            effects_.environment += infinite->radiance;
            environment_by = by;
            continue;
        }
        check_can_be_found(light);
        if (std::holds_alternative<DistantLight>(light.emitter))
            f.lights |= LIGHTS_DISTANT, distant_by = by;
        else if (std::holds_alternative<PointLight>(light.emitter))
            f.lights |= LIGHTS_POINT, point_by = by;
        else
            f.lights |= LIGHTS_SPOT, spot_by = by;
    }
    f.has_environment = !is_black(effects_.environment);
    // Light sampling starts from where light is scattered.
    if (!f.has_scattering && !(f.surface_queues & ~(1u << QUEUE_INTERFACE))) f.lights = 0;
    const std::uint32_t lights = f.lights;
    effects_.lists_lights = f.lights != 0;
    if (!samples_lights(scene_.integrator)) f.lights = 0;
    f.light_candidates = f.lights ? light_candidates(scene_) : 1;
    if (f.has_scattering) effects_.lit_ball = find_lit_ball(scene_);
    f.has_lit_ball = effects_.lit_ball.has_value();
    f.has_equiangular = f.lights & (LIGHTS_POINT | LIGHTS_SPOT) && !thin_by_.empty() &&
                        scene_.integrator.kind == Integrator::Kind::volpath &&
                        scene_.integrator.absorption == Integrator::Absorption::expected;
    add("environment", f.has_environment, environment_by);
    add_value("light sampling", f.lights ? "on" : "off");
    add("area lights", lights & LIGHTS_AREA, emitter_by_);
    add("grids as lights", lights & LIGHTS_VOXELS, grid_by_);
    add("distant lights", lights & LIGHTS_DISTANT, distant_by);
    add("point lights", lights & LIGHTS_POINT, point_by);
    add("spot lights", lights & LIGHTS_SPOT, spot_by);
    add("choice among lights", f.light_candidates > 1, "more lights than one");
    add("equiangular sampling", f.has_equiangular,
        fmt::format("{} in {}", spot_by.empty() ? point_by : spot_by, thin_by_));
    add("roulette by reach of light", f.has_lit_ball, "a medium without end");
}

bool Collector::is_all_grey() const {
    bool grey = is_grey(effects_.environment);
    for (const Medium& m : scene_.media)
        grey = grey && is_grey(m.sigma_a) && is_grey(m.sigma_s) && is_grey(m.emission);
    const shared::Features& f = effects_.features;
    grey = grey && !f.has_rgb_grids && !f.has_temperature && !f.has_chromatic_phases;
    for (const Material& m : scene_.materials)
        grey = grey && is_grey(m.reflectance) && is_grey(m.eta) && is_grey(m.k);
    for (const AreaLight& a : scene_.area_lights)
        grey = grey && is_grey(a.radiance) && is_grey(a.power_radiance);
    for (const Light& light : scene_.lights) {
        if (const auto* d = std::get_if<DistantLight>(&light.emitter))
            grey = grey && is_grey(d->irradiance);
        if (const auto* p = std::get_if<PointLight>(&light.emitter))
            grey = grey && is_grey(p->intensity);
        if (const auto* s = std::get_if<SpotLight>(&light.emitter))
            grey = grey && is_grey(s->intensity);
    }
    return grey;
}

void Collector::collect_camera() {
    shared::Features& f = effects_.features;
    switch (scene_.filter.kind) {
    case PixelFilter::Kind::box:
        f.filter_kind = FILTER_BOX;
        break;
    case PixelFilter::Kind::triangle:
        f.filter_kind = FILTER_TRIANGLE;
        break;
    default:
        f.filter_kind = FILTER_TABLE;
        break;
    }
    f.has_lens = scene_.camera.lens_radius > 0;
    f.has_clamp = scene_.film.max_component_value < std::numeric_limits<double>::infinity();
    f.is_orthographic = scene_.camera.kind == Camera::Kind::orthographic;
    constexpr std::array<const char*, 3> filters{"box", "triangle", "tabulated"};
    f.sampler_kind = SAMPLER_INDEPENDENT + static_cast<std::uint32_t>(scene_.sampler);
    f.zsobol_bits = scene_.sampler == Sampler::zsobol ? scene_.zsobol_bits() : 0;
    add_value("pixel filter", filters[f.filter_kind]);
    constexpr std::array<const char*, 3> samplers{"independent", "Sobol'", "Sobol', Z order"};
    add_value("sampler", samplers[f.sampler_kind],
              scene_.sampler_where.line > 0 ? place("Sampler", scene_.sampler_where) : "");
    add("depth of field", f.has_lens, "lensradius");
    add("radiance limit", f.has_clamp, "maxcomponentvalue");
}

Effects Collector::collect() {
    collect_geometry();
    collect_media();
    collect_lights();
    collect_camera();
    effects_.features.is_grey = is_all_grey();
    effects_.features.event_limit = scene_.integrator.event_limit;
    add_value("channels", effects_.features.is_grey ? "1" : "3");
    return std::move(effects_);
}

} // namespace

std::uint32_t queue_of(const Material& material) {
    const bool is_rough = material.alpha >= 1e-3;
    switch (material.kind) {
    case Material::Kind::interface:
        return QUEUE_INTERFACE;
    case Material::Kind::diffuse:
        return QUEUE_SURFACE;
    case Material::Kind::thin_dielectric:
        return QUEUE_DIELECTRIC;
    case Material::Kind::dielectric:
        // The facets of a boundary that does not bend light do nothing.
        return is_rough && material.eta != Rgb(1) ? QUEUE_ROUGH_DIELECTRIC : QUEUE_DIELECTRIC;
    case Material::Kind::conductor:
        return is_rough ? QUEUE_ROUGH_CONDUCTOR : QUEUE_CONDUCTOR;
    }
    return QUEUE_SURFACE;
}

Effects compute_effects(const Scene& scene) {
    return Collector(scene).collect();
}

} // namespace tyndall
