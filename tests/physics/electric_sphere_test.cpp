#include <array>
#include <boost/test/unit_test.hpp>

#include "tests/support/electric.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

constexpr int sphere_order = 12;
constexpr std::array kRatios{1e-8, 0.5, 1.0 - 1e-12, 1.0, 1.0 + 1e-12, 2.0, 1e8};

/// Unit sphere with V_m = V cos θ in the field E ẑ: φ_i = −a r cos θ, φ_e = (b/r² − E r) cos θ.
struct SphereSolution {
  double a, b;
};

SphereSolution exact_solution(const ElectricParameters& electric, double v) {
  const double e = electric.field.z();
  const double a =
      electric.conductivity_out * (3.0 * e - 2.0 * v) / (electric.conductivity_in + 2.0 * electric.conductivity_out);
  return {a, e - v - a};
}

ElectricParameters field_along_z(double ratio) { return {{0.0, 0.0, 1.3}, ratio, 1.0, 1.0}; }

struct UnitSphere {
  Space space{sphere_order};
  Membrane membrane = make_membrane(space, sphere(sphere_order), kLaplaceLayers);
  Vector cos_theta = membrane.surface.position.col(2);

  [[nodiscard]] Vector dipole(double v) const { return space.fine.analyze(v * cos_theta); }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(electric_sphere, UnitSphere)

BOOST_AUTO_TEST_CASE(fluxes_charge_and_potentials_are_exact_at_every_conductivity_ratio) {
  for (const double ratio : kRatios) {
    for (const double v : {0.0, 0.7}) {
      const ElectricParameters electric = field_along_z(ratio);
      const SphereSolution exact = exact_solution(electric, v);
      const ElectricTraces traces = solve_traces(electric, membrane, dipole(v));
      BOOST_TEST_CONTEXT("conductivity ratio " << ratio << ", V_m amplitude " << v) {
        const double flux_out = -electric.field.z() - 2.0 * exact.b;
        BOOST_TEST(max_difference(traces.flux_in, -exact.a * cos_theta) < 1e-11);
        BOOST_TEST(max_difference(traces.flux_out, flux_out * cos_theta) < 1e-11);
        BOOST_TEST(max_difference(traces.charge, (-exact.a - flux_out) * cos_theta) < 1e-11);
        BOOST_TEST(max_difference(traces.potential_in, dipole(-exact.a)) < 1e-11);
        BOOST_TEST(max_difference(traces.potential_out, dipole(exact.b - electric.field.z())) < 1e-11);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(currents_balance_to_the_last_digits_at_every_conductivity_ratio) {
  // σ_i ∂φ_i/∂n = σ_e ∂φ_e/∂n holds although the fluxes differ by eight orders of magnitude.
  for (const double ratio : kRatios) {
    const ElectricParameters electric = field_along_z(ratio);
    const ElectricTraces traces = solve_traces(electric, membrane, dipole(0.7));
    const Vector current_out = electric.conductivity_out * traces.flux_out;
    BOOST_TEST(relative_difference(electric.conductivity_in * traces.flux_in, current_out) < 1e-14, "ratio " << ratio);
  }
}

BOOST_AUTO_TEST_CASE(equal_conductivities_leave_the_field_alone_without_membrane_potential) {
  const ElectricTraces traces = solve_traces(field_along_z(1.0), membrane, dipole(0.0));
  BOOST_TEST(traces.charge.isZero(0.0));
  BOOST_TEST(electric_force(1.0, membrane, traces).cwiseAbs().maxCoeff() < 1e-12);
}

BOOST_AUTO_TEST_CASE(maxwell_stress_is_the_one_worked_out_by_hand) {
  // σ_i : σ_e = 1 : 2, E = 1, V_m = 0: the field inside is 6/5 ẑ; outside its components are 3/5 cos θ along n and −6/5
  // sin θ along e_θ. f_E = [[E_n E − ½|E|² n]]: normal 27/50 cos² θ, tangential −18/25 sin θ cos θ.
  const double permittivity = 1.5;
  const ElectricParameters electric{{0.0, 0.0, 1.0}, 1.0, 2.0, permittivity};
  const Matrix force = electric_force(permittivity, membrane, solve_traces(electric, membrane, dipole(0.0)));
  const Eigen::ArrayXd cosine = cos_theta;
  const Eigen::ArrayXd sine = (1.0 - cosine.square()).sqrt();
  Matrix e_theta(force.rows(), 3);
  const Matrix& r = membrane.surface.position;
  e_theta << (cosine / sine).matrix().asDiagonal() * r.leftCols(2), -sine;
  const Vector normal_part = 27.0 / 50.0 * permittivity * cosine.square();
  const Vector tangential_part = -18.0 / 25.0 * permittivity * sine * cosine;
  BOOST_TEST(max_difference(force, normal_part.asDiagonal() * r + tangential_part.asDiagonal() * e_theta) < 1e-11);
}

BOOST_AUTO_TEST_CASE(permittivity_ratio_scales_the_stress_inside_alone) {
  // The field inside is E = 6/5 ẑ: each unit of ε_i adds E_n E − ½ E² n.
  const ElectricParameters electric{{0.0, 0.0, 1.0}, 1.0, 2.0, 1.0};
  const ElectricTraces traces = solve_traces(electric, membrane, dipole(0.0));
  const Matrix added = electric_force(1.0, membrane, traces, 3.0) - electric_force(1.0, membrane, traces);
  const Matrix& n = membrane.surface.normal;
  Matrix stress = -0.5 * 1.44 * n;
  stress.col(2) += 1.44 * n.col(2);
  BOOST_TEST(max_difference(added, 2.0 * stress) < 1e-11);
}

BOOST_AUTO_TEST_CASE(poorly_conducting_interior_is_compressed_along_the_field) {
  // The force on the fluid is −f_E: it points inwards at the poles, as in the prolate-to-oblate Example 2.
  const ElectricParameters electric{{0.0, 0.0, 1.0}, 1.0, 2.0, 1.0};
  const Matrix force = electric_force(1.0, membrane, solve_traces(electric, membrane, dipole(0.0)));
  const Vector outwards = -row_dot(force, membrane.surface.normal);
  BOOST_TEST(outwards[0] < -0.5);
  BOOST_TEST(outwards[outwards.size() - 1] < -0.5);
}

BOOST_AUTO_TEST_SUITE_END()
