#include "bie/physics/scalar_support.hpp"

#include "bie/sphere/harmonics.hpp"

namespace vehd {

std::vector<Index> scalar_support(const SphereTransform& transform) {
  std::vector<Index> support;
  const int order = transform.order();
  if (transform.azimuthal_order() == order) return support;
  for (int n = 0; n <= order; ++n) support.push_back(coefficient_index(n, 0));
  return support;
}

}  // namespace vehd
