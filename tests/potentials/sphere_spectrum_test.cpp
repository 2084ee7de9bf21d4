#include <boost/test/unit_test.hpp>

#include "tests/support/layers.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

/// Largest |operator Y_nm − eigenvalue(n) Y_nm| over all n ≤ p/2, on every coefficient up to degree p.
template <typename Eigenvalue>
double spectrum_error(const ScalarOperator& layer, int order, const Eigenvalue& eigenvalue) {
  const Index count = n_coefficients(order / 2);
  Matrix expected = Matrix::Zero(n_coefficients(order), count);
  for (int n = 0; n <= order / 2; ++n) {
    for (Index i = coefficient_index(n, -n); i <= coefficient_index(n, n); ++i) expected(i, i) = eigenvalue(n);
  }
  return max_difference(layer.apply(Matrix::Identity(n_coefficients(order), count)), expected);
}

double single_layer(int n) { return 1.0 / (2.0 * n + 1.0); }
double double_layer(int n) { return -0.5 / (2.0 * n + 1.0); }

}  // namespace

BOOST_AUTO_TEST_SUITE(sphere_spectrum)

BOOST_AUTO_TEST_CASE(laplace_layers_have_the_eigenvalues_of_the_unit_sphere) {
  for (const int order : {8, 16, 32}) {
    const Space space(order);
    const LayerOperators layers = assemble(space, sphere(order), kLaplaceLayers);
    BOOST_TEST_CONTEXT("order " << order) {
      BOOST_TEST(spectrum_error(layers.laplace_single, order, single_layer) < 1e-11);
      BOOST_TEST(spectrum_error(layers.laplace_double, order, double_layer) < 1e-11);
      BOOST_TEST(spectrum_error(layers.laplace_adjoint, order, double_layer) < 1e-11);
    }
  }
}

// At this order the latitudes are analysed in several blocks.
BOOST_AUTO_TEST_CASE(single_layer_has_its_eigenvalues_at_order_64) {
  const Space space(64);
  const LayerSelection single{.laplace_single = true};
  BOOST_TEST(spectrum_error(assemble(space, sphere(64), single).laplace_single, 64, single_layer) < 1e-11);
  Instruments instruments;
  const LayerOperators mirrored = assemble_layer_operators(space.quadrature, space.coarse, sphere(64), single,
                                                           instruments, {{}, Reflection{1, 1, -1}});
  BOOST_TEST(spectrum_error(mirrored.laplace_single, 64, single_layer) < 1e-11);
}

BOOST_AUTO_TEST_CASE(radius_enters_the_single_layer_alone_and_the_centre_nothing) {
  // S scales with R, and its density is J f = R² f.
  const double radius = 2.5;
  const Space space(16);
  const LayerOperators layers = assemble(space, translated(sphere(16, radius), {3.0, -1.0, 0.7}), kLaplaceLayers);
  const auto scaled_single_layer = [radius](int n) { return single_layer(n) / radius; };
  BOOST_TEST(spectrum_error(layers.laplace_single, 16, scaled_single_layer) < 1e-11);
  BOOST_TEST(spectrum_error(layers.laplace_double, 16, double_layer) < 1e-11);
  BOOST_TEST(spectrum_error(layers.laplace_adjoint, 16, double_layer) < 1e-11);
}

BOOST_AUTO_TEST_SUITE_END()
