#include "bie/stepping/state_difference.hpp"

#include <algorithm>

namespace vehd {

double state_difference(const State& state, const State& reference) {
  const auto relative = [](const Matrix& a, const Matrix& b) {
    const double size = b.size() == 0 ? 0.0 : b.cwiseAbs().maxCoeff();
    return size > 0.0 ? (a - b).cwiseAbs().maxCoeff() / size : 0.0;
  };
  return std::max(relative(state.position, reference.position),
                  relative(state.transmembrane_potential, reference.transmembrane_potential));
}

}  // namespace vehd
