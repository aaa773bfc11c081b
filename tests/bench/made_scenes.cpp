#include "bench/made_scenes.h"

#include <array>
#include <cmath>

namespace tyndall::bench {

Mesh bumpy_ball(int n) {
    constexpr float pi = 3.14159265F;
    Mesh mesh;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j) {
            const float a = pi * static_cast<float>(i) / static_cast<float>(n);
            const float b = 2 * pi * static_cast<float>(j) / static_cast<float>(n);
            const float r = 0.8F + 0.12F * std::sin(9 * a) * std::cos(7 * b) +
                            0.05F * std::sin(41 * a) * std::sin(37 * b);
            mesh.positions.push_back(
                r * glm::vec3(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)));
        }
    const auto index = [&](int i, int j) { return static_cast<std::uint32_t>(i * (n + 1) + j); };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            mesh.triangles.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
            mesh.triangles.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
        }
    return mesh;
}

Grid make_field(int edge, const std::function<double(const glm::ivec3&)>& value) {
    const VoxelBox box{glm::ivec3(0), glm::ivec3(edge - 1)};
    GridBuilder builder(box);
    std::array<float, kBrickVoxels> values;
    each_brick_of(box, [&](const glm::ivec3& brick) {
        for (int i = 0; i < kBrickVoxels; ++i)
            values[static_cast<std::size_t>(i)] = static_cast<float>(value(brick_voxel(brick, i)));
        builder.set_brick(brick, values);
    });
    return builder.finish();
}

} // namespace tyndall::bench
