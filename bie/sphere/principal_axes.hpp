#pragma once

#include "bie/support/types.hpp"

namespace vehd {

/// Eigenvalues of a symmetric tensor in ascending order, with unit eigenvectors in the columns of `directions`.
struct PrincipalAxes {
  Vector3 values;
  Matrix3 directions;
};

/// @param tensor  symmetric; only its lower triangle is read
/// Accuracy: rounding of the largest eigenvalue (tests/sphere/principal_axes_test.cpp)
/// Source: tridiagonal QR, Eigen's SelfAdjointEigenSolver
PrincipalAxes principal_axes(const Matrix3& tensor);

}  // namespace vehd
