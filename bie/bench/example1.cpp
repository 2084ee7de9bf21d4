#include "bie/bench/example1.hpp"

#include <chrono>
#include <cmath>
#include <numbers>

#include "bie/scene/shapes/initial_shape.hpp"
#include "bie/stepping/space/membrane_at.hpp"

namespace vehd {

/// Drawn at random once: three sources at radius 0.2 and three at radius 4.
std::vector<PointSource> example1_sources() {
  return {{{0.0727073135, 0.1728598974, 0.0695205182}, -1.3031572316, true},
          {{0.1583696428, 0.0780822041, -0.0939267035}, 0.5811181042, true},
          {{0.1553713089, 0.1253516489, 0.0121128228}, 0.5467129866, true},
          {{-3.2907611504, -0.7279445349, -2.1542951992}, 0.5988462126, false},
          {{0.1901132074, -1.3997215775, -3.7422769104}, -0.2571922406, false},
          {{0.0246152487, -0.8331962230, 3.9121832963}, 1.0067243153, false}};
}

ElectricParameters example1_electric() {
  ElectricParameters electric;
  electric.conductivity_in = 2.0;
  electric.conductivity_out = 1.0;
  return electric;
}

Matrix example1_position(int order) {
  Scene scene;
  scene.shape.kind = ShapeKind::radial;
  scene.shape.base = 1.0;
  scene.shape.amplitude = 0.2;
  scene.shape.exponent = -3.0;
  scene.shape.modes = {{3, 2, 1.0}};
  scene.numerics.order = order;
  return initial_position(scene);
}

Example1Result solve_example1(int order, int upsampling, double tolerance) {
  NumericalSettings settings;
  settings.order = order;
  settings.upsampling = upsampling;
  const auto begin = std::chrono::steady_clock::now();
  const MembraneSpace space(settings, {});
  const std::chrono::duration<double> tables = std::chrono::steady_clock::now() - begin;
  const Matrix position = example1_position(order);

  const auto start = std::chrono::steady_clock::now();
  Instruments instruments;
  const LayerSelection selection{true, true, true, false};
  const Membrane membrane = membrane_at(space, position, selection, 1.0, instruments);
  const PointSourceErrors errors = point_source_errors(example1_electric(), example1_sources(), membrane, tolerance);
  require_converged(errors.report, "charge density, Eq. (35)");
  const std::chrono::duration<double> solution = std::chrono::steady_clock::now() - start;
  return {order, errors, solution.count(), (tables + solution).count()};
}

}  // namespace vehd
