#include <omp.h>

#include <boost/test/unit_test.hpp>

#include "bie/support/errors.hpp"
#include "tests/support/layers.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

/// Results of all layers on smooth densities, in adjacent columns.
Matrix results(const LayerOperators& layers, const Matrix& density) {
  Matrix all(density.rows(), 6);
  all << layers.laplace_single.apply(density.col(0)), layers.laplace_double.apply(density.col(1)),
      layers.laplace_adjoint.apply(density.col(2)), layers.stokes_single.apply(density);
  return all;
}

/// Change of the results under a rotation of the parametrisation.
double pole_dependence(int order) {
  const Space space(order);
  const Matrix3 rotation = general_rotation();
  const Matrix position = asymmetric_shape(order);
  const Matrix density = smooth_coefficients(order, 5, 3, 51);
  const Matrix here = results(assemble(space, position, kAllLayers), density);
  const Matrix moved =
      results(assemble(space, move_poles(position, rotation), kAllLayers), move_poles(density, rotation));
  return relative_difference(moved, move_poles(here, rotation));
}

}  // namespace

BOOST_AUTO_TEST_SUITE(quadrature)

BOOST_AUTO_TEST_CASE(results_do_not_depend_on_the_poles_beyond_discretisation) {
  const double coarse = pole_dependence(8);
  const double fine = pole_dependence(24);
  BOOST_TEST(fine < 1e-3 * coarse);
  BOOST_TEST(fine < 1e-6);
}

BOOST_AUTO_TEST_CASE(converges_in_oversampling_and_the_default_is_past_the_knee) {
  const int order = 16;
  const Matrix density = smooth_coefficients(order, 8, 3, 52);
  const auto with = [&](double oversampling) {
    const Space space(order, NumericalSettings{}.upsampling, oversampling);
    return results(assemble(space, shape_33(order), kAllLayers), density);
  };
  const Matrix reference = with(4.0);
  const double error_low = relative_difference(with(0.7), reference);
  const double error_default = relative_difference(with(NumericalSettings{}.quadrature_oversampling), reference);
  const double error_high = relative_difference(with(2.5), reference);
  BOOST_TEST(error_default < 0.1 * error_low);
  BOOST_TEST(error_high < 1e-2 * error_default);
  BOOST_TEST(error_default < 1e-5);
}

BOOST_AUTO_TEST_CASE(layers_assembled_together_equal_layers_assembled_alone) {
  const Space space(8);
  const Matrix position = asymmetric_shape(8);
  const LayerOperators together = assemble(space, position, kAllLayers);
  const LayerOperators single = assemble(space, position, {.laplace_single = true});
  const LayerOperators adjoint = assemble(space, position, {.laplace_adjoint = true});
  const Matrix all = Matrix::Identity(n_coefficients(8), n_coefficients(8));
  BOOST_TEST(max_difference(single.laplace_single.apply(all), together.laplace_single.apply(all)) < 1e-14);
  BOOST_TEST(max_difference(adjoint.laplace_adjoint.apply(all), together.laplace_adjoint.apply(all)) < 1e-14);
  BOOST_TEST(single.laplace_double.empty());
  BOOST_TEST(single.laplace_adjoint.empty());
  BOOST_TEST(single.stokes_single.empty());
}

BOOST_AUTO_TEST_CASE(only_selected_kernels_are_evaluated_and_counted) {
  const Space space(8);
  Instruments instruments;
  assemble_layer_operators(space.quadrature, space.coarse, sphere(8), kStokesLayer, instruments);
  const auto& counts = instruments.kernel_evaluations();
  BOOST_TEST(counts.size() == 1u);
  BOOST_TEST(counts.at("stokes_single") ==
             static_cast<std::uint64_t>(space.coarse.grid().n_points() * space.quadrature.n_nodes()));
}

BOOST_AUTO_TEST_CASE(operators_have_the_same_bits_on_any_number_of_threads) {
  const int threads = omp_get_max_threads();
  const Space space(12);
  const Matrix position = asymmetric_shape(12);
  const Matrix density = random_coefficients(12, 3, 53);
  omp_set_num_threads(1);
  const Matrix alone = results(assemble(space, position, kAllLayers), density);
  omp_set_num_threads(2);
  const Matrix shared = results(assemble(space, position, kAllLayers), density);
  omp_set_num_threads(threads);
  BOOST_TEST((alone.array() == shared.array()).all());
}

BOOST_AUTO_TEST_CASE(sizes_that_do_not_belong_together_are_refused) {
  const Space space(8);
  BOOST_CHECK_THROW(assemble(space, sphere(7), kLaplaceLayers), ShapeError);
  const LayerOperators layers = assemble(space, sphere(8), kAllLayers);
  BOOST_CHECK_THROW(static_cast<void>(layers.laplace_single.apply(Matrix::Zero(80, 1))), ShapeError);
  BOOST_CHECK_THROW(static_cast<void>(layers.stokes_single.apply(Matrix::Zero(81, 2))), ShapeError);
  BOOST_CHECK_THROW(static_cast<void>(layers.stokes_single.apply(Matrix::Zero(80, 3))), ShapeError);
}

BOOST_AUTO_TEST_SUITE_END()
