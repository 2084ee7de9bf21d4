#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "fem_check/app/comparison.hpp"

namespace vehd::fem_check {

/// How far the membrane is from inextensible as the finite elements see it: ∇_γ·v over the rate ‖A‖ + |v|/radius.
struct SurfaceDivergence {
  Norms size;
  Norms levels_change;
};

/// How V_m came from an earlier snapshot.
struct InTimeResult {
  double begin;
  int steps;                    ///< between two discontinuities of the field
  std::optional<double> order;  ///< observed, in the size of the steps
  bool moves;                   ///< the shape does
};

/// Share of a field that the error of either method may reach for both to agree, unless asked for another.
constexpr double default_requirement = 0.02;

/// Result of a check. Of several vesicles each has a result of its own, and the whole has no rows itself.
struct CheckResult {
  std::string source;
  std::string name;  ///< of the vesicle; empty where there is only one
  double time = 0.0;
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

  /// Of all rows that count: the worst of them.
  [[nodiscard]] Verdict verdict() const;
  /// Labels of the rows with this verdict that count, of several vesicles with their names.
  [[nodiscard]] std::vector<std::string> rows_with(Verdict verdict) const;
};

/// The table for the terminal.
std::string table_of(const CheckResult& result);

/// docs/check.md lists the keys.
nlohmann::json json_of(const CheckResult& result);

}  // namespace vehd::fem_check
