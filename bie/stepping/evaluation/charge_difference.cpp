#include "bie/stepping/evaluation/charge_difference.hpp"

#include <algorithm>

#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/space/resolution.hpp"
#include "bie/stepping/state/composition.hpp"

namespace vehd {

double charge_difference(const Model& model, const Discretisation& discretisation, const Evaluation& first,
                         const Evaluation& second) {
  const auto charge_of = [&](const VesicleFields& fields) -> Matrix {
    return is_averaged(model) ? fields.charge_amplitude : Matrix(fields.charge);
  };
  double largest = 0.0;
  for (std::size_t a = 0; a < second.fields.vesicles.size(); ++a) {
    const Matrix charge = charge_of(second.fields.vesicles[a]);
    if (charge.size() == 0) continue;
    const MembraneSpace& space = discretisation.vesicle(a);
    const Matrix former = resize_order(charge_of(first.fields.vesicles[a]), space.order());
    const double difference = space.fine_transform().synthesize(charge - former).cwiseAbs().maxCoeff();
    const double size = space.fine_transform().synthesize(charge).cwiseAbs().maxCoeff();
    largest = std::max(largest, difference / charge_scale(model, a, size));
  }
  return largest;
}

}  // namespace vehd
