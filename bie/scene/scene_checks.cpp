#include "bie/scene/scene_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "bie/scene/initial_shape.hpp"
#include "bie/scene/toml_values.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

/// Names of snapshots have six digits.
constexpr double most_snapshots = 999999;
constexpr double most_steps = 1e9;
/// Largest trace of a velocity gradient, relative to its entries: what decimal input rounds to.
constexpr double trace_tolerance = 1e-12;

class Checks {
 public:
  Checks(const Scene& scene, const toml::table& table, const std::string& file)
      : scene_(scene), table_(table), file_(file) {}

  void run() const {
    check_placement();
    if (scene_.shape.kind == ShapeKind::radial) check_radial_shape();
    if (scene_.flow && scene_.flow->kind == FlowKind::gradient) check_gradient();
    if (scene_.electric) check_conductivities();
    check_counts();
  }

 private:
  [[noreturn]] void refuse(std::string_view table, std::string_view key, const std::string& problem) const {
    const auto node = table_[table][key];
    throw InputError(fmt::format("{}: {}", place(node ? *node.node() : *table_[table].node(), file_), problem));
  }

  void check_placement() const {
    const ShapeScene& shape = scene_.shape;
    if (shape.area && shape.scale) {
      refuse("shape", "scale", "\"scale\" in [shape] together with \"area\"; accepted: one of them");
    }
    if (shape.rotation && (*shape.rotation)[0] == 0.0 && (*shape.rotation)[1] == 0.0 && (*shape.rotation)[2] == 0.0) {
      refuse("shape", "rotation", "\"rotation\" in [shape] has the axis 0, 0, 0; accepted: an axis that is not zero");
    }
  }

  void check_radial_shape() const {
    const ShapeScene& shape = scene_.shape;
    if (!shape.amplitude && table_["shape"]["exponent"]) {
      refuse("shape", "exponent", "\"exponent\" in [shape] has no effect without \"amplitude\"");
    }
    for (std::size_t i = 0; i < shape.modes.size(); ++i) {
      if (shape.modes[i].n <= scene_.numerics.order) continue;
      const toml::node& entry = *table_["shape"]["modes"][i].node();
      throw InputError(fmt::format("{}: \"modes\" in [shape] has the degree n = {}; accepted: at most the order {}",
                                   place(entry, file_), shape.modes[i].n, scene_.numerics.order));
    }
    const double smallest = smallest_radius(scene_);
    if (!(smallest > 0.0)) {
      refuse("shape", "modes",
             fmt::format("the radius in [shape] falls to {}; accepted: > 0 and finite in every direction", smallest));
    }
  }

  void check_gradient() const {
    const TripleOfTriples& gradient = scene_.flow->gradient;
    double largest = 0.0;
    for (const Triple& row : gradient) {
      for (const double entry : row) largest = std::max(largest, std::abs(entry));
    }
    const double trace = gradient[0][0] + gradient[1][1] + gradient[2][2];
    if (!(std::abs(trace) <= trace_tolerance * largest)) {
      refuse("flow", "gradient",
             fmt::format("\"gradient\" in [flow] has the trace {}; accepted: 0 (incompressible flow)", trace));
    }
  }

  void check_conductivities() const {
    if (scene_.electric->conductivity_in == 0.0 && scene_.electric->conductivity_out == 0.0) {
      refuse("electric", "conductivity_in",
             "\"conductivity_in\" and \"conductivity_out\" in [electric] are both 0; accepted: at least one > 0");
    }
  }

  void check_counts() const {
    const NumericsScene& numerics = scene_.numerics;
    if (numerics.end_time / numerics.dt > most_steps) {
      refuse("numerics", "dt",
             fmt::format("end_time / dt in [numerics] asks for {:.3g} steps; accepted: at most {:g}",
                         numerics.end_time / numerics.dt, most_steps));
    }
    if (scene_.output.every && numerics.end_time / *scene_.output.every > most_snapshots) {
      refuse("output", "every",
             fmt::format("\"every\" in [output] asks for {:.3g} snapshots; accepted: at most {:g}",
                         numerics.end_time / *scene_.output.every, most_snapshots));
    }
  }

  const Scene& scene_;
  const toml::table& table_;
  const std::string& file_;
};

}  // namespace

void check_scene(const Scene& scene, const toml::table& table, const std::string& file) {
  Checks(scene, table, file).run();
}

void require_shape_file(const Scene& scene, const toml::table& table, const std::string& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(scene.shape.path, error)) {
    throw InputError(fmt::format("{}: \"path\" in [shape] is {}: no such file",
                                 place(*table["shape"]["path"].node(), file), scene.shape.path));
  }
}

}  // namespace vehd
