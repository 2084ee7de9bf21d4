#include <boost/test/unit_test.hpp>

#include "meshes/box_mesh.hpp"
#include "tests/fem_check/cases.hpp"

using namespace vehd::fem_check;
using namespace vehd::fem_check::testing;

/// CTest runs this suite under mpirun with two and four ranks: the collective result must equal that of a single rank.
BOOST_AUTO_TEST_SUITE(parallel)

BOOST_AUTO_TEST_CASE(ranks_together_solve_the_potential_as_one_alone) {
  PotentialProblem problem;
  problem.field = {0.3, 0.2, 1.0};
  problem.conductivity_out = 2.0;
  const MembraneCondition membranes[] = {
      PrescribedJump{on_surface([](const Vector3& x, const Vector3&) { return 0.2 * x.z(); })},
      SteadyMembrane{5.0, 0.0}, SteadyMembrane{0.0, 0.3}};
  const OneMesh level{.degree = 3};
  const Discretisation together = discretise(shapes::shape_33(), level);
  const Discretisation alone = discretise(shapes::shape_33(), level, Ranks::each_alone);
  const SurfacePoints points = alone.quadrature_points(5);
  for (const auto& membrane : membranes) {
    problem.membrane = membrane;
    const PotentialTraces a = solve_potential(together, problem).on_surface(points);
    const PotentialTraces b = solve_potential(alone, problem).on_surface(points);
    BOOST_TEST(relative_l2(points, a.transmembrane_potential, b.transmembrane_potential) < 1e-8);
    BOOST_TEST((a.flux_in - b.flux_in).cwiseAbs().maxCoeff() < 1e-8);
    BOOST_TEST(relative_l2(points, a.force, b.force) < 1e-8);
  }
}

BOOST_AUTO_TEST_CASE(ranks_together_solve_the_flow_as_one_alone) {
  FlowProblem problem;
  problem.force = vectors_on_surface(
      [](const Vector3& x, const Vector3& n) { return Vector3(x.z() * n + Vector3(0.1, x.x() * x.y(), 0.0)); });
  const OneMesh level{.degree = 3};
  const Discretisation together = discretise(shapes::prolate(), level);
  const Discretisation alone = discretise(shapes::prolate(), level, Ranks::each_alone);
  const SurfacePoints points = alone.quadrature_points(5);
  for (const double inside : {1.0, 4.0}) {
    problem.viscosity_in = inside;
    const FlowTraces a = solve_flow(together, problem).on_surface(points);
    const FlowTraces b = solve_flow(alone, problem).on_surface(points);
    BOOST_TEST(relative_l2(points, a.velocity, b.velocity) < 1e-7);
  }
}

BOOST_AUTO_TEST_CASE(ranks_together_solve_the_flow_beside_a_wall_as_one_alone) {
  FlowProblem problem;
  problem.force = vectors_on_surface([](const Vector3& x, const Vector3& n) { return Vector3(x.z() * n); });
  problem.viscosity_in = 0.5;
  meshes::BoxMeshOptions options;
  options.cells_per_edge = 2;
  const Vector3 normal = Vector3(1.0, -2.0, 0.5).normalized();
  const auto mesh =
      std::make_shared<meshes::BoxMesh>(meshes::make_mesh_beside_wall(unit_sphere(), {-1.4 * normal, normal}, options));
  const Discretisation together(mesh, 3), alone(mesh, 3, Ranks::each_alone);
  const SurfacePoints points = alone.quadrature_points(5);
  for (const WallFlow wall : {WallFlow::no_slip, WallFlow::stress_free}) {
    problem.wall = wall;
    const FlowTraces a = solve_flow(together, problem).on_surface(points);
    const FlowTraces b = solve_flow(alone, problem).on_surface(points);
    BOOST_TEST(relative_l2(points, a.velocity, b.velocity) < 1e-7);
  }
}

BOOST_AUTO_TEST_SUITE_END()
