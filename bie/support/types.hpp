#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

/// Dense types shared by every module. Matrices are column-major: a vector field on n points is [n x 3], each
/// Cartesian component contiguous, which is the row-major [3, n] of the output files without a copy.
namespace vehd {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;
using Index = Eigen::Index;

}  // namespace vehd
