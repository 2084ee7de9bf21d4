#include "bie/stepping/time/rate.hpp"

namespace vehd {

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

}  // namespace vehd
