#include "bie/stepping/evaluation/volume_moments.hpp"

#include <Eigen/Geometry>
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <utility>

#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(moments_of_volume)

namespace {

constexpr int kOrder = 16;
const Vector3 kAxes(0.7, 1.0, 1.4), kCentre(30.0, -2.0, 5.0);
const Matrix3 kTurn = Eigen::AngleAxisd(0.8, Vector3(1.0, 2.0, -1.0).normalized()).toRotationMatrix();

Surface leaning_ellipsoid() {
  const SphereTransform fine(kOrder, make_grid(2 * kOrder));
  return make_surface(fine, translated(ellipsoid(kOrder, kAxes) * kTurn.transpose(), kCentre));
}

/// x = ρ(ω) ω about a centre, and its moments by quadrature over the sphere of directions ω: ∫dV = ∫ρ³/3 dω,
/// ∫x dV = ∫ρ⁴/4 ω dω, ∫xxᵀ dV = ∫ρ⁵/5 ωωᵀ dω. Exact for the degrees here, without surface integrals.
struct LopsidedBody {
  Surface surface;
  double volume = 0.0;
  Vector3 centroid = Vector3::Zero();
  Matrix3 spread = Matrix3::Zero();

  LopsidedBody() {
    Vector rho = std::sqrt(4.0 * std::numbers::pi) * harmonic(kOrder, 0, 0);
    rho[coefficient_index(1, 1)] = 0.3;
    rho[coefficient_index(1, 0)] = -0.2;
    rho[coefficient_index(2, -1)] = 0.15;
    rho[coefficient_index(3, 2)] = 0.1;
    const SphereTransform fine(kOrder, make_grid(2 * kOrder));
    const SphereGrid& grid = fine.grid();
    const Vector radius = fine.synthesize(rho).col(0);
    const Matrix directions = grid_directions(grid);
    for (Index i = 0; i < grid.n_points(); ++i) {
      const double weight = grid.weight[i / grid.n_phi], r = radius[i];
      const Vector3 w = directions.row(i).transpose();
      volume += weight * std::pow(r, 3) / 3.0;
      centroid += weight * std::pow(r, 4) / 4.0 * w;
      spread += weight * std::pow(r, 5) / 5.0 * w * w.transpose();
    }
    centroid /= volume;
    spread = spread / volume - centroid * centroid.transpose();
    surface = make_surface(fine, translated(fine.analyze(radius.asDiagonal() * directions), kCentre));
  }
};

}  // namespace

// The centroid of an ellipsoid equals that of its surface, whatever the flux is divided by; here the two differ.
BOOST_AUTO_TEST_CASE(a_body_without_symmetry_has_the_centroid_and_spread_of_its_volume) {
  const LopsidedBody body;
  const VolumeMoments moments = volume_moments(body.surface);
  BOOST_TEST((moments.centroid - kCentre - body.centroid).norm() < 1e-11);
  BOOST_TEST((centroid(body.surface) - kCentre - body.centroid).norm() > 1e-3);
  BOOST_TEST((moments.spread - body.spread).norm() < 1e-11);
  BOOST_TEST(std::abs(enclosed_volume(body.surface) - body.volume) < 1e-11 * 30.0);
}

BOOST_AUTO_TEST_CASE(modes_of_a_shape_are_those_of_its_radius) {
  const std::array<double, 5> modes = {0.1, -0.05, 0.02, 0.01, -0.03};
  Vector rho = std::sqrt(4.0 * std::numbers::pi) * harmonic(kOrder, 0, 0);
  for (int l = 2; l <= 6; ++l) {
    rho[coefficient_index(l, 0)] =
        modes[static_cast<std::size_t>(l - 2)] * std::sqrt(4.0 * std::numbers::pi / (2 * l + 1));
  }
  rho[coefficient_index(3, 2)] = 0.1;
  constexpr int kFine = 48;
  const SphereTransform fine(kOrder, make_grid(kFine));
  const Matrix directions = grid_directions(fine.grid());
  const Matrix x = 3.0 * fine.synthesize(rho).col(0).asDiagonal() * directions * kTurn.transpose();
  const SphereTransform whole(kOrder, make_grid(kFine));
  const Surface surface = make_surface(whole, translated(whole.analyze(x), kCentre));
  const std::array<double, 5> found = shape_modes(surface, kCentre, 2.0 * kTurn.col(2));
  for (std::size_t i = 0; i < modes.size(); ++i) BOOST_TEST(std::abs(found[i] - modes[i]) < 1e-10);
}

BOOST_AUTO_TEST_CASE(an_ellipsoid_has_its_centre_and_its_axes) {
  const VolumeMoments moments = volume_moments(leaning_ellipsoid());
  BOOST_TEST((moments.centroid - kCentre).norm() < 1e-12);
  const Matrix3 expected = kTurn * kAxes.cwiseAbs2().asDiagonal() * kTurn.transpose() / 5.0;
  BOOST_TEST((moments.spread - expected).norm() < 1e-10);
  BOOST_TEST(std::abs(moments.aspect_ratio() - 2.0) < 1e-10);
  const double along = 1.4 * 1.4, across = 0.5 * (0.7 * 0.7 + 1.0);
  BOOST_TEST(std::abs(moments.aspect_ratio_along(-3.0 * kTurn.col(2)) - std::sqrt(along / across)) < 1e-10);
}

// A motion x ↦ v + Ax moves the centroid accordingly, whether it keeps area and volume or not.
BOOST_AUTO_TEST_CASE(the_centroid_moves_as_the_body_does) {
  Matrix3 gradient;
  gradient << 0.3, -1.0, 0.2, 0.5, 0.1, 0.7, -0.4, 0.6, 0.9;
  const Vector3 velocity(1.0, -2.0, 0.5);
  const LopsidedBody body;
  for (const auto& [s, centre] :
       {std::pair{leaning_ellipsoid(), kCentre}, {body.surface, Vector3(kCentre + body.centroid)}}) {
    const Matrix motion = (s.position * gradient.transpose()).rowwise() + velocity.transpose();
    const Vector3 expected = velocity + gradient * centre;
    BOOST_TEST((centroid_velocity(s, volume_moments(s), motion) - expected).norm() < 1e-9);
  }
}

// Points of an ellipsoid that move on ellipses about one of its axes, v = ω (−(a/b) y, (b/a) x, 0) along its own axes,
// leave the shape at rest and return ω/2π times per unit time; a rotation of the body adds to it.
BOOST_AUTO_TEST_CASE(an_ellipsoid_tumbles_and_its_membrane_treads) {
  const Surface s = leaning_ellipsoid();
  const VolumeMoments moments = volume_moments(s);
  const double circulation = -0.6, ratio = kAxes[0] / kAxes[1];
  Matrix3 treading = Matrix3::Zero();
  treading(0, 1) = -circulation * ratio;
  treading(1, 0) = circulation / ratio;
  treading = kTurn * treading * kTurn.transpose();
  const Vector3 axis = kTurn.col(2);
  for (const double rotation : {0.0, 0.25, -2.0}) {
    Matrix3 spin;
    spin << 0.0, -axis.z(), axis.y(), axis.z(), 0.0, -axis.x(), -axis.y(), axis.x(), 0.0;
    const Matrix3 gradient = treading + rotation * spin;
    const Matrix relative = (s.position.rowwise() - moments.centroid.transpose()) * gradient.transpose();
    for (const double side : {2.0, -1.0}) {
      const Turning turns = turning(s, moments, relative, side * axis);
      const double sign = side > 0.0 ? 1.0 : -1.0;
      const Vector3 across = (side * axis).cross(Vector3::UnitX()).normalized();
      const Vector3 along = across.cross(side > 0.0 ? axis : Vector3(-axis));
      const Vector3 longer = kTurn.col(kAxes[0] > kAxes[1] ? 0 : 1);
      BOOST_TEST(std::abs(std::abs(longer.dot(std::cos(turns.angle) * along + std::sin(turns.angle) * across)) - 1.0) <
                 1e-10);
      BOOST_TEST(std::abs(2.0 * std::numbers::pi * turns.shape - sign * rotation) < 1e-10);
      BOOST_TEST(std::abs(2.0 * std::numbers::pi * turns.membrane - sign * circulation) < 1e-10);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_round_shape_does_not_tumble_and_a_deforming_one_does_not_tread) {
  const SphereTransform fine(kOrder, make_grid(2 * kOrder));
  const Surface s = make_surface(fine, ellipsoid(kOrder, {2.0, 2.0, 2.0}));
  Matrix3 gradient = Matrix3::Zero();
  gradient(0, 2) = 1.0;
  gradient(2, 0) = -1.0;
  const auto turns = [&] { return turning(s, volume_moments(s), s.position * gradient.transpose(), Vector3::UnitY()); };
  BOOST_TEST(turns().angle == 0.0);
  BOOST_TEST(turns().shape == 0.0);
  BOOST_TEST(std::abs(turns().membrane - 0.5 / std::numbers::pi) < 1e-12);
  gradient(2, 0) = 0.5;
  BOOST_TEST(turns().membrane == 0.0);
}

BOOST_AUTO_TEST_SUITE_END()
