#pragma once

#include <optional>

namespace vehd {

/// When a membrane is said to porate; nothing follows from it. At least one of the two.
struct PorationCriterion {
  std::optional<double> potential{};  ///< V_c of |V_m|
  std::optional<double> tension{};    ///< λ_c of λ + ½ C_m V_m²
  bool operator==(const PorationCriterion&) const = default;
};

}  // namespace vehd
