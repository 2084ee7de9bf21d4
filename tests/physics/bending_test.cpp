#include "bie/physics/effects/bending.hpp"

#include <boost/test/unit_test.hpp>
#include <numbers>

#include "tests/support/membrane.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

const BendingParameters kBending{0.7};
constexpr int kOrder = 32;

struct BendingFixture : AsymmetricMembrane {
  BendingFixture() : AsymmetricMembrane(kOrder) {}

  [[nodiscard]] double energy(const Matrix& x) const {
    return kBending.modulus * bending_energy_scaled(make_surface(space.fine, x));
  }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(bending, BendingFixture)

BOOST_AUTO_TEST_CASE(energy_of_any_sphere_is_four_pi) {
  for (const double radius : {0.3, 1.0, 4.0}) {
    const Surface s = make_surface(space.fine, translated(sphere(kOrder, radius), {1.0, 2.0, 3.0}));
    BOOST_TEST(std::abs(bending_energy_scaled(s) / (4.0 * std::numbers::pi) - 1.0) < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(force_is_minus_the_gradient_of_the_energy) {
  // Central differences of E_b along random perturbations; the remaining error comes from the degrees of H above p.
  const Matrix force = bending_force(kBending, membrane);
  for (const int band : {2, 4, 6, 8}) {
    Matrix direction = smooth_coefficients(kOrder, band, 3, 60 + band);
    direction /= direction.norm();
    const double h = 1e-4;
    const double slope = (energy(position + h * direction) - energy(position - h * direction)) / (2.0 * h);
    const double work = row_dot(force, space.fine.synthesize(direction)).dot(membrane.surface.quadrature);
    BOOST_TEST(std::abs(slope + work) < 1e-6 * std::abs(slope), "band " << band << ": " << slope << " and " << -work);
  }
}

BOOST_AUTO_TEST_CASE(force_vanishes_on_a_sphere) {
  const Membrane round = make_membrane(space, sphere(kOrder, 1.3), {});
  BOOST_TEST(bending_force(kBending, round).cwiseAbs().maxCoeff() < 1e-10);
}

BOOST_AUTO_TEST_CASE(energy_ignores_size_and_force_falls_with_its_cube) {
  const double scale = 3.0;
  const Membrane large = make_membrane(space, scale * position, {});
  BOOST_TEST(std::abs(energy(scale * position) / energy(position) - 1.0) < 1e-12);
  BOOST_TEST(relative_difference(std::pow(scale, 3) * bending_force(kBending, large),
                                 bending_force(kBending, membrane)) < 1e-10);
}

BOOST_AUTO_TEST_CASE(force_is_proportional_to_the_modulus) {
  BOOST_TEST(relative_difference(bending_force({0.1}, membrane), bending_force(kBending, membrane) / 7.0) < 1e-14);
}

BOOST_AUTO_TEST_CASE(force_turns_with_the_shape) {
  const Matrix3 rotation = general_rotation();
  const Membrane rotated = make_membrane(space, position * rotation.transpose(), {});
  BOOST_TEST(relative_difference(bending_force(kBending, rotated),
                                 bending_force(kBending, membrane) * rotation.transpose()) < 1e-11);
}

BOOST_AUTO_TEST_CASE(curvature_falls_as_a_membrane_grows) {
  // H is proportional to 1/size.
  const Vector increment = curvature_increment(membrane, space.fine, space.fine.synthesize_hessian(position));
  BOOST_TEST(relative_difference(increment, space.fine.analyze(-membrane.surface.mean_curvature)) < 1e-12);
}

BOOST_AUTO_TEST_CASE(curvature_increment_is_the_first_variation_at_material_points) {
  Matrix displacement = smooth_coefficients(kOrder, 4, 3, 71);
  displacement /= displacement.norm();
  const double step = 1e-5;
  const auto curvature = [&](double share) {
    return space.fine.analyze(make_surface(space.fine, position + share * displacement).mean_curvature);
  };
  const Vector difference = (curvature(step) - curvature(-step)) / (2.0 * step);
  const Vector increment = curvature_increment(membrane, space.fine, space.fine.synthesize_hessian(displacement));
  BOOST_TEST(relative_difference(increment, difference) < 1e-6);
}

BOOST_AUTO_TEST_CASE(rigid_motion_has_no_curvature_increment) {
  // Δ_γ(a + Bx) = 2H B n, normal to n for antisymmetric B; a rotation does not stretch the membrane.
  Matrix3 spin;
  spin << 0.0, -0.9, -0.5, 0.9, 0.0, -0.2, 0.5, 0.2, 0.0;
  const Matrix motion = translated(position * spin.transpose(), {1.0, -2.0, 0.5});
  BOOST_TEST(curvature_increment(membrane, space.fine, space.fine.synthesize_hessian(motion)).cwiseAbs().maxCoeff() <
             1e-12);
}

BOOST_AUTO_TEST_CASE(linearised_force_of_the_present_curvature_is_the_force) {
  // (28a) at the shape itself: a shape in equilibrium is stationary for every time step.
  const Vector curvature = space.fine.analyze(membrane.surface.mean_curvature);
  BOOST_TEST(relative_difference(linearised_bending_force(kBending, membrane, curvature),
                                 bending_force(kBending, membrane)) < 1e-14);
}

BOOST_AUTO_TEST_SUITE_END()
