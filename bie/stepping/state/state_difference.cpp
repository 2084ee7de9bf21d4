#include "bie/stepping/state/state_difference.hpp"

#include <algorithm>

#include "bie/stepping/state/field_table.hpp"

namespace vehd {

double state_difference(const State& state, const State& reference) {
  double largest = 0.0;
  const auto add = [&](const FieldRow&, const auto& a, const auto& b) {
    const double size = b.size() > 0 ? b.cwiseAbs().maxCoeff() : 0.0;
    if (size > 0.0) largest = std::max(largest, (a - b).cwiseAbs().maxCoeff() / size);
  };
  for (std::size_t a = 0; a < state.vesicles.size(); ++a) {
    for_each_unknown(add, state.vesicles[a], reference.vesicles[a]);
  }
  return largest;
}

}  // namespace vehd
