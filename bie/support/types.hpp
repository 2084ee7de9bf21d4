#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

/// Dense types shared by every module. Matrices are column-major: a vector field on n points is [n x 3], each
/// Cartesian component contiguous, which is the row-major [3, n] of the output files without a copy.
namespace vehd {

/// Column of doubles.
using Vector = Eigen::VectorXd;
/// Column-major matrix of doubles: one column per field, one row per point or coefficient.
using Matrix = Eigen::MatrixXd;
/// Row-major matrix of doubles.
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
/// A point or a vector in space.
using Vector3 = Eigen::Vector3d;
/// A tensor or a frame in space.
using Matrix3 = Eigen::Matrix3d;
/// Signed type of sizes and indices of matrices.
using Index = Eigen::Index;

}  // namespace vehd
