#include "render/scene_tables.h"

#include "core/error.h"
#include "render/film_unit.h"
#include "render/geometry_tables.h"
#include "render/light_reach.h"
#include "render/light_table.h"
#include "render/primitives.h"
#include "render/volume_tables.h"
#include "scene/emitting_voxels.h"
#include "scene/filter.h"
#include "shared/random.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

namespace tyndall {
namespace {

using namespace shared;

static_assert(sizeof(CameraRecord) == CAMERA_TEXELS * 16);
static_assert(sizeof(BallRecord) == 16);
static_assert(sizeof(MediumRecord) == MEDIUM_TEXELS * 16);
static_assert(sizeof(ShapeRecord) == SHAPE_TEXELS * 16);
static_assert(sizeof(LightRecord) == LIGHT_TEXELS * 16);
static_assert(sizeof(RegionRecord) == REGION_TEXELS * 16);

double mean(const Rgb& c) {
    return (c.r + c.g + c.b) / 3;
}

std::uint32_t medium_word(int medium) {
    return medium < 0 ? VACUUM : static_cast<std::uint32_t>(medium);
}

/// Packs a scene table by table.
class Packer {
  public:
    Packer(const Scene& scene, const Effects& effects)
        : scene_(scene), effects_(effects), origin_(scene.camera.world_from_camera[3]) {
        render_from_world_[3] = glm::dvec4(-origin_, 1);
        tables_.film_unit = film_unit(scene);
    }
    SceneTables pack();

  private:
    /// Appends a table and returns the texel at which it starts.
    template<typename T>
    std::uint32_t append(const std::vector<T>& table, const char* name);

    void count_bytes(const char* name, std::size_t bytes);
    CameraRecord camera() const;
    MarchRecord march() const;
    std::vector<glm::vec4> filter_table() const;
    std::vector<ShapeRecord> shapes();
    void collect_emitters();
    std::vector<LightRecord> lights();
    void pack_geometry();

    struct Emitter {
        std::uint32_t primitive;
        Rgb radiance;
        double power;
    };

    const Scene& scene_;
    const Effects& effects_;
    glm::dvec3 origin_;
    glm::dmat4 render_from_world_{1};
    SceneTables tables_;
    std::optional<VolumePacker> volumes_;
    std::vector<const Shape*> shape_list_; ///< By shape record.
    GeometryTables geometry_;
    std::vector<Emitter> emitters_;
};

template<typename T>
std::uint32_t Packer::append(const std::vector<T>& table, const char* name) {
    static_assert(sizeof(T) % 16 == 0);
    const std::size_t start = tables_.texels.size();
    const std::size_t bytes = table.size() * sizeof(T);
    tables_.texels.resize(start + bytes / 16);
    if (bytes) std::memcpy(tables_.texels.data() + start, table.data(), bytes);
    if (bytes) count_bytes(name, bytes);
    if (tables_.texels.size() > 0x7FFFFFFFu)
        throw Error(ExitStatus::failed, "the scene is too large: its tables exceed 2^31 texels");
    return static_cast<std::uint32_t>(start);
}

/// Adds to what --stats tells of a table; several may share a name.
void Packer::count_bytes(const char* name, std::size_t bytes) {
    for (auto& [known, sum] : tables_.bytes)
        if (known == name) {
            sum += bytes;
            return;
        }
    tables_.bytes.emplace_back(name, bytes);
}

CameraRecord Packer::camera() const {
    const Camera& camera = scene_.camera;
    const Film& film = scene_.film;
    const std::array<double, 4>& window = camera.screen_window;
    const bool perspective = camera.kind == Camera::Kind::perspective;
    const double scale = perspective ? std::tan(camera.fov * 3.14159265358979323846 / 360) : 1;
    const glm::dmat3 linear(camera.world_from_camera);
    const glm::dvec3 corner = scale * (window[0] * linear[0] + window[3] * linear[1]);

    CameraRecord record{};
    record.origin_0 = perspective ? glm::dvec3(0) : corner;
    record.direction_0 = perspective ? corner + linear[2] : linear[2];
    record.direction_x = scale * (window[1] - window[0]) / film.width * linear[0];
    record.direction_y = -scale * (window[3] - window[2]) / film.height * linear[1];
    record.lens_u = camera.lens_radius * linear[0];
    record.lens_v = camera.lens_radius * linear[1];
    record.inverse_focal_distance = static_cast<float>(1 / camera.focal_distance);
    record.medium = effects_.has_camera_medium ? medium_word(camera.medium) : VACUUM;
    record.clamp = static_cast<float>(std::min(film.max_component_value, 3.4e38));
    record.exposure = static_cast<float>(camera.shutter_seconds * film.iso / 100);
    record.filter_x_radius = static_cast<float>(scene_.filter.x_radius);
    record.filter_y_radius = static_cast<float>(scene_.filter.y_radius);
    record.environment = effects_.environment;
    record.filter_cells = FilterTable::cell_count;
    return record;
}

MarchRecord Packer::march() const {
    const Integrator& integrator = scene_.integrator;
    return {.steps = static_cast<std::uint32_t>(integrator.steps),
            .step_size = static_cast<float>(integrator.step_size),
            .film_unit = static_cast<float>(tables_.film_unit)};
}

std::vector<glm::vec4> Packer::filter_table() const {
    std::vector<glm::vec4> nodes;
    if (effects_.features.filter_kind != FILTER_TABLE) return nodes;
    for (double radius : {scene_.filter.x_radius, scene_.filter.y_radius}) {
        const FilterTable table = make_filter_table(scene_.filter, radius);
        for (int i = 0; i <= FilterTable::cell_count; ++i)
            nodes.emplace_back(table.density[i], table.cdf[i], table.sign_change, 0);
    }
    return nodes;
}

std::vector<ShapeRecord> Packer::shapes() {
    for (const Shape& shape : scene_.shapes)
        shape_list_.push_back(&shape);
    for (const ObjectDefinition& object : scene_.objects)
        for (const Shape& shape : object.shapes)
            shape_list_.push_back(&shape);
    std::vector<ShapeRecord> records;
    for (const Shape* shape : shape_list_) {
        const Material& material = scene_.materials[shape->material];
        ShapeRecord record{};
        if (material.kind == Material::Kind::interface) record.flags |= SHAPE_INTERFACE;
        if (material.kind == Material::Kind::thin_dielectric) record.flags |= SHAPE_THIN;
        if (shape->media.is_transition() && effects_.features.has_media)
            record.flags |= SHAPE_TRANSITION;
        if (shape->area_light >= 0) {
            record.flags |= SHAPE_EMITS;
            if (scene_.area_lights[shape->area_light].two_sided) record.flags |= SHAPE_TWO_SIDED;
        }
        record.medium_inside = medium_word(shape->media.inside);
        record.medium_outside = medium_word(shape->media.outside);
        record.queue = queue_of(material);
        record.reflectance = material.reflectance;
        record.alpha = static_cast<float>(material.alpha);
        record.eta = material.eta;
        record.k = material.k;
        records.push_back(record);
    }
    return records;
}

/// Every primitive that emits is a light of its own, in the order of the scene (not of the
/// hierarchy).
void Packer::collect_emitters() {
    for (std::uint32_t i = 0; i < geometry_.primitives.size(); ++i) {
        if (geometry_.primitives[i].kind_and_shape >> KIND_SHIFT == KIND_INSTANCE) continue;
        const Shape& shape = *shape_list_[geometry_.primitives[i].kind_and_shape & SHAPE_MASK];
        if (shape.area_light < 0 || !(geometry_.areas[i] > 0)) continue;
        constexpr std::array<std::uint32_t, 4> kinds{PRIMITIVE_TRIANGLES, PRIMITIVE_PATCHES,
                                                     PRIMITIVE_SPHERES, PRIMITIVE_DISKS};
        tables_.emitters |= kinds[geometry_.primitives[i].kind_and_shape >> KIND_SHIFT];
        const AreaLight& light = scene_.area_lights[shape.area_light];
        const Rgb radiance = light.radiance + light.power_radiance / geometry_.areas[i];
        const double sides = light.two_sided ? 2 : 1;
        emitters_.push_back(
            {i, radiance, sides * 3.14159265358979323846 * geometry_.areas[i] * mean(radiance)});
    }
    std::sort(emitters_.begin(), emitters_.end(), [&](const Emitter& a, const Emitter& b) {
        return geometry_.source_order[a.primitive] < geometry_.source_order[b.primitive];
    });
}

std::vector<LightRecord> Packer::lights() {
    constexpr double pi = 3.14159265358979323846;
    std::vector<LightRecord> records;
    std::vector<double> powers;
    if (!effects_.lists_lights) return records;
    // What a distant light shines on: the ball around all surfaces; without any, that of radius 1.
    const double diameter =
        glm::length(glm::dvec3(geometry_.bounds.upper) - glm::dvec3(geometry_.bounds.lower));
    const double disk = diameter > 0 ? pi * diameter * diameter / 4 : pi;
    for (const Light& light : scene_.lights) {
        if (const auto* d = std::get_if<DistantLight>(&light.emitter)) {
            records.push_back({.position = d->direction,
                               .kind = LIGHT_DISTANT,
                               .radiance = d->irradiance,
                               .reach = static_cast<float>(1 / disk)});
            powers.push_back(mean(d->irradiance) * disk);
        } else if (const auto* p = std::get_if<PointLight>(&light.emitter)) {
            records.push_back({.position = p->position - origin_,
                               .kind = LIGHT_POINT,
                               .radiance = p->intensity,
                               .reach = static_cast<float>(1 / (4 * pi))});
            powers.push_back(mean(p->intensity) * 4 * pi);
        } else if (const auto* s = std::get_if<SpotLight>(&light.emitter)) {
            const double angle = 2 * pi * (1 - (s->cos_falloff_start + s->cos_total_width) / 2);
            records.push_back({.position = s->position - origin_,
                               .kind = LIGHT_SPOT,
                               .radiance = s->intensity,
                               .axis = s->axis,
                               .complement_start = static_cast<float>(1 - s->cos_falloff_start),
                               .complement_width = static_cast<float>(1 - s->cos_total_width),
                               .reach = static_cast<float>(1 / angle)});
            powers.push_back(mean(s->intensity) * angle);
        }
    }
    const std::size_t first_grid = records.size();
    std::vector<VolumePacker::VoxelLight> grids;
    for (int medium : emitting_grids(scene_)) {
        const VolumePacker::VoxelLight light = volumes_->pack_voxel_light(medium);
        if (light.total == 0) continue;
        grids.push_back(light);
        records.push_back({.kind = LIGHT_VOXELS, .primitive = light.texel});
        set_voxel_reach(records.back(), light);
        powers.push_back(light.total * 4 * pi);
    }
    for (const Emitter& e : emitters_) {
        const Shape& shape =
            *shape_list_[geometry_.primitives[e.primitive].kind_and_shape & SHAPE_MASK];
        const bool two_sided = scene_.area_lights[shape.area_light].two_sided;
        records.push_back({.kind = two_sided ? LIGHT_AREA_TWO_SIDED : LIGHT_AREA,
                           .radiance = e.radiance,
                           .primitive = e.primitive});
        set_area_reach(records.back(), geometry_);
        powers.push_back(e.power);
    }
    const std::vector<AliasCell> cells = make_alias_table(powers);
    std::vector<AliasRecord> table;
    for (std::size_t i = 0; i < records.size(); ++i) {
        records[i].probability = static_cast<float>(cells[i].probability);
        table.push_back(
            {.threshold = static_cast<float>(cells[i].threshold), .alias = cells[i].alias});
    }
    tables_.push.alias_table = append(table, "light choice");
    for (std::size_t i = 0; i < grids.size(); ++i) {
        const double chance =
            std::min(1.0, effects_.features.light_candidates * cells[first_grid + i].probability);
        tables_.texels[grids[i].density + GRID_LIGHT_DENSITY].w =
            std::bit_cast<std::uint32_t>(static_cast<float>(chance / grids[i].total));
    }
    return records;
}

void Packer::pack_geometry() {
    collect_emitters();
    const std::vector<LightRecord> light_records = lights();
    const auto first_area_light = static_cast<std::uint32_t>(
        light_records.size() - std::min(light_records.size(), emitters_.size()));
    for (std::uint32_t i = 0; i < emitters_.size() && !light_records.empty(); ++i)
        geometry_.primitives[emitters_[i].primitive].light = first_area_light + i;
    tables_.push.primitives = append(geometry_.primitives, "primitives");
    tables_.push.nodes = append(geometry_.nodes, "hierarchy");
    tables_.push.vertex_normals = append(geometry_.vertex_normals, "vertex normals");
    tables_.push.quadrics = append(geometry_.quadrics, "quadrics");
    tables_.push.instances = append(geometry_.instances, "instances");
    tables_.push.light_count = static_cast<std::uint32_t>(light_records.size());
    tables_.push.lights = append(light_records, "lights");
}

SceneTables Packer::pack() {
    append(std::vector{camera()}, "camera");
    append(std::vector{march()}, "march");
    if (const auto& ball = effects_.lit_ball)
        append(std::vector{BallRecord{ball->center - origin_, static_cast<float>(ball->radius)}},
               "lit ball");
    tables_.push.filter_table = append(filter_table(), "pixel filter");
    volumes_.emplace(scene_, render_from_world_,
                     [this](const std::vector<glm::uvec4>& table, const char* name) {
                         return append(table, name);
                     });
    tables_.push.blackbody =
        effects_.features.has_temperature ? append(make_blackbody_table(), "black body") : NONE;
    if (effects_.region) {
        const Region& r = *effects_.region;
        RegionRecord record{};
        const glm::dmat4 world_from_render = glm::inverse(render_from_world_);
        record.unit_from_world = make_affine(r.unit_from_world * world_from_render);
        record.lower = glm::vec3(r.lower - origin_);
        record.upper = glm::vec3(r.upper - origin_);
        record.medium = medium_word(r.medium);
        tables_.push.region = append(std::vector{record}, "region");
        geometry_.bounds = {record.lower, record.upper};
    }
    if (effects_.features.geometry == GEOMETRY_BVH) {
        tables_.push.shapes = append(shapes(), "shapes");
        geometry_ = make_geometry_tables(scene_, render_from_world_, [this](const glm::dmat4& m) {
            return volumes_->medium_shift(m);
        });
        tables_.primitives = geometry_.kinds;
        tables_.push.triangle_root = geometry_.world.triangles;
        tables_.push.other_root = geometry_.world.others;
        tables_.push.instance_root = geometry_.instance_root;
    }
    pack_geometry();
    tables_.push.media = append(volumes_->take_records(), "media");
    tables_.voxels = volumes_->take_voxels();
    const Film& film = scene_.film;
    tables_.push.seed = {static_cast<std::uint32_t>(scene_.seed),
                         static_cast<std::uint32_t>(scene_.seed >> 32)};
    tables_.push.width = static_cast<std::uint32_t>(film.bounds.width());
    tables_.push.pixel_count =
        tables_.push.width * static_cast<std::uint32_t>(film.bounds.height());
    tables_.push.x0 = static_cast<std::uint32_t>(film.bounds.x0);
    tables_.push.y0 = static_cast<std::uint32_t>(film.bounds.y0);
    tables_.push.full_width = static_cast<std::uint32_t>(film.width);
    tables_.push.max_depth = static_cast<std::uint32_t>(scene_.integrator.max_depth);
    tables_.push.roulette_scale =
        effects_.environment == Rgb(0) ? ROULETTE_SCALE : ROULETTE_SCALE_IN_ENVIRONMENT;
    return std::move(tables_);
}

} // namespace

SceneTables make_scene_tables(const Scene& scene, const Effects& effects) {
    return Packer(scene, effects).pack();
}

} // namespace tyndall
