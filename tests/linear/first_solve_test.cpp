#include <boost/test/unit_test.hpp>
#include <limits>

#include "bie/linear/recycled_gcr.hpp"
#include "bie/support/errors.hpp"
#include "tests/linear/maps.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(first_solve)

namespace {

/// Unsymmetric matrix with well-separated eigenvalues: Krylov spaces need about ten dimensions for it.
Matrix test_matrix(Index size) { return banded_matrix(size, 5.0, 0.4, -0.2); }

Vector test_vector(Index size) { return Vector::LinSpaced(size, -1.0, 2.0).array().cos(); }

/// Solves with a new solver, starting from the given x.
SolveReport solve(const LinearMap& map, const LinearMap& preconditioner, const Vector& rhs, Vector& x,
                  const SolveOptions& options) {
  RecycledGcr solver(map, preconditioner, rhs.size());
  const RecycledGcr::Solution solution = solver.solve(rhs, x, options);
  x = solution.x;
  return solution.report;
}

}  // namespace

BOOST_AUTO_TEST_CASE(solves_a_known_system) {
  const Matrix matrix = test_matrix(60);
  const Vector expected = test_vector(60);
  Vector x = Vector::Zero(60);
  const SolveReport report = solve(map_of(matrix), identity, matrix * expected, x, {1e-12, 60});
  BOOST_TEST(report.converged());
  BOOST_TEST(report.iterations > 5);
  BOOST_TEST(report.residual <= 1e-12);
  BOOST_TEST((x - expected).norm() < 1e-11 * expected.norm());
}

BOOST_AUTO_TEST_CASE(reported_residual_is_the_preconditioned_one) {
  const Matrix matrix = test_matrix(60);
  const Vector inverse_diagonal = matrix.diagonal().cwiseInverse();
  const LinearMap preconditioner = [&](const Vector& r) -> Vector { return inverse_diagonal.cwiseProduct(r); };
  const Vector rhs = test_vector(60);
  Vector x = Vector::Zero(60);
  const SolveReport report = solve(map_of(matrix), preconditioner, rhs, x, {1e-6, 60});
  const double actual = preconditioner(rhs - matrix * x).norm() / preconditioner(rhs).norm();
  BOOST_TEST(report.converged());
  BOOST_TEST(actual <= 1e-6);
  BOOST_TEST(report.residual == actual, boost::test_tools::tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(exact_inverse_as_preconditioner_takes_one_iteration) {
  const Matrix matrix = test_matrix(30);
  const Matrix inverse = matrix.inverse();
  Vector x = Vector::Zero(30);
  const SolveReport report = solve(map_of(matrix), map_of(inverse), test_vector(30), x, {1e-10, 30});
  BOOST_TEST(report.converged());
  BOOST_TEST(report.iterations <= 1);
}

BOOST_AUTO_TEST_CASE(too_few_iterations_are_reported_and_thrown) {
  const Matrix matrix = test_matrix(60);
  Vector x = Vector::Zero(60);
  const SolveReport report = solve(map_of(matrix), identity, test_vector(60), x, {1e-12, 3});
  BOOST_TEST((report.end == SolveEnd::out_of_iterations));
  BOOST_TEST(!report.converged());
  BOOST_TEST(report.iterations == 3);
  BOOST_TEST(report.residual > 1e-12);
  BOOST_CHECK_EXCEPTION(require_converged(report, "the system"), ConvergenceError, [](const ConvergenceError& error) {
    return std::string(error.what()).find("the system") == 0;
  });
  BOOST_CHECK_NO_THROW(require_converged(SolveReport{SolveEnd::converged, 3, 0.0}, "the system"));
}

BOOST_AUTO_TEST_CASE(zero_right_hand_side_gives_zero_from_any_start) {
  const Matrix matrix = test_matrix(20);
  Vector x = test_vector(20);
  const SolveReport report = solve(map_of(matrix), identity, Vector::Zero(20), x, {1e-12, 20});
  BOOST_TEST(report.converged());
  BOOST_TEST(report.iterations == 0);
  BOOST_TEST(x.isZero(0.0));
}

BOOST_AUTO_TEST_CASE(good_start_takes_no_iteration_and_stays) {
  const Matrix matrix = test_matrix(20);
  const Vector start = test_vector(20);
  Vector x = start;
  const SolveReport report = solve(map_of(matrix), identity, matrix * start, x, {1e-12, 20});
  BOOST_TEST(report.converged());
  BOOST_TEST(report.iterations == 0);
  BOOST_TEST((x - start).isZero(0.0));
}

BOOST_AUTO_TEST_CASE(near_start_takes_fewer_iterations_for_the_same_accuracy) {
  const Matrix matrix = test_matrix(60);
  const Vector expected = test_vector(60);
  Vector from_zero = Vector::Zero(60);
  Vector from_near = expected + 1e-6 * Vector::Ones(60);
  const SolveOptions options{1e-10, 60};
  const SolveReport cold = solve(map_of(matrix), identity, matrix * expected, from_zero, options);
  const SolveReport warm = solve(map_of(matrix), identity, matrix * expected, from_near, options);
  BOOST_TEST(warm.converged());
  BOOST_TEST(warm.iterations < cold.iterations);
  BOOST_TEST((from_near - expected).norm() < 1e-9 * expected.norm());
}

BOOST_AUTO_TEST_CASE(nan_is_never_converged) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const Matrix matrix = test_matrix(20);
  Vector x = Vector::Zero(20);
  Vector rhs = test_vector(20);
  rhs[3] = kNan;
  BOOST_TEST(!solve(map_of(matrix), identity, rhs, x, {1e-10, 20}).converged());

  Matrix broken = matrix;
  broken(4, 4) = kNan;
  x.setZero();
  BOOST_TEST(!solve(map_of(broken), identity, test_vector(20), x, {1e-10, 20}).converged());

  x = Vector::Constant(20, kNan);
  BOOST_TEST(!solve(map_of(matrix), identity, test_vector(20), x, {1e-10, 20}).converged());
}

BOOST_AUTO_TEST_CASE(repetition_gives_the_same_bits) {
  const Matrix matrix = test_matrix(60);
  Vector first = Vector::Zero(60);
  Vector second = Vector::Zero(60);
  solve(map_of(matrix), identity, test_vector(60), first, {1e-8, 60});
  solve(map_of(matrix), identity, test_vector(60), second, {1e-8, 60});
  BOOST_TEST((first.array() == second.array()).all());
}

BOOST_AUTO_TEST_SUITE_END()
