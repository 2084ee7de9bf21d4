#include "bie/linear/recycled_subspace.hpp"

#include <boost/test/unit_test.hpp>
#include <limits>

using namespace vehd;

BOOST_AUTO_TEST_SUITE(recycled_subspace)

namespace {

constexpr Index kSize = 40;

/// Matrix close to the identity and far from symmetric.
Matrix test_matrix() {
  Matrix matrix = Matrix::Identity(kSize, kSize);
  matrix.diagonal(1).setConstant(0.4);
  matrix.diagonal(-3).setConstant(-0.2);
  return matrix;
}

/// Deterministic columns without structure.
Matrix columns(Index count, double phase) {
  Matrix result(kSize, count);
  for (Index j = 0; j < count; ++j) {
    for (Index i = 0; i < kSize; ++i) result(i, j) = std::sin(1.7 * i * (j + 1.3) + phase + 0.1 * i * i);
  }
  return result;
}

RecycledSubspace known_of(const Matrix& matrix, const Matrix& arguments) { return {arguments, matrix * arguments}; }

}  // namespace

BOOST_AUTO_TEST_CASE(recycled_subspace_are_taken_to_their_arguments) {
  const RecycledSubspace known = known_of(test_matrix(), columns(7, 0.0));
  const SecantInverse inverse(known);
  BOOST_TEST(inverse.kept().size() == 7);
  const Vector shares = Vector::LinSpaced(7, -1.0, 2.0);
  BOOST_TEST((inverse.apply(known.responses * shares) - known.arguments * shares).norm() < 1e-12);
}

BOOST_AUTO_TEST_CASE(vectors_orthogonal_to_all_responses_are_unchanged) {
  const RecycledSubspace known = known_of(test_matrix(), columns(7, 0.0));
  Vector r = columns(1, 2.0).col(0);
  r -= known.responses * known.responses.colPivHouseholderQr().solve(r);
  BOOST_TEST((SecantInverse(known).apply(r) - r).norm() < 1e-12 * r.norm());
}

BOOST_AUTO_TEST_CASE(an_empty_subspace_is_the_identity) {
  const Vector r = columns(1, 0.5).col(0);
  BOOST_TEST((SecantInverse().apply(r) == r));
  BOOST_TEST((SecantInverse({Matrix(kSize, 0), Matrix(kSize, 0)}).apply(r) == r));
}

BOOST_AUTO_TEST_CASE(of_contradicting_columns_the_newest_count) {
  const Matrix arguments = columns(4, 0.0);
  RecycledSubspace known = known_of(test_matrix(), arguments);
  const RecycledSubspace older = known_of(3.0 * test_matrix(), arguments);
  known = joined(known, older, 100);
  const SecantInverse inverse(known);
  BOOST_TEST((inverse.kept() == std::vector<Index>{0, 1, 2, 3}));
  for (Index i = 0; i < arguments.cols(); ++i) {
    BOOST_TEST((inverse.apply(test_matrix() * arguments.col(i)) - arguments.col(i)).norm() < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(columns_that_say_nothing_are_left_out) {
  RecycledSubspace known = known_of(test_matrix(), columns(4, 0.0));
  known.responses.col(1).setZero();
  known.responses.col(2)[5] = std::numeric_limits<double>::quiet_NaN();
  BOOST_TEST((SecantInverse(known).kept() == std::vector<Index>{0, 3}));
}

BOOST_AUTO_TEST_CASE(the_oldest_columns_are_cut) {
  const RecycledSubspace newer = known_of(test_matrix(), columns(3, 0.0));
  const RecycledSubspace older = known_of(test_matrix(), columns(5, 1.0));
  const RecycledSubspace both = joined(newer, older, 6);
  BOOST_TEST(both.count() == 6);
  BOOST_TEST((both.arguments.leftCols(3) == newer.arguments));
  BOOST_TEST((both.responses.rightCols(3) == older.responses.leftCols(3)));
  BOOST_TEST(joined(newer, older, 2).count() == 2);
  BOOST_TEST(joined({}, older, 9).count() == 5);
  BOOST_TEST(joined(newer, {}, 9).count() == 3);
}

BOOST_AUTO_TEST_SUITE_END()
