/// Light sources: emission that a path runs into, and choosing a point of a light from a place.
#pragma once

#include "reference/geometry.h"
#include "reference/light_choice.h"
#include "reference/march.h"
#include "scene/emitting_voxels.h"

namespace tyndall::reference {

/// Light that would arrive at a place, if nothing were in the way.
struct LightSample {
    Rgb radiance;    ///< Along -direction; of a delta light, irradiance at the place. Over the
                     ///< probability, it is what this light stands for.
    dvec3 direction; ///< From the place to the light, unit length.
    std::optional<dvec3> end; ///< Where the shadow ray ends; none: at infinity.
    double probability; ///< Of a delta light: of choosing it. Else: density per solid angle. As
                        ///< multiple importance sampling takes it.
    bool is_delta;
    /// The light is emission in this medium, and not there where another one is; -1: of none.
    int medium = -1;
    std::uint32_t light = 0; ///< Which it is.
};

/// Infinite lights are constant: paths find them by escaping, and they are not sampled. The others
/// are the distant, point and spot lights in the order of Scene::lights, then the grids that emit
/// (emitting_grids), then every primitive of an emitting shape, in the order of Scene::shapes, as a
/// light of its own; they are chosen by their power, averaged over the channels, and by their
/// place.
class Lights {
  public:
    /// Keeps references to both. Render space is the world minus camera_position.
    Lights(const Scene& scene, const Geometry& geometry, const dvec3& camera_position);

    /// Whether sample() can ever return anything.
    bool can_sample() const { return !choice_.empty(); }

    /// The words choose the light (LightChoice), words.y and words.z the point on it; voxel_words
    /// the point of a grid. None if it does not shine there.
    std::optional<LightSample> sample(const dvec3& place, const glm::uvec4& words,
                                      const glm::uvec4& voxel_words) const;

    /// The light that a word draws by power.
    std::uint32_t draw(std::uint32_t word) const { return choice_.draw(word); }
    /// A point of the light that was drawn. Not for grids.
    std::optional<LightSample> sample_drawn(std::uint32_t light, const dvec3& place,
                                            const glm::uvec4& words) const;

    /// Where a point or spot light may shine on [0, end] of a ray, as one step of equal angle; none
    /// if nowhere, or of another kind of light. `end` is finite.
    std::optional<Steps> lit_part(std::uint32_t light, const Ray& ray, double end) const;

    /// A point of the light that the words choose; none if it is at infinity, or a grid.
    std::optional<dvec3> place(const glm::uvec4& words) const;

    /// Radiance that leaves a hit surface against the direction of the ray.
    Rgb emitted(const SurfaceHit& hit, const dvec3& ray_direction) const;
    /// Density per solid angle with which sample() draws the direction from the place to the hit.
    double density(const dvec3& place, const SurfaceHit& hit) const;

    /// Density with which sample() finds emission at a voxel of a medium, a squared distance away,
    /// over that with which paths collide there: per solid angle, with the extinction for the
    /// density of collisions. Emission and extinction are in the same unit. 0 if the medium is no
    /// light.
    double density(int medium, const Rgb& emission, const Rgb& extinction, double squared) const;

    /// Radiance of everything at infinity that is not sampled.
    Rgb background() const { return background_; }

  private:
    struct AreaEmitter {
        PrimitiveId id;
        Rgb radiance;
        bool two_sided;
    };
    struct GridEmitter {
        int medium;
        std::vector<EmittingVoxel> voxels;
        AliasTable choice;
        double total; ///< Mean of sigma_a Le over the channels, integrated over the volume.
        dmat4 render_from_index;
    };
    using Emitter = std::variant<DistantLight, PointLight, SpotLight, AreaEmitter, GridEmitter>;

    /// Adds a light as sampling chooses it.
    void add(Emitter emitter, double power, LightReach reach);
    void add_lights(const Scene& scene);
    void add_grids(const Scene& scene);
    void add_surface(const Scene& scene, std::uint32_t index);
    LightReach reach_of(const AreaEmitter& light) const;
    std::uint32_t area_light_index(const PrimitiveId& id) const;
    /// With a probability that leaves out the choice of the light.
    std::optional<LightSample> sample_emitter(std::uint32_t light, const dvec3& place,
                                              const glm::uvec4& words,
                                              const glm::uvec4& voxel_words) const;
    std::optional<LightSample> sample_area(const AreaEmitter& light, const dvec3& place, double u1,
                                           double u2) const;
    std::optional<LightSample> sample_grid(const GridEmitter& light, const dvec3& place,
                                           const glm::uvec4& words) const;
    double area_density(const AreaEmitter& light, const dvec3& place,
                        const SurfacePoint& point) const;

    const Scene& scene_;
    const Geometry& geometry_;
    dvec3 camera_position_;
    Rgb background_{0};
    std::vector<Emitter> emitters_;
    std::vector<std::int64_t> grid_emitter_;  ///< For each of Scene::media; -1: is no light.
    std::vector<std::int64_t> first_emitter_; ///< For each of Scene::shapes; -1: does not emit.
    std::vector<double> powers_;
    std::vector<LightReach> reaches_;
    LightChoice choice_;
};

} // namespace tyndall::reference
