#include "bie/physics/charge_relaxation.hpp"

#include <utility>

#include "bie/physics/law_traces.hpp"

namespace vehd {

namespace {

Vector without_mean(const Membrane& membrane, Vector values) {
  const Vector& area = membrane.surface.quadrature;
  values.array() -= values.dot(area) / area.sum();
  return values;
}

}  // namespace

std::vector<RelaxingField> fields_of_charges(const std::vector<ChargingMembrane>& membranes,
                                             const Interaction& interaction, const std::vector<Unknowns>& charges,
                                             double tolerance, std::vector<Vector> start) {
  std::vector<CurrentLaw<double>> laws;
  for (std::size_t a = 0; a < membranes.size(); ++a) laws.push_back(law_of_charges(membranes[a], charges[a]));
  const SolveReport report = solve_laws(membranes, interaction, laws, tolerance, start);
  std::vector<ElectricTraces> traces = traces_of_laws(membranes, interaction, laws, start);
  std::vector<RelaxingField> fields;
  for (std::size_t a = 0; a < membranes.size(); ++a) {
    fields.push_back({std::move(start[a]), std::move(traces[a]), report});
  }
  return fields;
}

Unknowns charge_rates(const ChargingMembrane& of, const RelaxingField& field, const Vector& current) {
  const auto& [electric, membrane] = of.in_field;
  const Vector in = without_mean(membrane, -electric.conductivity_in * field.traces.flux_in);
  const Vector out = without_mean(membrane, -electric.conductivity_out * field.traces.flux_out);
  const double c = of.charging.capacitance;
  return {{}, membrane.fine.analyze(Vector(in - current)) / c, membrane.fine.analyze(Vector(in - out)) / c};
}

}  // namespace vehd
