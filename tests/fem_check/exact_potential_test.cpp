#include <boost/test/unit_test.hpp>

#include "tests/fem_check/cases.hpp"

using namespace vehd::fem_check;
using namespace vehd::fem_check::testing;

namespace {

/// κ of the charging law of a sphere.
double sphere_kappa(double in, double out) { return 2.0 * in * out / (in + 2.0 * out); }

}  // namespace

BOOST_AUTO_TEST_SUITE(exact_potential, *boost::unit_test::label("slow"))

BOOST_AUTO_TEST_CASE(conducting_sphere_is_exact_at_every_conductivity_ratio) {
  const Discretisation space = discretise(unit_sphere(), {.degree = 5});
  const SurfacePoints points = space.quadrature_points(8);
  const double conductance = 0.5;
  const Vector3 field(0.3, -0.2, 0.9);
  for (const double ratio : {1e-4, 0.5, 1.0, 3.0, 1e4}) {
    PotentialProblem problem;
    problem.field = field;
    problem.conductivity_in = ratio;
    problem.membrane = SteadyMembrane{conductance, 0.0};
    const PotentialTraces traces = solve_potential(space, problem).on_surface(points);
    const double kappa = sphere_kappa(ratio, 1.0);
    const Vector voltage = 1.5 * kappa / (kappa + conductance) * (points.position.transpose() * field);
    const Vector flux = -conductance / ratio * voltage;
    BOOST_TEST_CONTEXT("σ_i/σ_e = " << ratio) {
      BOOST_TEST(relative_l2(points, traces.transmembrane_potential, voltage) < 3e-5);
      BOOST_TEST(relative_l2(points, traces.flux_in, flux) < 3e-5);
      if (ratio == 1.0) {
        BOOST_TEST(traces.charge.cwiseAbs().maxCoeff() == 0.0);
      } else {
        BOOST_TEST(relative_l2(points, traces.charge, (1.0 - ratio) * flux) < 3e-5);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(sphere_charges_by_backward_euler) {
  const Discretisation space = discretise(unit_sphere(), {.degree = 4});
  const SurfacePoints points = space.quadrature_points(7);
  const double sigma_in = 1.0;
  const double sigma_out = 2.0;
  const double dt = 0.3;
  const double capacitance = 1.5;
  const double conductance = 0.2;
  PotentialProblem problem;
  problem.field = {0.0, 0.0, 1.0};
  problem.conductivity_in = sigma_in;
  problem.conductivity_out = sigma_out;
  problem.membrane = ChargingMembrane{capacitance, conductance, dt, 3,
                                      on_surface([](const Vector3& x, const Vector3&) { return 0.1 * x.z(); })};
  const double kappa = sphere_kappa(sigma_in, sigma_out);
  double voltage = 0.1;
  for (int step = 0; step < 3; ++step) {
    voltage = (capacitance / dt * voltage + 1.5 * kappa) / (capacitance / dt + conductance + kappa);
  }
  const PotentialTraces traces = solve_potential(space, problem).on_surface(points);
  const Vector exact = voltage * points.position.row(2).transpose();
  BOOST_TEST(relative_l2(points, traces.transmembrane_potential, exact) < 1e-4);
  const double flux = -kappa * (1.5 - voltage) / sigma_in;
  BOOST_TEST(relative_l2(points, traces.flux_in, flux * points.position.row(2).transpose()) < 1e-4);
}

// V = v·x and E_i = e·x with C v − ε_i e = p and ε_e (3E − 2e − 2v) − C v = q, for face charges p·x and q·x.
BOOST_AUTO_TEST_CASE(potential_of_charged_faces_of_a_sphere_is_that_of_its_dipoles) {
  const Discretisation space = discretise(unit_sphere(), {.degree = 4});
  const SurfacePoints points = space.quadrature_points(7);
  const Vector3 field(0.3, -0.2, 0.9), inner(0.5, 0.1, -0.4), outer(-0.2, 0.3, 0.6);
  const auto dipole = [](const Vector3& of) {
    return on_surface([of](const Vector3& x, const Vector3&) { return of.dot(x); });
  };
  const double capacitance = 1.5;
  for (const auto& [in, out] : {std::pair(0.4, 0.7), std::pair(0.7, 0.4), std::pair(0.02, 0.03)}) {
    PotentialProblem problem;
    problem.field = field;
    problem.conductivity_in = in;
    problem.conductivity_out = out;
    problem.membrane = ChargedMembrane{capacitance, dipole(inner)};
    problem.current_jump = dipole(inner + outer);
    const PotentialTraces traces = solve_potential(space, problem).on_surface(points);
    const double more = 1.0 + 2.0 * out / capacitance;
    const Vector3 inside = (3.0 * out * field - outer - more * inner) / (2.0 * out + in * more);
    const Vector3 voltage = (inner + in * inside) / capacitance;
    const Vector3 outside = 3.0 * field - 2.0 * inside - 2.0 * voltage;
    const auto exact = [&](const Vector3& of) { return Vector(points.position.transpose() * of); };
    BOOST_TEST_CONTEXT("ε_i = " << in << ", ε_e = " << out) {
      BOOST_TEST(relative_l2(points, traces.transmembrane_potential, exact(voltage)) < 1e-4);
      BOOST_TEST(relative_l2(points, traces.flux_in, exact(-inside)) < 1e-4);
      BOOST_TEST(relative_l2(points, traces.charge, exact(outside - inside)) < 1e-4);
    }
  }
}

BOOST_AUTO_TEST_CASE(prolate_without_jump_has_a_uniform_field_inside) {
  const Discretisation space = discretise(shapes::prolate(), {.degree = 5});
  const SurfacePoints points = space.quadrature_points(8);
  for (const double ratio : {0.01, 0.5, 20.0}) {
    PotentialProblem problem;
    problem.field = {0.0, 0.0, 1.0};
    problem.conductivity_in = ratio;
    problem.membrane = PrescribedJump{on_surface([](const Vector3&, const Vector3&) { return 0.0; })};
    const PotentialSolution solution = solve_potential(space, problem);
    const PotentialTraces traces = solution.on_surface(points);
    const double inside = 1.0 / (1.0 + kDepolarisation * (ratio - 1.0));
    const Vector flux = -inside * points.normal.row(2).transpose();
    BOOST_TEST_CONTEXT("σ_i/σ_e = " << ratio) {
      BOOST_TEST(relative_l2(points, traces.flux_in, flux) < 1e-3);
      BOOST_TEST(relative_l2(points, traces.charge, (1.0 - ratio) * flux) < 1e-3);
      Vectors sample(3, 2);
      sample << 0.1, -0.3, 0.2, 0.4, 1.1, -0.7;
      const Vector exact = -inside * sample.row(2).transpose();
      BOOST_TEST((solution.potential(space.locate(sample)) - exact).cwiseAbs().maxCoeff() < 1e-4);
    }
  }
}

BOOST_AUTO_TEST_CASE(insulating_membrane_takes_the_whole_potential_drop_when_steady) {
  const Discretisation space = discretise(shapes::prolate(), {.degree = 4});
  const SurfacePoints points = space.quadrature_points(7);
  PotentialProblem problem;
  problem.field = {0.0, 0.0, 1.0};
  problem.conductivity_out = 2.0;
  problem.membrane = SteadyMembrane{0.0, 0.7};
  const PotentialTraces traces = solve_potential(space, problem).on_surface(points);
  const Vector exact = (0.7 + points.position.row(2).array() / (1.0 - kDepolarisation)).transpose();
  BOOST_TEST(relative_l2(points, traces.transmembrane_potential, exact) < 3e-5);
  BOOST_TEST(traces.flux_in.cwiseAbs().maxCoeff() < 1e-8);
}

BOOST_AUTO_TEST_CASE(electric_force_on_the_sphere_is_the_one_of_the_formula) {
  // The field inside is uniform: E_n = E_i cos θ, E_t = −E_i sin θ.
  const Discretisation space = discretise(unit_sphere(), {.degree = 5});
  const SurfacePoints points = space.quadrature_points(8);
  const double ratio = 0.25;
  const double inside = 3.0 / (2.0 + ratio);
  PotentialProblem problem;
  problem.field = {0.0, 0.0, 1.0};
  problem.conductivity_in = ratio;
  problem.permittivity_in = 2.0;
  problem.permittivity_out = 0.7;
  problem.membrane = PrescribedJump{on_surface([](const Vector3&, const Vector3&) { return 0.0; })};
  const Vectors exact = sampled_vectors(points, [&](const Vector3&, const Vector3& n) {
    const Vector3 field(0.0, 0.0, inside);
    const double normal_in = n.dot(field);
    const Vector3 tangential = field - normal_in * n;
    const auto stress = [&](double permittivity, double normal_field) {
      const Vector3 e = tangential + normal_field * n;
      return Vector3(permittivity * (normal_field * e - 0.5 * e.squaredNorm() * n));
    };
    return Vector3(stress(2.0, normal_in) - stress(0.7, ratio * normal_in));
  });
  BOOST_TEST(relative_l2(points, solve_potential(space, problem).on_surface(points).force, exact) < 3e-4);
}

BOOST_AUTO_TEST_CASE(point_sources_on_shape_33_and_on_the_disc) {
  struct Case {
    vehd::meshes::FrozenShape shape;
    TwoSources sources;
    double charge, force, voltage;
  };
  const Case cases[] = {{shapes::shape_33(), sources_of_shape_33(), 1e-3, 1e-2, 1e-4},
                        {shapes::disc(), sources_of_disc(), 1e-2, 1e-1, 3e-3}};
  for (const Case& c : cases) {
    const Discretisation space = discretise(c.shape, {.cells_per_edge = 3, .degree = 4});
    const SurfacePoints points = space.quadrature_points(7);
    const TwoSources& exact = c.sources;
    PotentialProblem problem = exact.problem();
    const PotentialTraces traces = solve_potential(space, problem).on_surface(points);
    const auto charge = [&](const Vector3& x, const Vector3& n) { return exact.charge(x, n); };
    const auto force = [&](const Vector3& x, const Vector3& n) { return exact.force(x, n); };
    BOOST_TEST(relative_l2(points, traces.charge, sampled(points, charge)) < c.charge);
    BOOST_TEST(relative_l2(points, traces.charge_from_gradient, sampled(points, charge)) < c.charge);
    BOOST_TEST(relative_l2(points, traces.force, sampled_vectors(points, force)) < c.force);

    // Membrane law: one charging step that ends at the exact jump.
    const double dt = 0.2;
    problem.membrane = ChargingMembrane{1.0, 0.0, dt, 1, on_surface([&](const Vector3& x, const Vector3& n) {
                                          return exact.jump(x) + dt * exact.conductivity_in * exact.flux_in(x, n);
                                        })};
    const auto jump = [&](const Vector3& x, const Vector3&) { return exact.jump(x); };
    const PotentialTraces charged = solve_potential(space, problem).on_surface(points);
    BOOST_TEST(relative_l2(points, charged.transmembrane_potential, sampled(points, jump)) < c.voltage);
  }
}

BOOST_AUTO_TEST_CASE(outer_data_may_be_fluxes) {
  const Discretisation space = discretise(unit_sphere(), {.degree = 4});
  const TwoSources exact = sources_of_shape_33();
  PotentialProblem problem = exact.problem();
  problem.membrane = ChargingMembrane{1.0, 0.0, 0.2, 1, on_surface([&](const Vector3& x, const Vector3& n) {
                                        return exact.jump(x) + 0.2 * exact.conductivity_in * exact.flux_in(x, n);
                                      })};
  problem.outer.kind = OuterCondition::Kind::neumann;
  problem.outer.value = [&](const Vector3& x) { return exact.outer_field.gradient(x).dot(x.normalized()); };
  const SurfacePoints points = space.quadrature_points(7);
  const PotentialSolution solution = solve_potential(space, problem);
  const Vector charge = sampled(points, [&](const Vector3& x, const Vector3& n) { return exact.charge(x, n); });
  BOOST_TEST(relative_l2(points, solution.on_surface(points).charge, charge) < 1e-3);
}

BOOST_AUTO_TEST_CASE(input_out_of_range_is_refused) {
  const Discretisation space = discretise(unit_sphere(), {.degree = 2});
  PotentialProblem problem;
  problem.conductivity_in = 0.0;
  BOOST_CHECK_THROW(solve_potential(space, problem), std::invalid_argument);
  problem.conductivity_in = 1.0;
  problem.membrane = SteadyMembrane{-1.0, 0.0};
  BOOST_CHECK_THROW(solve_potential(space, problem), std::invalid_argument);
  BOOST_CHECK_THROW(discretise(unit_sphere(), {.degree = 11}), std::invalid_argument);
  BOOST_CHECK_THROW(static_cast<void>(space.locate(Vector3(9.0, 0.0, 0.0))), LocationError);
}

BOOST_AUTO_TEST_SUITE_END()
