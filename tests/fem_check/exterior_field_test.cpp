#include <boost/test/unit_test.hpp>

#include "meshes/harmonic_series.hpp"
#include "tests/fem_check/cases.hpp"

using namespace vehd::fem_check;
using namespace vehd::fem_check::testing;

BOOST_AUTO_TEST_SUITE(exterior_field)

namespace {

/// Outer spheres so close that errors of their boundary condition are visible.
constexpr double close_radius = 1.6;

/// One generic harmonic of each degree: Y and its gradient on the unit sphere.
class Harmonic {
 public:
  explicit Harmonic(int degree) : series_(coefficients(degree)) {}

  [[nodiscard]] double value(const Vector3& direction) const { return series_.value(direction)[0]; }
  [[nodiscard]] Vector3 gradient(const Vector3& direction) const {
    return series_.gradient(direction).row(0).transpose();
  }

 private:
  [[nodiscard]] static Eigen::MatrixXd coefficients(int degree) {
    const Eigen::Index first = Eigen::Index{degree} * degree, n = 2 * Eigen::Index{degree} + 1;
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(first + n, 1);
    for (Eigen::Index i = 0; i < n; ++i) result(first + i, 0) = 1.0 - 0.3 * static_cast<double>(i);
    return result;
  }

  vehd::meshes::HarmonicSeries series_;
};

/// A force on the unit sphere, and the ratio of velocity to force at equal viscosities 1.
struct Mode {
  Vector3 force;
  double eigenvalue;
};

std::array<Mode, 3> modes_at(const Harmonic& harmonic, int degree, const Vector3& x) {
  const double n = degree, y = harmonic.value(x);
  const Vector3 gradient = harmonic.gradient(x);
  return {Mode{gradient - (n + 1.0) * y * x, n / ((2.0 * n + 1.0) * (2.0 * n + 3.0))},
          Mode{gradient + n * y * x, (n + 1.0) / ((2.0 * n + 1.0) * (2.0 * n - 1.0))},
          Mode{x.cross(gradient), 1.0 / (2.0 * n + 1.0)}};
}

Discretisation close_sphere(int degree, double radius = close_radius) {
  return discretise(unit_sphere(), {.shell_layers = 1, .degree = degree, .outer_radius = radius});
}

/// Largest relative velocity error over all three forces of one degree.
double error_of_flows(const Discretisation& space, int degree, int exterior_degree) {
  const Harmonic harmonic(degree);
  const SurfacePoints points = space.quadrature_points(10);
  double largest = 0.0;
  for (std::size_t family = 0; family < 3; ++family) {
    const auto mode = [&](const Vector3& x) { return modes_at(harmonic, degree, x)[family]; };
    FlowProblem problem;
    problem.force = vectors_on_surface([&](const Vector3& x, const Vector3&) { return mode(x).force; });
    problem.exterior_degree = exterior_degree;
    const Vectors exact = sampled_vectors(
        points, [&](const Vector3& x, const Vector3&) { return Vector3(mode(x).eigenvalue * mode(x).force); });
    largest = std::max(largest, relative_l2(points, solve_flow(space, problem).on_surface(points).velocity, exact));
  }
  return largest;
}

/// Relative error of ∂φ_i/∂n for V_m = Y.
double error_of_flux(const Discretisation& space, int degree, int exterior_degree) {
  const Harmonic harmonic(degree);
  const SurfacePoints points = space.quadrature_points(10);
  const double n = degree;
  PotentialProblem problem;
  problem.conductivity_in = 2.0;
  problem.membrane = PrescribedJump{on_surface([&](const Vector3& x, const Vector3&) { return harmonic.value(x); })};
  problem.exterior_degree = exterior_degree;
  const Vector exact = sampled(points, [&](const Vector3& x, const Vector3&) {
    return n * (n + 1.0) / (2.0 * n + n + 1.0) * harmonic.value(x);
  });
  return relative_l2(points, solve_potential(space, problem).on_surface(points).flux_in, exact);
}

}  // namespace

// Degree 1 includes the flows of a net force and of a net torque.
BOOST_AUTO_TEST_CASE(flows_are_exact_up_to_the_degree_however_close_the_outer_sphere_is) {
  const Discretisation space = close_sphere(5);
  for (const int degree : {1, 2, 3, 4}) {
    BOOST_TEST(error_of_flows(space, degree, 4) < 2e-3, degree);
  }
  for (const int degree : {3, 4}) {
    BOOST_TEST(error_of_flows(space, degree, 2) > 1e-2, degree);
  }
}

BOOST_AUTO_TEST_CASE(flow_outside_of_the_larger_viscosity_is_exact_as_well) {
  const Discretisation space = close_sphere(5);
  const SurfacePoints points = space.quadrature_points(10);
  const Harmonic harmonic(3);
  FlowProblem problem;
  problem.viscosity_out = 5.0;
  problem.force =
      vectors_on_surface([&](const Vector3& x, const Vector3&) { return modes_at(harmonic, 3, x)[2].force; });
  // Traction per velocity: μ_i (n − 1) inside, −μ_e (n + 2) outside.
  const Vectors exact = problem.force(points) / (2.0 + 5.0 * 5.0);
  BOOST_TEST(relative_l2(points, solve_flow(space, problem).on_surface(points).velocity, exact) < 2e-3);
}

BOOST_AUTO_TEST_CASE(potentials_are_exact_up_to_the_degree_however_close_the_outer_sphere_is) {
  const Discretisation space = close_sphere(6);
  for (const int degree : {1, 2, 3, 4}) {
    BOOST_TEST(error_of_flux(space, degree, 4) < 2e-3, degree);
  }
  for (const int degree : {3, 4}) {
    BOOST_TEST(error_of_flux(space, degree, 2) > 5e-3, degree);
  }
}

BOOST_AUTO_TEST_CASE(charge_that_does_not_cancel_has_the_field_of_a_point) {
  const Discretisation space = close_sphere(4);
  PotentialProblem problem;
  problem.conductivity_out = 2.0;
  problem.membrane = PrescribedJump{on_surface([](const Vector3&, const Vector3&) { return 0.0; })};
  problem.current_jump = on_surface([](const Vector3&, const Vector3&) { return 3.0; });
  Vectors sample(3, 2);
  sample << 0.1, 0.7, 0.2, 0.9, -0.3, 0.4;
  const Vector potential = solve_potential(space, problem).potential(space.locate(sample));
  BOOST_TEST(std::abs(potential[0] - 1.5) < 1e-4);
  BOOST_TEST(std::abs(potential[1] - 1.5 / sample.col(1).norm()) < 1e-3);
}

BOOST_AUTO_TEST_CASE(error_of_a_truncated_expansion_falls_with_the_radius) {
  // The prolate without a jump: error against the exact field inside, relative to that with the disturbance set to
  // zero. Only odd harmonics occur, so the next one is two degrees higher.
  const auto error = [](double radius, OuterCondition::Kind kind, int exterior_degree) {
    const Discretisation space =
        discretise(shapes::prolate(), {.cells_per_edge = 3, .shell_layers = 4, .degree = 5, .outer_radius = radius});
    PotentialProblem problem;
    problem.field = {0.0, 0.0, 1.0};
    problem.conductivity_in = 20.0;
    problem.membrane = PrescribedJump{on_surface([](const Vector3&, const Vector3&) { return 0.0; })};
    problem.outer.kind = kind;
    problem.exterior_degree = exterior_degree;
    const Vector value = solve_potential(space, problem).potential(space.locate(Vector3(0.0, 0.0, 0.5)));
    return std::abs(-value[0] / 0.5 * (1.0 + kDepolarisation * 19.0) - 1.0);
  };
  using Kind = OuterCondition::Kind;
  const double near = error(3.0, Kind::exterior_field, 1), far = error(4.5, Kind::exterior_field, 1);
  BOOST_TEST(observed_order(near, far, 1.5) > 5.0);
  const double near_fixed = error(3.0, Kind::dirichlet, 1), far_fixed = error(4.5, Kind::dirichlet, 1);
  BOOST_TEST(std::abs(observed_order(near_fixed, far_fixed, 1.5) - 3.0) < 0.6);
  BOOST_TEST(near < 0.1 * near_fixed);
  BOOST_TEST(error(3.0, Kind::exterior_field, 3) < 0.2 * near);
}

BOOST_AUTO_TEST_SUITE_END()
