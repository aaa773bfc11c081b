#include "render/box.h"

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

namespace tyndall {
namespace {

using Facet = std::array<glm::dvec3, 3>;

/// The triangles of the mesh after the transform, patches as two.
std::vector<Facet> facets_of(const Mesh& mesh, const glm::dmat4& transform) {
    const auto point = [&](std::uint32_t i) {
        return glm::dvec3(transform * glm::dvec4(glm::dvec3(mesh.positions[i]), 1));
    };
    std::vector<Facet> facets;
    for (const auto& t : mesh.triangles)
        facets.push_back({point(t[0]), point(t[1]), point(t[2])});
    for (const auto& q : mesh.patches) { // p00 p10 p01 p11
        facets.push_back({point(q[0]), point(q[1]), point(q[3])});
        facets.push_back({point(q[0]), point(q[3]), point(q[2])});
    }
    return facets;
}

/// A corner as three bits (1: at the upper end of the axis), or -1 if the point is no corner.
int corner_of(const glm::dvec3& p, const AxisBox& box) {
    int corner = 0;
    for (int i = 0; i < 3; ++i) {
        if (p[i] == box.upper[i])
            corner |= 1 << i;
        else if (p[i] != box.lower[i])
            return -1;
    }
    return corner;
}

/// Triangles of one face, as sets of corners (bit c: corner c).
struct Face {
    std::vector<unsigned> corner_sets;
    int outward = 0; ///< Triangles whose normal points outward.

    /// Two triangles of three corners that share a diagonal cover the face.
    bool is_covered() const {
        if (corner_sets.size() != 2) return false;
        const unsigned shared = corner_sets[0] & corner_sets[1];
        if (std::popcount(corner_sets[0]) != 3 || std::popcount(corner_sets[1]) != 3 ||
            std::popcount(shared) != 2)
            return false;
        unsigned difference = 0; // opposite corners of a face differ in two bits
        for (unsigned corner = 0; corner < 8; ++corner)
            if (shared >> corner & 1u) difference ^= corner;
        return std::popcount(difference) == 2;
    }
};

/// Adds the triangle to the face of the box that it lies in; false if it lies in none.
bool add_facet(const Facet& facet, const AxisBox& box, std::array<Face, 6>& faces) {
    unsigned set = 0, all = 7, any = 0;
    for (const glm::dvec3& p : facet) {
        const int corner = corner_of(p, box);
        if (corner < 0) return false;
        set |= 1u << corner;
        all &= static_cast<unsigned>(corner);
        any |= static_cast<unsigned>(corner);
    }
    const glm::dvec3 normal = glm::cross(facet[1] - facet[0], facet[2] - facet[0]);
    for (unsigned axis = 0; axis < 3; ++axis) {
        const bool is_upper = all >> axis & 1u, is_lower = !(any >> axis & 1u);
        if (!is_upper && !is_lower) continue;
        Face& face = faces[2 * axis + (is_upper ? 1 : 0)];
        face.corner_sets.push_back(set);
        face.outward += (normal[static_cast<int>(axis)] > 0) == is_upper;
    }
    return true;
}

} // namespace

std::optional<AxisBox> find_box(const Shape& shape, const Mesh& mesh, const glm::dmat4& transform) {
    if (mesh.triangles.size() + 2 * mesh.patches.size() != 12 || !mesh.normals.empty())
        return std::nullopt;
    const std::vector<Facet> facets = facets_of(mesh, transform);
    AxisBox box{facets[0][0], facets[0][0], false};
    for (const Facet& facet : facets)
        for (const glm::dvec3& p : facet) {
            box.lower = glm::min(box.lower, p);
            box.upper = glm::max(box.upper, p);
        }
    if (glm::any(glm::equal(box.lower, box.upper))) return std::nullopt;
    std::array<Face, 6> faces;
    for (const Facet& facet : facets)
        if (!add_facet(facet, box, faces)) return std::nullopt;
    if (!std::all_of(faces.begin(), faces.end(), [](const Face& f) { return f.is_covered(); }))
        return std::nullopt;
    int outward = 0;
    for (const Face& face : faces)
        outward += face.outward;
    if (outward != 0 && outward != 12) return std::nullopt;
    const bool flip = shape.reverse_orientation != (glm::determinant(glm::dmat3(transform)) < 0);
    box.is_inward = (outward == 0) != flip;
    return box;
}

} // namespace tyndall
