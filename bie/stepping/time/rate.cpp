#include "bie/stepping/time/rate.hpp"

#include <cmath>

#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/space/resolution.hpp"

namespace vehd {

namespace {

TensionIntegrals tension_integrals(const VesicleSolution& solution, const VesicleFields& fields) {
  if (fields.tension.size() == 0 || solution.is_sphere) return {};
  const Membrane& membrane = *solution.membrane;
  const Vector tension = membrane.fine.synthesize(fields.tension);
  return {tension.dot(membrane.surface.quadrature), tension.cwiseAbs().dot(membrane.surface.quadrature)};
}

double largest_value(const SphereTransform& fine, const Matrix& coefficients) {
  return fine.synthesize(coefficients).cwiseAbs().maxCoeff();
}

}  // namespace

Rate rate_of(const SolvedFields& solved) {
  Rate rate;
  for (std::size_t a = 0; a < solved.vesicles.size(); ++a) {
    const VesicleSolution& solution = solved.vesicles[a];
    const VesicleFields& fields = solved.fields.vesicles[a];
    rate.unknowns.push_back(solution.rate);
    rate.instantaneous.push_back({fields.charge_amplitude.size() > 0 ? fields.charge_amplitude : Matrix(fields.charge),
                                  fields.potential_amplitude, tension_integrals(solution, fields)});
  }
  return rate;
}

InstantaneousDifference instantaneous_difference(const Model& model, const SolvedFields& grids, const Rate& a,
                                                 const Rate& b) {
  InstantaneousDifference largest;
  for (std::size_t i = 0; i < b.instantaneous.size(); ++i) {
    const Rate::Instantaneous& x = a.instantaneous[i];
    const Rate::Instantaneous& y = b.instantaneous[i];
    const double tension = std::abs(y.tension.sum - x.tension.sum);
    largest.tension = std::max(largest.tension, tension / tension_scale(model, i, y.tension.magnitude));
    if (x.charge.size() == 0 || y.charge.size() == 0) continue;
    const Membrane& membrane = *grids.vesicles[i].membrane;
    const SphereTransform& fine = membrane.fine;
    const auto change = [&](const Matrix& from, const Matrix& to) {
      return largest_value(fine, to - resize_order(from, fine.order()));
    };
    largest.charge =
        std::max(largest.charge, change(x.charge, y.charge) / charge_scale(model, i, largest_value(fine, y.charge)));
    if (y.potential_amplitude.size() == 0) continue;
    const double size = largest_value(fine, y.potential_amplitude);
    largest.charge = std::max(largest.charge, change(x.potential_amplitude, y.potential_amplitude) /
                                                  potential_scale(*model.electric, membrane.radius, size));
  }
  return largest;
}

}  // namespace vehd
