#include <boost/test/unit_test.hpp>

#include "tests/support/layers.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(target_images)

namespace {

constexpr int kOrder = 8;

Matrix star(int fold, double chirality) { return star_shape(kOrder, fold, chirality); }

/// Largest difference between all operators assembled with and without the symmetry maps.
double difference(const SphereTransform& transform, const Matrix& position, const std::vector<Reflection>& reflections,
                  int fold, const LayerSelection& everything) {
  const RotatedQuadrature quadrature = make_rotated_quadrature(transform.grid(), 1.15);
  Instruments instruments;
  const LayerOperators all = assemble_layer_operators(quadrature, transform, position, everything, instruments);
  const LayerOperators shared =
      assemble_layer_operators(quadrature, transform, position, everything, instruments, reflections, fold);
  const Matrix density = random_coefficients(kOrder, 3, 54);
  double result = 0.0;
  for (const auto layer : kScalarLayers) {
    result = std::max(result, max_difference((shared.*layer).apply(density), (all.*layer).apply(density)));
  }
  for (const auto layer : kVectorLayers) {
    result = std::max(result, max_difference((shared.*layer).apply(density), (all.*layer).apply(density)));
  }
  return result;
}

double difference(const SphereTransform& transform, const Matrix& position, const std::vector<Reflection>& reflections,
                  int fold) {
  double result = 0.0;
  for (const LayerSelection& everything : kEveryKernel) {
    result = std::max(result, difference(transform, position, reflections, fold, everything));
  }
  return result;
}

double difference(const Matrix& position, const std::vector<Reflection>& reflections, int fold, int n_phi) {
  return difference(SphereTransform(kOrder, make_grid(kOrder, n_phi)), position, reflections, fold);
}

}  // namespace

BOOST_AUTO_TEST_CASE(rotated_targets_share_rows_without_change) {
  BOOST_TEST(difference(star(3, 1.0), {{}}, 3, 18) < 1e-12);
  BOOST_TEST(difference(star(5, 1.0), {{}}, 5, 20) < 1e-12);
  BOOST_TEST(difference(star(4, 1.0), {{}, {-1, -1, 1}}, 4, 20) < 1e-12);
}

BOOST_AUTO_TEST_CASE(rotated_and_reflected_targets_share_rows_without_change) {
  const Reflection y{1, -1, 1}, x{-1, 1, 1};
  // n + m is even in each harmonic of the star, so z is a mirror as well.
  BOOST_TEST(difference(star(3, 0.0), {{}, y, {1, 1, -1}, {1, -1, -1}}, 3, 18) < 1e-12);
  BOOST_TEST(difference(star(4, 0.0), {{}, x, y, {-1, -1, 1}}, 4, 20) < 1e-12);
}

BOOST_AUTO_TEST_CASE(targets_in_a_mirror_need_half_their_nodes) {
  // On an axisymmetric body one longitude represents all four; it lies in the mirror plane of y.
  const SphereTransform transform(kOrder, make_grid(kOrder, 4), 1);
  const Reflection x{-1, 1, 1}, y{1, -1, 1}, half_turn{-1, -1, 1};
  Matrix pear = Matrix::Zero(n_coefficients(kOrder), 3);
  const std::vector<double> radius{0.0, 1.0, 0.2, 0.1}, height{0.0, 1.3, 0.3, -0.1};
  for (int n = 1; n < 4; ++n) {
    pear(coefficient_index(n, 1), 0) = pear(coefficient_index(n, -1), 1) = radius[n];
    pear(coefficient_index(n, 0), 2) = height[n];
  }
  BOOST_TEST(difference(transform, pear, {{}, x, y, half_turn}, 4) < 1e-13);
  const RotatedQuadrature quadrature = make_rotated_quadrature(transform.grid(), 1.15);
  BOOST_TEST(evaluations_per_assembly(quadrature, transform, {{}, x, y, half_turn}, 4) ==
             static_cast<std::uint64_t>((kOrder + 1) * quadrature.n_nodes() / 2));
  pear(coefficient_index(2, -1), 2) = 0.1;
  BOOST_TEST(difference(transform, pear, {{}, x, y, half_turn}, 4) > 1e-3);
}

BOOST_AUTO_TEST_CASE(wrong_fold_is_noticed) {
  BOOST_TEST(difference(star(3, 1.0), {{}}, 5, 30) > 1e-3);
  BOOST_TEST(difference(star(3, 1.0), {{}, {1, -1, 1}}, 3, 18) > 1e-3);
}

BOOST_AUTO_TEST_SUITE_END()
