#include "bie/stepping/evaluation/averaged_forces.hpp"

#include <utility>

#include "bie/physics/averaged_field.hpp"

namespace vehd {

std::vector<Matrix> averaged_forces(const std::vector<VesicleTask>& tasks, SolvedFields& solved) {
  std::vector<ElectricMembrane> membranes;
  std::vector<ChargingParameters> charging;
  for (const VesicleTask& task : tasks) {
    membranes.push_back({electric_parameters(task.model, task.vesicle), task.membrane});
    charging.push_back(task.vesicle.charging);
  }
  AveragedFields averaged =
      solve_averaged_fields(membranes, charging, solved.interaction.get(), tasks.front().settings.electric_tolerance);
  require_converged(averaged.report, "amplitudes of V_m in an averaged field");
  solved.iterations_electric += averaged.report.iterations;
  const Shares shares = solved.interaction ? solved.interaction->shares() : Shares();
  std::vector<Matrix> forces(tasks.size());
  for (const std::size_t a : shares.own(tasks.size())) {
    AveragedField& field = averaged.membranes[a];
    tasks[a].fields.potential_amplitude = std::move(field.potential);
    tasks[a].fields.charge_amplitude = std::move(field.charge);
    tasks[a].fields.force_electric = tasks[a].membrane.fine.analyze(field.force);
    forces[a] = std::move(field.force);
  }
  return forces;
}

}  // namespace vehd
