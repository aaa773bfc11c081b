#include "scene/cloud.h"

#include "scene/grid_media.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace tyndall {
namespace {

/// Perlin's permutation.
constexpr std::array<std::uint8_t, 256> permutation{
    151, 160, 137, 91,  90,  15,  131, 13,  201, 95,  96,  53,  194, 233, 7,   225, 140, 36,  103,
    30,  69,  142, 8,   99,  37,  240, 21,  10,  23,  190, 6,   148, 247, 120, 234, 75,  0,   26,
    197, 62,  94,  252, 219, 203, 117, 35,  11,  32,  57,  177, 33,  88,  237, 149, 56,  87,  174,
    20,  125, 136, 171, 168, 68,  175, 74,  165, 71,  134, 139, 48,  27,  166, 77,  146, 158, 231,
    83,  111, 229, 122, 60,  211, 133, 230, 220, 105, 92,  41,  55,  46,  245, 40,  244, 102, 143,
    54,  65,  25,  63,  161, 1,   216, 80,  73,  209, 76,  132, 187, 208, 89,  18,  169, 200, 196,
    135, 130, 116, 188, 159, 86,  164, 100, 109, 198, 173, 186, 3,   64,  52,  217, 226, 250, 124,
    123, 5,   202, 38,  147, 118, 126, 255, 82,  85,  212, 207, 206, 59,  227, 47,  16,  58,  17,
    182, 189, 28,  42,  223, 183, 170, 213, 119, 248, 152, 2,   44,  154, 163, 70,  221, 153, 101,
    155, 167, 43,  172, 9,   129, 22,  39,  253, 19,  98,  108, 110, 79,  113, 224, 232, 178, 185,
    112, 104, 218, 246, 97,  228, 251, 34,  242, 193, 238, 210, 144, 12,  191, 179, 162, 241, 81,
    51,  145, 235, 249, 14,  239, 107, 49,  192, 214, 31,  181, 199, 106, 157, 184, 84,  204, 176,
    115, 121, 50,  45,  127, 4,   150, 254, 138, 236, 205, 93,  222, 114, 67,  29,  24,  72,  243,
    141, 128, 195, 78,  66,  215, 61,  156, 180};

int permute(int x) {
    return permutation[static_cast<std::size_t>(x & 255)];
}

/// The gradient at a lattice point times the offset from it.
double gradient(const glm::ivec3& lattice, const glm::dvec3& d) {
    const int h = permute(permute(permute(lattice.x) + lattice.y) + lattice.z) & 15;
    const double u = h < 8 || h == 12 || h == 13 ? d.x : d.y;
    const double v = h < 4 || h == 12 || h == 13 ? d.y : d.z;
    return ((h & 1) ? -u : u) + ((h & 2) ? -v : v);
}

/// Differences of the noise over 1/100, as pbrt takes for its gradient.
glm::dvec3 noise_gradient(const glm::dvec3& point) {
    constexpr double delta = 0.01;
    glm::dvec3 difference;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 next = point;
        next[axis] += delta;
        difference[axis] = gradient_noise(next);
    }
    return (difference - gradient_noise(point)) / delta;
}

} // namespace

double gradient_noise(const glm::dvec3& point) {
    const glm::dvec3 base = glm::floor(point);
    const glm::dvec3 d = point - base;
    const glm::ivec3 lattice(glm::mod(base, 256.0));
    std::array<double, 8> v;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 offset(corner & 1, corner >> 1 & 1, corner >> 2);
        v[corner] = gradient(lattice + offset, d - glm::dvec3(offset));
    }
    const glm::dvec3 w = d * d * d * (d * (d * 6.0 - 15.0) + 10.0);
    for (int axis = 0; axis < 3; ++axis)
        for (int i = 0; i < 4 >> axis; ++i)
            v[i] = std::lerp(v[2 * i], v[2 * i + 1], w[axis]);
    return v[0];
}

double cloud_density(const glm::dvec3& point, double density, double wispiness, double frequency) {
    glm::dvec3 p = frequency * point;
    if (wispiness > 0) {
        double weight = 0.05 * wispiness, scale = 10;
        for (int i = 0; i < 2; ++i, weight *= 0.5, scale *= 1.99)
            p += weight * noise_gradient(scale * p);
    }
    double sum = 0, weight = 0.5, scale = 1;
    for (int i = 0; i < 5; ++i, weight *= 0.5, scale *= 1.99)
        sum += weight * gradient_noise(scale * p);
    const double cloud = std::clamp((1 - point.y) * 4.5 * density * sum, 0.0, 1.0);
    return std::clamp(cloud + 2 * std::max(0.0, 0.5 - point.y), 0.0, 1.0);
}

void read_cloud(Parameters& parameters, Medium& medium) {
    const double density = parameters.get_float("density", 1, require::non_negative);
    const double wispiness = parameters.get_float("wispiness", 1, require::non_negative);
    const double frequency = parameters.get_float("frequency", 5, require::non_negative);
    const std::optional<std::array<glm::dvec3, 2>> box = read_box(parameters);
    if (!box) return;
    constexpr double voxels_per_length = 32, most = 512;
    const glm::dvec3 wanted =
        glm::max(glm::ceil(voxels_per_length * frequency * ((*box)[1] - (*box)[0])), 1.0);
    const glm::ivec3 count(glm::min(wanted, most));
    if (glm::any(glm::greaterThan(wanted, glm::dvec3(most)))) {
        parameters.diagnostics().warning(
            parameters.where(),
            fmt::format("{} would take {} x {} x {} voxels; it is smoothed to {} x {} x {}",
                        parameters.subject(), wanted.x, wanted.y, wanted.z, count.x, count.y,
                        count.z));
    }
    const VoxelLattice lattice = make_lattice(count, *box);
    const glm::dmat4 medium_from_index = glm::inverse(lattice.index_from_medium);
    // One voxel more on each side, so that nothing fades at the faces of the box.
    const VoxelBox voxels{glm::ivec3(-1), count};
    GridBuilder builder(voxels);
    std::array<float, kBrickVoxels> values;
    each_brick_of(voxels, [&](const glm::ivec3& brick) {
        for (int i = 0; i < kBrickVoxels; ++i) {
            const glm::ivec3 voxel = brick_voxel(brick, i);
            const glm::dvec3 point(medium_from_index * glm::dvec4(voxel, 1));
            values[i] =
                voxels.contains(voxel)
                    ? static_cast<float>(cloud_density(point, density, wispiness, frequency))
                    : 0;
        }
        builder.set_brick(brick, values);
    });
    GridDensity cloud{.index_from_medium = lattice.index_from_medium,
                      .lower = lattice.lower(),
                      .upper = lattice.upper(),
                      .density = std::make_shared<const Grid>(builder.finish())};
    finish_density(cloud, medium);
    medium.density = std::move(cloud);
}

} // namespace tyndall
