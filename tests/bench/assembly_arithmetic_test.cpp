#include "bie/bench/assembly_arithmetic.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "tests/support/layers.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

double operations(int order, const LayerSelection& selection) {
  const Space space(order);
  return operations_per_assembly(space.quadrature, space.coarse, selection, {Symmetry{}, order}, 1);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(assembly_arithmetic)

BOOST_AUTO_TEST_CASE(assembly_is_of_fifth_order_in_the_degree) {
  const double exponent = std::log2(operations(48, kStokesLayer) / operations(24, kStokesLayer));
  BOOST_TEST(exponent > 4.3);
  BOOST_TEST(exponent < 5.0);
  BOOST_TEST(operations(16, kAllLayers) > operations(16, kStokesLayer));
  BOOST_TEST(operations(16, kAllLayers) < operations(16, kStokesLayer) + operations(16, kLaplaceLayers));
  BOOST_TEST(operations(16, {}) == 0.0);
}

BOOST_AUTO_TEST_CASE(every_kernel_value_costs_what_its_column_is_carried_through) {
  // One scalar column at p = 8, only the largest products: Legendre sums of all targets and the sums over the azimuth.
  const Space space(8);
  const double targets = space.coarse.grid().n_points();
  const double hemisphere = space.quadrature.n_theta / 2;
  const double legendre = 2.0 * 2.0 * hemisphere * (9.0 * 10.0 / 2.0);
  const double fourier = 2.0 * 2.0 * (space.quadrature.n_phi / 4) * 9.0 * space.quadrature.n_theta;
  const double four_columns = 4.0 * targets * (legendre + fourier);
  BOOST_TEST(operations(8, {.laplace_single = true}) > four_columns);
  BOOST_TEST(operations(8, {.laplace_single = true}) < 2.0 * four_columns);
}

BOOST_AUTO_TEST_CASE(the_symmetry_of_a_shear_flow_divides_operations_by_more_than_its_order) {
  Symmetry shear;
  shear.reflections = {{}, {1, -1, 1}, {-1, 1, -1}, {-1, -1, -1}};
  shear.potential_signs = {1, 1, 1, 1};
  const Space space(24);
  const auto with = [&](const Symmetry& symmetry, const LayerSelection& selection) {
    return operations_per_assembly(space.quadrature, space.coarse, selection, {symmetry, 24}, 1);
  };
  BOOST_TEST(with(shear, kStokesLayer) < with({}, kStokesLayer) / 5.0);
  // For Laplace layers all classes are kept.
  BOOST_TEST(with(shear, kLaplaceLayers) < with({}, kLaplaceLayers) / 3.0);
  BOOST_TEST(with(shear, kLaplaceLayers) > with({}, kLaplaceLayers) / 5.0);
}

BOOST_AUTO_TEST_SUITE_END()
