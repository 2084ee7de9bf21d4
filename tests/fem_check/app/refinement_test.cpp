#include "fem_check/app/refinement.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numeric>

#include "fem_check/flow.hpp"
#include "meshes/harmonic_series.hpp"
#include "tests/fem_check/cases.hpp"

BOOST_AUTO_TEST_SUITE(refinement)

namespace {

using namespace vehd::fem_check;
using namespace vehd::fem_check::testing;
using vehd::meshes::FrozenShape;
using vehd::meshes::Point;

FrozenShape ellipsoid(double width, double height) {
  return FrozenShape(
      shapes::project(1, [&](const Point& r) { return Point(width * r.x(), width * r.y(), height * r.z()); }));
}

/// A disc bent into a bowl, with a rim as narrow as that of a stomatocyte.
FrozenShape bowl(double thickness) {
  return FrozenShape(shapes::project(5, [&](const Point& r) {
    const Point flat = shapes::disc_point(r);
    return Point(flat.x(), flat.y(), thickness * flat.z() + 0.9 * (1.0 - r.z() * r.z()));
  }));
}

int highest_degree(const Refinement& refinement) { return refinement.flow_degrees.back(); }

}  // namespace

BOOST_AUTO_TEST_CASE(strongly_bent_shapes_have_smaller_cells_and_bowls_higher_degrees) {
  const Refinement usual = Refinement::finest();
  for (const FrozenShape& shape : {shapes::off_centre_sphere(), shapes::prolate(), shapes::shape_33()}) {
    const Refinement found = Refinement::following(shape);
    BOOST_TEST(found.cells_per_edge == usual.cells_per_edge);
    BOOST_TEST(found.shell_layers == usual.shell_layers);
    BOOST_TEST(highest_degree(found) == highest_degree(usual));
  }
  for (const FrozenShape& shape : {ellipsoid(1.0, 5.0), ellipsoid(1.0, 0.2)}) {
    const Refinement found = Refinement::following(shape);
    BOOST_TEST(found.cells_per_edge == 6);
    BOOST_TEST(highest_degree(found) < highest_degree(usual));
  }
  const Refinement of_bowl = Refinement::following(bowl(0.5));
  BOOST_TEST(of_bowl.cells_per_edge == 4);
  BOOST_TEST(of_bowl.shell_layers > usual.shell_layers);
  BOOST_TEST(highest_degree(of_bowl) > highest_degree(Refinement::following(ellipsoid(1.0, 0.2))));
}

BOOST_AUTO_TEST_CASE(quick_checks_have_smaller_cells_in_bowls_only) {
  const Refinement quick = Refinement::quick();
  for (const FrozenShape& shape : {shapes::prolate(), ellipsoid(1.0, 5.0), ellipsoid(1.0, 0.2)}) {
    BOOST_TEST(Refinement::quick_of(shape).cells_per_edge == quick.cells_per_edge);
  }
  const Refinement of_bowl = Refinement::quick_of(bowl(0.5));
  BOOST_TEST(of_bowl.cells_per_edge == Refinement::following(bowl(0.5)).cells_per_edge);
  BOOST_TEST(highest_degree(of_bowl) < highest_degree(Refinement::following(bowl(0.5))));
}

// The mean of Y_n0 over the sphere and its product with another harmonic are zero: a nonzero quadrature result is an
// aliasing error.
BOOST_AUTO_TEST_CASE(points_of_the_comparison_resolve_waves_of_a_degree) {
  const auto mean_of = [](int degree, int points_per_edge, int cells_per_edge) {
    const Discretisation space =
        discretise(unit_sphere(), {.cells_per_edge = cells_per_edge, .shell_layers = 1, .degree = 4});
    const SurfacePoints points = space.quadrature_points(points_per_edge);
    Eigen::MatrixXd coefficients = Eigen::MatrixXd::Zero((degree + 1) * (degree + 1), 1);
    coefficients(degree * degree + degree, 0) = 1.0;
    const vehd::meshes::HarmonicSeries harmonic(coefficients);
    return std::abs(harmonic.values(points.direction).row(0).dot(points.weight));
  };
  Refinement refinement = Refinement::finest();
  refinement.resolve(48);
  BOOST_TEST(refinement.points_per_edge == 12);
  refinement.resolve(96);
  BOOST_TEST(refinement.points_per_edge > 12);
  BOOST_TEST(mean_of(96, refinement.points_per_edge, refinement.cells_per_edge) < 1e-3);
  BOOST_TEST(mean_of(96, 12, refinement.cells_per_edge) > 1e-2);
}

// A force that is a harmonic of degree 40 along one direction has ∫ f dA = 0. Too few quadrature points give a spurious
// net force that drags the sphere along.
BOOST_AUTO_TEST_CASE(given_forces_are_integrated_at_points_that_resolve_their_waves) {
  constexpr int degree = 40;
  Eigen::MatrixXd coefficients = Eigen::MatrixXd::Zero((degree + 1) * (degree + 1), 1);
  coefficients(degree * degree + degree, 0) = 1.0;
  const vehd::meshes::HarmonicSeries harmonic(coefficients);
  FlowProblem problem;
  problem.force = [&](const SurfacePoints& at) {
    Vectors force = Vectors::Zero(3, at.size());
    force.row(2) = harmonic.values(at.direction).row(0);
    return force;
  };
  Refinement refinement = Refinement::quick();
  refinement.resolve(degree);
  const auto drift = [&](const Discretisation& space) {
    const SurfacePoints points = space.quadrature_points(refinement.points_per_edge);
    const Vectors velocity = solve_flow(space, problem).on_surface(points).velocity;
    return (velocity * points.weight).norm() / points.weight.sum();
  };
  Meshes meshes({unit_sphere()}, refinement);
  const double resolved = drift(meshes.discretise(3));
  const double unresolved =
      drift(discretise(unit_sphere(), {.cells_per_edge = 3, .shell_layers = 2, .degree = 3, .outer_radius = 4.2}));
  BOOST_TEST(resolved < 1e-2 * unresolved);
  BOOST_TEST(resolved < 1e-4);
}

// Best approximation of rising degree on a cell: the remainder is below the last increment, for even and odd functions.
BOOST_AUTO_TEST_CASE(last_two_degrees_of_a_quick_check_differ_by_more_than_the_last_leaves) {
  constexpr int n_intervals = 2000, highest = 20;
  constexpr double width = 2.0 / n_intervals;
  const auto squares = [](const auto& function) {
    std::vector<double> of_degree(highest + 1);
    for (int n = 0; n <= highest; ++n) {
      double product = 0.0;
      for (int i = 0; i < n_intervals; ++i) {
        const double x = -1.0 + (i + 0.5) * width, sign = x < 0.0 && n % 2 == 1 ? -1.0 : 1.0;
        product += width * function(x) * sign * std::legendre(static_cast<unsigned>(n), std::abs(x));
      }
      of_degree[static_cast<std::size_t>(n)] = 0.5 * (2 * n + 1) * product * product;
    }
    return of_degree;
  };
  const Refinement quick = Refinement::quick();
  for (const std::vector<int>& degrees : {quick.potential_degrees, quick.flow_degrees, quick.shape_flow_degrees}) {
    const int last = degrees.back(), before = degrees[degrees.size() - 2];
    for (const std::vector<double>& of_degree :
         {squares([](double x) { return std::cos(3.0 * x); }), squares([](double x) { return std::sin(3.0 * x); })}) {
      const auto begin = of_degree.begin();
      const double change = std::accumulate(begin + before + 1, begin + last + 1, 0.0);
      const double left = std::accumulate(begin + last + 1, of_degree.end(), 0.0);
      BOOST_TEST(change > left);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
