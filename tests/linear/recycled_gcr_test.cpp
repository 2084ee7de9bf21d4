#include "bie/linear/recycled_gcr.hpp"

#include <Eigen/Sparse>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/IterativeSolvers>

#include "bie/support/errors.hpp"
#include "tests/linear/maps.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

/// Unsymmetric matrix with eigenvalues from 1 to 20, far from normal.
Matrix test_matrix(Index size) { return banded_matrix(size, 20.0, 2.0, -1.0); }

Vector right_hand_side(Index size, double phase) { return (Vector::LinSpaced(size, -1.0, 2.0).array() + phase).cos(); }

constexpr Index kSize = 60;

}  // namespace

BOOST_AUTO_TEST_SUITE(recycled_gcr)

BOOST_AUTO_TEST_CASE(takes_as_many_iterations_as_gmres_for_the_first_right_hand_side) {
  const Matrix matrix = test_matrix(kSize);
  const Vector rhs = right_hand_side(kSize, 0.0);
  Eigen::GMRES<Eigen::SparseMatrix<double>, Eigen::IdentityPreconditioner> expected;
  expected.set_restart(kSize);
  expected.setTolerance(1e-10);
  expected.compute(matrix.sparseView());
  const Vector x = expected.solve(rhs);
  BOOST_TEST((matrix * x - rhs).norm() <= 1.1e-10 * rhs.norm());
  const RecycledGcr::Solution solution = RecycledGcr(map_of(matrix), identity, kSize).solve(rhs, {}, {1e-10, 60});
  BOOST_TEST(solution.report.converged());
  BOOST_TEST(std::abs(solution.report.iterations - static_cast<int>(expected.iterations())) <= 1);
  BOOST_TEST((matrix * solution.x - rhs).norm() <= 1.1e-10 * rhs.norm());
}

BOOST_AUTO_TEST_CASE(later_right_hand_sides_profit_from_former_ones) {
  const Matrix matrix = test_matrix(kSize);
  RecycledGcr solver(map_of(matrix), identity, kSize);
  const Vector rhs = right_hand_side(kSize, 0.0);
  const int first = solver.solve(rhs, {}, {1e-8, 60}).report.iterations;
  // The solution lies in the recycled subspace.
  BOOST_TEST(solver.solve(-3.0 * rhs, {}, {1e-7, 60}).report.iterations == 0);
  const Vector other = right_hand_side(kSize, 0.3);
  const RecycledGcr::Solution solution = solver.solve(other, {}, {1e-8, 60});
  BOOST_TEST(solution.report.converged());
  BOOST_TEST(2 * solution.report.iterations < first);
  BOOST_TEST((matrix * solution.x - other).norm() <= 1.1e-8 * other.norm());
}

BOOST_AUTO_TEST_CASE(residuals_are_relative_to_a_size_that_is_larger_than_the_right_hand_side) {
  const Matrix matrix = test_matrix(kSize);
  const Vector rhs = right_hand_side(kSize, 0.0);
  const auto solved = [&](double least_size) {
    return RecycledGcr(map_of(matrix), identity, kSize).solve(rhs, {}, {1e-8, 60}, least_size);
  };
  const RecycledGcr::Solution exact = solved(0.1 * rhs.norm()), rough = solved(1e4 * rhs.norm());
  BOOST_TEST(exact.size_of_rhs == rhs.norm());
  BOOST_TEST((matrix * exact.x - rhs).norm() <= 1.1e-8 * rhs.norm());
  const double left = (matrix * rough.x - rhs).norm();
  BOOST_TEST(left > 1e-6 * rhs.norm());
  BOOST_TEST(left <= 1.1e-4 * rhs.norm());
  BOOST_TEST(rough.report.residual == 1e-4 * left / rhs.norm(), boost::test_tools::tolerance(1e-3));
}

BOOST_AUTO_TEST_CASE(start_counts_and_the_tolerance_stays_that_of_the_right_hand_side) {
  const Matrix matrix = test_matrix(kSize);
  const Vector exact = right_hand_side(kSize, 1.0);
  const Vector start = exact + 1e-6 * right_hand_side(kSize, 2.0);
  const RecycledGcr::Solution solution =
      RecycledGcr(map_of(matrix), identity, kSize).solve(matrix * exact, start, {1e-3, 60});
  BOOST_TEST(solution.report.iterations == 0);
  BOOST_TEST((solution.x - start).norm() == 0.0);
}

BOOST_AUTO_TEST_CASE(recycling_from_a_similar_operator_saves_iterations_and_changes_no_solution) {
  const Matrix former = test_matrix(kSize);
  Matrix matrix = former;
  matrix.diagonal(2).setConstant(1e-3);
  const Vector rhs = right_hand_side(kSize, 0.0);
  RecycledGcr teacher(map_of(former), identity, kSize);
  teacher.solve(rhs, {}, {1e-10, 60});
  const RecycledSubspace learned = teacher.found();
  BOOST_TEST((former * learned.arguments - learned.responses).norm() < 1e-12 * learned.responses.norm());
  const int cold = RecycledGcr(map_of(matrix), identity, kSize).solve(rhs, {}, {1e-8, 60}).report.iterations;
  const RecycledGcr::Solution solution =
      RecycledGcr(map_of(matrix), identity, kSize, 0, learned).solve(rhs, {}, {1e-8, 60});
  BOOST_TEST(solution.report.converged());
  BOOST_TEST(3 * solution.report.iterations < cold);
  BOOST_TEST((matrix * solution.x - rhs).norm() <= 1.1e-8 * rhs.norm());
}

BOOST_AUTO_TEST_CASE(a_misleading_subspace_costs_at_most_twice_the_iterations) {
  const Matrix matrix = test_matrix(kSize);
  const Matrix arguments = Matrix::Identity(kSize, 20);
  // Images under a different operator, which reverses and mixes the arguments.
  const RecycledSubspace wrong{arguments, -test_matrix(kSize).transpose() * arguments.rowwise().reverse()};
  const Vector rhs = right_hand_side(kSize, 0.0);
  const int cold = RecycledGcr(map_of(matrix), identity, kSize).solve(rhs, {}, {1e-8, 60}).report.iterations;
  const RecycledGcr::Solution solution =
      RecycledGcr(map_of(matrix), identity, kSize, 0, wrong).solve(rhs, {}, {1e-8, 120});
  BOOST_TEST(solution.report.converged());
  BOOST_TEST(solution.report.iterations <= 2 * cold);
}

// Each proposed direction contains the same direction, larger than the new part by the factor: orthonormalisation loses
// that many digits of the remainder.
BOOST_AUTO_TEST_CASE(nearly_dependent_directions_fake_no_convergence) {
  const Matrix matrix = test_matrix(kSize);
  for (const double tolerance : {1e-6, 1e-10}) {
    for (int digits = 0; digits <= 16; ++digits) {
      const Matrix argument = std::pow(10.0, digits) * Matrix::Identity(kSize, 1);
      const RecycledSubspace obtrusive{argument, right_hand_side(kSize, 0.7)};
      RecycledGcr solver(map_of(matrix), identity, kSize, 0, obtrusive);
      for (const double phase : {0.0, 0.4, 1.1}) {
        const Vector b = right_hand_side(kSize, phase);
        const RecycledGcr::Solution solution = solver.solve(b, {}, {tolerance, 150});
        const double actual = (matrix * solution.x - b).norm() / b.norm();
        BOOST_TEST_CONTEXT("factor 1e" << digits << ", tolerance " << tolerance << ", " << solution.report.iterations
                                       << " iterations, residual " << solution.report.residual) {
          BOOST_TEST(solution.report.converged());
          BOOST_TEST(actual <= tolerance);
          // Products here and in the solver round differently, by some units of the last place of b.
          BOOST_TEST(actual <= solution.report.residual + 1e-14);
        }
      }
    }
  }
}

// A residual below rounding must not be reported as reached.
BOOST_AUTO_TEST_CASE(residual_below_rounding_is_never_claimed) {
  const Matrix matrix = test_matrix(kSize);
  const Matrix argument = 1e9 * Matrix::Identity(kSize, 1);
  const RecycledSubspace obtrusive{argument, right_hand_side(kSize, 0.7)};
  for (const double tolerance : {1e-14, 1e-15, 1e-17}) {
    RecycledGcr solver(map_of(matrix), identity, kSize, 0, obtrusive);
    const Vector b = right_hand_side(kSize, 0.2);
    const RecycledGcr::Solution solution = solver.solve(b, {}, {tolerance, 300});
    const double actual = (matrix * solution.x - b).norm() / b.norm();
    BOOST_TEST((!solution.report.converged() || actual <= 1.1 * tolerance));
    BOOST_TEST(solution.report.iterations < 300);
  }
}

BOOST_AUTO_TEST_CASE(well_conditioned_solves_apply_the_map_once_an_iteration) {
  const Matrix matrix = test_matrix(kSize);
  int applications = 0;
  const LinearMap counted = [&](const Vector& x) -> Vector {
    ++applications;
    return matrix * x;
  };
  RecycledGcr solver(counted, identity, kSize);
  int iterations = 0;
  for (const double phase : {0.0, 0.3, 0.9}) {
    iterations += solver.solve(right_hand_side(kSize, phase), {}, {1e-9, 60}).report.iterations;
  }
  BOOST_TEST(applications == iterations);
  BOOST_TEST(solver.found().count() == iterations);
}

BOOST_AUTO_TEST_CASE(further_entries_belong_to_the_solution) {
  const Matrix matrix = test_matrix(kSize);
  const Matrix other = Matrix::Random(4, kSize);
  const LinearMap map = [&](const Vector& x) {
    Vector result(kSize + 4);
    result << matrix * x, other * x;
    return result;
  };
  RecycledGcr solver(map, identity, kSize, 4);
  for (const double phase : {0.0, 0.5}) {
    const RecycledGcr::Solution solution =
        solver.solve(right_hand_side(kSize, phase), right_hand_side(kSize, 3.0), {1e-6, 60});
    BOOST_TEST((solution.further - other * solution.x).norm() < 1e-12 * solution.further.norm());
  }
}

BOOST_AUTO_TEST_CASE(an_operator_that_turns_by_a_right_angle_is_solved) {
  // Residual and image are orthogonal, so a search direction along the residual makes no progress.
  Matrix matrix = Matrix::Zero(2, 2);
  matrix << 0.0, -1.0, 1.0, 0.0;
  const Vector rhs{{1.0, 0.0}};
  const RecycledGcr::Solution solution = RecycledGcr(map_of(matrix), identity, 2).solve(rhs, {}, {1e-12, 10});
  BOOST_TEST(solution.report.converged());
  BOOST_TEST((matrix * solution.x - rhs).norm() < 1e-12);
}

BOOST_AUTO_TEST_CASE(unsolvable_equations_are_reported) {
  Matrix singular = test_matrix(kSize);
  singular.row(7).setZero();
  const RecycledGcr::Solution solution =
      RecycledGcr(map_of(singular), identity, kSize).solve(right_hand_side(kSize, 0.0), {}, {1e-10, 100});
  BOOST_TEST(!solution.report.converged());
  BOOST_TEST(solution.report.residual > 1e-10);

  const LinearMap broken = [](const Vector& x) -> Vector {
    return Vector::Constant(x.size(), std::numeric_limits<double>::quiet_NaN());
  };
  BOOST_TEST(
      !RecycledGcr(broken, identity, kSize).solve(right_hand_side(kSize, 0.0), {}, {1e-10, 100}).report.converged());
}

BOOST_AUTO_TEST_CASE(zero_right_hand_side_costs_nothing) {
  const Matrix matrix = test_matrix(5);
  const RecycledGcr::Solution solution =
      RecycledGcr(map_of(matrix), identity, 5).solve(Vector::Zero(5), Vector::Ones(5), {1e-10, 10});
  BOOST_TEST(solution.report.converged());
  BOOST_TEST(solution.x.isZero(0.0));
}

// The message must name the cause instead of "relative residual -nan".
BOOST_AUTO_TEST_CASE(numbers_that_are_not_finite_are_said_to_be_so) {
  const Matrix matrix = test_matrix(5);
  for (const double number : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const RecycledGcr::Solution solution =
        RecycledGcr(map_of(matrix), identity, 5).solve(Vector::Constant(5, number), {}, {1e-10, 10});
    BOOST_CHECK_EXCEPTION(require_converged(solution.report, "tension"), ConvergenceError, [](const auto& error) {
      return std::string(error.what()) == "tension: the equations hold numbers that are not finite";
    });
  }
}

BOOST_AUTO_TEST_SUITE_END()
