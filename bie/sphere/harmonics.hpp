#pragma once

#include <cmath>
#include <numbers>

#include "bie/support/types.hpp"

/// Real orthonormal spherical harmonics without the Condon-Shortley sign: with N P the normalised Legendre function,
///   Y_{n,0} = N P_n^0,  Y_{n,m} = √2 N P_n^m cos mφ,  Y_{n,-m} = √2 N P_n^m sin mφ  (m > 0),  P_n^m ≥ 0 near θ = 0.
/// The complex harmonic of Eq. (17) has Re = Y_{n,m}/√2, Im = Y_{n,-m}/√2 for m > 0.
namespace vehd {

/// (p + 1)², the number of harmonics of degree up to p.
constexpr Index n_coefficients(int order) { return Index{order + 1} * (order + 1); }

/// Position of (n, m), −n ≤ m ≤ n, in a coefficient vector: degree-major, so truncation keeps a prefix.
constexpr Index coefficient_index(int n, int m) { return Index{n} * n + n + m; }

/// Degree n of the harmonic at this position.
int degree_of(Index index);

/// Order p of a coefficient array with (p+1)² rows.
/// @throws ShapeError if the count is not a square
int order_of(Index n_coefficients);

/// Coefficient of degree 0 of the field that is 1 everywhere: 1/Y_{0,0}.
inline const double coefficient_of_one = std::sqrt(4.0 * std::numbers::pi);

/// Mean of a vector field over the parameter sphere; of a position, a point within the body that moves with the body.
/// @param coefficients  [n_coefficients x 3]
inline Vector3 mean_vector(const Matrix& coefficients) { return coefficients.row(0).transpose() / coefficient_of_one; }

/// Coefficients truncated or padded with zeros to another order, [(order + 1)² x n_fields].
Matrix resize_order(const Matrix& coefficients, int order);

/// Values at arbitrary points: [n_points x n_fields] from coefficients [(p+1)² x n_fields].
/// @param theta, phi  in radians, [n_points] each; θ = 0 and π are allowed
/// @throws ShapeError if the number of rows is not (p + 1)², or theta and phi differ in length
/// Cost O(n_points p²).
/// Accuracy: rounding; low degrees agree with their explicit formulas to 1e-14 (tests/sphere/transform_test.cpp)
/// Source: paper Eqs. (16), (17)
Matrix evaluate_harmonics(const Matrix& coefficients, const Vector& theta, const Vector& phi);
/// Values [n_points x n_fields] for |m| ≤ azimuthal_order only, at cost O(n_points p azimuthal_order).
Matrix evaluate_harmonics(const Matrix& coefficients, const Vector& theta, const Vector& phi, int azimuthal_order);
/// Values [n_points x n_fields] in given directions.
/// @param directions  [n_points x 3], of any nonzero length
/// @throws ShapeError if there are not three columns
Matrix evaluate_harmonics(const Matrix& coefficients, const Matrix& directions, int azimuthal_order);

}  // namespace vehd
