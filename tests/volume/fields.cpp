#include "volume/fields.h"

#include <array>
#include <cmath>

namespace tyndall {
namespace {

double uniform(Random& random, double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
}

} // namespace

std::vector<float> random_values(Random& random, const glm::ivec3& count, double share) {
    std::vector<float> values(std::size_t(count.x) * count.y * count.z);
    for (float& value : values)
        value = uniform(random, 0, 1) < share ? static_cast<float>(uniform(random, 0, 10)) : 0.0f;
    return values;
}

Grid random_bricks(Random& random, const glm::ivec3& first_brick, const glm::ivec3& brick_count) {
    const VoxelBox box{kBrickSize * first_brick, kBrickSize * (first_brick + brick_count) - 1};
    GridBuilder builder(box);
    each_brick_of(box, [&](const glm::ivec3& brick) {
        const unsigned kind = random() % 4;
        if (kind == 0) builder.set_tile(brick, static_cast<float>(random() % 3));
        if (kind > 1) return;
        std::array<float, kBrickVoxels> values{};
        for (float& value : values)
            if (random() % 8 == 0) value = static_cast<float>(uniform(random, 0, 10));
        builder.set_brick(brick, values);
    });
    return builder.finish();
}

glm::dvec3 random_point(Random& random, const glm::dvec3& lower, const glm::dvec3& upper,
                        double margin) {
    glm::dvec3 point;
    for (int axis = 0; axis < 3; ++axis) {
        point[axis] = uniform(random, lower[axis] - margin, upper[axis] + margin);
        if (random() % 4 == 0) point[axis] = std::round(point[axis]);
    }
    return point;
}

} // namespace tyndall
