#include "bie/stepping/evaluation/tension_difference.hpp"

#include <algorithm>
#include <cmath>

#include "bie/stepping/space/resolution.hpp"

namespace vehd {

TensionIntegrals tension_integrals(const VesicleSolution& solution, const VesicleFields& fields) {
  if (fields.tension.size() == 0 || solution.is_sphere) return {};
  const Membrane& membrane = *solution.membrane;
  const Vector tension = membrane.fine.synthesize(fields.tension);
  return {tension.dot(membrane.surface.quadrature), tension.cwiseAbs().dot(membrane.surface.quadrature)};
}

double tension_difference(const Model& model, const Evaluation& first, const Evaluation& second) {
  double largest = 0.0;
  for (std::size_t a = 0; a < second.vesicles.size(); ++a) {
    const TensionIntegrals former = tension_integrals(first.vesicles[a], first.fields.vesicles[a]);
    const TensionIntegrals tension = tension_integrals(second.vesicles[a], second.fields.vesicles[a]);
    largest = std::max(largest, std::abs(tension.sum - former.sum) / tension_scale(model, a, tension.magnitude));
  }
  return largest;
}

}  // namespace vehd
