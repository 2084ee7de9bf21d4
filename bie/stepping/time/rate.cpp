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
  rate.tension = tension_integrals(solution, fields);
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
