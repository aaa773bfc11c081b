// Specialization constants: what a pipeline is built for. Effects (render/effects.h) sets them from
// the scene; a driver drops every branch that a constant decides.
//
// X(constant_id, name, default)
#ifndef TYNDALL_FEATURES_H
#define TYNDALL_FEATURES_H

#include "interop.h"

TYNDALL_SHARED_BEGIN

TYNDALL_CONSTANT uint GEOMETRY_NONE = 0u; // nothing to hit
TYNDALL_CONSTANT uint GEOMETRY_BOX = 1u;  // one axis-aligned box that bounds one medium in a vacuum
TYNDALL_CONSTANT uint GEOMETRY_ELLIPSOID = 2u; // one ellipsoid, likewise
TYNDALL_CONSTANT uint GEOMETRY_BVH = 3u;       // anything

TYNDALL_CONSTANT uint PRIMITIVE_TRIANGLES = 1u;
TYNDALL_CONSTANT uint PRIMITIVE_PATCHES = 2u;
TYNDALL_CONSTANT uint PRIMITIVE_SPHERES = 4u;
TYNDALL_CONSTANT uint PRIMITIVE_DISKS = 8u;
TYNDALL_CONSTANT uint PRIMITIVE_QUADRICS = 12u; // either
TYNDALL_CONSTANT uint PRIMITIVE_INSTANCES = 16u;
TYNDALL_CONSTANT uint PRIMITIVE_CUTS = 32u; // some sphere or disk is not whole
TYNDALL_CONSTANT uint PRIMITIVE_BOXES = 64u;
TYNDALL_CONSTANT uint PRIMITIVE_OTHERS = 78u; // all but triangles and instances
TYNDALL_CONSTANT uint PRIMITIVE_TREES = 128u; // some hierarchy has inner nodes

TYNDALL_CONSTANT uint LIGHTS_DISTANT = 1u;
TYNDALL_CONSTANT uint LIGHTS_POINT = 2u;
TYNDALL_CONSTANT uint LIGHTS_SPOT = 4u;
TYNDALL_CONSTANT uint LIGHTS_AREA = 8u;
TYNDALL_CONSTANT uint LIGHTS_VOXELS = 16u;

// By the kind of a medium's density (volume_records.h).
TYNDALL_CONSTANT uint DENSITY_BIT_GRID = 2u;
TYNDALL_CONSTANT uint DENSITY_BIT_PLANE = 4u;
TYNDALL_CONSTANT uint DENSITY_BIT_SPHERE = 8u;
TYNDALL_CONSTANT uint DENSITY_BITS_TRACKED = 10u; // flights by tracking

// By the kind of a phase function (phase_records.h).
TYNDALL_CONSTANT uint PHASE_BIT_HENYEY_GREENSTEIN = 1u;
TYNDALL_CONSTANT uint PHASE_BIT_SCHLICK = 2u;
TYNDALL_CONSTANT uint PHASE_BIT_RAYLEIGH = 4u;
TYNDALL_CONSTANT uint PHASE_BIT_TABLE = 8u;

TYNDALL_CONSTANT uint MARCH_NONE = 0u; // paths fly, and scatter
TYNDALL_CONSTANT uint MARCH_UNIFORM = 1u;
TYNDALL_CONSTANT uint MARCH_JITTERED = 2u;
TYNDALL_CONSTANT uint MARCH_EQUIANGULAR = 3u;

TYNDALL_CONSTANT uint SAMPLER_INDEPENDENT = 0u; // random.h
TYNDALL_CONSTANT uint SAMPLER_SOBOL = 1u;       // sobol.h
TYNDALL_CONSTANT uint SAMPLER_ZSOBOL = 2u;      // likewise, one sequence for all pixels

TYNDALL_CONSTANT uint FILTER_BOX = 0u;
TYNDALL_CONSTANT uint FILTER_TRIANGLE = 1u;
TYNDALL_CONSTANT uint FILTER_TABLE = 2u;

TYNDALL_SHARED_END

#define TYNDALL_FEATURES(X)                                                                        \
    X(0, workgroup_size, 64)      /* invocations per workgroup */                                  \
    X(1, storage_fallback, 0)     /* bit n: texel buffer n is too large, read its storage twin */  \
    X(2, geometry, 3)             /* GEOMETRY_* */                                                 \
    X(3, primitives, 255)         /* PRIMITIVE_* bits that occur */                                \
    X(4, lights, 31)              /* LIGHTS_* bits that light sampling has to deal with */         \
    X(5, filter_kind, 2)          /* FILTER_* */                                                   \
    X(6, has_media, 1)            /* any medium at all */                                          \
    X(7, has_scattering, 1)       /* some medium scatters */                                       \
    X(8, has_emission, 1)         /* some medium emits */                                          \
    X(9, phases, 15)              /* PHASE_BIT_* kinds that occur; 0: all scatter isotropically */ \
    X(10, is_chromatic, 1)        /* some medium differs between channels */                       \
    X(11, is_grey, 0)             /* nothing at all differs between channels */                    \
    X(12, has_interfaces, 1)      /* some surface is a mere boundary between media */              \
    X(13, surface_queues, 1023)   /* bit q: at some surface or interface, paths wait in queue q */ \
    X(14, has_emitters, 1)        /* some surface emits */                                         \
    X(15, has_shading_normals, 1) /* some mesh has vertex normals */                               \
    X(16, has_environment, 1)     /* light arrives from infinity in all directions */              \
    X(17, has_lens, 1)            /* the camera has an aperture */                                 \
    X(18, has_clamp, 1)           /* radiance is limited to maxcomponentvalue */                   \
    X(19, is_orthographic, 1)     /* kind of camera */                                             \
    X(20, emitters, 15)           /* PRIMITIVE_* bits that occur among what emits */               \
    X(21, densities, 15)          /* DENSITY_BIT_* bits: how the density of media varies */        \
    X(22, has_rgb_grids, 1)       /* some grid has coefficients of its own by channel */           \
    X(23, has_temperature, 1)     /* some grid emits as a black body */                            \
    X(24, voxels_are_half, 0)     /* voxels are 16-bit floats */                                   \
    X(25, is_rough, 1)       /* this stage's surfaces are rough; set by stage, not by scene */     \
    X(26, has_thin_panes, 1) /* some smooth dielectric is a thin pane */                           \
    X(27, has_dispersion, 1) /* some index of refraction differs between channels */               \
    X(28, has_mixtures, 1)   /* some medium has more than one phase function */                    \
    X(29, has_chromatic_phases, 1) /* some phase function differs between channels */              \
    X(30, has_lit_ball, 1)         /* all light comes from a ball, and a medium goes on around */  \
    X(31, event_limit, 4194304)    /* Integrator::event_limit */                                   \
    X(32, log_capacity, 0)         /* events that a replay keeps; 0: no log */                     \
    X(33, loops_test_first, 0)     /* SwiftShader; see wavefront/phases.glsl */                    \
    X(34, is_analog, 0)            /* flights end by absorption, too, and paths with them */       \
    X(35, marches_shadows, 0)      /* shadow rays march through media that are tracked */          \
    X(36, march, 0) /* MARCH_*: paths march through media that scatter, and scatter once there */  \
    X(37, has_contacts, 1) /* some boundary may touch another surface */                           \
    X(38, texel_stores, 0) /* bit n: buffer n is too large for a storage binding to write to */    \
    X(39, sampler_kind, 0) /* SAMPLER_* */                                                         \
    X(40, zsobol_bits, 4)  /* Scene::zsobol_bits */                                                \
    X(41, has_delta_phases, 1) /* some phase function is as good as a delta (lib/phase.glsl) */    \
    X(42, has_closed_media, 1) /* some medium has transmittance in closed form: not all tracked */ \
    X(43, light_candidates, 4) /* drawn by power, one is taken by place; 1: power alone decides */ \
    X(44, has_equiangular, 1)  /* light is looked for on segments that paths pass, too */

#ifdef __cplusplus
namespace tyndall::shared {
#define TYNDALL_FEATURE_MEMBER(id, name, value) std::uint32_t name = value;
struct Features {
    TYNDALL_FEATURES(TYNDALL_FEATURE_MEMBER)
    bool operator==(const Features&) const = default;
};
#undef TYNDALL_FEATURE_MEMBER
} // namespace tyndall::shared
#else
#define TYNDALL_FEATURE_CONSTANT(id, name, value) layout(constant_id = id) const uint name = value;
TYNDALL_FEATURES(TYNDALL_FEATURE_CONSTANT)
#undef TYNDALL_FEATURE_CONSTANT
#endif

#endif
