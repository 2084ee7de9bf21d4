#include "bie/physics/effects/tension.hpp"

#include <boost/test/unit_test.hpp>

#include "tests/support/membrane.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

constexpr int tension_order = 24;

struct TensionFixture : AsymmetricMembrane {
  TensionFixture() : AsymmetricMembrane(tension_order) {}

  Vector tension = smooth_coefficients(tension_order, 5, 1, 70);

  [[nodiscard]] double integral(const Vector& values) const { return values.dot(membrane.surface.quadrature); }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(tension_effect, TensionFixture)

BOOST_AUTO_TEST_CASE(force_is_minus_the_gradient_of_the_energy_of_frozen_tension) {
  // E = ∫λ dA for a λ that moves with the material.
  const Vector lambda = space.fine.synthesize(tension);
  const auto energy = [&](const Matrix& x) { return lambda.dot(make_surface(space.fine, x).quadrature); };
  const Matrix force = tension_force(membrane, tension);
  for (const int band : {1, 4, 8}) {
    Matrix direction = smooth_coefficients(tension_order, band, 3, 71 + band);
    direction /= direction.norm();
    const double h = 1e-4;
    const double slope = (energy(position + h * direction) - energy(position - h * direction)) / (2.0 * h);
    const double work = integral(row_dot(force, space.fine.synthesize(direction)));
    BOOST_TEST(std::abs(slope + work) < 1e-6 * std::abs(slope), "band " << band << ": " << slope << " and " << -work);
  }
}

BOOST_AUTO_TEST_CASE(positive_tension_pulls_a_sphere_inwards) {
  // Young–Laplace law: the force is 2λ/R towards the centre.
  const double radius = 1.6;
  const Membrane round = make_membrane(space, sphere(tension_order, radius), {});
  const Vector uniform = 0.8 * std::sqrt(4.0 * std::numbers::pi) * harmonic(tension_order, 0, 0);
  const Matrix expected = -2.0 * 0.8 / radius * round.surface.normal;
  BOOST_TEST(max_difference(tension_force(round, uniform), expected) < 1e-11);
}

BOOST_AUTO_TEST_CASE(force_is_linear_and_falls_with_size) {
  const double scale = 3.0;
  const Membrane large = make_membrane(space, scale * position, {});
  BOOST_TEST(relative_difference(scale * tension_force(large, tension), tension_force(membrane, tension)) < 1e-12);
  BOOST_TEST(relative_difference(tension_force(membrane, -2.0 * tension), -2.0 * tension_force(membrane, tension)) <
             1e-14);
}

BOOST_AUTO_TEST_CASE(weighted_divergence_is_the_rate_of_change_of_the_area_element) {
  const Matrix velocity = smooth_coefficients(tension_order, 5, 3, 75);
  const double h = 1e-5;
  const Vector grown = make_surface(space.fine, position + h * velocity).area_element;
  const Vector shrunk = make_surface(space.fine, position - h * velocity).area_element;
  const Matrix rate = space.fine.analyze((grown - shrunk) / (2.0 * h));
  const Vector divergence = weighted_divergence(membrane, space.fine.synthesize_gradient(velocity));
  BOOST_TEST(relative_difference(divergence, rate) < 1e-8);
}

BOOST_AUTO_TEST_CASE(tension_does_no_work_on_inextensible_motion) {
  // ∫ f_λ·u dA = −∫ λ ∇_γ·u dA: the constraint operator is minus the adjoint of the force.
  const Matrix velocity = smooth_coefficients(tension_order, 6, 3, 76);
  const SphereDerivatives u = space.fine.synthesize_gradient(velocity);
  const double work = integral(row_dot(tension_force(membrane, tension), u.value));
  BOOST_TEST(std::abs(work + tension.dot(weighted_divergence(membrane, u))) < 1e-12 * std::abs(work));
}

BOOST_AUTO_TEST_SUITE_END()
