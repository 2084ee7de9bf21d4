#include "bie/bench/exact_problems.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "bie/potentials/translating_prolate.hpp"
#include "bie/scene/shapes/initial_shape.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/space/discretisation.hpp"
#include "bie/support/memory.hpp"

namespace vehd {

std::optional<std::int64_t> memory_of(const std::function<void()>& solve) {
  constexpr const char* part = "solution";
  MemoryMeter meter;
  meter.start();
  meter.begin(part);
  solve();
  meter.end();
  const auto found = meter.peaks().find(part);
  if (found == meter.peaks().end()) return std::nullopt;
  return found->second;
}

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

Example1Result solve_example1(int order, int upsampling) {
  constexpr double kTolerance = 1e-10;
  NumericalSettings settings;
  settings.order = order;
  settings.upsampling = upsampling;
  const MembraneSpace space(settings, {});
  const Matrix position = example1_position(order);

  const auto start = std::chrono::steady_clock::now();
  Instruments instruments;
  const LayerSelection selection{true, true, true, false};
  const Membrane membrane = membrane_at(space, position, selection, 1.0, instruments);
  const PointSourceErrors errors = point_source_errors(example1_electric(), example1_sources(), membrane, kTolerance);
  require_converged(errors.report, "charge density, Eq. (35)");
  const std::chrono::duration<double> solution = std::chrono::steady_clock::now() - start;
  return {order, errors, solution.count()};
}

namespace {

/// An arbitrary rotation without symmetry.
Matrix3 rotated_frame() {
  return (Eigen::AngleAxisd(0.7, Vector3::UnitX()) * Eigen::AngleAxisd(1.1, Vector3::UnitY()) *
          Eigen::AngleAxisd(0.4, Vector3::UnitZ()))
      .toRotationMatrix();
}

/// x = map r̂, exact at every order.
Matrix linear_image_of_sphere(int order, const Matrix3& map) {
  Matrix position = Matrix::Zero(n_coefficients(order), 3);
  const double unit = std::sqrt(4.0 * std::numbers::pi / 3.0);
  position.row(coefficient_index(1, 1)) = unit * map.col(0).transpose();
  position.row(coefficient_index(1, -1)) = unit * map.col(1).transpose();
  position.row(coefficient_index(1, 0)) = unit * map.col(2).transpose();
  return position;
}

}  // namespace

SolvedProblem solve_translating_prolate(int order) {
  NumericalSettings settings;
  settings.order = order;
  const MembraneSpace space(settings, {});
  const Matrix3 frame = rotated_frame();
  const Matrix3 stretch = Vector3(1.0, 1.0, 2.0).asDiagonal();
  const Matrix position = linear_image_of_sphere(order, frame * stretch * frame.transpose());
  const ProlateSpeeds exact = translating_prolate_speeds();

  const auto start = std::chrono::steady_clock::now();
  Instruments instruments;
  const LayerSelection selection{.stokes_single = true};
  const Membrane membrane = membrane_at(space, position, selection, 1.0, instruments);
  const Vector support = membrane.surface.position.cwiseProduct(membrane.surface.normal).rowwise().sum();
  SolvedProblem result;
  const auto pull = [&](const Vector3& axis, double speed) {
    const Matrix density = membrane.weighted(support * axis.transpose());
    const Matrix velocity = membrane.fine.synthesize(membrane.layers.stokes_single.apply(density));
    const double deviation = (velocity.rowwise() - speed * axis.transpose()).cwiseAbs().maxCoeff();
    result.error = std::max(result.error, deviation / speed);
  };
  pull(frame.col(2), exact.along);
  pull(frame.col(0), exact.across);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace vehd
