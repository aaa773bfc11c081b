#include "scene/shapes.h"

#include "scene/ply.h"
#include "scene/type_names.h"

#include <algorithm>
#include <fmt/core.h>

namespace tyndall {
namespace {

constexpr Requirement is_sweep{[](double x) { return x > 0; }, "an angle > 0, in degrees"};

double read_phi_max(Parameters& parameters) {
    // pbrt clamps, so that 720 is a full turn.
    return glm::radians(std::min(parameters.get_float("phimax", 360, is_sweep), 360.0));
}

Sphere read_sphere(Parameters& parameters) {
    Sphere sphere;
    sphere.radius = parameters.get_float("radius", 1, require::positive);
    const double a = parameters.get_float("zmin", -sphere.radius);
    const double b = parameters.get_float("zmax", sphere.radius);
    sphere.z_min = std::clamp(std::min(a, b), -sphere.radius, sphere.radius);
    sphere.z_max = std::clamp(std::max(a, b), -sphere.radius, sphere.radius);
    sphere.phi_max = read_phi_max(parameters);
    if (sphere.z_min == sphere.z_max) {
        parameters.diagnostics().error(
            parameters.where(),
            fmt::format("the sphere of radius {} has nothing between zmin {} and "
                        "zmax {} (expected a part of it)",
                        sphere.radius, a, b));
    }
    return sphere;
}

Disk read_disk(Parameters& parameters) {
    Disk disk;
    disk.height = parameters.get_float("height", 0);
    disk.radius = parameters.get_float("radius", 1, require::positive);
    disk.inner_radius = parameters.get_float("innerradius", 0, require::non_negative);
    disk.phi_max = read_phi_max(parameters);
    if (disk.inner_radius >= disk.radius) {
        parameters.diagnostics().error(
            parameters.where(), fmt::format("the disk has the radius {} and the inner radius {} "
                                            "(expected the inner one to be smaller)",
                                            disk.radius, disk.inner_radius));
    }
    return disk;
}

std::vector<glm::vec3> read_vectors(Parameters& parameters, std::string_view type,
                                    std::string_view name) {
    std::vector<glm::vec3> vectors;
    if (const Parameter* parameter = parameters.find(type, name)) {
        const std::vector<double>& n = parameter->numbers;
        vectors.reserve(n.size() / 3);
        for (std::size_t i = 0; i < n.size(); i += 3) {
            vectors.emplace_back(static_cast<float>(n[i]), static_cast<float>(n[i + 1]),
                                 static_cast<float>(n[i + 2]));
        }
    }
    return vectors;
}

std::vector<glm::vec2> read_uvs(Parameters& parameters) {
    std::vector<glm::vec2> uvs;
    if (const Parameter* parameter = parameters.find("point2", "uv")) {
        const std::vector<double>& n = parameter->numbers;
        uvs.reserve(n.size() / 2);
        for (std::size_t i = 0; i < n.size(); i += 2) {
            uvs.emplace_back(static_cast<float>(n[i]), static_cast<float>(n[i + 1]));
        }
    }
    return uvs;
}

/// Leaves out values that do not come one for each of `expected`, as pbrt does.
template<typename T>
void keep_if_matching(std::vector<T>& values, std::size_t expected, std::string_view name,
                      const Parameters& parameters) {
    if (values.empty() || values.size() == expected) return;
    parameters.diagnostics().warning(
        parameters.where(),
        fmt::format("{} has {} values of \"{}\" (expected {}); they are left out",
                    parameters.subject(), values.size(), name, expected));
    values.clear();
}

/// The indices in groups of `corners`; one group in order if there are none and just enough
/// vertices.
template<std::size_t corners>
std::vector<std::array<std::uint32_t, corners>> read_faces(Parameters& parameters,
                                                           std::size_t vertex_count) {
    std::vector<std::array<std::uint32_t, corners>> faces;
    const Parameter* parameter = vertex_count == corners
                                     ? parameters.find("integer", "indices")
                                     : parameters.find_required("integer", "indices");
    if (!parameter) {
        if (vertex_count == corners) {
            for (std::uint32_t i = 0; i < corners; ++i)
                faces.resize(1), faces[0][i] = i;
        }
        return faces;
    }
    const std::vector<int>& indices = parameter->integers;
    if (indices.size() % corners != 0) {
        parameters.diagnostics().warning(
            parameter->where, fmt::format("{} indices (expected a multiple of {}); the last {} are "
                                          "left out",
                                          indices.size(), corners, indices.size() % corners));
    }
    faces.resize(indices.size() / corners);
    if (faces.empty()) {
        parameters.report_value(*parameter, "too short",
                                fmt::format("at least {} indices", corners));
    }
    for (std::size_t i = 0; i < faces.size() * corners; ++i) {
        const int index = indices[i];
        if (index < 0 || static_cast<std::size_t>(index) >= vertex_count) {
            parameters.report_value(
                *parameter, fmt::format("{} at position {}", index, i),
                fmt::format("indices from 0 to below {}, the number of points", vertex_count));
            return {};
        }
        faces[i / corners][i % corners] = static_cast<std::uint32_t>(index);
    }
    return faces;
}

/// What trianglemesh and bilinearmesh share.
Mesh read_vertices(Parameters& parameters) {
    Mesh mesh;
    parameters.find_required("point3", "P");
    mesh.positions = read_vectors(parameters, "point3", "P");
    mesh.normals = read_vectors(parameters, "normal", "N");
    mesh.uvs = read_uvs(parameters);
    keep_if_matching(mesh.normals, mesh.positions.size(), "N", parameters);
    keep_if_matching(mesh.uvs, mesh.positions.size(), "uv", parameters);
    return mesh;
}

/// Face indices serve textures only; they are checked and left out.
void check_face_indices(Parameters& parameters, std::size_t face_count) {
    if (const Parameter* parameter = parameters.find("integer", "faceIndices")) {
        std::vector<int> indices = parameter->integers;
        keep_if_matching(indices, face_count, "faceIndices", parameters);
    }
}

Mesh read_triangle_mesh(Parameters& parameters) {
    Mesh mesh = read_vertices(parameters);
    std::vector<glm::vec3> tangents = read_vectors(parameters, "vector3", "S");
    keep_if_matching(tangents, mesh.positions.size(), "S", parameters);
    if (mesh.positions.empty()) {
        parameters.find("integer", "indices");
    } else {
        mesh.triangles = read_faces<3>(parameters, mesh.positions.size());
    }
    check_face_indices(parameters, mesh.triangles.size());
    return mesh;
}

Mesh read_bilinear_mesh(Parameters& parameters) {
    Mesh mesh = read_vertices(parameters);
    parameters.reject("string", "emissionfilename");
    if (mesh.positions.empty()) {
        parameters.find("integer", "indices");
    } else {
        mesh.patches = read_faces<4>(parameters, mesh.positions.size());
    }
    check_face_indices(parameters, mesh.patches.size());
    return mesh;
}

Mesh read_ply_shape(Parameters& parameters, InputFiles& files) {
    parameters.reject_texture("displacement");
    parameters.get_float("edgelength", 1, require::positive); // of displaced meshes only
    if (!parameters.find_required("string", "filename")) return {};
    const std::string name = parameters.get_string("filename", "");
    const std::filesystem::path file = files.resolve(name, *parameters.where().file);
    try {
        PlyMesh ply = read_ply(files.read(file), file.string());
        if (ply.ignored_faces > 0) {
            parameters.diagnostics().warning(
                parameters.where(),
                fmt::format("{}: {} faces are left out (expected 3 or 4 vertices)", file.string(),
                            ply.ignored_faces));
        }
        return std::move(ply.mesh);
    } catch (const Error& error) {
        parameters.diagnostics().error(parameters.where(), error.what());
        return {};
    }
}

void check_alpha(Parameters& parameters) {
    parameters.reject_texture("alpha");
    // pbrt takes 1 and more as opaque.
    if (parameters.get_float("alpha", 1) < 1) parameters.reject("float", "alpha");
}

} // namespace

std::optional<Geometry> read_geometry(const std::string& type, Parameters& parameters,
                                      InputFiles& files) {
    static const TypeNames names{"shape",
                                 {"sphere", "disk", "trianglemesh", "plymesh", "bilinearmesh"},
                                 {"cylinder", "curve", "loopsubdiv"}};
    if (!check_type(names, type, parameters.where(), parameters.diagnostics())) return std::nullopt;
    std::optional<Geometry> geometry;
    if (type == "sphere") {
        geometry = read_sphere(parameters);
    } else if (type == "disk") {
        geometry = read_disk(parameters);
    } else if (type == "trianglemesh") {
        geometry = read_triangle_mesh(parameters);
    } else if (type == "bilinearmesh") {
        geometry = read_bilinear_mesh(parameters);
    } else {
        geometry = read_ply_shape(parameters, files);
    }
    check_alpha(parameters);
    parameters.report_unused();
    return geometry;
}

} // namespace tyndall
