#include <algorithm>
#include <boost/test/unit_test.hpp>

#include "bie/sphere/harmonics.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(symmetry)

namespace {

constexpr int kOrder = 12;

NumericalSettings settings_of_order(int order) {
  NumericalSettings settings;
  settings.order = order;
  return settings;
}

State state_of(const Model& model, const Matrix& position) {
  return start(model, discretisation_of(order_of(position.rows())), position, 0.1);
}

std::uint64_t stokes_evaluations(const Model& model, const Matrix& position, const Symmetry& symmetry) {
  const Discretisation discretisation(settings_of_order(kOrder), symmetry);
  const State state = start(model, discretisation, position, 0.1);
  Instruments instruments;
  evaluate(model, discretisation, state, instruments);
  return instruments.kernel_evaluations().at("stokes_single");
}

}  // namespace

BOOST_AUTO_TEST_CASE(prolate_in_a_field_along_its_axis_is_axisymmetric) {
  const Symmetry found = find_symmetry(field_model(), state_of(field_model(), prolate(kOrder)));
  BOOST_TEST(found.axisymmetric);
  BOOST_TEST(found.reflections.size() == 8);
  BOOST_TEST(symmetry_text(found) == "axisymmetric about z, mirror z");
}

BOOST_AUTO_TEST_CASE(even_coefficients_are_those_of_symmetric_scalars) {
  const auto has = [](const std::vector<Index>& entries, int n, int m) {
    return std::binary_search(entries.begin(), entries.end(), coefficient_index(n, m));
  };
  Symmetry axis;
  axis.axisymmetric = true;
  const std::vector<Index> zonal = scalar_entries(axis, kOrder);
  BOOST_TEST(zonal.size() == kOrder + 1);
  BOOST_TEST((has(zonal, 3, 0) && !has(zonal, 3, 1)));
  BOOST_TEST(scalar_entries({}, kOrder).size() == static_cast<std::size_t>(n_coefficients(kOrder)));
  Symmetry mirror;
  mirror.reflections.push_back({1, 1, -1});
  mirror.potential_signs.push_back(-1);
  const std::vector<Index> even = scalar_entries(mirror, kOrder);
  BOOST_TEST((has(even, 2, 0) && has(even, 3, 1) && !has(even, 1, 0) && !has(even, 3, 2)));
}

BOOST_AUTO_TEST_CASE(ellipsoid_in_shear_has_a_mirror_a_half_turn_and_the_inversion) {
  Model model = field_model();
  model.flow = shear_flow(1.0);
  const Symmetry found = find_symmetry(model, state_of(model, ellipsoid(kOrder, {2.0, 1.0, 1.0})));
  BOOST_TEST(symmetry_text(found) == "mirror y, half turn about y, inversion");
}

BOOST_AUTO_TEST_CASE(symmetry_that_is_gone_is_not_used) {
  const Matrix shape = prolate(kOrder);
  BOOST_TEST(symmetry_text(find_symmetry(field_model(), state_of(field_model(), asymmetric_shape(kOrder)))) == "none");
  Matrix bump = shape;
  bump(coefficient_index(4, 3), 1) = 1e-9;
  BOOST_TEST(!find_symmetry(field_model(), state_of(field_model(), bump)).axisymmetric);
  Model tilted = field_model();
  tilted.electric->field = {1e-6, 0.0, 1.0};
  BOOST_TEST(symmetry_text(find_symmetry(tilted, state_of(tilted, shape))) == "mirror y, half turn about y, inversion");
  Model sheared = field_model();
  sheared.flow = shear_flow(1e-6);
  BOOST_TEST(!find_symmetry(sheared, state_of(sheared, shape)).axisymmetric);
  Model swirling = field_model();
  swirling.flow = BackgroundFlow{};
  swirling.flow->gradient(0, 1) = 1e-3;
  swirling.flow->gradient(1, 0) = -1e-3;
  BOOST_TEST(!find_symmetry(swirling, state_of(swirling, shape)).axisymmetric);
  // A potential that is neither even nor odd in z.
  State charged = state_of(field_model(), shape);
  charged.vesicles[0].transmembrane_potential[coefficient_index(1, 0)] = 0.1;
  charged.vesicles[0].transmembrane_potential[coefficient_index(2, 0)] = 0.1;
  BOOST_TEST(symmetry_text(find_symmetry(field_model(), charged)) == "axisymmetric about z");
}

BOOST_AUTO_TEST_CASE(reduced_solver_makes_the_same_steps) {
  BOOST_TEST(difference_with_symmetry(field_model(), prolate(kOrder), 0.5, 4) < 1e-9);
  Model pear = relaxation_model(0.5);
  Matrix shape = prolate(kOrder);
  shape(coefficient_index(2, 0), 2) = 0.2;  // no mirror z
  BOOST_TEST(difference_with_symmetry(pear, shape, 0.2, 4) < 1e-9);
  Model sheared = field_model();
  sheared.flow = shear_flow(1.0);
  BOOST_TEST(difference_with_symmetry(sheared, ellipsoid(kOrder, {2.0, 1.0, 1.0}), 0.1, 4) < 1e-9);
  BOOST_TEST(difference_with_symmetry(field_model(), ellipsoid(kOrder, {0.8, 1.2, 1.5}), 0.1, 4) < 1e-9);
}

// Without symmetry: 2p + 2 longitudes of p + 1 latitudes. Axisymmetric with mirror z: one longitude of half the
// latitudes, which lies in a mirror, so that half of the nodes about each target suffice.
BOOST_AUTO_TEST_CASE(only_independent_targets_are_evaluated) {
  const Symmetry axis = find_symmetry(field_model(), state_of(field_model(), prolate(kOrder)));
  const double full = double(stokes_evaluations(field_model(), prolate(kOrder), {}));
  const double reduced = double(stokes_evaluations(field_model(), prolate(kOrder), axis));
  const double targets_full = (kOrder + 1) * (2 * kOrder + 2);
  const double targets_reduced = (kOrder / 2 + 1) * 0.5;
  BOOST_TEST(reduced / full == targets_reduced / targets_full, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_SUITE_END()
