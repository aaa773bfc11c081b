#include "device/full_scene.h"

#include "device/test_scenes.h"
#include "support/materials.h"
#include "support/phases.h"
#include "support/volumes.h"

#include <glm/gtc/matrix_transform.hpp>

namespace tyndall::device_test {
namespace {

using namespace support;

class FullScene {
  public:
    explicit FullScene(std::string missing) : missing_(std::move(missing)) {}

    Scene make() {
        scene_ = empty_scene(12);
        scene_.integrator.max_depth = 12;
        set_camera();
        add_room();
        add_media();
        add_balls();
        add_lights();
        return std::move(scene_);
    }

  private:
    bool has(const char* effect) const { return missing_ != effect; }

    void set_camera() {
        Camera& camera = scene_.camera;
        camera.kind = Camera::Kind::perspective;
        camera.fov = 45;
        camera.world_from_camera = look_at({0, 1.6, -5}, {0, 0.9, 0}, {0, 1, 0});
        if (has("depth of field")) camera.lens_radius = 0.02, camera.focal_distance = 5;
        if (has("radiance limit")) scene_.film.max_component_value = 1e4;
    }

    /// A floor, a ring of smooth normals, and two instances of a box.
    void add_room() {
        if (!has("diffuse surfaces")) return;
        const int paint = add_diffuse(scene_, {0.6, 0.5, 0.4});
        add_shape(scene_, square_mesh(4, 0, 1), {.material = paint},
                  glm::rotate(glm::dmat4(1), -1.5707963, glm::dvec3(1, 0, 0)));
        add_shape(scene_, torus_mesh(8, 6, has("shading normals")), {.material = paint},
                  translation({-1.2, 0.9, 1.5}) * scaling(glm::dvec3(0.5)));
        if (!has("instances")) return;
        const Shape box =
            make_shape(box_mesh(glm::vec3(-0.2F), glm::vec3(0.2F)), {.material = paint});
        scene_.objects.push_back({"box", {box}});
        scene_.instances.push_back({0, translation({1.5, 0.3, -1})});
        scene_.instances.push_back({0, translation({1.8, 0.8, -0.6})});
    }

    /// A ball of each kind of medium.
    void add_media() {
        if (!has("media")) return;
        const Rgb chromatic(2, 1.5, 1), grey(1.5);
        const Rgb sigma_s = !has("scattering") ? Rgb(0) : has("spectral MIS") ? chromatic : grey;
        const auto add_ball = [&](const glm::dvec3& center) {
            const int medium = add_medium(scene_, Rgb(0.4, 0.3, 0.2), sigma_s, 0.5);
            const bool is_interface = has("interfaces");
            if (!is_interface)
                scene_.camera.medium = medium; // all that there is without a boundary
            else
                add_shape(scene_, full_sphere(0.45), {.inside = medium}, translation(center));
            return &scene_.media.back();
        };
        if (has("media in closed form")) {
            Medium* plain = add_ball({-1.2, 0.6, -1});
            plain->phases = phases();
            if (!has("equiangular sampling")) plain->density = air_above({-1.2, 0.6, -1});
            if (!has("interfaces")) {
                plain->sigma_a = 0.02 * plain->sigma_a, plain->sigma_s = 0.02 * plain->sigma_s;
                return;
            }
        }
        if (has("grids")) add_grid(*add_ball({0, 0.6, -1}), {0, 0.6, -1});
        if (has("exponential atmospheres") && has("media in closed form")) {
            Medium* air = add_ball({0, 1.6, 0});
            air->density = air_above({0, 1.6, 0});
            if (has("delta phases")) air->phases = {henyey_greenstein(1)}; // not in mixtures
        }
    }

    static ExponentialDensity air_above(const glm::dvec3& origin) {
        return {.origin = origin, .up = {0, 1, 0}, .scale_height = 0.3};
    }

    std::vector<PhaseFunction> phases() const {
        const bool is_chromatic = has("chromatic phases") && has("spectral MIS");
        const PhaseFunction table = is_chromatic ? mie({3, 4, 5}, 1.4) : mie(4, 1.4);
        if (!has("mixtures of phases")) return {table};
        return {weighted(0.5, table), weighted(0.2, rayleigh()), weighted(0.2, schlick(0.6)),
                weighted(0.1, henyey_greenstein(0.9))};
    }

    void add_grid(Medium& medium, const glm::dvec3& center) const {
        const Lattice lattice{center - 0.5, center + 0.5, {7, 6, 8}};
        GridDensity density =
            lattice.density([](const glm::ivec3& v) { return (v.x * v.y + 3 * v.z) % 5 / 2.0; });
        if (has("emission of media")) {
            medium.emission = Rgb(has("black body emission") ? 0.02 : 2);
            const auto glow = [](const glm::ivec3& v) { return 200.0 * v.y; };
            if (has("black body emission")) density.temperature = lattice.grid(glow);
        }
        medium.density = std::move(density);
    }

    void add_balls() {
        const double spread = has("dispersion") && has("spectral MIS") ? 0.02 : 0;
        const Rgb glass(1.5 - spread, 1.5, 1.5 + spread);
        const auto add_ball = [&](const char* effect, int material, const glm::dvec3& center) {
            if (has(effect))
                add_shape(scene_, full_sphere(0.3), {.material = material}, translation(center));
        };
        add_ball("smooth dielectrics", add_dielectric(scene_, glass), {-0.7, 0.3, -1.8});
        add_ball("rough dielectrics", add_dielectric(scene_, glass, 0.2), {0, 0.3, -1.8});
        add_ball("smooth metal", add_conductor(scene_, Rgb(0.2), Rgb(3)), {0.7, 0.3, -1.8});
        add_ball("rough metal", add_conductor(scene_, Rgb(0.2), Rgb(3), 0.3), {1.3, 1.4, 0});
    }

    void add_lights() {
        if (has("emitting surfaces") && has("area lights") && has("diffuse surfaces"))
            add_shape(scene_, square_mesh(0.5, 3, -1),
                      {.material = black, .area_light = add_area_light(scene_, {4, 4, 3})},
                      glm::rotate(glm::dmat4(1), -1.5707963, glm::dvec3(1, 0, 0)));
        if (has("environment")) add_infinite(scene_, {0.2, 0.25, 0.3});
        if (has("distant lights"))
            add_light(scene_, DistantLight{Rgb(0.5), glm::normalize(glm::dvec3(1, -2, 1))});
        if (has("point lights")) add_light(scene_, PointLight{Rgb(2), {1, 3, -2}});
        if (has("spot lights"))
            add_light(scene_, SpotLight{.intensity = Rgb(4),
                                        .position = {-1, 3, -2},
                                        .axis = glm::normalize(glm::dvec3(0.3, -1, 0.6)),
                                        .cos_falloff_start = 0.9,
                                        .cos_total_width = 0.7});
    }

    std::string missing_;
    Scene scene_;
};

} // namespace

Scene full_scene(const std::string& missing) {
    return FullScene(missing).make();
}

} // namespace tyndall::device_test
