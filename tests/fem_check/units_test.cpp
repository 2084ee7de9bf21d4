#include <boost/test/unit_test.hpp>

#include "tests/fem_check/cases.hpp"

using namespace vehd::fem_check;
using namespace vehd::fem_check::testing;

/// The same problem in other units of length, potential, conductivity, viscosity and force has the same solution in
/// these units, up to the error of the linear solver.
BOOST_AUTO_TEST_SUITE(units)

namespace {

constexpr double kSame = 1e-8;

vehd::meshes::FrozenShape prolate_in_units_of(double length) {
  return vehd::meshes::FrozenShape(shapes::project(
      1, [&](const Vector3& r) { return Vector3(length * Vector3(r.x() + 0.2, r.y() - 0.1, 2.0 * r.z() + 0.3)); }));
}

Discretisation space_in_units_of(double length) {
  return discretise(prolate_in_units_of(length), {.degree = 3, .outer_radius = 8.0 * length});
}

/// The same problem in units of length, potential and conductivity.
PotentialProblem electric_problem(double length, double potential, double conductivity) {
  PotentialProblem problem;
  problem.field = potential / length * Vector3(0.3, 0.2, 1.0);
  problem.conductivity_in = 3.0 * conductivity;
  problem.conductivity_out = conductivity;
  return problem;
}

struct Units {
  double length, potential, conductivity;
};
constexpr Units kOdd[] = {{1e-5, 1.0, 1.0}, {1e5, 1.0, 1.0}, {1.0, 1e-7, 1.0}, {1.0, 1.0, 1e-9}, {1e-6, 0.05, 1e9}};

}  // namespace

BOOST_AUTO_TEST_CASE(potential_is_the_same_in_all_units) {
  const auto traces_in = [](const Units& u) {
    const Discretisation space = space_in_units_of(u.length);
    const SurfacePoints points = space.quadrature_points(4);
    std::vector<PotentialTraces> results;
    PotentialProblem problem = electric_problem(u.length, u.potential, u.conductivity);
    const MembraneCondition membranes[] = {
        PrescribedJump{
            on_surface([&](const Vector3& x, const Vector3&) { return u.potential * 0.2 * x.z() / u.length; })},
        SteadyMembrane{5.0 * u.conductivity / u.length, 0.0}, SteadyMembrane{0.0, 0.3 * u.potential},
        ChargedMembrane{2.0 * u.conductivity / u.length, on_surface([&](const Vector3& x, const Vector3&) {
                          return 0.2 * u.conductivity * u.potential / u.length * x.x() / u.length;
                        })}};
    for (const auto& membrane : membranes) {
      problem.membrane = membrane;
      PotentialTraces traces = solve_potential(space, problem).on_surface(points);
      const double field = u.potential / u.length;
      traces.transmembrane_potential /= u.potential;
      traces.charge /= field;
      traces.flux_in /= field;
      traces.force /= field * field;
      results.push_back(traces);
    }
    return results;
  };
  const std::vector<PotentialTraces> one = traces_in({1.0, 1.0, 1.0});
  for (const Units& units : kOdd) {
    const std::vector<PotentialTraces> other = traces_in(units);
    for (std::size_t i = 0; i < one.size(); ++i) {
      BOOST_TEST_CONTEXT("membrane " << i << ", length " << units.length << ", potential " << units.potential
                                     << ", conductivity " << units.conductivity) {
        BOOST_TEST(relative_max(other[i].transmembrane_potential, one[i].transmembrane_potential) < kSame);
        BOOST_TEST(relative_max(other[i].force, one[i].force) < kSame);
        // Without conductance the flux vanishes, so there is no reference value.
        if (i < 2) BOOST_TEST(relative_max(other[i].charge, one[i].charge) < kSame);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(flow_is_the_same_in_all_units) {
  // Length, viscosity, force per area.
  const auto velocity_in = [](double length, double viscosity, double force) {
    const Discretisation space = space_in_units_of(length);
    FlowProblem problem;
    problem.viscosity_in = 2.0 * viscosity;
    problem.viscosity_out = viscosity;
    problem.gradient = force / viscosity * 0.1 * Vector3(1.0, 1.0, -2.0).asDiagonal().toDenseMatrix();
    problem.force = vectors_on_surface([&](const Vector3& x, const Vector3& n) {
      return Vector3(force * (x.z() / length * n + Vector3(0.1, x.x() * x.y() / (length * length), 0.0)));
    });
    const FlowSolution solution = solve_flow(space, problem);
    return std::pair(Vectors(solution.on_surface(space.quadrature_points(4)).velocity * viscosity / (force * length)),
                     Vector(solution.pressure(space.locate(length * Vectors(Vector3(0.3, 0.1, 0.4)))) / force));
  };
  const auto [velocity, pressure] = velocity_in(1.0, 1.0, 1.0);
  const double odd[][3] = {{1e-5, 1.0, 1.0}, {1e5, 1.0, 1.0}, {1.0, 1e-3, 1.0}, {1.0, 1e6, 1.0}, {1e-6, 1e-3, 1e-2}};
  for (const auto& [length, viscosity, force] : odd) {
    const auto [other, other_pressure] = velocity_in(length, viscosity, force);
    BOOST_TEST_CONTEXT("length " << length << ", viscosity " << viscosity << ", force " << force) {
      BOOST_TEST(relative_max(other, velocity) < kSame);
      BOOST_TEST(relative_max(other_pressure, pressure) < kSame);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
