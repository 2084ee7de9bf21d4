#include "fem_check/inextensible_flow.hpp"

#include <boost/test/unit_test.hpp>

#include "fem_check/bending.hpp"
#include "tests/fem_check/cases.hpp"

using namespace vehd::fem_check;
using namespace vehd::fem_check::testing;

BOOST_AUTO_TEST_SUITE(inextensible_flow)

namespace {

VectorOnSurface no_force() {
  return vectors_on_surface([](const Vector3&, const Vector3&) { return Vector3(Vector3::Zero()); });
}

Matrix3 general_gradient() {
  Matrix3 a;
  a << 0.3, 0.9, -0.2, 0.1, -0.5, 0.4, -0.6, 0.3, 0.2;
  return a;
}

/// Unit sphere in v = A x. With Y = x·Ex, E the strain: the flow drives ½ W and the tension τ μ_e Y drives V and W,
/// V = ∇Y − 3Y n, W = ∇Y + 2Y n. Eigenvalues of the layers at degree 2 (docs/conventions.md) and of the map of
/// viscosity contrast; without expansion the velocity is α (V − 6W).
struct InextensibleSphere {
  Matrix3 gradient;
  double ratio;  ///< μ_i/μ_e

  [[nodiscard]] double on_v() const { return 8.0 / 175.0 / (0.5 * (1.0 + ratio) - (1.0 - ratio) * 3.0 / 70.0); }
  [[nodiscard]] double map_of_w() const { return 0.5 * (1.0 + ratio) + (1.0 - ratio) / 10.0; }
  [[nodiscard]] double tension_factor() const { return -0.5 / map_of_w() / (6.0 * on_v() + 1.0 / 25.0 / map_of_w()); }
  [[nodiscard]] Matrix3 strain() const { return 0.5 * (gradient + gradient.transpose()); }
  [[nodiscard]] double tension(const Vector3& x) const { return tension_factor() * x.dot(strain() * x); }
  [[nodiscard]] Vector3 velocity(const Vector3& x) const {
    const double y = x.dot(strain() * x);
    const Vector3 slope = 2.0 * (strain() * x - y * x);
    return (gradient - strain()) * x + on_v() * tension_factor() * (slope - 3.0 * y * x - 6.0 * (slope + 2.0 * y * x));
  }
};

struct Errors {
  double velocity, tension, divergence;
};

Errors sphere_errors(const Discretisation& space, double ratio) {
  const InextensibleSphere exact{general_gradient(), ratio};
  FlowProblem problem;
  problem.force = no_force();
  problem.gradient = exact.gradient;
  problem.viscosity_in = 1.7 * ratio;
  problem.viscosity_out = 1.7;
  problem.tolerance = 1e-8;
  const SurfacePoints points = space.quadrature_points(6);
  const InextensibleFlow found = solve_inextensible_flow(space, problem);
  BOOST_TEST(!found.constant_is_determined());
  const FlowTraces traces = found.flow().on_surface(points);
  const Vectors velocity = sampled_vectors(points, [&](const Vector3& x, const Vector3&) { return exact.velocity(x); });
  const Vector tension = 1.7 * sampled(points, [&](const Vector3& x, const Vector3&) { return exact.tension(x); });
  return {relative_l2(points, traces.velocity, velocity), relative_l2(points, found.tension(points), tension),
          std::sqrt(points.weight.dot(traces.divergence.cwiseAbs2()) / points.weight.sum())};
}

}  // namespace

BOOST_AUTO_TEST_CASE(sphere_in_a_linear_flow_has_the_exact_velocity_and_tension) {
  const Discretisation space = discretise(unit_sphere(), {.shell_layers = 3, .degree = 3});
  for (const double ratio : {1.0, 0.2, 5.0}) {
    BOOST_TEST_CONTEXT("viscosity ratio " << ratio) {
      const Errors errors = sphere_errors(space, ratio);
      BOOST_TEST_MESSAGE(ratio << ": v " << errors.velocity << ", tension " << errors.tension << ", divergence "
                               << errors.divergence);
      BOOST_TEST(errors.velocity < 1e-2);
      BOOST_TEST(errors.tension < 2e-2);
      BOOST_TEST(errors.divergence < 5e-2);
    }
  }
}

BOOST_AUTO_TEST_CASE(velocity_and_tension_converge_with_the_mesh) {
  std::vector<Errors> errors;
  for (const int n : {1, 2, 3}) {
    errors.push_back(sphere_errors(
        discretise(unit_sphere(),
                   {.cells_per_edge = n, .blend_layers = n, .shell_layers = 2 * n, .degree = 3, .outer_radius = 4}),
        1.0));
  }
  BOOST_TEST_MESSAGE("velocity " << errors[0].velocity << " " << errors[1].velocity << " " << errors[2].velocity
                                 << ", tension " << errors[0].tension << " " << errors[1].tension << " "
                                 << errors[2].tension);
  BOOST_TEST(observed_order(errors[0].velocity, errors[2].velocity, 3.0) > 2.0);
  BOOST_TEST(observed_order(errors[0].tension, errors[2].tension, 3.0) > 2.0);
}

BOOST_AUTO_TEST_CASE(traction_of_a_translating_ellipsoid_moves_it_without_tension) {
  // A translating rigid ellipsoid exerts a traction (n·x) times a constant vector on the fluid: the membrane carries no
  // tension, so λ = 0, its mean included.
  const Discretisation space = discretise(shapes::prolate(), {.shell_layers = 3, .degree = 4});
  const SurfacePoints points = space.quadrature_points(6);
  FlowProblem problem;
  problem.tolerance = 1e-7;
  const Vector3 direction(0.3, -0.2, 1.0);
  problem.force = vectors_on_surface([&](const Vector3& x, const Vector3& n) { return Vector3(n.dot(x) * direction); });
  const InextensibleFlow found = solve_inextensible_flow(space, problem);
  BOOST_TEST(found.constant_is_determined());
  const Vectors velocity = found.flow().on_surface(points).velocity;
  const Vector3 mean = velocity * points.weight / points.weight.sum();
  BOOST_TEST((velocity.colwise() - mean).cwiseAbs().maxCoeff() < 1e-2 * mean.norm());
  BOOST_TEST(found.tension(points).cwiseAbs().maxCoeff() < 2e-2 * direction.norm());
}

BOOST_AUTO_TEST_CASE(tension_balances_a_force_of_tension_and_nothing_moves) {
  // f = −(2λHn + ∇_γλ) for a given λ, its constant included. Principal curvatures of the prolate with axes 1, 1, 2:
  // 2/g^(3/2) and 2/g^(1/2), g = 4 − 3 (z/2)².
  const Discretisation space = discretise(shapes::prolate(), {.shell_layers = 3, .degree = 4});
  const SurfacePoints points = space.quadrature_points(6);
  const auto tension = [](const Vector3& x) { return 0.8 + 0.3 * x.z() - 0.2 * x.x() * x.y(); };
  FlowProblem problem;
  problem.tolerance = 1e-7;
  problem.force = vectors_on_surface([&](const Vector3& x, const Vector3& n) {
    const double g = 4.0 - 0.75 * x.z() * x.z();
    const double twice_mean = -(2.0 * std::pow(g, -1.5) + 2.0 * std::pow(g, -0.5));
    const Vector3 slope(-0.2 * x.y(), -0.2 * x.x(), 0.3);
    return Vector3(-tension(x) * twice_mean * n - (slope - slope.dot(n) * n));
  });
  const InextensibleFlow found = solve_inextensible_flow(space, problem);
  const Vector exact = sampled(points, [&](const Vector3& x, const Vector3&) { return tension(x); });
  BOOST_TEST_MESSAGE("tension " << relative_l2(points, found.tension(points), exact) << " force "
                                << relative_l2(points, found.tension_force(points), -problem.force(points)));
  BOOST_TEST(relative_l2(points, found.tension(points), exact) < 5e-3);
  BOOST_TEST(found.flow().on_surface(points).velocity.cwiseAbs().maxCoeff() < 1e-3);
  BOOST_TEST(relative_l2(points, found.tension_force(points), -problem.force(points)) < 5e-2);
}

BOOST_AUTO_TEST_CASE(tension_of_a_nearly_round_membrane_is_as_precise_as_the_tolerance) {
  // A constant tension hardly moves this shape, so its error from the initial guess leaves only a small residual.
  const meshes::FrozenShape shape(
      shapes::project(1, [](const meshes::Point& r) { return meshes::Point(r.x(), 1.1 * r.y(), 1.25 * r.z()); }));
  OneMesh level{.cells_per_edge = 2, .shell_layers = 2, .degree = 3, .outer_radius = 4.0};
  const Discretisation coarse = discretise(shape, level);
  level.degree = 5;
  const Discretisation fine = discretise(shape, level);
  const SurfacePoints points = fine.quadrature_points(6);
  FlowProblem problem;
  problem.force = bending_force(fine, {0.1, -0.3}, 9);
  problem.gradient(0, 2) = 1.0;
  const Vector exact = solve_inextensible_flow(fine, problem).tension(points);
  for (const double tolerance : {1e-5, 3e-6, 4e-7}) {
    problem.tolerance = tolerance;
    const InextensibleFlow start = solve_inextensible_flow(coarse, problem);
    const double error = relative_l2(points, solve_inextensible_flow(fine, problem, &start).tension(points), exact);
    BOOST_TEST_MESSAGE(tolerance << ": " << error);
    BOOST_TEST(error < 5.0 * tolerance);
  }
}

BOOST_AUTO_TEST_CASE(units_change_nothing_but_the_units) {
  const double length = 3.0, viscosity = 0.1;
  const auto scaled = [&](double l, double mu, double rate) {
    meshes::BlockMeshOptions options;
    options.cells_per_edge = 1;
    options.blend_layers = 1;
    options.shell_layers = 2;
    options.outer_radius = 8.0 * l;
    const meshes::FrozenShape shape(
        l * shapes::project(1, [](const meshes::Point& r) { return meshes::Point(r.x(), r.y(), 2.0 * r.z()); }));
    const Discretisation space(std::make_shared<meshes::HexMesh>(meshes::make_block_mesh(shape, options)), 3);
    FlowProblem problem;
    problem.force = no_force();
    problem.gradient = rate * general_gradient();
    problem.viscosity_in = 2.0 * mu;
    problem.viscosity_out = mu;
    return solve_inextensible_flow(space, problem).tension(space.quadrature_points(4));
  };
  const Vector one = scaled(1.0, 1.0, 1.0);
  const Vector other = scaled(length, viscosity, 50.0) / (viscosity * 50.0 * length);
  BOOST_TEST((one - other).norm() < 1e-6 * one.norm());
}

BOOST_AUTO_TEST_SUITE_END()

/// CTest also runs this suite on two ranks.
BOOST_AUTO_TEST_SUITE(parallel)

BOOST_AUTO_TEST_CASE(ranks_together_solve_the_inextensible_flow_as_one_alone) {
  const OneMesh level{.cells_per_edge = 1, .shell_layers = 2, .degree = 3};
  const Discretisation together = discretise(shapes::prolate(), level);
  const Discretisation alone = discretise(shapes::prolate(), level, Ranks::each_alone);
  const SurfacePoints points = alone.quadrature_points(5);
  FlowProblem problem;
  problem.force = bending_force(alone, {0.1, 0.2}, 6);
  problem.gradient(0, 2) = 1.0;
  problem.viscosity_in = 3.0;
  const InextensibleFlow a = solve_inextensible_flow(together, problem);
  const InextensibleFlow b = solve_inextensible_flow(alone, problem);
  BOOST_TEST(relative_l2(points, a.tension(points), b.tension(points)) < 1e-7);
  BOOST_TEST(relative_l2(points, a.flow().on_surface(points).velocity, b.flow().on_surface(points).velocity) < 1e-7);
}

BOOST_AUTO_TEST_SUITE_END()
