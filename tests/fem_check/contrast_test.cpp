#include <boost/test/unit_test.hpp>

#include "tests/fem_check/cases.hpp"

using namespace vehd::fem_check;
using namespace vehd::fem_check::testing;

/// Coefficients differing by many powers of ten, against exact solutions on the sphere; also checks that the solver
/// tolerance bounds the error in the compared fields.
BOOST_AUTO_TEST_SUITE(contrast)

namespace {

/// One ratio is so near 1 that 1/σ_i − 1/σ_e has a relative error of a hundredth.
constexpr double kRatios[] = {1e-8, 1e-4, 1.0 - 1.01e-14, 1e4, 1e7, 1e8};

/// V_m = V cos θ prescribed on the unit sphere in a unit field along z: φ_i = −a r cos θ, φ_e = (−r + b/r²) cos θ.
struct GivenVoltage {
  double ratio;  ///< σ_i/σ_e
  double voltage = 0.7;

  [[nodiscard]] double disturbance() const { return (ratio * (1.0 - voltage) - 1.0) / (ratio + 2.0); }  // b
  [[nodiscard]] double flux_out() const { return -1.0 - 2.0 * disturbance(); }
  [[nodiscard]] double flux_in() const { return flux_out() / ratio; }
  [[nodiscard]] double charge() const { return (1.0 - ratio) * flux_in(); }
  [[nodiscard]] Vector3 force(const Vector3& n) const {
    const Vector3 z = Vector3::UnitZ();
    const Vector3 tangential = z - n.z() * n;
    const auto stress = [&](double along, double flux) {
      const Vector3 e = -along * tangential - flux * n.z() * n;
      return Vector3(e.dot(n) * e - 0.5 * e.squaredNorm() * n);
    };
    return stress(flux_in(), flux_in()) - stress(-1.0 + disturbance(), flux_out());
  }
  [[nodiscard]] PotentialProblem problem() const {
    PotentialProblem result;
    result.field = Vector3::UnitZ();
    result.conductivity_in = ratio;
    result.membrane = PrescribedJump{on_surface([v = voltage](const Vector3& x, const Vector3&) { return v * x.z(); })};
    return result;
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(charge_and_force_of_a_given_voltage_at_every_conductivity_ratio) {
  const Discretisation space = discretise(unit_sphere(), {.degree = 5});
  const SurfacePoints points = space.quadrature_points(8);
  for (const double ratio : kRatios) {
    const GivenVoltage exact{ratio};
    const PotentialSolution solution = solve_potential(space, exact.problem());
    const PotentialTraces traces = solution.on_surface(points);
    const Vector cosine = points.normal.row(2).transpose();
    BOOST_TEST_CONTEXT("σ_i/σ_e = " << ratio) {
      BOOST_TEST(relative_l2(points, traces.flux_in, exact.flux_in() * cosine) < 1e-4);
      BOOST_TEST(relative_l2(points, traces.charge, exact.charge() * cosine) < 1e-4);
      const Vectors force = sampled_vectors(points, [&](const Vector3&, const Vector3& n) { return exact.force(n); });
      BOOST_TEST(relative_l2(points, traces.force, force) < 3e-4);
    }
  }
}

BOOST_AUTO_TEST_CASE(error_of_the_linear_solver_is_within_its_tolerance_at_every_conductivity_ratio) {
  const Discretisation space = discretise(unit_sphere(), {.degree = 4});
  const SurfacePoints points = space.quadrature_points(6);
  for (const double ratio : kRatios) {
    PotentialProblem problem = GivenVoltage{ratio}.problem();
    problem.tolerance = 1e-12;
    const PotentialTraces tight = solve_potential(space, problem).on_surface(points);
    problem.tolerance = 1e-7;
    const PotentialSolution loose = solve_potential(space, problem);
    BOOST_TEST(loose.cost().solver_error <= 1e-7);
    // The norm contains the energies of both conductors, the better one dominating: a factor √ratio at worst.
    const PotentialTraces traces = loose.on_surface(points);
    const double allowed = 1e-5 * std::max(1.0, std::sqrt(1.0 / ratio));
    BOOST_TEST_CONTEXT("σ_i/σ_e = " << ratio) {
      BOOST_TEST(relative_l2(points, traces.charge, tight.charge) < allowed);
      BOOST_TEST(relative_l2(points, traces.force, tight.force) < allowed);
    }
  }
}

BOOST_AUTO_TEST_CASE(voltage_of_a_membrane_law_at_every_conductivity_ratio) {
  const Discretisation space = discretise(unit_sphere(), {.degree = 5});
  const SurfacePoints points = space.quadrature_points(8);
  for (const double ratio : kRatios) {
    PotentialProblem problem;
    problem.field = Vector3::UnitZ();
    problem.conductivity_in = ratio;
    problem.membrane = SteadyMembrane{0.5, 0.0};
    const double kappa = 2.0 * ratio / (ratio + 2.0);
    const Vector voltage = 1.5 * kappa / (kappa + 0.5) * points.normal.row(2).transpose();
    const PotentialTraces traces = solve_potential(space, problem).on_surface(points);
    BOOST_TEST_CONTEXT("σ_i/σ_e = " << ratio) {
      BOOST_TEST(relative_l2(points, traces.transmembrane_potential, voltage) < 3e-5);
      BOOST_TEST(relative_l2(points, traces.flux_in, -0.5 / ratio * voltage) < 1e-4);
    }
  }
}

BOOST_AUTO_TEST_CASE(flow_divides_force_and_strain_at_every_viscosity_ratio) {
  // r̂ × ∇Y of degree 1, a rotation, which a stiff drop does not resist, and of degree 2, a twist, which it does.
  const Discretisation space = discretise(unit_sphere(), {.degree = 4});
  const SurfacePoints points = space.quadrature_points(6);
  const Matrix3 strain = Vector3(0.3, 0.5, -0.8).asDiagonal();
  const Vector3 axis(0.3, -0.4, 1.0);
  for (const double ratio : {1e-8, 1e-4, 1e4, 1e8}) {
    FlowProblem problem;
    problem.viscosity_in = ratio;
    problem.force = vectors_on_surface([&](const Vector3& x, const Vector3&) { return Vector3(x.cross(axis)); });
    const Vectors rotation = solve_flow(space, problem).on_surface(points).velocity;
    // Traction per velocity: μ_i (n − 1) inside, −μ_e (n + 2) outside.
    const Vectors exact = 1.0 / 3.0 * problem.force(points);
    problem.force = vectors_on_surface([&](const Vector3& x, const Vector3&) { return Vector3(x.cross(strain * x)); });
    const Vectors twist = solve_flow(space, problem).on_surface(points).velocity;
    const Vectors exact_twist = problem.force(points) / (ratio + 4.0);
    problem.force = vectors_on_surface([](const Vector3&, const Vector3&) { return Vector3(Vector3::Zero()); });
    problem.gradient = strain;
    const Vectors strained = solve_flow(space, problem).velocity(space.locate(Vector3(0.2, -0.3, 0.1)));
    BOOST_TEST_CONTEXT("μ_i/μ_e = " << ratio) {
      // Elements of degree k on cells of degree k + 1 do not represent a rotation exactly: a drop 1e8 times as viscous
      // as the fluid around it resists the rest of it and turns too slowly.
      if (ratio <= 1e4) BOOST_TEST(relative_l2(points, rotation, exact) < 1e-3);
      BOOST_TEST(relative_l2(points, twist, exact_twist) < 1e-3);
      // The strain inside is 5 μ_e/(3 μ_e + 2 μ_i) of the rate far away: almost zero in a stiff drop.
      const Vector3 inside = 5.0 / (3.0 + 2.0 * ratio) * strain * Vector3(0.2, -0.3, 0.1);
      BOOST_TEST((strained.col(0) - inside).norm() < 1e-3 * (strain * Vector3(0.2, -0.3, 0.1)).norm());
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
