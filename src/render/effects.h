/// What a scene calls for, and therefore what is simulated.
///
/// Effects are derived here and nowhere else. They decide the specialization constants, the stages
/// that are recorded, and the buffers that are allocated.
#pragma once

#include "scene/lit_ball.h"
#include "shared/features.h"

#include <optional>
#include <string>
#include <vector>

namespace tyndall {

/// One effect, as `info` and --stats tell it.
struct Effect {
    std::string name;
    std::string value;      ///< "yes", "no", or what it is ("box", "3").
    std::string called_for; ///< By what: `medium "smoke" at scene.pbrt:14:1`, or "".
};

/// The boundary of a medium when it is all the geometry there is, convex, and in a vacuum.
struct Region {
    std::uint32_t geometry =
        shared::GEOMETRY_NONE;     ///< shared::GEOMETRY_BOX or shared::GEOMETRY_ELLIPSOID
    glm::dvec3 lower{0}, upper{0}; ///< box, in the world
    glm::dmat4 unit_from_world{1}; ///< ellipsoid: to the unit sphere
    int medium = -1;
};

struct Effects {
    /// What the scene says; workgroup_size, storage_fallback, primitives and emitters follow later,
    /// from the device and from how the scene was packed.
    shared::Features features;
    std::optional<Region> region;
    Rgb environment{0}; ///< Sum of the infinite lights.
    std::optional<Ball> lit_ball;
    bool has_camera_medium = false;
    bool lists_lights = false; ///< Lights are sampled, or surfaces look their emission up.
    std::vector<Effect> list;
};

/// QUEUE_*: where paths wait that stand at a surface of the material. Smooth is what pbrt takes for
/// it.
std::uint32_t queue_of(const Material& material);

/// @param scene  with the command line's choices applied (integrator, depth).
Effects compute_effects(const Scene& scene);

/// The region that makes a hierarchy superfluous, if the scene is of that kind.
std::optional<Region> find_region(const Scene& scene);

} // namespace tyndall
