#include "bie/potentials/nearest_points.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "bie/potentials/far_rule.hpp"
#include "bie/potentials/foot_point.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/neighbourhood.hpp"
#include "bie/sphere/point_derivatives.hpp"
#include "bie/sphere/transform.hpp"

namespace vehd {

namespace {

/// A membrane sampled at nodes that resolve its shape.
struct SampledMembrane {
  const Matrix& position;
  SphereGrid grid;
  Matrix nodes;    ///< [n x 3]
  Vector3 middle;  ///< mean of the nodes
  double reach;    ///< largest distance of a node from it

  static SphereTransform transform_of(int order) {
    constexpr int kCoarsest = 12;
    return {order, make_grid(std::max(order, kCoarsest))};
  }
  explicit SampledMembrane(const Matrix& coefficients)
      : SampledMembrane(coefficients, transform_of(order_of(coefficients.rows()))) {}
  /// @param transform  transform_of its degree
  SampledMembrane(const Matrix& coefficients, const SphereTransform& transform) : position(coefficients) {
    grid = transform.grid();
    nodes = transform.synthesize(coefficients);
    middle = nodes.colwise().mean().transpose();
    reach = (nodes.rowwise() - middle.transpose()).rowwise().norm().maxCoeff();
  }
  [[nodiscard]] Vector3 node(Index i) const { return nodes.row(i).transpose(); }
  [[nodiscard]] Vector3 direction_of(Index i) const { return direction(point_of(grid, i)); }
};

Index nearest_node(const SampledMembrane& membrane, const Vector3& point, double& distance) {
  Index best = 0;
  distance = std::sqrt((membrane.nodes.rowwise() - point.transpose()).rowwise().squaredNorm().minCoeff(&best));
  return best;
}

/// Positive definite, every pivot at least `least`.
bool is_convex(const Eigen::LLT<Eigen::Matrix4d>& factor, double least) {
  return factor.info() == Eigen::Success && factor.matrixLLT().diagonal().cwiseAbs2().minCoeff() >= least;
}

/// A point of each membrane, with ½|x − y|² and its derivatives there.
struct PointPair {
  TangentFrame u, v;
  PointDerivatives x, y;
  Eigen::RowVector3d r;
  Eigen::Vector4d gradient;

  PointPair(const Matrix& first, const Matrix& second, const Vector3& at_first, const Vector3& at_second)
      : u(point_of(at_first)),
        v(point_of(at_second)),
        x(point_derivatives(first, u.point)),
        y(point_derivatives(second, v.point)),
        r(x.value - y.value) {
    gradient << r.dot(x.d1), r.dot(x.d2), -r.dot(y.d1), -r.dot(y.d2);
  }

  [[nodiscard]] double value() const { return 0.5 * r.squaredNorm(); }

  /// Newton step with the Hessian shifted until it is positive definite, hence a direction of descent.
  [[nodiscard]] Eigen::Vector4d step() const {
    constexpr double kLongest = 0.3, kLeastCurvature = 1e-6, kShiftGrowth = 4.0;
    Eigen::Matrix4d hessian;
    const auto dot = [](const Eigen::RowVectorXd& a, const Eigen::RowVectorXd& b) { return a.dot(b); };
    const Eigen::RowVectorXd d = r;
    hessian << dot(x.d1, x.d1) + dot(d, x.d11), dot(x.d1, x.d2) + dot(d, x.d12), -dot(x.d1, y.d1), -dot(x.d1, y.d2),
        dot(x.d1, x.d2) + dot(d, x.d12), dot(x.d2, x.d2) + dot(d, x.d22), -dot(x.d2, y.d1), -dot(x.d2, y.d2),
        -dot(x.d1, y.d1), -dot(x.d2, y.d1), dot(y.d1, y.d1) - dot(d, y.d11), dot(y.d1, y.d2) - dot(d, y.d12),
        -dot(x.d1, y.d2), -dot(x.d2, y.d2), dot(y.d1, y.d2) - dot(d, y.d12), dot(y.d2, y.d2) - dot(d, y.d22);
    const double scale = hessian.cwiseAbs().maxCoeff();
    Eigen::LLT<Eigen::Matrix4d> factor(hessian);
    const double least = kLeastCurvature * scale;
    for (double shift = least; std::isfinite(scale) && !is_convex(factor, least); shift *= kShiftGrowth) {
      factor.compute(hessian + shift * Eigen::Matrix4d::Identity());
    }
    Eigen::Vector4d result = -factor.solve(gradient);
    if (const double length = result.norm(); length > kLongest) result *= kLongest / length;
    return result;
  }
};

/// The nearest pair of nodes.
std::pair<Index, Index> nearest_nodes_of(const SampledMembrane& first, const SampledMembrane& second) {
  std::pair<Index, Index> best{0, 0};
  double least = std::numeric_limits<double>::infinity();
  for (Index i = 0; i < first.nodes.rows(); ++i) {
    double distance = 0.0;
    const Index j = nearest_node(second, first.node(i), distance);
    if (distance < least) {
      least = distance;
      best = {i, j};
    }
  }
  return best;
}

bool is_inside(const SampledMembrane& membrane, const FarRule& rule, const Vector3& point) {
  if ((point - membrane.middle).norm() > membrane.reach) return false;
  double distance = 0.0;
  const Index node = nearest_node(membrane, point, distance);
  // Approximate spacing of its nodes.
  const double spacing = membrane.reach * std::numbers::pi / static_cast<double>(membrane.grid.n_theta);
  if (distance > 2.0 * spacing) return rule.enclosures(point.transpose())[0] < -0.5;
  constexpr double kTouching = 1e-12;
  return find_foot_point(membrane.position, membrane.direction_of(node), point).height <= kTouching * membrane.reach;
}

Index nodes_inside(const SampledMembrane& membrane, const SampledMembrane& other) {
  const FarRule rule(membrane.position, membrane.grid.n_theta - 1);
  Index count = 0;
  for (Index i = 0; i < other.nodes.rows(); ++i) count += is_inside(membrane, rule, other.node(i)) ? 1 : 0;
  return count;
}

NearestPoints nearest_points(const SampledMembrane& a, const SampledMembrane& b) {
  constexpr int kMaxSteps = 60, kMaxHalvings = 30;
  constexpr double kTolerance = 1e-12;
  const Matrix &first = a.position, &second = b.position;
  const auto [i, j] = nearest_nodes_of(a, b);
  PointPair pair(first, second, a.direction_of(i), b.direction_of(j));
  for (int steps = 0; steps < kMaxSteps; ++steps) {
    Eigen::Vector4d step = pair.step();
    if (step.norm() < kTolerance) break;
    const auto moved = [&] {
      return PointPair(first, second, pair.u.moved(step.head<2>()), pair.v.moved(step.tail<2>()));
    };
    PointPair next = moved();
    const auto is_nearer = [&] { return next.value() < pair.value() || next.gradient.norm() < pair.gradient.norm(); };
    for (int halvings = 0; !is_nearer() && halvings < kMaxHalvings; ++halvings) {
      step *= 0.5;
      next = moved();
    }
    if (!is_nearer()) break;
    pair = next;
  }
  NearestPoints result{pair.x.value.transpose(), pair.y.value.transpose(), pair.r.norm()};
  const Vector3 normal = Vector3(pair.x.d1.transpose()).cross(Vector3(pair.x.d2.transpose()));
  if ((result.on_second - result.on_first).dot(normal) < 0.0) result.gap = -result.gap;
  return result;
}

}  // namespace

NearestPoints nearest_points(const Matrix& first, const Matrix& second) {
  return nearest_points(SampledMembrane(first), SampledMembrane(second));
}

std::vector<ClosePair> close_pairs(const std::vector<Matrix>& membranes, double reach) {
  if (membranes.size() < 2) return {};
  std::vector<SampledMembrane> sampled;
  std::map<int, SphereTransform> transforms;
  for (const Matrix& membrane : membranes) {
    const int order = order_of(membrane.rows());
    auto found = transforms.find(order);
    if (found == transforms.end()) found = transforms.emplace(order, SampledMembrane::transform_of(order)).first;
    sampled.emplace_back(membrane, found->second);
  }
  struct Candidate {
    double least;  ///< lower bound of the gap
    std::size_t first, second;
  };
  std::vector<Candidate> candidates;
  for (std::size_t b = 0; b < sampled.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a) {
      const double distance = (sampled[a].middle - sampled[b].middle).norm();
      // The largest node distance slightly underestimates the reach of the surface.
      constexpr double kMissed = 1.05;
      candidates.push_back({distance - kMissed * (sampled[a].reach + sampled[b].reach), a, b});
    }
  }
  std::ranges::sort(candidates, {}, &Candidate::least);
  std::vector<ClosePair> close;
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& [least, a, b] : candidates) {
    if (least > std::max(reach, smallest)) break;
    close.push_back({a, b, nearest_points(sampled[a], sampled[b])});
    smallest = std::min(smallest, close.back().points.gap);
  }
  std::erase_if(close, [&](const ClosePair& pair) { return pair.points.gap > std::max(reach, smallest); });
  std::ranges::stable_sort(close, {}, [](const ClosePair& pair) { return pair.points.gap; });
  return close;
}

Arrangement arrangement_of(const Matrix& first, const Matrix& second) {
  const SampledMembrane a(first), b(second);
  if ((a.middle - b.middle).norm() > a.reach + b.reach) return Arrangement::apart;
  const Index of_second = nodes_inside(a, b), of_first = nodes_inside(b, a);
  if (of_second == b.nodes.rows() && of_first == 0) return Arrangement::second_is_inside;
  if (of_first == a.nodes.rows() && of_second == 0) return Arrangement::first_is_inside;
  if (of_first > 0 || of_second > 0) return Arrangement::intersecting;
  // Parts that are thinner than the node spacing may meet between the nodes.
  return nearest_points(first, second).gap > 0.0 ? Arrangement::apart : Arrangement::intersecting;
}

}  // namespace vehd
