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

/// What a check found.
struct CheckResult {
  std::string source;
  double time = 0.0;
  int order = 0, high_order = 0;
  std::vector<FieldComparison> fields;
  std::vector<Level> levels;
  std::optional<SurfaceDivergence> divergence;
  std::optional<double> stored_velocity;  ///< relative L2 of the snapshot's dx/dt against v at the same order
  double outer_radius = 0.0, far_outer_radius = 0.0;
  double seconds = 0.0;

  [[nodiscard]] bool agrees() const;
  /// Labels of the fields that do not agree, separated by commas.
  [[nodiscard]] std::string disagreeing() const;
};

/// The table for the terminal.
std::string table_of(const CheckResult& result);

/// docs/check.md lists the keys.
nlohmann::json json_of(const CheckResult& result);

}  // namespace vehd::fem_check
