// Every record that crosses between host and device, defined once for both compilers.
//
// Scene records are whole texels (16 bytes each, rgba32ui): three floats and a word, or four words.
// The device reads them through the load functions of wavefront/scene.glsl. All positions are in
// render space: the world moved so that the camera is at the origin, which is where float32 is
// finest. An index or offset of NONE means "none". Medium indices are those of Scene::media; VACUUM
// is none.
#ifndef TYNDALL_RECORDS_H
#define TYNDALL_RECORDS_H

#include "health.h"
#include "interop.h"
#include "sample_histogram.h"

TYNDALL_SHARED_BEGIN

TYNDALL_CONSTANT uint NONE = 0xFFFFFFFFu;
TYNDALL_CONSTANT uint VACUUM = 0xFFFFu;

// Primitive kinds, in the upper bits of PrimitiveRecord::kind_and_shape.
TYNDALL_CONSTANT uint KIND_SHIFT = 29u;
TYNDALL_CONSTANT uint KIND_TRIANGLE = 0u;
TYNDALL_CONSTANT uint KIND_PATCH = 1u;
TYNDALL_CONSTANT uint KIND_SPHERE = 2u;
TYNDALL_CONSTANT uint KIND_DISK = 3u;
TYNDALL_CONSTANT uint KIND_INSTANCE = 4u;
TYNDALL_CONSTANT uint KIND_BOX = 5u;
TYNDALL_CONSTANT uint SHAPE_MASK = 0x1FFFFFFFu;

// ShapeRecord::flags
TYNDALL_CONSTANT uint SHAPE_INTERFACE = 1u;  // no surface: only a boundary between media
TYNDALL_CONSTANT uint SHAPE_TRANSITION = 2u; // crossing it changes the medium
TYNDALL_CONSTANT uint SHAPE_EMITS = 4u;
TYNDALL_CONSTANT uint SHAPE_TWO_SIDED = 8u; // emits on both sides
TYNDALL_CONSTANT uint SHAPE_THIN = 16u;     // a thin pane of a dielectric

// LightRecord::kind
TYNDALL_CONSTANT uint LIGHT_DISTANT = 0u;
TYNDALL_CONSTANT uint LIGHT_POINT = 1u;
TYNDALL_CONSTANT uint LIGHT_SPOT = 2u;
TYNDALL_CONSTANT uint LIGHT_AREA = 3u;
TYNDALL_CONSTANT uint LIGHT_AREA_TWO_SIDED = 4u;
TYNDALL_CONSTANT uint LIGHT_VOXELS = 5u; // VoxelLightRecord

// Children of a NodeRecord: inner nodes by index; leaves as LEAF | (count - 1) << 24 | first
// primitive.
TYNDALL_CONSTANT uint LEAF = 0x80000000u;
TYNDALL_CONSTANT uint LEAF_COUNT_SHIFT = 24u;
TYNDALL_CONSTANT uint LEAF_COUNT_MAX = 128u;
TYNDALL_CONSTANT uint LEAF_FIRST_MASK = 0x00FFFFFFu;
TYNDALL_CONSTANT uint BVH_DEPTH_MAX = 31u; // of one level; instances add a second level

/// The camera as affine maps of the film point (x, y), in pixels, y down.
/// perspective:  direction = direction_0 + x direction_x + y direction_y (camera z of 1); origin_0
/// orthographic: origin = origin_0 + x direction_x + y direction_y; direction_0
/// A point (u, v) of the unit disk moves the origin by u lens_u + v lens_v and the direction by
/// -(u lens_u + v lens_v) * inverse_focal_distance.
struct CameraRecord {
    vec3 origin_0;
    uint medium; ///< That the camera is in.
    vec3 direction_0;
    float inverse_focal_distance;
    vec3 direction_x;
    float clamp; ///< Largest component of a path's radiance (maxcomponentvalue).
    vec3 direction_y;
    float exposure; ///< Multiplies radiance (imaging ratio).
    vec3 lens_u;
    float filter_x_radius; ///< In pixels.
    vec3 lens_v;
    float filter_y_radius;
    vec3 environment;  ///< Radiance that arrives from infinity, the same in all directions.
    uint filter_cells; ///< FILTER_TABLE: cells per axis.
};
TYNDALL_CONSTANT uint CAMERA_TEXELS = 7u;

/// How long the steps of a march are, and the unit of errors. Follows the camera, which opens the
/// scene buffer.
struct MarchRecord {
    uint steps;      ///< Of a march through one segment in one medium, ...
    float step_size; ///< ... or, if > 0, their length at most.
    float film_unit; ///< Deviations in the film are times this (render/film_unit.h).
    uint pad1;
};
TYNDALL_CONSTANT uint MARCH_TEXEL = CAMERA_TEXELS;
TYNDALL_CONSTANT uint MARCH_STEPS_MAX = 4096u; // see wavefront/volume.glsl on loops

/// The ball around all surfaces and lights (scene/lit_ball.h), after that.
struct BallRecord {
    vec3 center;
    float radius;
};
TYNDALL_CONSTANT uint LIT_BALL_TEXEL = MARCH_TEXEL + 1u;

/// A medium. Coefficients per scene unit.
struct MediumRecord {
    vec3 sigma_a;
    float phase_parameter; ///< Of a single phase function with one: g or k.
    vec3 sigma_s;
    uint phase;    ///< PHASE_* and a texel (phase_records.h).
    vec3 emission; ///< Le; the source term is sigma_a Le.
    float pad0;
    uint density_kind;   ///< DENSITY_* (volume_records.h): what scales sigma_a and sigma_s.
    uint density_record; ///< Texel of the record of that kind.
    uint pad1;
    uint pad2;
};
TYNDALL_CONSTANT uint MEDIUM_TEXELS = 4u;

/// What the surface of a shape is like.
struct ShapeRecord {
    uint flags;          ///< SHAPE_*
    uint medium_inside;  ///< Against the normal.
    uint medium_outside; ///< On the side of the normal.
    uint queue;          ///< QUEUE_*: where paths that stand at it wait.
    vec3 reflectance;    ///< Of a diffuse surface.
    float alpha;         ///< Roughness (GGX) of a dielectric or a conductor.
    vec3 eta;            ///< Index of refraction. Dielectric: inside over outside.
    float pad0;
    vec3 k; ///< Absorption index of a conductor.
    float pad1;
};
TYNDALL_CONSTANT uint SHAPE_TEXELS = 4u;

/// One primitive, in the order of the leaves of the hierarchy.
/// triangle: a, b, c vertices; normal and offset of its plane (normal . p = offset)
/// patch:    a, b, c, normal = p00, p10, p01, p11; offset = -1 flips cross(dp/du, dp/dv), else 1
/// sphere, disk: extra = quadric index; offset = -1 or 1, likewise
/// box: the axis-aligned box a ... b; offset = 1, or -1 if its normals point inward
/// instance: extra = instance index
struct PrimitiveRecord {
    vec3 a;
    uint kind_and_shape;
    vec3 b;
    uint light; ///< Index of the light that it is, or NONE.
    vec3 c;
    uint extra; ///< triangle, patch: index of its vertex normals (triples, quadruples), or NONE.
    vec3 normal;
    float offset;
};
TYNDALL_CONSTANT uint PRIMITIVE_TEXELS = 4u;

/// Rows of a 3x4 matrix.
struct AffineRecord {
    vec4 row0;
    vec4 row1;
    vec4 row2;
};
TYNDALL_CONSTANT uint AFFINE_TEXELS = 3u;

/// A sphere about the origin, or a disk in the plane z = z_min, in its object space.
struct QuadricRecord {
    AffineRecord object_from_world;
    AffineRecord world_from_object;
    float radius;
    float inner_radius; ///< disk
    float z_min;
    float z_max;
    float phi_max;
    uint flags;        ///< QUADRIC_*
    float determinant; ///< |det| of world_from_object: world volume per object volume.
    float pad0;
};
TYNDALL_CONSTANT uint QUADRIC_TEXELS = 8u;
TYNDALL_CONSTANT uint QUADRIC_FULL = 1u; // a sphere without cuts
TYNDALL_CONSTANT uint QUADRIC_SIMILARITY =
    2u; // world_from_object keeps shapes: rotation, translation, equal scale

struct InstanceRecord {
    AffineRecord object_from_world;
    AffineRecord world_from_object;
    uint triangle_root; ///< Roots of its hierarchies, as in PushConstants.
    uint other_root;
    uint medium_shift; ///< Added to the media of its shapes' boundaries: its own copies, which move
                       ///< with it.
    uint pad0;
};
TYNDALL_CONSTANT uint INSTANCE_TEXELS = 7u;

/// Inner node of a binary hierarchy: words and boxes of both children. Along each axis, a box goes
/// from origin + lower / 256 * width to origin + upper / 256 * width. The lowest 9 bits of the word
/// of an origin are the exponent and the first bit of the mantissa of a width, and part of the
/// origin no less.
struct NodeRecord {
    uint child0;
    uint child1;
    uint origin_x; ///< Bits of a float.
    uint origin_y;
    uint origin_z;
    uint box_x; ///< Four bytes, lowest first: lower and upper of child 0, then of child 1.
    uint box_y;
    uint box_z;
};
TYNDALL_CONSTANT uint NODE_TEXELS = 2u;
TYNDALL_CONSTANT uint NODE_WIDTH_SHIFT = 22u; // from the word of an origin to a width
TYNDALL_CONSTANT uint NODE_WIDTH_MASK = 0x7FC00000u;

/// A light that light sampling chooses.
struct LightRecord {
    vec3 position;     ///< Its middle; direction of travel for distant
    uint kind;         ///< LIGHT_*
    vec3 radiance;     ///< area: radiance; point, spot: intensity; distant: irradiance
    float probability; ///< That it is chosen.
    vec3 axis;         ///< spot: where it shines; area: its mean normal, 0 for spheres
    uint primitive;    ///< area: index into the primitives; voxels: texel of the VoxelLightRecord
    float complement_start; ///< spot: 1 - cos of the angle up to which it is at full intensity,
                            ///< area: share of importance that every direction has.
    float complement_width; ///< spot: 1 - cos of the angle from which there is none.
    float reach;            ///< Importance over power, times squared distance unless distant.
    float size2;            ///< Added to the squared distance from its middle.
};
TYNDALL_CONSTANT uint LIGHT_TEXELS = 4u;

/// A cell of the alias table by which a light is chosen (Vose 1991).
struct AliasRecord {
    float threshold; ///< Keep the cell's own index if the fraction of the draw is below, else take
                     ///< ...
    uint alias;      ///< ... this one.
    uint pad0;
    uint pad1;
};

/// A medium's convex boundary for GEOMETRY_BOX and GEOMETRY_ELLIPSOID: the box is lower..upper; the
/// ellipsoid is the unit sphere of unit_from_world.
struct RegionRecord {
    AffineRecord unit_from_world;
    vec3 lower;
    uint medium;
    vec3 upper;
    float pad0;
};
TYNDALL_CONSTANT uint REGION_TEXELS = 5u;

/// Where each table starts in the scene buffer (texel offsets), and what a dispatch works on.
struct PushConstants {
    uvec2 seed;
    uint slot_count;  ///< Paths in flight.
    uint run_length;  ///< Most events per path and dispatch.
    uint width;       ///< Of the rendered bounds.
    uint pixel_count; ///< Of the rendered bounds.
    uint x0;          ///< Of the rendered bounds in the picture.
    uint y0;
    uint full_width; ///< Of the picture.
    uint max_depth;
    uint first_sample; ///< Samples rendered: first_sample <= sample < end_sample
    uint end_sample;
    uint first_piece; ///< Piece of a batch (schedule.h) of ticket 0.
    uint piece_count; ///< Pieces of this epoch: tickets 0 ... piece_count * pixel_count - 1.
    uint window;      ///< Pieces that may be in flight at once: a power of two.
    uint filter_table;
    uint media;
    uint shapes;
    uint primitives;
    uint nodes;
    uint vertex_normals;
    uint quadrics;
    uint instances;
    uint lights;
    uint alias_table;
    uint light_count;
    uint region;
    uint triangle_root;   ///< Child words of the roots of three hierarchies, or NONE: triangles,
    uint other_root;      ///< patches, quadrics and boxes,
    uint instance_root;   ///< instances.
    uint blackbody;       ///< Table of emission over log temperature (volume_records.h), or NONE.
    float roulette_scale; ///< A path survives roulette with this times its throughput.
};

TYNDALL_CONSTANT int PIECE_WINDOW_MAX = 1024;

// Queues of path slots, by what waits in them. Queue q holds its slots from q * slot_count on.
TYNDALL_CONSTANT uint QUEUE_VOLUME = 0u;    // collided in a medium
TYNDALL_CONSTANT uint QUEUE_SURFACE = 1u;   // stand at a diffuse surface
TYNDALL_CONSTANT uint QUEUE_INTERFACE = 2u; // stand at a boundary between media
TYNDALL_CONSTANT uint QUEUE_SHADOW = 3u;    // have a shadow ray to trace
TYNDALL_CONSTANT uint QUEUE_ENDED = 4u;     // have no path, or one that has ended
TYNDALL_CONSTANT uint QUEUE_TRACK = 5u; // fly through a medium on voxels, or a spherical atmosphere
TYNDALL_CONSTANT uint QUEUE_DIELECTRIC = 6u; // stand at a smooth dielectric, or a thin pane
TYNDALL_CONSTANT uint QUEUE_ROUGH_DIELECTRIC = 7u;
TYNDALL_CONSTANT uint QUEUE_CONDUCTOR = 8u; // stand at smooth metal
TYNDALL_CONSTANT uint QUEUE_ROUGH_CONDUCTOR = 9u;
TYNDALL_CONSTANT uint QUEUE_EMITTER = 10u; // have a surface that emits at the end of their segment
TYNDALL_CONSTANT uint QUEUE_PASSING = 11u; // pass light in a medium without a collision
TYNDALL_CONSTANT uint QUEUE_COUNT = 12u;

/// Arguments of vkCmdDispatchIndirect.
struct DispatchSize {
    uint x, y, z;
};

/// What the device tells itself and the host. Zeroed at the start of an epoch.
struct Control {
    DispatchSize queue_dispatch[QUEUE_COUNT];
    DispatchSize slot_dispatch; ///< All slots, or none if none has work.
    DispatchSize fold_dispatch;
    uint queue_size[QUEUE_COUNT];
    uint queue_total[QUEUE_COUNT]; ///< Of the rounds before: what stages were given,
    uint slot_rounds;              ///< and rounds that were given all slots.
    uint next_ticket;   ///< Work item = ticket: piece ticket / pixel_count, pixel ticket %
                        ///< pixel_count.
    uint ticket_limit;  ///< Tickets below may be worked on.
    uint folded_pieces; ///< Pieces of this epoch that are in the film.
    uint fold_count;    ///< Pieces that the next fold adds.
    uint fold_limit;    ///< Pieces of this epoch that may be folded: the host looks at them first.
    uint fold_least;    ///< Pieces that are worth a fold before fold_limit, by the host.
    uint finished[PIECE_WINDOW_MAX];  ///< Pixels finished of each piece in the window.
    uint health[HEALTH_COUNT];        ///< Paths by kind of mishap (health.h);
    uint health_pixel[HEALTH_COUNT];  ///< of the first that was noticed, x | y << 16
    uint health_sample[HEALTH_COUNT]; ///< and the sample.
    uint worst_majorant_ratio;        ///< Bits of a float.
    uint lost_throughput_low;  ///< Of paths ended by the event limit, mean over channels: 2^-16.
    uint lost_throughput_high; ///< Its upper word.
    uint sample_histogram[SAMPLE_BINS]; ///< Of single samples, by luminance.
};

// Path state: groups of one texel, so that a stage touches only what it needs (a store costs as
// much as ten loads on a CPU driver).
TYNDALL_CONSTANT uint PATH_ORIGIN =
    0u; // origin xyz | medium (16 bits), status (4), hero (2), mishaps (10)
TYNDALL_CONSTANT uint PATH_DIRECTION = 1u;  // direction xyz | event
TYNDALL_CONSTANT uint PATH_THROUGHPUT = 2u; // throughput rgb | depth
TYNDALL_CONSTANT uint PATH_RADIANCE =
    3u; // radiance rgb | density of the last direction per steradian
TYNDALL_CONSTANT uint PATH_SAMPLE = 4u; // x | y << 16 in the picture, sample, end of piece, weight
TYNDALL_CONSTANT uint PATH_SUM = 5u;    // sum over the piece: weight * radiance, weight
// Ticket, pixel, slot of the piece in the window | distance to the surface (EMITTER queue, and
// collisions that passing.glsl weighs)
TYNDALL_CONSTANT uint PATH_TICKET = 6u;
// The rest is there only as far as a scene needs it (render/stages.h).
TYNDALL_CONSTANT uint PATH_SPECTRAL = 7u; // ratios r rgb (chromatic media) | unused
// Distance to the end of the segment, primitive and instance there | distance before the segment
TYNDALL_CONSTANT uint PATH_HIT = 8u;
// Tracking: how far it has come along the segment | what is left of its flight | unused. March:
// steps done | optical depth rgb.
TYNDALL_CONSTANT uint PATH_TRACK = 9u;
TYNDALL_CONSTANT uint PATH_SHADOW =
    10u; // 3: origin | medium; direction | distance; contribution | target
TYNDALL_CONSTANT uint PATH_GROUPS = 13u;

// Film, FILM_TEXELS a pixel: compensated sum of weight * radiance and weight; sums over the batches
// (Welford), from which the variance of the mean follows, and the error (stats/error_estimate.h).
TYNDALL_CONSTANT uint FILM_SUM = 0u;          // rgb, weight
TYNDALL_CONSTANT uint FILM_COMPENSATION = 1u; // rgb, weight
TYNDALL_CONSTANT uint FILM_RESIDUAL = 2u;     // sum c^2 of rgb | W
TYNDALL_CONSTANT uint FILM_PAIR = 3u;         // residual of the last batch, rgb | G
TYNDALL_CONSTANT uint FILM_BATCH = 4u;        // sum over the pieces of the next batch so far
TYNDALL_CONSTANT uint FILM_TEXELS = 5u;

// Behind the pixels of the film: ERROR_TEXELS for each invocation of update_film, with its part of
// the sums behind the stated error (stats/error_estimate.h). Norms are roots of sums of squares:
// squares of squared radiance would overflow.
TYNDALL_CONSTANT uint ERROR_VARIANCES = 0u;   // sum w c^2 of rgb | norm of D
TYNDALL_CONSTANT uint ERROR_COVARIANCES = 1u; // sum w c c' of rg, rb, gb | norm of g
TYNDALL_CONSTANT uint ERROR_PIXELS = 2u;      // sum |mean|^2, norms of |mean| sqrt(W), W, G
TYNDALL_CONSTANT uint ERROR_TEXELS = 3u;

/// Invocations of update_film, each of which folds every fold_lanes-th pixel.
TYNDALL_SHARED_INLINE uint fold_lanes(uint pixel_count) {
    return clamp(pixel_count / 16u, 1u, 8192u);
}

TYNDALL_SHARED_END

#endif
