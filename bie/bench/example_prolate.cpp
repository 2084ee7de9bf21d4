#include "bie/bench/example_prolate.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "bie/potentials/translating_prolate.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/space/membrane_at.hpp"

namespace vehd {
namespace {

/// Any rotation without symmetry.
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

ProlateResult solve_translating_prolate(int order) {
  NumericalSettings settings;
  settings.order = order;
  const auto begin = std::chrono::steady_clock::now();
  const MembraneSpace space(settings, {});
  const std::chrono::duration<double> tables = std::chrono::steady_clock::now() - begin;
  const Matrix3 frame = rotated_frame();
  const Matrix3 stretch = Vector3(1.0, 1.0, 2.0).asDiagonal();
  const Matrix position = linear_image_of_sphere(order, frame * stretch * frame.transpose());
  const ProlateSpeeds exact = translating_prolate_speeds();

  const auto start = std::chrono::steady_clock::now();
  Instruments instruments;
  const LayerSelection selection{.stokes_single = true};
  const Membrane membrane = membrane_at(space, position, selection, 1.0, instruments);
  const Vector support = membrane.surface.position.cwiseProduct(membrane.surface.normal).rowwise().sum();
  ProlateResult result;
  const auto pull = [&](const Vector3& axis, double speed) {
    const Matrix density = membrane.weighted(support * axis.transpose());
    const Matrix velocity = membrane.fine.synthesize(membrane.layers.stokes_single.apply(density));
    const double deviation = (velocity.rowwise() - speed * axis.transpose()).cwiseAbs().maxCoeff();
    result.error = std::max(result.error, deviation / speed);
  };
  pull(frame.col(2), exact.along);
  pull(frame.col(0), exact.across);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  result.first_seconds = tables.count() + result.seconds;
  return result;
}

}  // namespace vehd
