#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "bie/potentials/nearest_points.hpp"
#include "bie/scene/problem.hpp"
#include "bie/scene/read/reading_steps.hpp"
#include "bie/scene/schema.hpp"
#include "bie/scene/shapes/initial_shape.hpp"
#include "bie/scene/shapes/placement.hpp"
#include "bie/scene/vesicles.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/thresholds.hpp"

namespace vehd {
namespace {

/// Bound on the distance of membrane points from their mean, by the addition theorem for each degree.
double reach_bound(const Matrix& position) {
  double bound = 0.0;
  for (int n = 1; n <= order_of(position.rows()); ++n) {
    const double size = position.middleRows(coefficient_index(n, -n), 2 * n + 1).norm();
    bound += size * std::sqrt((2.0 * n + 1.0) / (4.0 * std::numbers::pi));
  }
  return bound;
}

class VesicleChecks {
 public:
  VesicleChecks(const Scene& scene, const TomlFile& file) : scene_(scene), file_(file) {}

  void run() const {
    if (scene_.contact) check_contact(*scene_.contact);
    if (!scene_.vesicles.empty()) {
      if (scene_.electric) check_electric();
      check_positions();
    } else if (scene_.shape.centre != Triple{} || scene_.shape.kind == ShapeKind::file) {
      check_distance(0, initial_position(scene_));
    }
    if (scene_.numerics.symmetry == SymmetryUse::axisymmetric) check_symmetry();
  }

 private:
  /// Node of a vesicle for messages; vesicles of a suspension have none of their own.
  [[nodiscard]] const toml::node& node_of(std::size_t vesicle) const {
    if (const toml::node* all = file_.table.get("vesicle")) return (*all->as_array())[vesicle];
    const toml::node* suspension = file_.table.get("suspension");
    return suspension != nullptr ? *suspension : *file_.table.get("shape");
  }

  /// Node of the centre of a vesicle, or of its owner if the centre is left out.
  [[nodiscard]] const toml::node& centre_of(std::size_t vesicle) const {
    const toml::node& owner = node_of(vesicle);
    const auto centre = owner.as_table()->at_path(file_.table.contains("vesicle") ? "shape.centre" : "centre");
    return centre ? *centre.node() : owner;
  }

  [[nodiscard]] std::string called(std::size_t vesicle) const {
    return scene_.vesicles.empty() ? "the vesicle" : fmt::format("vesicle \"{}\"", scene_.vesicles[vesicle].name);
  }

  void check_contact(const ContactScene& contact) const {
    const toml::node& table = *file_.table.get("contact");
    if (scene_.vesicles.empty()) {
      file_.refuse(table, "[contact] acts between vesicles, and there is one; accepted: with tables [[vesicle]]");
    }
    if (contact.energy == 0.0) {
      file_.refuse(table, "\"energy\" in [contact] is 0: it has no effect; accepted: any other value");
    }
    if (!scene_.membrane.mobile) {
      file_.refuse(table, "[contact] has no effect while \"mobile\" in [membrane] is false");
    }
  }

  void check_electric() const {
    const auto is_steady = [](const VesicleScene& vesicle) {
      return vesicle.electric->initial_potential == InitialPotential::steady;
    };
    const bool steady = is_steady(scene_.vesicles.front());
    for (std::size_t a = 0; a < scene_.vesicles.size(); ++a) {
      const VesicleScene& vesicle = scene_.vesicles[a];
      if (is_steady(vesicle) != steady) {
        file_.refuse(
            node_of(a),
            "{} {}start with a steady V_m, but {} does{}; accepted: \"initial_Vm\" steady for all vesicles or for "
            "none",
            called(a), steady ? "does not " : "", called(0), steady ? "" : " not");
      }
      if (vesicle.electric->conductivity_in > 0.0 && vesicle.electric->conductivity_out > 0.0) continue;
      file_.refuse(
          node_of(a),
          "\"conductivity_in\" or \"conductivity_out\" of {} is 0; accepted with several vesicles: > 0, as small as "
          "it has to be",
          called(a));
    }
  }

  void check_positions() const {
    std::vector<Matrix> positions;
    for (const Scene& one : each_alone(scene_)) {
      positions.push_back(initial_position(one));
      check_distance(positions.size() - 1, positions.back());
    }
    for (std::size_t a = 0; scene_.contact && a < positions.size(); ++a) {
      const double radius = std::sqrt(vehd::size_of(positions[a]).area / (4.0 * std::numbers::pi));
      if (scene_.contact->range >= thresholds::shortest_contact * radius) continue;
      file_.refuse_key("contact", "range", "\"range\" in [contact] is {:.2g} radii of {}; accepted: at least {:g}",
                       scene_.contact->range / radius, called(a), thresholds::shortest_contact);
    }
    for (std::size_t b = 0; b < positions.size(); ++b) {
      for (std::size_t a = 0; a < b; ++a) check_pair(a, b, positions);
    }
  }

  /// Differences of rounded coordinates must resolve the tightest tolerance.
  void check_distance(std::size_t vesicle, const Matrix& position) const {
    constexpr double farthest = tightest_tolerance / std::numeric_limits<double>::epsilon();
    const double distance = position.row(0).norm();
    const double size = position.bottomRows(position.rows() - 1).norm();
    if (distance <= farthest * size) return;
    file_.refuse(centre_of(vesicle),
                 "\"centre\" in [shape] places {} {:.3g} radii from the origin; accepted: at most {:.2g}",
                 called(vesicle), distance / size, farthest);
  }

  void check_pair(std::size_t a, std::size_t b, const std::vector<Matrix>& positions) const {
    const double distance = (mean_vector(positions[a]) - mean_vector(positions[b])).norm();
    if (distance > 1.01 * (reach_bound(positions[a]) + reach_bound(positions[b]))) return;
    const Arrangement arrangement = arrangement_of(positions[a], positions[b]);
    if (arrangement == Arrangement::apart) return check_gap(a, b, positions);
    constexpr const char* accepted = "accepted: each outside all others, by \"centre\" in [vesicle.shape]";
    const auto placed = [&](std::size_t vesicle) {
      const Triple& centre = scene_.vesicles[vesicle].shape.centre;
      return fmt::format("{}, about ({:g}, {:g}, {:g})", called(vesicle), centre[0], centre[1], centre[2]);
    };
    if (arrangement == Arrangement::intersecting)
      file_.refuse(node_of(b), "{}, overlaps {}; {}", placed(b), placed(a), accepted);
    if (arrangement == Arrangement::first_is_inside)
      file_.refuse(node_of(b), "{}, has {} inside; {}", placed(b), called(a), accepted);
    file_.refuse(node_of(b), "{}, is inside {}; {}", placed(b), called(a), accepted);
  }

  /// A run with a smaller gap would stop at its start.
  void check_gap(std::size_t a, std::size_t b, const std::vector<Matrix>& positions) const {
    const double gap = nearest_points(positions[a], positions[b]).gap;
    const Matrix& first = positions[a];
    // Vesicles farther apart than this pass; their radii are not needed.
    constexpr double kFar = 0.01;
    if (gap > kFar * first.bottomRows(first.rows() - 1).norm()) return;
    const double area = std::min(vehd::size_of(positions[a]).area, vehd::size_of(positions[b]).area);
    const double relative = gap / std::sqrt(area / (4.0 * std::numbers::pi));
    if (relative >= thresholds::smallest_gap) return;
    file_.refuse(node_of(b), "{} is {:.2g} radii from {}; accepted: at least {:g}", called(b), relative, called(a),
                 thresholds::smallest_gap);
  }

  void check_symmetry() const {
    const Problem found = problem_of(scene_);
    if (found.symmetry.axisymmetric) return;
    file_.refuse_key(
        "numerics", "symmetry",
        "\"symmetry\" in [numerics] is axisymmetric, but shape, flow and field have no common axis of symmetry; "
        "symmetry found: {}",
        symmetry_text(found.symmetry, found.frame));
  }

  const Scene& scene_;
  const TomlFile& file_;
};

}  // namespace

void check_vesicles(const Scene& scene, const TomlFile& file) { VesicleChecks(scene, file).run(); }

}  // namespace vehd
