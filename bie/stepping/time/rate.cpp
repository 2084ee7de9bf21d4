#include "bie/stepping/time/rate.hpp"

#include "bie/stepping/solve/rigid_sphere.hpp"

namespace vehd {

namespace {

Rate::OfVesicle rate_of(const VesicleSolution& solution, const VesicleFields& fields) {
  const Membrane& membrane = *solution.membrane;
  Rate::OfVesicle rate;
  rate.velocity = solution.is_sphere ? rigid_sphere_velocity(membrane, fields.velocity) : fields.velocity;
  rate.potential = solution.potential_rate;
  rate.free_charge = solution.free_charge_rate;
  rate.poration = solution.poration_rate;
  rate.charge = fields.charge_amplitude.size() > 0 ? fields.charge_amplitude : Matrix(fields.charge);
  rate.potential_amplitude = fields.potential_amplitude;
  if (fields.tension.size() > 0 && !solution.is_sphere) {
    const Vector tension = membrane.fine.synthesize(fields.tension);
    rate.tension_integral = tension.dot(membrane.surface.quadrature);
    rate.tension_size = tension.cwiseAbs().dot(membrane.surface.quadrature);
  }
  return rate;
}

}  // namespace

Rate rate_of(const SolvedFields& solved) {
  Rate rate;
  for (std::size_t a = 0; a < solved.vesicles.size(); ++a) {
    rate.vesicles.push_back(rate_of(solved.vesicles[a], solved.fields.vesicles[a]));
  }
  return rate;
}

}  // namespace vehd
