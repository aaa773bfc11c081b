/// The transformations of the scene language, as matrices that act on column vectors.
///
/// Source: pbrt-v4 book, sec. 3.9; angles in degrees, camera space left-handed.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

namespace tyndall {

glm::dmat4 translation(const glm::dvec3& offset);
glm::dmat4 scaling(const glm::dvec3& factors);

/// Rotation by `degrees` about `axis`, counter-clockwise for one who looks against the axis in a
/// right-handed picture. Nothing if the axis has no length.
std::optional<glm::dmat4> rotation(double degrees, const glm::dvec3& axis);

/// Camera space from world space for a camera at `eye` that looks to `look`: +z towards `look`, +y
/// close to `up`. Nothing if that does not fix a direction.
std::optional<glm::dmat4> look_at(const glm::dvec3& eye, const glm::dvec3& look,
                                  const glm::dvec3& up);

/// The matrix of 16 numbers in the order of the scene language: column after column.
glm::dmat4 matrix(const std::array<double, 16>& values);

/// Whether the last row is 0 0 0 1.
bool is_affine(const glm::dmat4& m);

/// Whether the matrix is finite and has an inverse.
bool is_invertible(const glm::dmat4& m);

/// Whether the matrix keeps angles: rotation, reflection and one scale for all axes.
bool is_similarity(const glm::dmat4& m);

glm::dvec3 transform_point(const glm::dmat4& m, const glm::dvec3& point);
glm::dvec3 transform_vector(const glm::dmat4& m, const glm::dvec3& vector);

} // namespace tyndall
