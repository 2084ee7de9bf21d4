#include <boost/test/unit_test.hpp>

#include "tests/fem_check/cases.hpp"

using namespace vehd::fem_check;
using namespace vehd::fem_check::testing;

namespace {

struct Errors {
  double potential, voltage, flux, flux_from_gradient;
};

Errors errors_on_sphere(const OneMesh& level) {
  const Discretisation space = discretise(unit_sphere(), level);
  const SurfacePoints points = space.quadrature_points(level.degree + 3);
  const TwoSources exact = {{{1.5, -1.2, 3.0}, 10.0}, {{0.1, 0.2, -0.1}, 1.0}};
  PotentialProblem problem = exact.problem();
  const double dt = 0.2;
  problem.membrane = ChargingMembrane{1.0, 0.0, dt, 1, on_surface([&](const Vector3& x, const Vector3& n) {
                                        return exact.jump(x) + dt * exact.conductivity_in * exact.flux_in(x, n);
                                      })};
  const PotentialSolution solution = solve_potential(space, problem);
  const PotentialTraces traces = solution.on_surface(points);
  const Vector flux = sampled(points, [&](const Vector3& x, const Vector3& n) { return exact.flux_in(x, n); });
  const Vector jump = sampled(points, [&](const Vector3& x, const Vector3&) { return exact.jump(x); });
  const VolumePoints lattice = space.volume_lattice(3);
  Vector potential(lattice.size());
  for (Eigen::Index i = 0; i < lattice.size(); ++i) {
    const PointSource& source = lattice.inside[i] ? exact.inner_field : exact.outer_field;
    potential[i] = source.value(lattice.position.col(i));
  }
  return {(solution.potential(lattice) - potential).norm() / potential.norm(),
          relative_l2(points, traces.transmembrane_potential, jump), relative_l2(points, traces.flux_in, flux),
          relative_l2(points, traces.flux_in_from_gradient, flux)};
}

}  // namespace

BOOST_AUTO_TEST_SUITE(convergence, *boost::unit_test::label("slow"))

BOOST_AUTO_TEST_CASE(potential_gains_degree_plus_one_and_flux_degree) {
  // Three levels with layers in proportion to the cells per edge.
  for (const int degree : {2, 3}) {
    std::vector<Errors> errors;
    for (const int n : {2, 4, 6}) {
      errors.push_back(errors_on_sphere(
          {.cells_per_edge = n, .blend_layers = n / 2, .shell_layers = 2 * n, .degree = degree, .outer_radius = 4.0}));
    }
    const auto order = [&](double Errors::*field) { return observed_order(errors[0].*field, errors[2].*field, 3.0); };
    BOOST_TEST_CONTEXT("degree " << degree) {
      BOOST_TEST(order(&Errors::potential) > degree + 0.6);
      BOOST_TEST(order(&Errors::voltage) > degree + 0.6);
      BOOST_TEST(order(&Errors::flux) > degree - 0.2);
      BOOST_TEST(order(&Errors::flux_from_gradient) > degree - 0.2);
      BOOST_TEST(errors[1].voltage < errors[0].voltage);
      BOOST_TEST(errors[2].voltage < errors[1].voltage);
    }
  }
}

BOOST_AUTO_TEST_CASE(raising_the_degree_converges_exponentially) {
  std::vector<double> errors;
  for (const int degree : {2, 3, 4, 5}) {
    errors.push_back(errors_on_sphere({.degree = degree, .outer_radius = 4.0}).voltage);
  }
  for (std::size_t i = 1; i < errors.size(); ++i) BOOST_TEST(errors[i] < 0.35 * errors[i - 1]);
}

BOOST_AUTO_TEST_SUITE_END()
