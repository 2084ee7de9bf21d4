#include "bie/potentials/foot_point.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/neighbourhood.hpp"
#include "bie/sphere/point_derivatives.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// ½|x − y|² on the sphere with its first two derivatives.
struct SquaredDistance {
  double value;
  Eigen::Vector2d gradient;
  Eigen::Matrix2d hessian, metric;
};

SquaredDistance squared_distance(const PointDerivatives& y, const Vector3& target) {
  const Eigen::RowVector3d r = target.transpose() - y.value;
  SquaredDistance q;
  q.value = 0.5 * r.squaredNorm();
  q.gradient << -r.dot(y.d1), -r.dot(y.d2);
  q.metric << y.d1.squaredNorm(), y.d1.dot(y.d2), y.d1.dot(y.d2), y.d2.squaredNorm();
  q.hessian << r.dot(y.d11), r.dot(y.d12), r.dot(y.d12), r.dot(y.d22);
  q.hessian = (q.metric - q.hessian).eval();
  return q;
}

/// Newton step, or Gauss-Newton step if the squared distance is not convex.
Eigen::Vector2d descent_step(const SquaredDistance& q) {
  constexpr double kLongestStep = 0.3;
  const bool convex = q.hessian.trace() > 0.0 && q.hessian.determinant() > 1e-6 * q.metric.determinant();
  Eigen::Vector2d step = -(convex ? q.hessian : q.metric).inverse() * q.gradient;
  const double length = step.norm();
  if (length > kLongestStep) step *= kLongestStep / length;
  return step;
}

FootPoint foot_point_at(const TangentFrame& direction, const PointDerivatives& y, const SquaredDistance& q,
                        const Vector3& target) {
  FootPoint foot;
  foot.theta = direction.point.theta;
  foot.phi = direction.point.phi;
  foot.position = y.value.transpose();
  const Vector3 cross = Vector3(y.d1.transpose()).cross(Vector3(y.d2.transpose()));
  foot.area_element = cross.norm();
  foot.normal = cross / foot.area_element;
  foot.height = (target - foot.position).dot(foot.normal);
  // Eigenvalues of the Hessian: their mean and half their difference.
  const double mean = 0.5 * q.hessian.trace();
  const double half = std::hypot(0.5 * (q.hessian(0, 0) - q.hessian(1, 1)), q.hessian(0, 1));
  foot.smallest_stretch = std::sqrt(std::max(mean - half, 0.0));
  foot.largest_stretch = std::sqrt(std::max(mean + half, 0.0));
  return foot;
}

/// One search for a nearest point: query() is where derivatives are needed next, supply() takes them.
class FootSearch {
 public:
  FootSearch(const Vector3& start, const Vector3& target) : target_(target), query_(point_of(start)) {}

  [[nodiscard]] bool is_done() const { return done_; }
  /// Point at which derivatives are needed.
  [[nodiscard]] const SpherePoint& query() const { return query_.point; }

  void supply(PointDerivatives y) {
    const SquaredDistance q = squared_distance(y, target_);
    // The square of a tiny distance is flat to rounding: then the gradient decides.
    const bool nearer = steps_ == 0 || q.value <= q_.value || q.gradient.norm() < q_.gradient.norm();
    if (!nearer && halvings_ < kMaxHalvings && !last_) {
      step_ *= 0.5;
      ++halvings_;
    } else {
      direction_ = query_;
      y_ = std::move(y);
      q_ = q;
      converged_ = last_;
      done_ = converged_ || steps_ == kMaxSteps;
      step_ = descent_step(q_);
      last_ = step_.norm() < kTolerance;
      halvings_ = 0;
      ++steps_;
    }
    query_ = TangentFrame(point_of(direction_.moved(step_)));
  }

  /// @throws ConvergenceError after too many steps
  [[nodiscard]] FootPoint result() const {
    // Near a centre of curvature the distance hardly depends on the point, and any nearly nearest one will do.
    constexpr double kFlatGradient = 1e-3;
    if (!converged_ && q_.gradient.norm() > kFlatGradient * std::sqrt(2.0 * q_.value * q_.metric.trace())) {
      throw ConvergenceError(
          fmt::format("nearest point of the membrane to ({:.6g}, {:.6g}, {:.6g}): no convergence in {} "
                      "steps from the nearest node",
                      target_.x(), target_.y(), target_.z(), kMaxSteps));
    }
    return foot_point_at(direction_, y_, q_, target_);
  }

 private:
  static constexpr int kMaxSteps = 60;
  static constexpr int kMaxHalvings = 30;
  static constexpr double kTolerance = 1e-13;

  Vector3 target_;
  TangentFrame query_, direction_ = query_;
  PointDerivatives y_;
  SquaredDistance q_{};
  Eigen::Vector2d step_ = Eigen::Vector2d::Zero();
  int steps_ = 0, halvings_ = 0;
  bool last_ = false, converged_ = false, done_ = false;
};

}  // namespace

FootPoint find_foot_point(const Matrix& position, const Vector3& start, const Vector3& target) {
  return find_foot_points(position, start.transpose(), target.transpose()).front();
}

std::vector<FootPoint> find_foot_points(const Matrix& position, const Matrix& starts, const Matrix& targets) {
  require_size("position (Cartesian components)", position.cols(), 3);
  require_size("starts", starts.rows(), targets.rows());
  std::vector<FootSearch> searches;
  for (Index i = 0; i < targets.rows(); ++i) {
    searches.emplace_back(Vector3(starts.row(i).transpose()), Vector3(targets.row(i).transpose()));
  }
  std::vector<FootSearch*> active;
  for (FootSearch& search : searches) active.push_back(&search);
  std::vector<SpherePoint> points;
  while (!active.empty()) {
    points.clear();
    for (const FootSearch* search : active) points.push_back(search->query());
    std::vector<PointDerivatives> found = point_derivatives(position, points);
    for (std::size_t i = 0; i < found.size(); ++i) active[i]->supply(std::move(found[i]));
    std::erase_if(active, [](const FootSearch* search) { return search->is_done(); });
  }
  std::vector<FootPoint> feet;
  for (const FootSearch& search : searches) feet.push_back(search.result());
  return feet;
}

namespace {

constexpr double kNodeGrowth = 1.25;
/// Finest grading, t = 2^−50: smaller distances are rounding.
constexpr int kFinestLevel = 50;

/// Rounds up to a multiple of four, as make_graded_rule requires.
int multiple_of_four(double n) { return 4 * static_cast<int>(std::ceil(0.25 * n)); }
int least_n_theta(int order, int level) { return static_cast<int>(std::ceil(1.15 * order)) + 8 + level; }
int least_n_phi(int order) { return 2 * order + 12; }

/// Powers of kNodeGrowth above the least azimuthal node count: along a circle about the pole |x − y| oscillates with
/// the ratio of the stretches a ≥ b, and every two nodes reduce the error of the trapezoidal rule by (a + b)/(a − b).
int azimuth_level(const FootPoint& foot, int least, double tolerance) {
  constexpr int kHighest = 5;
  const double gain =
      (foot.largest_stretch + foot.smallest_stretch) / (foot.largest_stretch - foot.smallest_stretch + 1e-300);
  const double needed = 2.0 * std::log(1.0 / tolerance) / std::log(std::max(gain, 1.0 + 1e-6));
  return std::clamp(static_cast<int>(std::ceil(std::log(needed / least) / std::log(kNodeGrowth))), 0, kHighest);
}

}  // namespace

NearRule near_rule(const FootPoint& foot, int order, double tolerance, bool on_membrane) {
  NearRule choice;
  if (!on_membrane) {
    const double ratio = foot.largest_stretch / std::abs(foot.height);
    choice.level = std::clamp(static_cast<int>(std::ceil(std::log2(std::max(ratio, 1.0)))), 0, kFinestLevel);
  }
  choice.azimuth = azimuth_level(foot, least_n_phi(order), tolerance);
  return choice;
}

GradedRule make_near_rule(int order, const NearRule& choice, int stage) {
  return make_graded_rule(order, std::exp2(-choice.level),
                          multiple_of_four(least_n_theta(order, choice.level) * std::pow(kNodeGrowth, stage)),
                          multiple_of_four(least_n_phi(order) * std::pow(kNodeGrowth, choice.azimuth + stage)));
}

std::vector<FootPoint> nearest_feet(const Matrix& position, const SmoothGrid& grid,
                                    const std::vector<NearestNodes>& nearest, const Matrix& targets) {
  require_size("nearest nodes", static_cast<long>(nearest.size()), targets.rows());
  std::vector<Index> nodes, of_targets;
  const auto seek = [&](Index target, Index node) {
    nodes.push_back(node);
    of_targets.push_back(target);
  };
  for (Index i = 0; i < targets.rows(); ++i) {
    const NearestNodes& from = nearest[static_cast<std::size_t>(i)];
    seek(i, from.first);
    if (from.opposite_counts) seek(i, from.opposite);
  }
  const std::vector<FootPoint> found =
      find_foot_points(position, grid.directions(nodes, Eigen::all), targets(of_targets, Eigen::all));
  std::vector<FootPoint> feet;
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (k == 0 || of_targets[k] != of_targets[k - 1]) {
      feet.push_back(found[k]);
    } else if (std::abs(found[k].height) < std::abs(feet.back().height)) {
      feet.back() = found[k];
    }
  }
  return feet;
}

}  // namespace vehd
