#pragma once

#include <cmath>
#include <numbers>

#include "tests/support/runs.hpp"

/// Membranes whose material varies along the surface.
namespace vehd::testing {

inline const double kEverywhere = std::sqrt(4.0 * std::numbers::pi);

/// C_m, G_m and J_p of a few low degrees, without any symmetry.
inline MembraneMaterial electric_material(int order) {
  const auto uniform = [&](double value) -> Vector { return value * kEverywhere * harmonic(order, 0, 0); };
  MembraneMaterial material;
  material.capacitance = uniform(0.8) + 0.15 * harmonic(order, 1, 0) - 0.1 * harmonic(order, 2, 1);
  material.conductance = uniform(0.5) + 0.2 * harmonic(order, 1, 1) + 0.1 * harmonic(order, 2, -2);
  material.pump_current = uniform(0.1) + 0.4 * harmonic(order, 1, -1) + 0.3 * harmonic(order, 2, 0);
  return material;
}

inline State varying_start(const Model& model, const Discretisation& discretisation,
                           const std::vector<Matrix>& positions, double dt,
                           const std::vector<MembraneMaterial>& materials, bool steady = false) {
  std::vector<StartMembrane> membranes;
  for (std::size_t a = 0; a < positions.size(); ++a) membranes.push_back({positions[a], {steady, {}}, materials[a]});
  Instruments instruments;
  return initial_state(model, discretisation, membranes, dt, instruments);
}

inline State varying_start(const Model& model, const Discretisation& discretisation, const Matrix& position, double dt,
                           const MembraneMaterial& material, bool steady = false) {
  return varying_start(model, discretisation, std::vector{position}, dt, std::vector{material}, steady);
}

/// The material given by the parameters of a model, uniform over the membrane.
inline MembraneMaterial same_everywhere(const VesicleModel& vesicle, int order, double curvature) {
  const auto uniform = [&](double value) -> Vector { return value * kEverywhere * harmonic(order, 0, 0); };
  MembraneMaterial material;
  material.capacitance = uniform(vesicle.charging.capacitance);
  material.conductance = uniform(vesicle.charging.conductance);
  material.bending_modulus = uniform(vesicle.bending->modulus);
  material.spontaneous_curvature = uniform(curvature);
  return material;
}

/// After steps of 0.05: a uniform membrane, and the same one with a material that could vary.
struct UniformAndVarying {
  State uniform, varying;
  MembraneMaterial material;  ///< at the start

  UniformAndVarying(const Model& model, int time_order, const Matrix& position, int n_steps) {
    constexpr double kDt = 0.05;
    const int order = order_of(position.rows());
    NumericalSettings settings = solved_to_rounding(order);
    settings.time_order = time_order;
    const Discretisation discretisation(settings, find_symmetry(model, at_rest(position)));
    uniform = run(model, discretisation, start(model, discretisation, position, kDt), kDt, n_steps);
    material = same_everywhere(model.vesicles[0], order, 0.0);
    varying = run(model, discretisation, varying_start(model, discretisation, position, kDt, material), kDt, n_steps);
  }
};

}  // namespace vehd::testing
