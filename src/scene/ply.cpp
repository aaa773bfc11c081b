#include "scene/ply.h"

#include "scene/diagnostics.h"
#include "scene/ply_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <limits>

namespace tyndall {
namespace {

[[noreturn]] void fail(const std::string& what) {
    throw Error(ExitStatus::bad_input, what);
}

/// Where the properties of a vertex go.
enum Slot : std::size_t { x, y, z, nx, ny, nz, u, v, slot_count };
constexpr std::size_t no_slot = slot_count;

struct VertexLayout {
    std::vector<std::size_t> slots; ///< Of each property; no_slot: skip it.
    bool has_normals = false;
    bool has_uvs = false;
};

bool find_slots(const PlyElement& element, std::initializer_list<std::string_view> names,
                std::size_t first_slot, VertexLayout& layout) {
    std::vector<std::size_t> slots = layout.slots;
    std::size_t slot = first_slot;
    for (const std::string_view name : names) {
        const auto found =
            std::find_if(element.properties.begin(), element.properties.end(),
                         [&](const PlyProperty& p) { return p.name == name && !p.is_list; });
        if (found == element.properties.end()) return false;
        slots[static_cast<std::size_t>(found - element.properties.begin())] = slot++;
    }
    layout.slots = std::move(slots);
    return true;
}

VertexLayout make_vertex_layout(const PlyElement& element) {
    VertexLayout layout;
    layout.slots.assign(element.properties.size(), no_slot);
    if (!find_slots(element, {"x", "y", "z"}, x, layout)) fail("vertices without x, y and z");
    layout.has_normals = find_slots(element, {"nx", "ny", "nz"}, nx, layout);
    layout.has_uvs = find_slots(element, {"u", "v"}, u, layout) ||
                     find_slots(element, {"s", "t"}, u, layout) ||
                     find_slots(element, {"texture_u", "texture_v"}, u, layout) ||
                     find_slots(element, {"texture_s", "texture_t"}, u, layout);
    return layout;
}

void skip_property(PlyValues& values, const PlyProperty& property) {
    const std::size_t count = property.is_list ? values.read_length(property.count_type) : 1;
    for (std::size_t i = 0; i < count; ++i)
        values.read(property.type);
}

void read_vertex(PlyValues& values, const PlyElement& element, const VertexLayout& layout,
                 Mesh& mesh) {
    std::array<float, slot_count> vertex{};
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
        const PlyProperty& property = element.properties[i];
        if (layout.slots[i] == no_slot) {
            skip_property(values, property);
            continue;
        }
        const double value = values.read(property.type);
        if (!(std::abs(value) <= std::numeric_limits<float>::max())) {
            fail(fmt::format("property {} is {} (expected a finite number)",
                             in_quotes(property.name), value));
        }
        vertex[layout.slots[i]] = static_cast<float>(value);
    }
    mesh.positions.emplace_back(vertex[x], vertex[y], vertex[z]);
    if (layout.has_normals) mesh.normals.emplace_back(vertex[nx], vertex[ny], vertex[nz]);
    if (layout.has_uvs) mesh.uvs.emplace_back(vertex[u], vertex[v]);
}

bool is_index_list(const PlyProperty& property) {
    return property.is_list &&
           (property.name == "vertex_indices" || property.name == "vertex_index");
}

std::uint32_t read_index(PlyValues& values, PlyType type) {
    const double index = values.read(type);
    if (index < 0 || index > std::numeric_limits<std::uint32_t>::max() ||
        index != std::floor(index)) {
        fail(fmt::format("the vertex index {} (expected an integer >= 0)", index));
    }
    return static_cast<std::uint32_t>(index);
}

void read_face_indices(PlyValues& values, const PlyProperty& property, PlyMesh& result) {
    const std::size_t count = values.read_length(property.count_type);
    std::array<std::uint32_t, 4> face{};
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t index = read_index(values, property.type);
        if (i < face.size()) face[i] = index;
    }
    if (count == 3) {
        result.mesh.triangles.push_back({face[0], face[1], face[2]});
    } else if (count == 4) {
        // A quadrilateral runs around its edge, a patch from row to row.
        result.mesh.patches.push_back({face[0], face[1], face[3], face[2]});
    } else {
        ++result.ignored_faces;
    }
}

void read_element(PlyValues& values, const PlyElement& element, PlyMesh& result) {
    if (element.properties.empty()) return;
    const bool is_vertex = element.name == "vertex";
    const bool is_face = element.name == "face";
    const VertexLayout layout = is_vertex ? make_vertex_layout(element) : VertexLayout{};
    std::uint64_t index = 0;
    try {
        for (; index < element.count; ++index) {
            if (is_vertex) {
                read_vertex(values, element, layout, result.mesh);
                continue;
            }
            for (const PlyProperty& property : element.properties) {
                if (is_face && is_index_list(property)) {
                    read_face_indices(values, property, result);
                } else {
                    skip_property(values, property);
                }
            }
        }
    } catch (const Error& error) {
        fail(fmt::format("{} {} of {}{}: {}", element.name, index, element.count, values.place(),
                         error.what()));
    }
}

void check_indices(const Mesh& mesh) {
    const auto check = [&](const auto& face) {
        for (const std::uint32_t index : face) {
            if (index >= mesh.positions.size()) {
                fail(
                    fmt::format("a face has the vertex index {} (expected one below {}, the number "
                                "of vertices)",
                                index, mesh.positions.size()));
            }
        }
    };
    for (const auto& triangle : mesh.triangles)
        check(triangle);
    for (const auto& patch : mesh.patches)
        check(patch);
}

PlyMesh read(std::string_view bytes) {
    const PlyHeader header = read_ply_header(bytes);
    PlyValues values(bytes, header);
    PlyMesh result;
    bool has_indices = false;
    for (const PlyElement& element : header.elements) {
        read_element(values, element, result);
        has_indices |=
            element.name == "face" &&
            std::any_of(element.properties.begin(), element.properties.end(), is_index_list);
    }
    if (result.mesh.positions.empty()) fail("no vertices");
    if (!has_indices) fail("no faces with a list \"vertex_indices\"");
    if (result.mesh.triangles.empty() && result.mesh.patches.empty()) {
        fail("no faces with 3 or 4 vertices");
    }
    check_indices(result.mesh);
    return result;
}

} // namespace

PlyMesh read_ply(std::string_view bytes, const std::string& file_name) {
    try {
        return read(bytes);
    } catch (const Error& error) {
        fail(fmt::format("{}: {}", file_name, error.what()));
    }
}

} // namespace tyndall
