#include <boost/test/unit_test.hpp>

#include "tests/fem_check/cases.hpp"

using namespace vehd::fem_check;
using namespace vehd::fem_check::testing;

namespace {

enum class Family { growing, decaying, toroidal };  // ∇Y − (n+1) Y r̂, ∇Y + n Y r̂, r̂ × ∇Y

/// Vector harmonics of degree 1 and 2 on the unit sphere, Y = c·x and Y = x·A x.
struct Mode {
  Family family;
  int degree;

  static Matrix3 quadratic() {
    Matrix3 a;
    a << 0.3, 0.5, -0.2, 0.5, 0.1, 0.4, -0.2, 0.4, -0.4;
    return a;
  }
  [[nodiscard]] Vector3 operator()(const Vector3& x, const Vector3&) const {
    const Vector3 linear(0.3, -0.4, 1.0);
    const double y = degree == 1 ? linear.dot(x) : x.dot(quadratic() * x);
    const Vector3 ambient = degree == 1 ? linear : Vector3(2.0 * quadratic() * x);
    const Vector3 gradient = ambient - x.dot(ambient) * x;
    if (family == Family::growing) return gradient - (degree + 1) * y * x;
    if (family == Family::decaying) return gradient + degree * y * x;
    return x.cross(gradient);
  }
  /// Eigenvalue of the single layer at μ = 1.
  [[nodiscard]] double eigenvalue() const {
    const double n = degree;
    if (family == Family::growing) return n / ((2.0 * n + 1.0) * (2.0 * n + 3.0));
    if (family == Family::decaying) return (n + 1.0) / ((2.0 * n + 1.0) * (2.0 * n - 1.0));
    return 1.0 / (2.0 * n + 1.0);
  }
};

}  // namespace

BOOST_AUTO_TEST_SUITE(exact_flow)

BOOST_AUTO_TEST_CASE(single_layer_of_the_sphere_has_the_eigenvalues_of_the_vector_harmonics) {
  // Degree 1 includes a net force (decaying) and a net torque (toroidal).
  const Discretisation space = discretise(unit_sphere(), {.degree = 3});
  const SurfacePoints points = space.quadrature_points(6);
  for (const int degree : {1, 2}) {
    for (const Family family : {Family::growing, Family::decaying, Family::toroidal}) {
      const Mode mode{family, degree};
      FlowProblem problem;
      problem.force = vectors_on_surface(mode);
      const FlowTraces traces = solve_flow(space, problem).on_surface(points);
      const Vectors exact = mode.eigenvalue() * sampled_vectors(points, mode);
      BOOST_TEST_CONTEXT("degree " << degree << ", family " << static_cast<int>(family)) {
        BOOST_TEST(relative_l2(points, traces.velocity, exact) < 1e-2);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(velocity_gains_degree_plus_one) {
  const Mode mode{Family::growing, 2};
  std::vector<double> errors;
  for (const int n : {1, 2, 3}) {
    const Discretisation space = discretise(
        unit_sphere(), {.cells_per_edge = n, .blend_layers = n, .shell_layers = 2 * n, .degree = 3, .outer_radius = 4});
    const SurfacePoints points = space.quadrature_points(6);
    FlowProblem problem;
    problem.force = vectors_on_surface(mode);
    const Vectors exact = mode.eigenvalue() * sampled_vectors(points, mode);
    errors.push_back(relative_l2(points, solve_flow(space, problem).on_surface(points).velocity, exact));
  }
  BOOST_TEST(errors[1] < errors[0]);
  BOOST_TEST(observed_order(errors[0], errors[2], 3.0) > 3.0);
}

BOOST_AUTO_TEST_CASE(toroidal_flow_divides_the_force_between_the_two_viscosities) {
  // Traction per velocity: μ_i (n − 1) inside, −μ_e (n + 2) outside.
  const Discretisation space = discretise(unit_sphere(), {.degree = 3});
  const SurfacePoints points = space.quadrature_points(6);
  const Mode mode{Family::toroidal, 2};
  for (const auto& [inside, outside] : {std::pair{5.0, 1.0}, std::pair{1.0, 5.0}}) {
    FlowProblem problem;
    problem.force = vectors_on_surface(mode);
    problem.viscosity_in = inside;
    problem.viscosity_out = outside;
    const Vectors exact = sampled_vectors(points, mode) / (inside + 4.0 * outside);
    BOOST_TEST(relative_l2(points, solve_flow(space, problem).on_surface(points).velocity, exact) < 1e-2);
  }
}

BOOST_AUTO_TEST_CASE(drop_without_tension_strains_as_the_inclusion_formula_says) {
  // A sphere transmitting the full traction: the rate of strain inside is 5 μ_e/(3 μ_e + 2 μ_i) of that far away.
  const Discretisation space = discretise(unit_sphere(), {.degree = 3});
  Vectors sample(3, 3);
  sample << 0.1, 0.5, -0.3, 0.2, -0.4, 0.6, 0.3, 0.2, 0.1;
  for (const auto& [inside, outside] : {std::pair{6.0, 1.0}, std::pair{1.0, 6.0}}) {
    FlowProblem problem;
    problem.force = vectors_on_surface([](const Vector3&, const Vector3&) { return Vector3(Vector3::Zero()); });
    problem.gradient = Mode::quadratic();
    problem.viscosity_in = inside;
    problem.viscosity_out = outside;
    const Vectors velocity = solve_flow(space, problem).velocity(space.locate(sample));
    const Vectors exact = 5.0 * outside / (3.0 * outside + 2.0 * inside) * Mode::quadratic() * sample;
    BOOST_TEST((velocity - exact).norm() < 1e-2 * exact.norm());
  }
}

BOOST_AUTO_TEST_CASE(normal_force_of_one_is_a_pressure_inside_and_no_flow) {
  // [[−p n]] = n holds for every shape.
  const Discretisation space = discretise(shapes::shape_33(), {.degree = 3});
  const SurfacePoints points = space.quadrature_points(6);
  FlowProblem problem;
  problem.force = [](const SurfacePoints& p) { return p.normal; };
  const FlowSolution solution = solve_flow(space, problem);
  BOOST_TEST(solution.on_surface(points).velocity.cwiseAbs().maxCoeff() < 1e-3);
  Vectors sample(3, 2);
  sample << 0.1, 1.5, 0.2, 1.5, -0.3, 2.0;
  const Vector pressure = solution.pressure(space.locate(sample));
  BOOST_TEST(std::abs(pressure[0] + 1.0) < 1e-2);
  BOOST_TEST(std::abs(pressure[1]) < 1e-3);
}

BOOST_AUTO_TEST_CASE(divergence_on_the_membrane_is_that_of_the_background_flow_alone) {
  const Discretisation space = discretise(shapes::prolate(), {.degree = 3});
  const SurfacePoints points = space.quadrature_points(6);
  FlowProblem problem;
  problem.gradient = Mode::quadratic();
  problem.force = vectors_on_surface([](const Vector3&, const Vector3&) { return Vector3(Vector3::Zero()); });
  const FlowTraces traces = solve_flow(space, problem).on_surface(points);
  const Vector exact = sampled(points, [](const Vector3&, const Vector3& n) { return -n.dot(Mode::quadratic() * n); });
  BOOST_TEST((traces.divergence - exact).cwiseAbs().maxCoeff() < 1e-10);
  BOOST_TEST((traces.velocity - Mode::quadratic() * points.position).cwiseAbs().maxCoeff() < 1e-10);
}

BOOST_AUTO_TEST_CASE(operators_serve_every_problem_of_their_viscosities) {
  const Discretisation space = discretise(shapes::prolate(), {.cells_per_edge = 1, .shell_layers = 2, .degree = 3});
  const SurfacePoints points = space.quadrature_points(5);
  const FlowOperators operators(space, 3.0, 1.0);
  FlowProblem problem;
  problem.viscosity_in = 3.0;
  problem.gradient = Mode::quadratic();
  problem.force = vectors_on_surface([](const Vector3& x, const Vector3&) { return Vector3(x.z(), x.x(), 0.3); });
  double apart = 0.0;
  Vectors before;
  for (const int exterior_degree : {usual_exterior_degree, 2}) {
    problem.exterior_degree = exterior_degree;
    const Vectors shared = solve_flow(operators, problem).on_surface(points).velocity;
    const Vectors own = solve_flow(space, problem).on_surface(points).velocity;
    BOOST_TEST((shared - own).cwiseAbs().maxCoeff() < 1e-9 * own.cwiseAbs().maxCoeff());
    if (before.size() > 0) apart = (shared - before).norm() / before.norm();
    before = shared;
  }
  BOOST_TEST(apart > 1e-8);
  problem.viscosity_in = 2.0;
  BOOST_CHECK_THROW(solve_flow(operators, problem), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(input_out_of_range_is_refused) {
  FlowProblem problem;
  problem.force = vectors_on_surface([](const Vector3&, const Vector3&) { return Vector3(Vector3::Zero()); });
  BOOST_CHECK_THROW(solve_flow(discretise(unit_sphere(), {.degree = 1}), problem), std::invalid_argument);
  const Discretisation space = discretise(unit_sphere(), {.degree = 2});
  problem.gradient = Matrix3::Identity();
  BOOST_CHECK_THROW(solve_flow(space, problem), std::invalid_argument);
  problem.gradient.setZero();
  problem.viscosity_in = -1.0;
  BOOST_CHECK_THROW(solve_flow(space, problem), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
