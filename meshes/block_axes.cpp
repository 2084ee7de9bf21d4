#include "meshes/block_axes.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "meshes/block_map.hpp"
#include "meshes/gauss_rule.hpp"

namespace vehd::meshes {
namespace {

/// Stretches differ if their ratio is at least this.
constexpr double kMarked = 1.05;
/// tan(π/8): beyond the half-angle π/8 about an axis, another orientation of the cube is nearer.
constexpr double kLargestTurn = std::numbers::sqrt2 - 1.0;

struct PrincipalAxes {
  BlockAxes axes;
  std::array<double, 3> stretch;  ///< along each axis
};

PrincipalAxes find_principal_axes(const Matrix3& affine) {
  constexpr double kNoise = 1e-9;
  const double scale = affine.cwiseAbs().maxCoeff();
  const Matrix3 clean = (affine / (scale * kNoise)).array().round().matrix() * kNoise;
  const Eigen::JacobiSVD<Matrix3> svd(clean, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d& s = svd.singularValues();
  const std::array<double, 3> equal{1.0, 1.0, 1.0};
  if (!(s[2] > 0.0) || affine.determinant() <= 0.0) return {{Matrix3::Identity(), Matrix3::Identity()}, equal};
  const Matrix3 turn = svd.matrixU() * svd.matrixV().transpose();
  if (s[0] < kMarked * s[2]) return {{Matrix3::Identity(), turn}, equal};

  const Matrix3& v = svd.matrixV();
  std::array<int, 3> order{0, 1, 2};
  std::array<int, 3> best = order;
  double closeness = -1.0;
  do {
    const double sum = std::abs(v(0, order[0])) + std::abs(v(1, order[1])) + std::abs(v(2, order[2]));
    if (sum > closeness + kNoise) {
      closeness = sum;
      best = order;
    }
  } while (std::next_permutation(order.begin(), order.end()));
  PrincipalAxes result;
  for (int k = 0; k < 3; ++k) {
    result.axes.in_directions.col(k) = v.col(best[k]) * (v(k, best[k]) < 0.0 ? -1.0 : 1.0);
    result.stretch[k] = s[best[k]];
  }
  if (result.axes.in_directions.determinant() < 0.0) result.axes.in_directions.col(2) *= -1.0;
  result.axes.in_space = turn * result.axes.in_directions;
  return result;
}

BlockAxes rotated(const BlockAxes& axes, const Matrix3& turn) {
  return {axes.in_directions * turn, axes.in_space * turn};
}

/// Rotation about r by the angle 2 atan |r|.
Matrix3 rotation_of(const Point& rodrigues) {
  return Eigen::Quaterniond(1.0, rodrigues.x(), rodrigues.y(), rodrigues.z()).normalized().toRotationMatrix();
}

/// Components of r that a rotation can have: those about axes across which the stretches are equal.
std::array<bool, 3> free_components(const std::array<double, 3>& stretch) {
  std::array<bool, 3> result;
  for (int k = 0; k < 3; ++k) {
    const auto [low, high] = std::minmax(stretch[(k + 1) % 3], stretch[(k + 2) % 3]);
    result[k] = high < kMarked * low;
  }
  return result;
}

/// Grid of rotations r that no symmetry of the cube brings closer to 0: |r_k| ≤ √2 − 1, Σ|r_k| ≤ 1.
std::vector<Point> grid_of_turns(const std::array<bool, 3>& free) {
  constexpr int kSteps = 2;
  std::vector<Point> result;
  const auto range = [&](int k) { return free[k] ? kSteps : 0; };
  for (int a = -range(0); a <= range(0); ++a) {
    for (int b = -range(1); b <= range(1); ++b) {
      for (int c = -range(2); c <= range(2); ++c) {
        const Point r = kLargestTurn / kSteps * Point(a, b, c);
        if (r.lpNorm<1>() <= 1.0) result.push_back(r);
      }
    }
  }
  return result;
}

/// Directions of the Gauss points of all faces of the cube, face after face, first face coordinate fastest.
Eigen::Matrix3Xd face_points(int cells_per_edge, const GaussRule& rule) {
  std::vector<Point> points;
  const auto place = [&](int cell, double node) { return (2 * cell + 1 + node) / cells_per_edge - 1.0; };
  for (int face = 0; face < 6 * cells_per_edge * cells_per_edge; ++face) {
    const int column = face % cells_per_edge;
    const int row = face / cells_per_edge % cells_per_edge;
    const int block = face / (cells_per_edge * cells_per_edge);
    for (const double second : rule.node) {
      for (const double first : rule.node) {
        points.push_back(
            BlockMap::cube_direction(block / 2, block % 2 == 0 ? -1.0 : 1.0, place(column, first), place(row, second)));
      }
    }
  }
  Eigen::Matrix3Xd result(3, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) result.col(static_cast<Eigen::Index>(i)) = points[i];
  return result;
}

/// Orthonormal Legendre polynomial of degree n − 1 at the n nodes of a rule, times the weights.
Eigen::VectorXd highest_mode(const GaussRule& rule) {
  const int degree = static_cast<int>(rule.node.size()) - 1;
  Eigen::VectorXd result(degree + 1);
  for (int i = 0; i <= degree; ++i) {
    result[i] = rule.weight[i] * std::sqrt(degree + 0.5) * std::legendre(static_cast<unsigned>(degree), rule.node[i]);
  }
  return result;
}

/// Nodes per direction of a face; the part of degree kNodes − 1 is measured.
constexpr int kNodes = 7;

/// Root mean square over all faces of the part of a field that has degree 6 in a face coordinate.
/// @param values  [components x points], in the order of face_points()
double part_of_highest_degree(const Eigen::MatrixXd& values, const GaussRule& rule) {
  const Eigen::VectorXd mode = highest_mode(rule);
  const Eigen::Map<const Eigen::VectorXd> weight(rule.weight.data(), kNodes);
  double squares = 0.0;
  double area = 0.0;
  for (Eigen::Index begin = 0; begin < values.cols(); begin += kNodes * kNodes) {
    for (Eigen::Index component = 0; component < values.rows(); ++component) {
      const Eigen::VectorXd row = values.row(component).segment(begin, kNodes * kNodes);
      const Eigen::Map<const Eigen::MatrixXd> on_face(row.data(), kNodes, kNodes);
      squares += weight.dot((on_face.transpose() * mode).cwiseAbs2()) + weight.dot((on_face * mode).cwiseAbs2());
    }
    area += weight.sum() * weight.sum();
  }
  return std::sqrt(squares / area);
}

}  // namespace

double truncation_error(const FrozenShape& shape, const Matrix3& in_directions) {
  constexpr int kCellsPerEdge = 3;
  const GaussRule rule = gauss_rule(kNodes);
  return part_of_highest_degree(shape.positions(in_directions * face_points(kCellsPerEdge, rule)), rule);
}

double normal_truncation_error(const FrozenShape& shape, const Matrix3& in_directions, int cells_per_edge) {
  const GaussRule rule = gauss_rule(kNodes);
  const Eigen::Matrix3Xd directions = in_directions * face_points(cells_per_edge, rule);
  Eigen::Matrix3Xd normals(3, directions.cols());
  for (Eigen::Index i = 0; i < directions.cols(); ++i) normals.col(i) = shape.area_vector(directions.col(i));
  return part_of_highest_degree(normals.colwise().normalized(), rule);
}

bool is_strongly_bent(const FrozenShape& shape, int cells_per_edge) {
  constexpr double kAccepted = 5e-4;
  return normal_truncation_error(shape, best_axes(shape).in_directions, cells_per_edge) > kAccepted;
}

BlockAxes axes_along(const FrozenShape& shape, const Matrix3& in_directions) {
  const PrincipalAxes found = find_principal_axes(shape.affine_part());
  return {in_directions, found.axes.in_space * found.axes.in_directions.transpose() * in_directions};
}

BlockAxes principal_axes(const FrozenShape& shape) { return find_principal_axes(shape.affine_part()).axes; }

BlockAxes best_axes(const FrozenShape& shape) {
  /// Smallest relative reduction of the error for which one rotation is preferred to another (kTie), or to none.
  constexpr double kTie = 1e-3;
  constexpr double kClearGain = 0.05;
  constexpr double kFinestStep = 0.02;
  const PrincipalAxes principal = find_principal_axes(shape.affine_part());
  const std::array<bool, 3> free = free_components(principal.stretch);
  const auto error_of = [&](const Point& r) {
    return truncation_error(shape, rotated(principal.axes, rotation_of(r)).in_directions);
  };

  Point best = Point::Zero();
  const double unrotated = error_of(best);
  double least = unrotated;
  const auto improves = [&](const Point& r) {
    const double error = error_of(r);
    if (!(error < (1.0 - kTie) * least)) return false;
    least = error;
    best = r;
    return true;
  };
  for (const Point& r : grid_of_turns(free)) improves(r);
  for (double step = kLargestTurn / 4.0; step > kFinestStep; step /= 2.0) {
    for (bool moved = true; moved;) {
      moved = false;
      for (int k = 0; k < 3; ++k) {
        if (free[k]) moved = moved || improves(best + step * Point::Unit(k)) || improves(best - step * Point::Unit(k));
      }
    }
  }
  return least < (1.0 - kClearGain) * unrotated ? rotated(principal.axes, rotation_of(best)) : principal.axes;
}

}  // namespace vehd::meshes
