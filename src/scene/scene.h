/// The scene as plain values: what every renderer reads, and nothing that any of them needs for
/// itself. Built by read_scene (scene/reader.h), validated there once; after that no value is
/// checked again.
///
/// Conventions. Lengths are in scene units. Coefficients (sigma) are per scene unit. Colours are
/// linear sRGB triples in double. Spectra were turned into triples by scene/spectrum.h. Matrices
/// act on column vectors; names read "to_from". Indices of -1 mean "none"; a medium index of -1 is
/// vacuum.
#pragma once

#include "core/error.h"
#include "phase/mie.h"
#include "volume/grid.h"

#include <array>
#include <bit>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace tyndall {

using Rgb = glm::dvec3;

/// How a medium scatters. The angle is between the directions of travel: g > 0 is forward.
struct PhaseFunction {
    enum class Kind {
        henyey_greenstein, ///< Isotropic for g = 0.
        schlick,           ///< (1 - k^2) / (4 pi (1 - k mu)^2)
        rayleigh,          ///< 3 / (16 pi) (1 + mu^2)
        mie                ///< Lorenz-Mie, from `table`
    };
    Kind kind = Kind::henyey_greenstein;
    double weight = 1; ///< Share in the mixture; the weights of a medium sum to 1.
    double g = 0;      ///< henyey_greenstein: mean cosine, in [-1, 1].
    double k = 0;      ///< schlick, in (-1, 1).
    std::shared_ptr<const PhaseTable> table; ///< mie
    std::array<MieChannel, 3> spheres{};     ///< mie: efficiencies, for who asks.
};

/// Density that scales the coefficients of a medium, on voxels (uniformgrid, nanovdb, vdb, cloud).
struct GridDensity {
    glm::dmat4 index_from_medium{1}; ///< Of all grids here.
    /// Box in index space outside of which the medium is not; lies in the cells of `majorants`.
    glm::dvec3 lower{0}, upper{1};
    std::shared_ptr<const Grid> density; ///< Null: 1 everywhere in the box (rgbgrid).
    /// rgbgrid: coefficients by voxel and channel, in place of density * sigma; null otherwise.
    std::array<std::shared_ptr<const Grid>, 3> sigma_a, sigma_s, emission;
    std::shared_ptr<const Grid> emission_scale; ///< Lescale; null: 1.
    /// Kelvin, offset and scale applied; where it is above 100 K the medium emits like a black body
    /// and Medium::emission scales that (Lescale); null: none.
    std::shared_ptr<const Grid> temperature;
    MajorantGrid
        majorants; ///< Of density, or for rgbgrid of the largest sigma_a + sigma_s of a channel.
};

/// Density exp(-h / scale_height), h the height above a plane or a sphere (not below 0 for the
/// sphere).
struct ExponentialDensity {
    bool is_spherical = false;
    glm::dvec3 origin{0};   ///< Of medium space: a point of the plane, or the centre of the sphere.
    glm::dvec3 up{0, 1, 0}; ///< Plane: unit normal in medium space.
    double radius = 0;      ///< Of the sphere.
    double scale_height = 1; ///< > 0
};

/// A participating medium: sigma_a and sigma_s times the density. Emits sigma_a * emission per unit
/// length (radiance).
struct Medium {
    std::string name;
    SourceLocation where;
    Rgb sigma_a{1};  ///< Absorption coefficient, >= 0, "scale" applied. 1 for rgbgrid.
    Rgb sigma_s{1};  ///< Scattering coefficient, >= 0, "scale" applied. 1 for rgbgrid.
    Rgb emission{0}; ///< Le: radiance of an optically thick, purely absorbing body, >= 0.
    std::vector<PhaseFunction> phases{PhaseFunction{}}; ///< A mixture; at least one.
    std::variant<std::monostate, GridDensity, ExponentialDensity> density; ///< None: homogeneous.
    glm::dmat4 world_from_medium{1};
    bool is_homogeneous() const { return std::holds_alternative<std::monostate>(density); }
};

struct Material {
    enum class Kind {
        interface, ///< No surface at all: only a boundary between media.
        diffuse,
        dielectric,      ///< Boundary of a transparent body; smooth or rough (GGX).
        thin_dielectric, ///< A thin pane: both boundaries at once.
        conductor        ///< Metal; smooth or rough (GGX).
    };
    Kind kind = Kind::diffuse;
    Rgb reflectance{0.5}; ///< diffuse: albedo of each side, in [0, 1].
    /// dielectrics: index of refraction, inside (against the normal) over outside; where the
    /// channels differ, a path that is refracted goes on in its hero channel alone. conductor: of
    /// the metal.
    Rgb eta{1.5};
    Rgb k{0}; ///< conductor: absorption index.
    double alpha =
        0; ///< dielectric, conductor: GGX roughness, pbrt's remapping applied; 0: smooth.
    SourceLocation where;
};

/// Media on both sides of a surface. The outside is the side that the normal points to.
struct MediumInterface {
    int inside = -1;
    int outside = -1;
    /// pbrt's rule: a surface with equal media on both sides leaves the medium of a ray as it is.
    bool is_transition() const { return inside != outside; }
};

/// Triangles and bilinear patches over shared vertices, in object space.
struct Mesh {
    std::vector<glm::vec3> positions; ///< Finite.
    std::vector<glm::vec3> normals;   ///< Empty, or one a vertex; need not be of unit length.
    std::vector<glm::vec2> uvs;       ///< Empty, or one a vertex.
    std::vector<std::array<std::uint32_t, 3>> triangles;
    /// p(u, v) bilinear in the vertices [p00, p10, p01, p11], as pbrt's bilinearmesh.
    std::vector<std::array<std::uint32_t, 4>> patches;
};

/// Sphere about the origin of object space, cut to zmin <= z <= zmax and 0 <= phi <= phi_max.
struct Sphere {
    double radius = 1; ///< > 0
    double z_min = -1;
    double z_max = 1;                            ///< -radius <= z_min < z_max <= radius
    double phi_max = 2 * 3.14159265358979323846; ///< radians, in (0, 2 pi]
    bool is_full() const { return z_min <= -radius && z_max >= radius && phi_max >= 6.28318530; }
};

/// Annulus in the plane z = height of object space; its normal is +z.
struct Disk {
    double height = 0;
    double radius = 1;
    double inner_radius = 0;
    double phi_max = 2 * 3.14159265358979323846; ///< radians, in (0, 2 pi]
};

/// One Shape directive.
///
/// Normals: of a triangle, cross(p1 - p0, p2 - p0) in object space, carried to the world; of a
/// patch, cross(dp/du, dp/dv); both are flipped by reverse_orientation, and then turned to the side
/// of the vertex normals where the mesh has them; vertex normals are carried to the world and
/// flipped by reverse_orientation, too (pbrt's rule). Of a sphere, outward; of a disk, +z; both are
/// flipped by reverse_orientation and, once more, if world_from_object mirrors (pbrt's rule for
/// quadrics).
struct Shape {
    std::variant<Mesh, Sphere, Disk> geometry;
    glm::dmat4 world_from_object{
        1}; ///< In an ObjectDefinition: definition space from object space.
    bool reverse_orientation = false;
    int material = 0; ///< Index into Scene::materials.
    MediumInterface media;
    int area_light = -1; ///< Index into Scene::area_lights; the shape emits.
    SourceLocation where;
};

/// Emission of a shape (AreaLightSource "diffuse").
struct AreaLight {
    Rgb radiance{1}; ///< Photometric scaling applied; 0 where power_radiance counts.
    /// Of meshes where "power" was given: the radiance of each triangle and of each patch is this
    /// over its own area in world space (pbrt: each is a light of its own, with the full power).
    /// Spheres and disks have their power in `radiance` already.
    Rgb power_radiance{0};
    bool two_sided = false; ///< Else only the side that the normal points to emits.
};

/// Lights that are not shapes. All quantities are in linear sRGB with pbrt's photometric scaling.
struct InfiniteLight {
    Rgb radiance{1}; ///< The same from every direction.
};
struct DistantLight {
    Rgb irradiance{1};             ///< On a plane perpendicular to the light.
    glm::dvec3 direction{0, 0, 1}; ///< Of travel, in the world, unit length.
};
struct PointLight {
    Rgb intensity{1}; ///< Power per solid angle.
    glm::dvec3 position{0};
};
struct SpotLight {
    Rgb intensity{1}; ///< Along the axis.
    glm::dvec3 position{0};
    glm::dvec3 axis{0, 0, 1};     ///< Unit length.
    double cos_falloff_start = 1; ///< Full intensity inside this cone ...
    double cos_total_width = 0;   ///< ... none outside this one, smoothstep of the cosine between.
};
struct Light {
    std::variant<InfiniteLight, DistantLight, PointLight, SpotLight> emitter;
    SourceLocation where;
};

/// ObjectBegin ... ObjectEnd: shapes that instances share.
struct ObjectDefinition {
    std::string name;
    std::vector<Shape> shapes; ///< None of them emits (pbrt's rule).
};
struct ObjectInstance {
    int object = 0;
    glm::dmat4 world_from_definition{1};
    SourceLocation where;
};

/// Camera space is left-handed: +x right, +y up, +z into the picture.
struct Camera {
    enum class Kind { perspective, orthographic };
    Kind kind = Kind::perspective;
    glm::dmat4 world_from_camera{1};
    double fov = 90; ///< perspective: degrees, of the shorter axis of the picture, in (0, 180).
    /// Scene rectangle that the picture shows, {x0, x1, y0, y1}, on the plane z = 1 / tan(fov / 2)
    /// (perspective) or in scene units (orthographic). Derived from the picture's aspect if not
    /// given.
    std::array<double, 4> screen_window{-1, 1, -1, 1};
    bool screen_window_given = false;
    double frame_aspect_ratio = 0; ///< 0: width / height of the film.
    double lens_radius = 0;
    double focal_distance = 1e6;
    double shutter_seconds = 1; ///< shutterclose - shutteropen.
    int medium = -1;            ///< The medium that the camera is in.
};

struct PixelFilter {
    enum class Kind { box, gaussian, triangle, mitchell };
    Kind kind = Kind::gaussian;
    double x_radius = 1.5;
    double y_radius = 1.5;
    double sigma = 0.5;              ///< gaussian
    double b = 1.0 / 3, c = 1.0 / 3; ///< mitchell
};

/// Pixel rectangle, upper bounds exclusive.
struct PixelBounds {
    int x0 = 0, x1 = 0, y0 = 0, y1 = 0;
    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
};

struct Film {
    int width = 1280; ///< Of the whole picture.
    int height = 720;
    PixelBounds bounds{0, 1280, 0, 720}; ///< The part that is rendered; not empty.
    std::string filename = "pbrt.exr";
    double iso = 100;
    double max_component_value = std::numeric_limits<double>::infinity();
    bool half_float = false; ///< savefp16 true was asked for.
};

/// How light is estimated.
struct Integrator {
    enum class Kind {
        volpath,      ///< Surfaces and media.
        path,         ///< Surfaces only: media are ignored.
        singlescatter ///< Surfaces; media by marching, with light that scatters in them once.
    };
    /// volpath: what a collision does to a path.
    enum class Absorption {
        expected, ///< Flights end where light is scattered; absorption is a weight.
        analog    ///< Flights end where light meets matter, and there paths end with it.
    };
    /// Of shadow rays, where there is no closed form.
    enum class Transmittance {
        tracked, ///< Ratio tracking: unbiased.
        marched  ///< exp(-sum of sigma_t dt) at the middles of steps: deterministic and biased.
    };
    /// singlescatter: where in its step a sample stands.
    enum class Placement {
        uniform,    ///< In the middle.
        jittered,   ///< Anywhere, by a random number of its own.
        equiangular ///< Steps of equal angle as seen from a light (Kulla and Fajardo 2012).
    };
    Kind kind = Kind::volpath;
    int max_depth =
        5; ///< Most scattering events (surface or medium) of a path; interfaces are free.
    /// volpath, path: next-event estimation. Else lights are found by running into them.
    bool samples_lights = true;
    Absorption absorption = Absorption::expected;
    Transmittance transmittance = Transmittance::tracked;
    int steps = 64;       ///< Of a march through one segment in one medium, > 0 ...
    double step_size = 0; ///< ... or, if > 0, their length at most, in scene units.
    Placement placement = Placement::uniform;
    /// Most segments of a path, tentative collisions included. A guard against paths without an
    /// end, never part of the method: what it ends is counted. Optical depths of 1000 need some
    /// 1e6.
    std::uint32_t event_limit = 1u << 22;
};

/// Where the random numbers of the samples of a pixel come from.
enum class Sampler {
    independent, ///< shared/random.h
    sobol,       ///< Owen-scrambled Sobol' points: shared/sobol.h
    zsobol       ///< Likewise, with errors that cancel between neighbours.
};

struct Scene {
    std::string filename;
    std::string
        sha256; ///< Hex digest over the bytes of every file that was read, in reading order.
    Camera camera;
    Film film;
    PixelFilter filter;
    Integrator integrator;
    Sampler sampler =
        Sampler::independent; ///< Of a scene that was read: sobol, if it says nothing.
    SourceLocation sampler_where;
    int samples_per_pixel = 16;

    /// zsobol: so many samples of a pixel, as a power of two, are of the sequence of all pixels.
    std::uint32_t zsobol_bits() const {
        return static_cast<std::uint32_t>(
            std::bit_width(static_cast<std::uint32_t>(samples_per_pixel - 1)));
    }

    std::uint64_t seed = 0;

    std::vector<Medium> media;
    std::vector<Material> materials;
    std::vector<AreaLight> area_lights;
    std::vector<Light> lights;
    std::vector<Shape> shapes; ///< In world space (world_from_object applies).
    std::vector<ObjectDefinition> objects;
    std::vector<ObjectInstance> instances;

    std::vector<std::string> warnings; ///< "file:line:column: warning: ..." lines, for the user.
};

} // namespace tyndall
