#include "scene/transform.h"

#include <cmath>

namespace tyndall {

glm::dmat4 translation(const glm::dvec3& offset) {
    glm::dmat4 m(1);
    m[3] = glm::dvec4(offset, 1);
    return m;
}

glm::dmat4 scaling(const glm::dvec3& factors) {
    glm::dmat4 m(1);
    for (int i = 0; i < 3; ++i)
        m[i][i] = factors[i];
    return m;
}

std::optional<glm::dmat4> rotation(double degrees, const glm::dvec3& axis) {
    const double length = glm::length(axis);
    if (!(length > 0)) return std::nullopt;
    const glm::dvec3 a = axis / length;
    const double angle = glm::radians(degrees);
    const double sine = std::sin(angle);
    const double cosine = std::cos(angle);
    // Rodrigues: R e = cos e + sin (a x e) + (1 - cos) (a . e) a for each basis vector e.
    glm::dmat4 m(1);
    for (int i = 0; i < 3; ++i) {
        glm::dvec3 e(0);
        e[i] = 1;
        m[i] = glm::dvec4(cosine * e + sine * glm::cross(a, e) + (1 - cosine) * a[i] * a, 0);
    }
    return m;
}

std::optional<glm::dmat4> look_at(const glm::dvec3& eye, const glm::dvec3& look,
                                  const glm::dvec3& up) {
    const glm::dvec3 forward = look - eye;
    if (!(glm::length(forward) > 0) || !(glm::length(up) > 0)) return std::nullopt;
    const glm::dvec3 z = glm::normalize(forward);
    const glm::dvec3 side = glm::cross(glm::normalize(up), z);
    if (!(glm::length(side) > 1e-12)) return std::nullopt;
    const glm::dvec3 x = glm::normalize(side);
    const glm::dvec3 y = glm::cross(z, x);
    // The inverse of the rigid motion with the columns x, y, z, eye.
    glm::dmat4 m(1);
    for (int i = 0; i < 3; ++i)
        m[i] = glm::dvec4(x[i], y[i], z[i], 0);
    m[3] = glm::dvec4(-glm::dot(x, eye), -glm::dot(y, eye), -glm::dot(z, eye), 1);
    return m;
}

glm::dmat4 matrix(const std::array<double, 16>& values) {
    glm::dmat4 m;
    for (int i = 0; i < 16; ++i)
        m[i / 4][i % 4] = values[static_cast<std::size_t>(i)];
    return m;
}

bool is_affine(const glm::dmat4& m) {
    return m[0][3] == 0 && m[1][3] == 0 && m[2][3] == 0 && m[3][3] == 1;
}

bool is_invertible(const glm::dmat4& m) {
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            if (!std::isfinite(m[i][j])) return false;
        }
    }
    const glm::dmat4 inverse = glm::inverse(m);
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            if (!std::isfinite(inverse[i][j])) return false;
        }
    }
    return true;
}

bool is_similarity(const glm::dmat4& m) {
    const glm::dmat3 linear(m);
    const glm::dmat3 product = glm::transpose(linear) * linear;
    const double scale = product[0][0];
    const double tolerance = 1e-6 * scale;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            if (std::abs(product[i][j] - (i == j ? scale : 0)) > tolerance) return false;
        }
    }
    return true;
}

glm::dvec3 transform_point(const glm::dmat4& m, const glm::dvec3& point) {
    return glm::dvec3(m * glm::dvec4(point, 1));
}

glm::dvec3 transform_vector(const glm::dmat4& m, const glm::dvec3& vector) {
    return glm::dvec3(m * glm::dvec4(vector, 0));
}

} // namespace tyndall
