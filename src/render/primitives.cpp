#include "render/primitives.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tyndall {

using namespace shared;

namespace {

glm::dvec3 transform(const glm::dmat4& m, const glm::dvec3& p) {
    return m * glm::dvec4(p, 1);
}

bool mirrors(const glm::dmat4& m) {
    return glm::determinant(glm::dmat3(m)) < 0;
}

/// Appends the transformed vertex normals and returns where they are, or NONE.
template<std::size_t N>
std::uint32_t append_normals(const Mesh& mesh, const std::array<std::uint32_t, N>& indices,
                             const glm::dmat3& normal_matrix, bool reverse, glm::dvec3& mean,
                             PrimitiveSet& set) {
    mean = glm::dvec3(0);
    if (mesh.normals.empty()) return NONE;
    const auto first = static_cast<std::uint32_t>(set.vertex_normals.size());
    for (std::uint32_t index : indices) {
        glm::dvec3 n = normal_matrix * glm::dvec3(mesh.normals[index]);
        const double length = glm::length(n);
        if (length > 0) n /= reverse ? -length : length;
        mean += n;
        set.vertex_normals.emplace_back(glm::vec3(n), 0.0f);
    }
    return first;
}

void append_triangles(const Shape& shape, const Mesh& mesh, const glm::dmat4& m,
                      std::uint32_t shape_index, PrimitiveSet& set, std::uint64_t& count) {
    const glm::dmat3 normal_matrix = glm::transpose(glm::inverse(glm::dmat3(m)));
    const bool flip = shape.reverse_orientation != mirrors(m);
    for (const auto& t : mesh.triangles) {
        // The plane is that of the float32 vertices: edges and plane tell the same triangle.
        std::array<glm::vec3, 3> p;
        for (int i = 0; i < 3; ++i)
            p[i] = glm::vec3(transform(m, glm::dvec3(mesh.positions[t[i]])));
        glm::dvec3 normal =
            glm::cross(glm::dvec3(p[1]) - glm::dvec3(p[0]), glm::dvec3(p[2]) - glm::dvec3(p[0]));
        const double twice_area = glm::length(normal);
        if (!(twice_area > 0)) continue;
        normal /= flip ? -twice_area : twice_area;
        glm::dvec3 mean;
        const std::uint32_t normals =
            append_normals(mesh, t, normal_matrix, shape.reverse_orientation, mean, set);
        if (glm::dot(normal, mean) < 0) normal = -normal;
        const glm::vec3 rounded(normal);
        const double offset = glm::dot(
            glm::dvec3(rounded), (glm::dvec3(p[0]) + glm::dvec3(p[1]) + glm::dvec3(p[2])) / 3.0);
        set.primitives.push_back({.a = p[0],
                                  .kind_and_shape = KIND_TRIANGLE << KIND_SHIFT | shape_index,
                                  .b = p[1],
                                  .light = NONE,
                                  .c = p[2],
                                  .extra = normals,
                                  .normal = rounded,
                                  .offset = static_cast<float>(offset)});
        set.kinds |= PRIMITIVE_TRIANGLES;
        set.bounds.push_back(
            {glm::min(p[0], glm::min(p[1], p[2])), glm::max(p[0], glm::max(p[1], p[2]))});
        set.areas.push_back(shape.area_light >= 0 ? twice_area / 2 : 0);
        set.source_order.push_back(count++);
    }
}

/// Area of a bilinear patch by Gauss-Legendre quadrature (it only weighs lights and scales
/// "power").
double patch_area(const std::array<glm::dvec3, 4>& p) {
    constexpr std::array<double, 4> nodes{0.06943184420297371, 0.33000947820757187,
                                          0.66999052179242813, 0.93056815579702629};
    constexpr std::array<double, 4> weights{0.17392742256872693, 0.32607257743127307,
                                            0.32607257743127307, 0.17392742256872693};
    double area = 0;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            area += weights[i] * weights[j] *
                    glm::length(glm::cross(glm::mix(p[1] - p[0], p[3] - p[2], nodes[j]),
                                           glm::mix(p[2] - p[0], p[3] - p[1], nodes[i])));
    return area;
}

void append_patches(const Shape& shape, const Mesh& mesh, const glm::dmat4& m,
                    std::uint32_t shape_index, PrimitiveSet& set, std::uint64_t& count) {
    const glm::dmat3 normal_matrix = glm::transpose(glm::inverse(glm::dmat3(m)));
    const bool flip = shape.reverse_orientation != mirrors(m);
    for (const auto& q : mesh.patches) {
        std::array<glm::dvec3, 4> p;
        for (int i = 0; i < 4; ++i)
            p[i] = glm::vec3(transform(m, glm::dvec3(mesh.positions[q[i]])));
        const double area = patch_area(p);
        if (!(area > 0)) continue;
        glm::dvec3 mean;
        const std::uint32_t normals =
            append_normals(mesh, q, normal_matrix, shape.reverse_orientation, mean, set);
        const glm::dvec3 middle = glm::cross(p[1] - p[0] + p[3] - p[2], p[2] - p[0] + p[3] - p[1]);
        const bool turned = (glm::dot(middle, mean) * (flip ? -1 : 1)) < 0;
        set.primitives.push_back({.a = glm::vec3(p[0]),
                                  .kind_and_shape = KIND_PATCH << KIND_SHIFT | shape_index,
                                  .b = glm::vec3(p[1]),
                                  .light = NONE,
                                  .c = glm::vec3(p[2]),
                                  .extra = normals,
                                  .normal = glm::vec3(p[3]),
                                  .offset = flip != turned ? -1.0f : 1.0f});
        set.kinds |= PRIMITIVE_PATCHES;
        set.bounds.push_back({glm::vec3(glm::min(glm::min(p[0], p[1]), glm::min(p[2], p[3]))),
                              glm::vec3(glm::max(glm::max(p[0], p[1]), glm::max(p[2], p[3])))});
        set.areas.push_back(shape.area_light >= 0 ? area : 0);
        set.source_order.push_back(count++);
    }
}

/// Whether the linear part only rotates, mirrors and scales all axes alike.
bool is_similarity(const glm::dmat3& m) {
    const double scale = glm::dot(m[0], m[0]);
    const auto close = [&](double a, double b) { return std::abs(a - b) <= 1e-9 * scale; };
    return close(glm::dot(m[1], m[1]), scale) && close(glm::dot(m[2], m[2]), scale) &&
           close(glm::dot(m[0], m[1]), 0) && close(glm::dot(m[1], m[2]), 0) &&
           close(glm::dot(m[0], m[2]), 0);
}

/// Box of the image of an object-space box [-r, r] x [-r, r] x [z0, z1].
Bounds quadric_bounds(const glm::dmat4& m, double r, double z0, double z1) {
    const glm::dvec3 center = transform(m, {0, 0, (z0 + z1) / 2});
    const glm::dmat3 linear(m);
    glm::dvec3 half;
    for (int i = 0; i < 3; ++i)
        half[i] = std::abs(linear[0][i]) * r + std::abs(linear[1][i]) * r +
                  std::abs(linear[2][i]) * (z1 - z0) / 2;
    // A hit found with the error of float32 transforms must lie inside.
    half += 1e-6 * (glm::abs(center) + half);
    return round_outward(center - half, center + half);
}

/// Area of the image of a quadric, by summing over a fine grid of its parameters.
double quadric_area(const glm::dmat4& m, const Shape& shape) {
    const glm::dmat3 linear(m);
    const auto* sphere = std::get_if<Sphere>(&shape.geometry);
    const auto* disk = std::get_if<Disk>(&shape.geometry);
    constexpr int steps = 64;
    const double z_extent = sphere ? sphere->z_max - sphere->z_min : 0;
    const double area =
        sphere ? sphere->phi_max * sphere->radius * z_extent
               : 0.5 * disk->phi_max *
                     (disk->radius * disk->radius - disk->inner_radius * disk->inner_radius);
    const glm::dmat3 cofactor =
        glm::transpose(glm::inverse(linear)) * std::abs(glm::determinant(linear));
    if (disk) return area * glm::length(cofactor * glm::dvec3(0, 0, 1));
    if (is_similarity(linear)) return area * glm::dot(linear[0], linear[0]);
    double stretch = 0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const double z = (sphere->z_min + z_extent * (i + 0.5) / steps) / sphere->radius;
            const double phi = sphere->phi_max * (j + 0.5) / steps;
            const double s = std::sqrt(std::max(0.0, 1 - z * z));
            stretch += glm::length(cofactor * glm::dvec3(s * std::cos(phi), s * std::sin(phi), z));
        }
    return area * stretch / (steps * steps);
}

void append_quadric(const Shape& shape, const glm::dmat4& m, std::uint32_t shape_index,
                    PrimitiveSet& set, std::uint64_t& count) {
    const auto* sphere = std::get_if<Sphere>(&shape.geometry);
    const auto* disk = std::get_if<Disk>(&shape.geometry);
    QuadricRecord q{};
    q.object_from_world = make_affine(glm::inverse(m));
    q.world_from_object = make_affine(m);
    q.determinant = static_cast<float>(std::abs(glm::determinant(glm::dmat3(m))));
    q.radius = static_cast<float>(sphere ? sphere->radius : disk->radius);
    q.inner_radius = static_cast<float>(disk ? disk->inner_radius : 0);
    q.z_min = static_cast<float>(sphere ? sphere->z_min : disk->height);
    q.z_max = static_cast<float>(sphere ? sphere->z_max : disk->height);
    q.phi_max = static_cast<float>(sphere ? sphere->phi_max : disk->phi_max);
    if (sphere && sphere->is_full()) q.flags |= QUADRIC_FULL;
    if (is_similarity(glm::dmat3(m))) q.flags |= QUADRIC_SIMILARITY;
    const bool flip = shape.reverse_orientation != mirrors(m);
    set.primitives.push_back(
        {.kind_and_shape = (sphere ? KIND_SPHERE : KIND_DISK) << KIND_SHIFT | shape_index,
         .light = NONE,
         .extra = static_cast<std::uint32_t>(set.quadrics.size()),
         .offset = flip ? -1.0f : 1.0f});
    set.kinds |= sphere ? PRIMITIVE_SPHERES : PRIMITIVE_DISKS;
    const bool is_whole =
        sphere ? sphere->is_full() : disk->inner_radius == 0 && disk->phi_max >= 6.28318530;
    if (!is_whole) set.kinds |= PRIMITIVE_CUTS;
    set.bounds.push_back(quadric_bounds(m, q.radius, q.z_min, q.z_max));
    set.areas.push_back(shape.area_light >= 0 ? quadric_area(m, shape) : 0);
    set.source_order.push_back(count++);
    set.quadrics.push_back(q);
}

void append_box(const AxisBox& box, std::uint32_t shape_index, PrimitiveSet& set,
                std::uint64_t& count) {
    const glm::vec3 lower(box.lower), upper(box.upper);
    set.primitives.push_back({.a = lower,
                              .kind_and_shape = KIND_BOX << KIND_SHIFT | shape_index,
                              .b = upper,
                              .light = NONE,
                              .extra = NONE,
                              .offset = box.is_inward ? -1.0f : 1.0f});
    set.kinds |= PRIMITIVE_BOXES;
    set.bounds.push_back({lower, upper});
    set.areas.push_back(0);
    set.source_order.push_back(count++);
}

} // namespace

AffineRecord make_affine(const glm::dmat4& m) {
    const auto row = [&](int i) {
        return glm::vec4(glm::dvec4(m[0][i], m[1][i], m[2][i], m[3][i]));
    };
    return {row(0), row(1), row(2)};
}

std::optional<AxisBox> find_plain_box(const Shape& shape, const Mesh& mesh,
                                      const glm::dmat4& transform) {
    if (shape.area_light >= 0) return std::nullopt;
    return find_box(shape, mesh, transform);
}

bool are_patches_flat(const Shape& shape, const Mesh& mesh) {
    if (shape.area_light >= 0 || !mesh.normals.empty()) return false;
    return std::all_of(mesh.patches.begin(), mesh.patches.end(), [&](const auto& q) {
        std::array<glm::dvec3, 4> p; // around the patch: p00, p10, p11, p01
        for (int i = 0; i < 4; ++i)
            p[i] = glm::dvec3(mesh.positions[q[i < 2 ? i : 5 - i]]);
        const glm::dvec3 normal = glm::cross(p[2] - p[0], p[3] - p[1]);
        const double size = glm::length(p[2] - p[0]) + glm::length(p[3] - p[1]);
        if (!(glm::length(normal) > 0)) return false;
        for (int i = 0; i < 4; ++i) { // every corner turns the same way, and lies in the plane
            const glm::dvec3 edge = p[(i + 1) % 4] - p[i], next = p[(i + 2) % 4] - p[(i + 1) % 4];
            if (glm::dot(glm::cross(edge, next), normal) < 0) return false;
            if (std::abs(glm::dot(edge, glm::normalize(normal))) > 1e-9 * size) return false;
        }
        return true;
    });
}

void append_shape(const Shape& shape, const glm::dmat4& to_target, std::uint32_t shape_index,
                  ShapeSet& set) {
    const glm::dmat4 m = to_target * shape.world_from_object;
    if (const auto* mesh = std::get_if<Mesh>(&shape.geometry)) {
        if (const std::optional<AxisBox> box = find_plain_box(shape, *mesh, m)) {
            append_box(*box, shape_index, set.others, set.count);
        } else if (are_patches_flat(shape, *mesh)) {
            Mesh flat = *mesh;
            for (const auto& q : mesh->patches) {
                flat.triangles.push_back({q[0], q[1], q[3]});
                flat.triangles.push_back({q[0], q[3], q[2]});
            }
            append_triangles(shape, flat, m, shape_index, set.triangles, set.count);
        } else {
            append_triangles(shape, *mesh, m, shape_index, set.triangles, set.count);
            append_patches(shape, *mesh, m, shape_index, set.others, set.count);
        }
    } else {
        append_quadric(shape, m, shape_index, set.others, set.count);
    }
}

} // namespace tyndall
