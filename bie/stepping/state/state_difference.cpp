#include "bie/stepping/state/state_difference.hpp"

#include <algorithm>

namespace vehd {

double state_difference(const State& state, const State& reference) {
  const auto relative = [](const Matrix& a, const Matrix& b) {
    const double size = b.size() == 0 ? 0.0 : b.cwiseAbs().maxCoeff();
    return size > 0.0 ? (a - b).cwiseAbs().maxCoeff() / size : 0.0;
  };
  double largest = 0.0;
  for (std::size_t a = 0; a < state.vesicles.size(); ++a) {
    const VesicleState& one = state.vesicles[a];
    const VesicleState& other = reference.vesicles[a];
    largest = std::max({largest, relative(one.position, other.position),
                        relative(one.transmembrane_potential, other.transmembrane_potential),
                        relative(one.free_charge, other.free_charge), relative(one.poration, other.poration)});
  }
  return largest;
}

}  // namespace vehd
