#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/physics/membrane_charging.hpp"
#include "tests/support/electric.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

constexpr int prolate_order = 24;

/// The 2:1 prolate in a field along its axis.
struct ProlateInField {
  Space space{prolate_order};
  Membrane membrane = make_membrane(space, prolate(prolate_order), kLaplaceLayers);
  double field = 1.3;

  [[nodiscard]] ElectricParameters electric(double ratio) const { return {{0.0, 0.0, field}, ratio, 1.0, 1.0}; }
};

/// Depolarisation factor along the axis, 0.1735640.
double depolarisation() {
  const double e = std::sqrt(0.75);
  return (1.0 - e * e) / (e * e) * (std::atanh(e) / e - 1.0);
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(electric_prolate, ProlateInField)

BOOST_AUTO_TEST_CASE(depolarisation_factor_is_the_tabulated_one) {
  BOOST_TEST(std::abs(depolarisation() - 0.1735640) < 5e-8);
}

BOOST_AUTO_TEST_CASE(interior_field_is_uniform_and_charge_follows_the_normal) {
  for (const double ratio : {1e-8, 0.5, 1.0, 2.0, 20.0, 1e8}) {
    const double interior = field / (1.0 + depolarisation() * (ratio - 1.0));
    const Vector none = Vector::Zero(n_coefficients(prolate_order));
    const ElectricTraces traces = solve_traces(electric(ratio), membrane, none);
    const Vector normal_z = membrane.surface.normal.col(2);
    const Vector charge = -(1.0 - ratio) * interior * normal_z;
    BOOST_TEST_CONTEXT("conductivity ratio " << ratio) {
      const Matrix potential = space.fine.synthesize(traces.potential_in);
      BOOST_TEST(max_difference(potential, -interior * membrane.surface.position.col(2)) < 1e-10 * field);
      BOOST_TEST(max_difference(traces.flux_in, -interior * normal_z) < 1e-10 * field);
      BOOST_TEST(max_difference(traces.charge, charge) < 1e-10 * field);
    }
  }
}

BOOST_AUTO_TEST_CASE(insulating_membrane_takes_the_whole_potential_drop_when_steady) {
  for (const double ratio : {0.5, 2.0, 1e6}) {
    std::vector<Vector> potentials(1);
    require_converged(steady_potentials({{{electric(ratio), membrane}, {1.0, 0.0}}}, {}, 1e-12, potentials),
                      "steady potential");
    const Vector expected = field / (1.0 - depolarisation()) * membrane.surface.position.col(2);
    BOOST_TEST(max_difference(space.fine.synthesize(potentials[0]), expected) < 1e-10 * field,
               "conductivity ratio " << ratio);
  }
}

BOOST_AUTO_TEST_SUITE_END()
