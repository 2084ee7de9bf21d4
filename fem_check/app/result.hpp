#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "fem_check/app/comparison.hpp"

namespace vehd::fem_check {

/// Deviation of the finite-element velocity from inextensibility: ∇_γ·v over the rate ‖A‖ + |v|/radius.
struct SurfaceDivergence {
  Norms size;
  Norms levels_change;
};

/// Advance of V_m from an earlier snapshot.
struct InTimeResult {
  double begin;
  std::string begin_text;       ///< with its unit
  int steps;                    ///< between two discontinuities of the field
  std::optional<double> order;  ///< observed, in the step size
  bool moves;                   ///< whether the shape moves
};

/// Default of the largest error of either method, relative to the field, for which both agree.
constexpr double default_requirement = 0.02;

/// Result of a check. With several vesicles, each has its own result, and the overall result has no rows.
struct CheckResult {
  std::string source;
  std::string name;  ///< of the vesicle; empty if there is only one
  double time = 0.0;
  std::string time_text;  ///< with its unit
  int order = 0, high_order = 0;
  double required = default_requirement;
  std::vector<FieldComparison> fields;
  std::vector<Level> levels;
  std::optional<SurfaceDivergence> divergence;
  std::optional<InTimeResult> in_time;
  std::optional<double> stored_velocity;  ///< relative L2 of the snapshot's dx/dt against v of its truncated forces
  double outer_radius = 0.0;
  double seconds = 0.0;
  std::vector<CheckResult> vesicles{};

  /// Worst verdict of all rows that count.
  [[nodiscard]] Verdict verdict() const;
  /// Labels of the rows that count and have this verdict; with several vesicles, including their names.
  [[nodiscard]] std::vector<std::string> rows_with(Verdict verdict) const;
};

/// The table as text.
std::string table_of(const CheckResult& result);

/// The result as JSON; docs/check.md lists the keys.
nlohmann::json json_of(const CheckResult& result);

}  // namespace vehd::fem_check
