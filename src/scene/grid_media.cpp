#include "scene/grid_media.h"

#include "scene/colours.h"
#include "scene/spectrum.h"

#include <fmt/format.h>
#include <span>

namespace tyndall {
namespace {

std::optional<VoxelLattice> read_lattice(Parameters& parameters) {
    constexpr Requirement is_count{[](double x) { return x >= 1; }, "a value >= 1"};
    glm::ivec3 count(1);
    for (int axis = 0; axis < 3; ++axis)
        count[axis] = parameters.get_integer(std::string{'n', "xyz"[axis]}, 1, is_count);
    const std::optional<std::array<glm::dvec3, 2>> box = read_box(parameters);
    return box ? std::optional(make_lattice(count, *box)) : std::nullopt;
}

/// Grids of the channels of a parameter, `channels` values a voxel.
using Channels = std::vector<std::shared_ptr<const Grid>>;

/// Times a factor; empty if the parameter is not given or an error was reported.
Channels read_channels(Parameters& parameters, const Parameter* parameter,
                       const VoxelLattice& lattice, std::size_t channels, double factor,
                       const Requirement& requirement) {
    if (!parameter) return {};
    const glm::ivec3 n = lattice.count;
    const std::size_t count = parameter->numbers.size() / channels;
    if (parameter->numbers.size() != channels * lattice.size()) {
        parameters.diagnostics().error(
            parameter->where,
            fmt::format("parameter {} has {} values (expected nx ny nz = {} x {} x {} = {})",
                        parameter->title(), count, n.x, n.y, n.z, double(n.x) * n.y * n.z));
        return {};
    }
    Channels grids;
    std::vector<float> values(count);
    for (std::size_t c = 0; c < channels; ++c) {
        for (std::size_t at = 0; at < count; ++at) {
            const double number = parameter->numbers[channels * at + c];
            if (!requirement.holds(number)) {
                parameters.report_value(*parameter,
                                        fmt::format("{} at voxel ({}, {}, {})", number, at % n.x,
                                                    at / n.x % n.y, at / n.x / n.y),
                                        requirement.expected);
                return {};
            }
            values[at] = static_cast<float>(factor * number);
        }
        grids.push_back(std::make_shared<const Grid>(make_dense_grid(values, n)));
    }
    return grids;
}

GridDensity make_density(const VoxelLattice& lattice) {
    return {.index_from_medium = lattice.index_from_medium,
            .lower = lattice.lower(),
            .upper = lattice.upper()};
}

/// "Le" or "temperature", times "Lescale" by voxel.
void read_grid_emission(Parameters& parameters, Medium& medium, GridDensity& density,
                        const VoxelLattice& lattice, InputFiles& files) {
    const Parameter* temperature = parameters.find("float", "temperature");
    const Channels kelvin =
        read_channels(parameters, temperature, lattice, 1, 1, require::anything);
    const Parameter* scale = parameters.find("float", "Lescale");
    const Channels scales = read_channels(parameters, scale, lattice, 1, 1, require::non_negative);
    if (!scales.empty()) density.emission_scale = scales[0];
    const std::optional<Rgb> emission = read_light_colour(parameters, "Le", files);
    medium.emission = emission.value_or(Rgb(temperature ? 1 : 0));
    if (emission && temperature) {
        parameters.diagnostics().error(
            temperature->where,
            fmt::format("{} has both \"Le\" and \"temperature\" (expected one of them)",
                        parameters.subject()));
    }
    if (kelvin.empty()) return;
    density.temperature = std::make_shared<const Grid>(
        read_temperature(parameters, *kelvin[0], find_support(*density.density)));
}

} // namespace

void read_uniform_grid(Parameters& parameters, Medium& medium, InputFiles& files) {
    const std::optional<VoxelLattice> lattice = read_lattice(parameters);
    const Parameter* values = parameters.find_required("float", "density");
    if (!lattice) return;
    const Channels voxels =
        read_channels(parameters, values, *lattice, 1, 1, require::non_negative);
    if (voxels.empty()) return;
    GridDensity density = make_density(*lattice);
    density.density = voxels[0];
    read_grid_emission(parameters, medium, density, *lattice, files);
    finish_density(density, medium);
    medium.density = std::move(density);
}

void read_rgb_grid(Parameters& parameters, Medium& medium) {
    const std::optional<VoxelLattice> lattice = read_lattice(parameters);
    const double scale = parameters.get_float("scale", 1, require::non_negative);
    const double emission_scale = parameters.get_float("Lescale", 1, require::non_negative);
    const Parameter* sigma_a = parameters.find("rgb", "sigma_a");
    const Parameter* sigma_s = parameters.find("rgb", "sigma_s");
    const Parameter* emission = parameters.find("rgb", "Le");
    if (!sigma_a && !sigma_s) {
        parameters.diagnostics().error(
            parameters.where(),
            fmt::format("{} needs a parameter \"rgb sigma_a\" or \"rgb sigma_s\"",
                        parameters.subject()));
    }
    if (emission && !sigma_a) {
        parameters.diagnostics().error(
            emission->where,
            fmt::format("{} has \"rgb Le\" without \"rgb sigma_a\" (expected both)",
                        parameters.subject()));
    }
    if (!lattice || (!sigma_a && !sigma_s)) return;
    GridDensity density = make_density(*lattice);
    // Constant up to the faces of the box, so with one more voxel around it.
    const auto constant = std::make_shared<const Grid>(
        make_constant_grid({glm::ivec3(-1), lattice->count}, static_cast<float>(scale)));
    const auto fill = [&](std::array<std::shared_ptr<const Grid>, 3>& grids,
                          const Parameter* parameter, double factor) {
        const Channels channels =
            read_channels(parameters, parameter, *lattice, 3, factor, require::non_negative);
        for (std::size_t c = 0; c < channels.size(); ++c)
            grids[c] = channels[c];
        return !parameter || !channels.empty();
    };
    density.sigma_a.fill(constant);
    density.sigma_s.fill(constant);
    const bool is_read = fill(density.sigma_a, sigma_a, scale) &
                         fill(density.sigma_s, sigma_s, scale) &
                         fill(density.emission, emission, 1);
    if (!is_read) return;
    // pbrt multiplies rgb by D65 as it is; only for other media it divides by the luminance, which
    // D65 shares with a constant 1.
    const double luminance = integrate_xyz(Spectrum::piecewise_linear({{300, 1}, {900, 1}})).y;
    medium.emission = Rgb(emission ? emission_scale * luminance : 0);
    finish_density(density, medium);
    medium.density = std::move(density);
}

} // namespace tyndall
