#include "bie/sphere/axis_crossing.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/point_derivatives.hpp"

namespace vehd {
namespace {

/// The surface at one point: its horizontal distance from the line and its height, with their derivatives in the frame
/// (e_θ, e_φ) of the point.
struct View {
  Eigen::Vector2d offset;
  Eigen::Matrix2d slopes;
  double height = 0.0;
  Eigen::Vector2d rise;
};

/// Bounds on second derivatives near a node, as norms of the Hessian.
struct Bends {
  double offset = 0.0;
  double height = 0.0;
};

/// Rectangle around `centre` with half sides `half` in the tangent plane of a node, mapped to the sphere along great
/// circles from the node, which does not increase distances.
struct Patch {
  TangentFrame node;
  Eigen::Vector2d half;
  Bends bends;
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();

  [[nodiscard]] double radius() const { return half.norm(); }
  [[nodiscard]] SpherePoint point() const { return point_of(node.moved(centre)); }
};

/// A crossing and the radius around it without another one.
struct Crossing {
  Vector3 place;
  double alone = 0.0;
};

/// Factor by which second derivatives may vary between a node and its neighbours at the given degree.
constexpr double kVariation = 1.5;

double remainder(double bend, double radius) { return 0.5 * bend * radius * radius; }

double highest_possible(const View& view, const Patch& patch) {
  return view.height + view.rise.norm() * patch.radius() + remainder(patch.bends.height, patch.radius());
}

/// Whether no point of the patch lies on the line: along some direction the offset exceeds its largest change.
bool misses(const View& view, const Patch& patch) {
  const auto apart = [&](const Eigen::Vector2d& along) {
    const double norm = along.norm();
    if (!(norm > 0.0)) return false;
    const Eigen::Vector2d unit = along / norm;
    const double reached =
        (view.slopes.transpose() * unit).norm() * patch.radius() + remainder(patch.bends.offset, patch.radius());
    return !(std::abs(unit.dot(view.offset)) <= reached);
  };
  // The second direction is normal to the ellipse onto which a disc is mapped.
  const Eigen::Matrix2d gram = view.slopes * view.slopes.transpose();
  return apart(view.offset) || (gram.determinant() > 0.0 && apart(gram.inverse() * view.offset));
}

/// Whether Newton's method converges from here, by the theorem of Kantorovich, to a crossing that has no other nearby.
bool is_settled(const View& view, const Patch& patch) {
  const double least = view.slopes.jacobiSvd().singularValues()[1];
  if (!(least > 0.0)) return false;
  const double step = (view.slopes.inverse() * view.offset).norm();
  return patch.bends.offset * step <= 0.5 * least;
}

class Search {
 public:
  Search(const Vector3& point, const SphereGrid& grid, const SphereDerivatives& nodes, const Matrix& coefficients)
      : point_(point),
        grid_(grid),
        nodes_(nodes),
        coefficients_(coefficients),
        size_((nodes.value.rowwise() - point.transpose()).rowwise().norm().maxCoeff()) {
    for (Index axis = 0; axis < 3; ++axis) {
      azimuthal_order_ = std::max(azimuthal_order_, azimuthal_order_of(coefficients.col(axis)));
    }
  }

  std::optional<SpherePoint> run() {
    struct Start {
      Patch patch;
      View view;
    };
    std::vector<Start> starts;
    std::vector<std::pair<double, std::size_t>> highest_first;
    const auto add = [&](const Patch& patch, const View& view) {
      if (misses(view, patch)) return;
      highest_first.emplace_back(-highest_possible(view, patch), starts.size());
      starts.push_back({patch, view});
    };
    for (const bool south : {false, true}) {
      const Patch cap = cap_around(south);
      add(cap, view_at(cap.point()));
    }
    for (Index node = 0; node < grid_.n_points(); ++node) add(patch_around(node), view_of(node));
    // Highest first: most other patches then cannot lie above the crossing already found.
    std::sort(highest_first.begin(), highest_first.end());
    for (const auto& [height, start] : highest_first) search(starts[start].patch, starts[start].view, 0);
    return best_;
  }

 private:
  void search(const Patch& patch, const View& view, int depth) {
    constexpr int kDeepest = 6;
    if (highest_possible(view, patch) <= best_height_ || is_known(patch) || misses(view, patch)) return;
    if (depth == kDeepest || is_settled(view, patch)) {
      newton(patch, view);
      return;
    }
    for (const double south : {-0.5, 0.5}) {
      for (const double east : {-0.5, 0.5}) {
        Patch quarter = patch;
        quarter.centre += patch.half.cwiseProduct(Eigen::Vector2d(south, east));
        quarter.half *= 0.5;
        search(quarter, view_at(quarter.point()), depth + 1);
      }
    }
  }

  /// Whether the whole patch is closer to a known crossing than any other crossing can be.
  [[nodiscard]] bool is_known(const Patch& patch) const {
    const Vector3 centre = patch.node.moved(patch.centre);
    return std::any_of(found_.begin(), found_.end(), [&](const Crossing& crossing) {
      return std::acos(std::min(1.0, centre.dot(crossing.place))) + patch.radius() <= crossing.alone;
    });
  }

  void newton(const Patch& patch, View here) {
    constexpr int kMost = 50;
    constexpr double kLeastShare = 1e-2;
    // One more step from there is accurate to rounding.
    constexpr double kConverged = 1e-11;
    SpherePoint at = patch.point();
    double share = 1.0;
    bool converged = false;
    for (int count = 0; count < kMost && share > kLeastShare; ++count) {
      Eigen::Vector2d step = -share * here.slopes.fullPivLu().solve(here.offset);
      const double length = step.norm();
      if (!(length > 0.0)) break;
      if (length > patch.radius()) step *= patch.radius() / length;
      const SpherePoint end = point_of(TangentFrame(at).moved(step));
      const View there = view_at(end);
      const bool last = converged;
      if (there.offset.norm() < here.offset.norm()) {
        share = 1.0;
        at = end;
        here = there;
        converged = here.offset.norm() <= kConverged * size_;
      } else {
        share *= 0.5;
      }
      if (last) break;
    }
    if (!(here.offset.norm() <= kConverged * size_)) return;
    // Two crossings at a distance d require second derivatives of 2/d times the least slope; bounds hold in the patch.
    const double least = here.slopes.jacobiSvd().singularValues()[1];
    found_.push_back({direction(at), std::min(patch.radius(), 2.0 * least / patch.bends.offset)});
    if (here.height <= best_height_) return;
    best_ = at;
    best_height_ = here.height;
  }

  [[nodiscard]] View view_at(const SpherePoint& at) const {
    const PointDerivatives x = point_derivatives(coefficients_, at, azimuthal_order_);
    Eigen::Matrix2d slopes;
    slopes << x.d1[0], x.d2[0], x.d1[1], x.d2[1];
    return {x.value.head<2>().transpose() - point_.head<2>(), slopes, x.value[2], x.gradient(2)};
  }

  [[nodiscard]] View view_of(Index node) const {
    View view;
    view.offset = nodes_.value.row(node).head<2>().transpose() - point_.head<2>();
    view.slopes.col(0) = nodes_.d1.row(node).head<2>().transpose();
    view.slopes.col(1) = nodes_.d2.row(node).head<2>().transpose();
    view.height = nodes_.value(node, 2);
    view.rise = {nodes_.d1(node, 2), nodes_.d2(node, 2)};
    return view;
  }

  [[nodiscard]] Bends bends_at(Index row, Index column) const {
    const Index node = row * grid_.n_phi + (column + grid_.n_phi) % grid_.n_phi;
    const auto norm = [&](Index first, Index n) {
      return std::sqrt(nodes_.d11.row(node).segment(first, n).squaredNorm() +
                       2.0 * nodes_.d12.row(node).segment(first, n).squaredNorm() +
                       nodes_.d22.row(node).segment(first, n).squaredNorm());
    };
    return {norm(0, 2), norm(2, 1)};
  }

  [[nodiscard]] Bends most_bent(Index first_row, Index last_row, Index first_column, Index n_columns) const {
    Bends most;
    for (Index row = std::max<Index>(0, first_row); row <= std::min<Index>(grid_.n_theta - 1, last_row); ++row) {
      for (Index column = 0; column < n_columns; ++column) {
        const Bends bends = bends_at(row, first_column + column);
        most.offset = std::max(most.offset, kVariation * bends.offset);
        most.height = std::max(most.height, kVariation * bends.height);
      }
    }
    return most;
  }

  /// Colatitude between the cells of latitudes row − 1 and row; the polar caps reach half way to the next node.
  [[nodiscard]] double boundary(Index row) const {
    const double before = row == 0 ? 0.0 : grid_.theta[row - 1];
    const double behind = row == grid_.n_theta ? std::numbers::pi : grid_.theta[row];
    return 0.5 * (before + behind);
  }

  /// Patch that contains the cell of the node, which reaches half way to its neighbours.
  [[nodiscard]] Patch patch_around(Index node) const {
    const Index row = node / grid_.n_phi;
    const double theta = grid_.theta[row];
    const double widest = std::sin(std::clamp(0.5 * std::numbers::pi, boundary(row), boundary(row + 1)));
    const Eigen::Vector2d half(std::max(theta - boundary(row), boundary(row + 1) - theta),
                               widest * std::numbers::pi / static_cast<double>(grid_.n_phi));
    // Parallels are not great circles.
    constexpr double kOverlap = 1.1;
    return {TangentFrame(point_of(grid_, node)), kOverlap * half,
            most_bent(row - 1, row + 1, node % grid_.n_phi - 1, 3)};
  }

  [[nodiscard]] Patch cap_around(bool south) const {
    const Index row = south ? grid_.n_theta - 1 : 0;
    const SpherePoint pole{south ? std::numbers::pi : 0.0, 0.0};
    const double half = south ? std::numbers::pi - boundary(grid_.n_theta) : boundary(0);
    return {TangentFrame(pole), Eigen::Vector2d::Constant(half), most_bent(row, row, 0, grid_.n_phi)};
  }

  const Vector3& point_;
  const SphereGrid& grid_;
  const SphereDerivatives& nodes_;
  const Matrix& coefficients_;
  double size_;
  int azimuthal_order_ = 0;
  std::vector<Crossing> found_;
  std::optional<SpherePoint> best_;
  double best_height_ = -std::numeric_limits<double>::infinity();
};

}  // namespace

std::optional<SpherePoint> highest_on_line(const Vector3& point, const SphereGrid& grid, const SphereDerivatives& nodes,
                                           const Matrix& coefficients) {
  return Search(point, grid, nodes, coefficients).run();
}

SpherePoint higher_pole(const Matrix& coefficients) {
  const Vector heights = evaluate_harmonics(coefficients.col(2), Vector{{0.0, std::numbers::pi}}, Vector::Zero(2), 0);
  return {heights[0] >= heights[1] ? 0.0 : std::numbers::pi, 0.0};
}

}  // namespace vehd
