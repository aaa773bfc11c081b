#include "scene/volume_media.h"

#include "scene/grid_media.h"
#include "scene/transform.h"
#include "volume/volume_file.h"

#include <array>
#include <fmt/format.h>
#include <optional>
#include <set>

namespace tyndall {
namespace {

/// Names of the grids to read.
struct VolumeNames {
    std::string density, temperature;
    bool is_temperature_given = false;
};

VolumeNames read_names(Parameters& parameters, bool is_vdb) {
    VolumeNames names;
    names.is_temperature_given = parameters.find("string", "temperaturename") != nullptr;
    names.density = parameters.get_string("gridname", "density");
    names.temperature = parameters.get_string("temperaturename", "temperature");
    if (is_vdb) {
        names.is_temperature_given |= parameters.find("string", "temperature") != nullptr;
        names.density = parameters.get_string("density", names.density);
        names.temperature = parameters.get_string("temperature", names.temperature);
    }
    return names;
}

/// The grids of a file; the temperature need not be there. Nothing after an error.
struct VolumeFields {
    Field density;
    std::optional<Field> temperature;
};
std::optional<VolumeFields> read_fields(Parameters& parameters, const Parameter& filename,
                                        const VolumeNames& names, InputFiles& files) {
    const std::filesystem::path path = files.resolve(filename.strings.at(0), *filename.where.file);
    std::string bytes;
    try {
        bytes = files.read(path);
    } catch (const Error& error) {
        parameters.diagnostics().error(filename.where, error.what());
        return std::nullopt;
    }
    try {
        return VolumeFields{*read_field(bytes, {.name = names.density}),
                            read_field(bytes, {.name = names.temperature,
                                               .may_be_missing = !names.is_temperature_given,
                                               .may_be_negative = true})};
    } catch (const Error& error) {
        parameters.diagnostics().error(
            filename.where, fmt::format("{}: {}", file_in_quotes(path.string()), error.what()));
        return std::nullopt;
    }
}

/// Whether two maps move no point near the box by more than a thousandth of a voxel.
bool are_equal_maps(const Field& a, const Field& b) {
    const glm::dmat4 a_from_b = glm::inverse(a.world_from_index) * b.world_from_index;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 point = glm::mix(glm::dvec3(a.grid.lower()), glm::dvec3(a.grid.upper()),
                                          glm::dvec3(corner & 1, corner >> 1 & 1, corner >> 2));
        if (glm::length(transform_point(a_from_b, point) - point) > 1e-3) return false;
    }
    return true;
}

/// A field by the voxels of another one: at those in bricks where `to` has values, and around them.
Grid resample(const Field& from, const Field& to) {
    const auto order = [](const glm::ivec3& a, const glm::ivec3& b) {
        return std::array{a.z, a.y, a.x} < std::array{b.z, b.y, b.x};
    };
    std::set<glm::ivec3, decltype(order)> bricks(order);
    const auto add = [&](const glm::ivec3& brick) {
        for (int i = 0; i < 27; ++i)
            bricks.insert(brick + glm::ivec3(i % 3, i / 3 % 3, i / 9) - 1);
    };
    to.grid.each_brick([&](const glm::ivec3& brick, auto) { add(brick); },
                       [&](const glm::ivec3& brick, float) { add(brick); });
    const glm::dmat4 from_to = glm::inverse(from.world_from_index) * to.world_from_index;
    GridBuilder builder({to.grid.lower() - kBrickSize, to.grid.upper() + kBrickSize});
    std::array<float, kBrickVoxels> values;
    for (const glm::ivec3& brick : bricks) {
        for (int i = 0; i < kBrickVoxels; ++i)
            values[i] = static_cast<float>(
                from.grid.sample(transform_point(from_to, glm::dvec3(brick_voxel(brick, i)))));
        builder.set_brick(brick, values);
    }
    return builder.finish();
}

/// The box of the active voxels of both fields, in the index space of the density.
void set_box(GridDensity& density, const VolumeFields& fields) {
    const VoxelBox active = fields.density.active;
    density.lower = glm::dvec3(active.lower);
    density.upper = glm::dvec3(active.upper) + 1.0;
    if (!fields.temperature || fields.temperature->active.is_empty()) return;
    const glm::dmat4 map =
        glm::inverse(fields.density.world_from_index) * fields.temperature->world_from_index;
    const VoxelBox other = fields.temperature->active;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 point =
            transform_point(map, glm::mix(glm::dvec3(other.lower), glm::dvec3(other.upper) + 1.0,
                                          glm::dvec3(corner & 1, corner >> 1 & 1, corner >> 2)));
        density.lower = glm::min(density.lower, point);
        density.upper = glm::max(density.upper, point);
    }
}

/// What the fields say about the medium.
void set_fields(Parameters& parameters, VolumeFields fields, double emission_scale,
                Medium& medium) {
    GridDensity density{.index_from_medium = glm::inverse(fields.density.world_from_index)};
    set_box(density, fields);
    const VoxelBox support = find_support(fields.density.grid);
    const bool is_hot = fields.temperature && !fields.temperature->grid.is_empty();
    if (is_hot && !are_equal_maps(*fields.temperature, fields.density))
        fields.temperature->grid = resample(*fields.temperature, fields.density);
    Grid kelvin = read_temperature(parameters, is_hot ? fields.temperature->grid : Grid{},
                                   is_hot ? support : VoxelBox{});
    medium.emission = Rgb(is_hot ? emission_scale : 0);
    if (is_hot) density.temperature = std::make_shared<const Grid>(std::move(kelvin));
    density.density = std::make_shared<const Grid>(std::move(fields.density.grid));
    finish_density(density, medium);
    medium.density = std::move(density);
}

} // namespace

void read_volume(Parameters& parameters, Medium& medium, bool is_vdb, InputFiles& files) {
    const VolumeNames names = read_names(parameters, is_vdb);
    const double emission_scale = parameters.get_float("Lescale", 1, require::non_negative);
    const Parameter* filename = parameters.find_required("string", "filename");
    const std::string file = parameters.get_string("filename", "");
    if (!filename || filename->strings.size() != 1) return;
    if (file.empty()) {
        parameters.report_value(*filename, "\"\"", "the name of a file");
        return;
    }
    std::optional<VolumeFields> fields = read_fields(parameters, *filename, names, files);
    if (!fields) {
        read_temperature(parameters, Grid{}, VoxelBox{}); // so that its parameters are not unused
        return;
    }
    for (const Field* field :
         {&fields->density, fields->temperature ? &*fields->temperature : nullptr})
        if (field && !is_invertible(field->world_from_index)) {
            parameters.diagnostics().error(
                filename->where, "a grid's transform has no inverse (expected one that keeps three "
                                 "dimensions)");
            return;
        }
    try {
        set_fields(parameters, std::move(*fields), emission_scale, medium);
    } catch (const Error& error) { // more voxels than a grid may have
        parameters.diagnostics().error(filename->where, error.what());
    }
}

} // namespace tyndall
