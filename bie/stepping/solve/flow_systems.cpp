#include "bie/stepping/solve/flow_systems.hpp"

#include "bie/stepping/thresholds.hpp"

namespace vehd {

FlowSystems::FlowSystems(const FlowParameters& parameters, const Membrane& membrane, FlowOptions options,
                         double explicit_relaxation, std::shared_ptr<const RecycledScalars> recycled)
    : alone_{{parameters, membrane}},
      flow_(alone_, none_),
      options_(std::move(options)),
      // An ellipsoidal disturbance of a sphere relaxes under a tension λ at the rate 24 λ/((32 + 23 μ_i/μ_e) μ_e R)
      // (quasi-spherical theory).
      explicit_tension_time_(explicit_relaxation * (32.0 + 23.0 * parameters.viscosity_ratio) / 24.0 *
                             parameters.viscosity * membrane.radius),
      recycled_(std::move(recycled)) {}

FlowSystem& FlowSystems::of(double dt) {
  for (auto& [size, system] : systems_) {
    if (size == dt) return *system;
  }
  const std::shared_ptr<const RecycledScalars> so_far = recycled();
  const FlowParameters& parameters = alone_.front().parameters;
  const Index n_scalars = (parameters.bending ? 1 : 0) + (parameters.inextensible ? 1 : 0);
  FlowOptions options = options_;
  options.dt = dt;
  Vector& held = options.held_tension;
  held = (held.array() - explicit_tension_time_ / dt).cwiseMax(held.array().cwiseMin(0.0));
  if (held.isZero(0.0)) held.resize(0);
  std::vector<FlowEquations> equations;
  equations.emplace_back(alone_.front(), std::move(options));
  std::vector<RecycledSubspace> known;
  if (so_far) known.push_back(so_far->in(options_.entries, n_scalars));
  if (systems_.size() == thresholds::most_flow_systems) systems_.pop_front();
  systems_.emplace_back(dt, std::make_unique<FlowSystem>(std::move(equations), flow_, std::move(known)));
  return *systems_.back().second;
}

std::shared_ptr<const RecycledScalars> FlowSystems::recycled() const {
  if (systems_.empty()) return recycled_;
  RecycledSubspace all = systems_.front().second->kept().front();
  for (const auto& [size, system] : systems_) all = joined(system->found().front(), all, thresholds::most_recycled);
  return recycled_scalars(options_.entries, std::move(all));
}

}  // namespace vehd
