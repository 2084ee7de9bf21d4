#include <boost/test/unit_test.hpp>

#include "bie/physics/electric.hpp"
#include "tests/support/membrane.hpp"
#include "tests/support/point_potential.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

/// Largest |J D′Y − eigenvalue Y| over n ≤ p/2 on a sphere, eigenvalue −n(n+1)/(2n+1) times R (D′ ~ 1/R, J = R²).
double sphere_error(int order, double radius) {
  const Space space(order);
  const Membrane membrane = make_membrane(space, sphere(order, radius), {.laplace_single = true});
  double error = 0.0;
  for (int n = 0; n <= order / 2; ++n) {
    for (int m = -n; m <= n; ++m) {
      const Vector y = harmonic(order, n, m);
      const double eigenvalue = -radius * n * (n + 1.0) / (2.0 * n + 1.0);
      error = std::max(error, max_difference(space.fine.analyze(weighted_hypersingular(membrane, y)), eigenvalue * y));
    }
  }
  return error;
}

struct GreenErrors {
  double interior, exterior;
};

/// Error of the normal derivative of Green's representation, S′[∂φ/∂n] − D′[φ] = ±½ ∂φ/∂n (+ for φ harmonic
/// inside), weighted and relative.
GreenErrors green_errors(int order) {
  const Space space(order);
  const Membrane membrane = make_membrane(space, shape_33(order), kLaplaceLayers);
  const auto error = [&](const Vector3& source, double side) {
    const PointPotential phi = point_potential(membrane.surface, source);
    const Vector adjoint = membrane.layers.laplace_adjoint.apply(membrane.weighted(phi.flux));
    const Vector hypersingular = weighted_hypersingular(membrane, space.fine.analyze(phi.value));
    const Vector expected = 0.5 * side * membrane.surface.area_element.cwiseProduct(phi.flux);
    return relative_difference(space.fine.synthesize(adjoint).col(0) - hypersingular, expected);
  };
  return {error({2.4, 1.1, -1.6}, 1.0), error({0.2, -0.1, 0.15}, -1.0)};
}

}  // namespace

BOOST_AUTO_TEST_SUITE(hypersingular)

BOOST_AUTO_TEST_CASE(has_the_eigenvalues_of_the_sphere) {
  for (const int order : {8, 16, 32}) BOOST_TEST(sphere_error(order, 1.0) < 1e-11, "order " << order);
  BOOST_TEST(sphere_error(16, 2.5) < 1e-11);
}

BOOST_AUTO_TEST_CASE(derivative_of_green_representation_converges_spectrally_on_shape_33) {
  const GreenErrors coarse = green_errors(8);
  const GreenErrors fine = green_errors(32);
  BOOST_TEST(fine.interior < 1e-3 * coarse.interior);
  BOOST_TEST(fine.exterior < 1e-3 * coarse.exterior);
}

BOOST_AUTO_TEST_CASE(constant_potential_gives_nothing_and_no_potential_gives_net_charge) {
  const Space space(16);
  const Membrane membrane = make_membrane(space, asymmetric_shape(16), {.laplace_single = true});
  BOOST_TEST(weighted_hypersingular(membrane, harmonic(16, 0, 0)).cwiseAbs().maxCoeff() < 1e-14);
  const Vector potential = smooth_coefficients(16, 6, 1, 90);
  BOOST_TEST(std::abs(space.fine.analyze(weighted_hypersingular(membrane, potential))(0, 0)) < 1e-12);
}

BOOST_AUTO_TEST_CASE(is_symmetric_and_negative) {
  const Space space(24);
  const Membrane membrane = make_membrane(space, asymmetric_shape(24), {.laplace_single = true});
  const Vector f = smooth_coefficients(24, 6, 1, 91);
  const Vector g = smooth_coefficients(24, 6, 1, 92);
  const auto form = [&](const Vector& a, const Vector& b) {
    return a.dot(space.fine.analyze(weighted_hypersingular(membrane, b)).col(0));
  };
  BOOST_TEST(form(f, f) < 0.0);
  BOOST_TEST(std::abs(form(f, g) - form(g, f)) < 1e-10 * std::abs(form(f, f)));
}

BOOST_AUTO_TEST_SUITE_END()
