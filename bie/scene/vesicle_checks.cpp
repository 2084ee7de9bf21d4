#include "bie/scene/vesicle_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "bie/potentials/nearest_points.hpp"
#include "bie/scene/initial_shape.hpp"
#include "bie/scene/placement.hpp"
#include "bie/scene/schema.hpp"
#include "bie/scene/toml_values.hpp"
#include "bie/scene/vesicles.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/types.hpp"

namespace vehd {
namespace {

/// No point of the membrane is farther from its mean, by the addition theorem degree by degree.
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
  VesicleChecks(const Scene& scene, const toml::table& file, const std::string& name)
      : scene_(scene), file_(file), name_(name) {}

  void run() const {
    if (scene_.contact) check_contact();
    if (scene_.vesicles.empty()) {
      const bool is_placed = scene_.shape.centre != Triple{} || scene_.shape.kind == ShapeKind::file;
      if (is_placed) check_distance(0, initial_position(scene_));
      return;
    }
    if (scene_.electric) check_electric();
    check_places();
  }

 private:
  [[noreturn]] void refuse(std::size_t vesicle, const std::string& problem) const {
    throw InputError(fmt::format("{}: {}", place(node_of(vesicle), name_), problem));
  }

  /// Those of a suspension stand nowhere.
  [[nodiscard]] const toml::node& node_of(std::size_t vesicle) const {
    if (const toml::node* all = file_.get("vesicle")) return (*all->as_array())[vesicle];
    const toml::node* suspension = file_.get("suspension");
    return suspension != nullptr ? *suspension : *file_.get("shape");
  }

  /// Where the file says it, otherwise what it belongs to.
  [[nodiscard]] const toml::node& centre_of(std::size_t vesicle) const {
    const toml::node& owner = node_of(vesicle);
    const auto centre = owner.as_table()->at_path(file_.contains("vesicle") ? "shape.centre" : "centre");
    return centre ? *centre.node() : owner;
  }

  void check_contact() const {
    const auto refuse_contact = [&](const std::string& problem) {
      throw InputError(fmt::format("{}: {}", place(*file_.get("contact"), name_), problem));
    };
    if (scene_.vesicles.empty()) {
      refuse_contact("[contact] acts between vesicles, and there is one; accepted: with tables [[vesicle]]");
    }
    if (scene_.contact->energy == 0.0) {
      refuse_contact("\"energy\" in [contact] is 0: it has no effect; accepted: any other value");
    }
    if (!scene_.membrane.mobile) refuse_contact("[contact] has no effect while \"mobile\" in [membrane] is false");
  }

  [[nodiscard]] std::string called(std::size_t vesicle) const {
    return fmt::format("vesicle \"{}\"", scene_.vesicles[vesicle].name);
  }

  void check_electric() const {
    const auto is_steady = [](const VesicleScene& vesicle) {
      return vesicle.electric->initial_potential == InitialPotential::steady;
    };
    const bool steady = is_steady(scene_.vesicles.front());
    for (std::size_t a = 0; a < scene_.vesicles.size(); ++a) {
      const VesicleScene& vesicle = scene_.vesicles[a];
      if (is_steady(vesicle) != steady) {
        refuse(a, fmt::format("{} {}start with a steady V_m, but {} does{}; accepted: \"initial_Vm\" steady for all "
                              "vesicles or for none",
                              called(a), steady ? "does not " : "", called(0), steady ? "" : " not"));
      }
      if (vesicle.electric->conductivity_in > 0.0 && vesicle.electric->conductivity_out > 0.0) continue;
      refuse(a, fmt::format("\"conductivity_in\" or \"conductivity_out\" of {} is 0; accepted with several vesicles: "
                            "> 0, as small as it has to be",
                            called(a)));
    }
  }

  void check_places() const {
    std::vector<Matrix> positions;
    for (const Scene& one : each_alone(scene_)) {
      positions.push_back(initial_position(one));
      check_distance(positions.size() - 1, positions.back());
    }
    if (scene_.contact) check_range(positions);
    for (std::size_t b = 0; b < positions.size(); ++b) {
      for (std::size_t a = 0; a < b; ++a) check_pair(a, b, positions);
    }
  }

  /// Coordinates are rounded, and their differences have to hold the tightest tolerance.
  void check_distance(std::size_t vesicle, const Matrix& position) const {
    constexpr double farthest = tightest_tolerance / std::numeric_limits<double>::epsilon();
    const double distance = position.row(0).norm();
    const double size = position.bottomRows(position.rows() - 1).norm();
    if (distance <= farthest * size) return;
    const std::string who = scene_.vesicles.empty() ? "the vesicle" : called(vesicle);
    throw InputError(
        fmt::format("{}: \"centre\" in [shape] places {} {:.3g} radii from the origin; accepted: at most {:.2g}",
                    place(centre_of(vesicle), name_), who, distance / size, farthest));
  }

  void check_range(const std::vector<Matrix>& positions) const {
    for (std::size_t a = 0; a < positions.size(); ++a) {
      const double radius = std::sqrt(vehd::size_of(positions[a]).area / (4.0 * std::numbers::pi));
      if (scene_.contact->range >= thresholds::shortest_contact * radius) continue;
      throw InputError(fmt::format("{}: \"range\" in [contact] is {:.2g} radii of {}; accepted: at least {:g}",
                                   place(*file_.at_path("contact.range").node(), name_), scene_.contact->range / radius,
                                   called(a), thresholds::shortest_contact));
    }
  }

  void check_pair(std::size_t a, std::size_t b, const std::vector<Matrix>& positions) const {
    const double distance = (positions[a].row(0) - positions[b].row(0)).norm() / std::sqrt(4.0 * std::numbers::pi);
    if (distance > 1.01 * (reach_bound(positions[a]) + reach_bound(positions[b]))) return;
    const auto refuse_pair = [&](const std::string& problem) {
      refuse(b, fmt::format("{}; accepted: each outside all others, by \"centre\" in [vesicle.shape]", problem));
    };
    switch (arrangement_of(positions[a], positions[b])) {
      case Arrangement::apart:
        check_gap(a, b, positions);
        return;
      case Arrangement::they_meet:
        refuse_pair(
            fmt::format("{}, about {}, overlaps {}, about {}", called(b), centre_text(b), called(a), centre_text(a)));
        return;
      case Arrangement::first_is_inside:
        refuse_pair(fmt::format("{}, about {}, has {} inside", called(b), centre_text(b), called(a)));
        return;
      case Arrangement::second_is_inside:
        refuse_pair(fmt::format("{}, about {}, is inside {}", called(b), centre_text(b), called(a)));
    }
  }

  /// A run would stop where it starts.
  void check_gap(std::size_t a, std::size_t b, const std::vector<Matrix>& positions) const {
    const double gap = nearest_points(positions[a], positions[b]).gap;
    const Matrix& first = positions[a];
    // Far from that, whatever the radius is exactly.
    constexpr double kFar = 0.01;
    if (gap > kFar * first.bottomRows(first.rows() - 1).norm()) return;
    const double area = std::min(vehd::size_of(positions[a]).area, vehd::size_of(positions[b]).area);
    const double relative = gap / std::sqrt(area / (4.0 * std::numbers::pi));
    if (relative >= thresholds::smallest_gap) return;
    refuse(b, fmt::format("{} is {:.2g} radii from {}; accepted: at least {:g}", called(b), relative, called(a),
                          thresholds::smallest_gap));
  }

  [[nodiscard]] std::string centre_text(std::size_t vesicle) const {
    const Triple& centre = scene_.vesicles[vesicle].shape.centre;
    return fmt::format("({:g}, {:g}, {:g})", centre[0], centre[1], centre[2]);
  }

  const Scene& scene_;
  const toml::table& file_;
  const std::string& name_;
};

}  // namespace

void check_vesicles(const Scene& scene, const toml::table& file, const std::string& name) {
  VesicleChecks(scene, file, name).run();
}

}  // namespace vehd
