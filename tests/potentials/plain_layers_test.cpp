#include <boost/test/unit_test.hpp>

#include "tests/potentials/off_surface_fields.hpp"
#include "tests/support/layers.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(plain_layers)

namespace {

constexpr int kOrder = 12, kFiner = 36, kBand = 5;

/// Error of a plain operator on densities of degree kBand on a bumpy surface, relative to the part of the result above
/// degree kOrder; both against a reference of much higher degree.
template <typename Operator>
double error_of(Operator LayerOperators::*layer, LayerSelection selection) {
  selection.plain = true;
  const Matrix position = asymmetric_shape(kOrder), density = smooth_coefficients(kOrder, kBand, 3, 81);
  const LayerOperators coarse = assemble(Space(kOrder), position, selection);
  const LayerOperators fine = assemble(Space(kFiner), resize_order(position, kFiner), selection);
  const Matrix exact = (fine.*layer).apply(resize_order(density, kFiner));
  const Matrix held = resize_order(exact, kOrder);
  return ((coarse.*layer).apply(density) - held).norm() / (exact - resize_order(held, kFiner)).norm();
}

}  // namespace

BOOST_AUTO_TEST_CASE(they_have_the_eigenvalues_of_a_sphere) {
  const double radius = 2.5;
  for (const int order : {8, 16, 32}) {
    const LayerOperators layers = assemble(Space(order), sphere(order, radius), kEveryKernel[1]);
    for (const int n : {0, 1, order / 4, order / 2}) {
      const Vector y = harmonic(order, n, n / 2);
      const double odd = 2.0 * n + 1.0;
      BOOST_TEST(max_difference(layers.laplace_single.apply(y), radius / odd * y) < 1e-11);
      BOOST_TEST(max_difference(layers.laplace_double.apply(y), -0.5 / odd * y) < 1e-11);
      BOOST_TEST(max_difference(layers.laplace_adjoint.apply(y), -0.5 / odd * y) < 1e-11);
      BOOST_TEST(max_difference(layers.laplace_hypersingular.apply(y), -n * (n + 1.0) / odd / radius * y) < 1e-10);
    }
  }
}

BOOST_AUTO_TEST_CASE(they_lose_no_more_than_the_degree_cannot_hold_of_their_result) {
  BOOST_TEST(error_of(&LayerOperators::laplace_single, {.laplace_single = true}) < 1.0);
  BOOST_TEST(error_of(&LayerOperators::laplace_double, {.laplace_double = true}) < 1.0);
  BOOST_TEST(error_of(&LayerOperators::laplace_adjoint, {.laplace_adjoint = true}) < 1.0);
  BOOST_TEST(error_of(&LayerOperators::laplace_hypersingular, {.laplace_hypersingular = true}) < 1.0);
  BOOST_TEST(error_of(&LayerOperators::stokes_single, {.stokes_single = true}) < 1.0);
  BOOST_TEST(error_of(&LayerOperators::stokes_double, {.stokes_double = true}) < 1.0);
}

BOOST_AUTO_TEST_CASE(off_the_surface_their_error_is_the_estimated_one) {
  const Matrix position = shape_33(kOrder);
  LayerDensities densities;
  densities.laplace_single = smooth_coefficients(kOrder, kBand, 1, 82);
  densities.stokes_single = smooth_coefficients(kOrder, kBand, 3, 83);
  densities.gradients = densities.plain = true;
  // A degree high enough to resolve J f.
  constexpr int kWeighted = 64;
  const SphereTransform transform(kWeighted, make_grid(2 * kWeighted));
  const Surface surface = make_surface(transform, resize_order(position, kWeighted));
  const auto weighted = [&](const Matrix& f) {
    return transform.analyze(surface.area_element.asDiagonal() * transform.synthesize(resize_order(f, kWeighted)));
  };
  LayerDensities exact;
  exact.laplace_single = weighted(densities.laplace_single);
  exact.stokes_single = weighted(densities.stokes_single);
  exact.gradients = true;

  const std::array<double, 6> distances{-0.2, -1e-3, 0.0, 1e-6, 1e-3, 2.0};
  Matrix points(static_cast<Index>(distances.size()), 3);
  for (Index i = 0; i < points.rows(); ++i) {
    const Index k = 997 * (i + 1);
    points.row(i) = surface.position.row(k) + distances[static_cast<std::size_t>(i)] * surface.normal.row(k);
  }
  const OffSurfaceValues found = evaluate(OffSurfaceLayers(position, densities), points);
  const OffSurfaceValues expected = evaluate(
      OffSurfaceLayers(resize_order(position, kWeighted), exact, {.tolerance = 1e-11, .max_rules = 14}), points);
  // Part of J f above the reference's degree; no quadrature rule includes it.
  constexpr double kCut = 1e-9;
  const auto check = [&](const LayerField& of_plain, const LayerField& reference) {
    for (Index i = 0; i < points.rows(); ++i) {
      const double difference = (of_plain.values.row(i) - reference.values.row(i)).norm();
      BOOST_TEST(difference < 10.0 * of_plain.error[i] + kCut, difference << " at " << distances[i]);
    }
    BOOST_TEST(of_plain.error.maxCoeff() < 1e-7);
  };
  check(found.laplace_single, expected.laplace_single);
  check(found.laplace_single_gradient, expected.laplace_single_gradient);
  check(found.stokes_single, expected.stokes_single);
}

BOOST_AUTO_TEST_SUITE_END()
