#include "fem_check/app/comparison.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include "fem_check/app/compared_field.hpp"
#include "fem_check/app/smooth_work.hpp"
#include "tests/fem_check/cases.hpp"

using namespace vehd::fem_check;
using namespace vehd::fem_check::testing;

BOOST_AUTO_TEST_SUITE(comparison)

namespace {

constexpr double fine_error = 1e-4, solver_error = 1e-6;

/// A field with the values 1 … n and equal weights.
Eigen::MatrixXd values(double factor = 1.0) { return factor * Vector::LinSpaced(50, 1.0, 50.0).transpose(); }

Level level(double error, long n_unknowns) {
  Level result;
  result.problem = "potential";
  result.n_unknowns = n_unknowns;
  result.surface["q"] = values(1.0 + error);
  return result;
}

/// Three levels with errors falling by a factor of 10; the outer sphere has no effect.
LevelSequence levels() {
  LevelSequence sequence;
  sequence.levels = {level(100 * fine_error, 1000), level(10 * fine_error, 8000), level(fine_error, 64000)};
  sequence.truncated = level(100 * fine_error, 1000);
  sequence.loose = level(100 * fine_error + solver_error, 1000);
  return sequence;
}

/// Boundary-integral results with an error of 1e-4.
ComparedField compared() {
  ComparedField result;
  result.name = result.label = result.values = "q";
  result.judged = result.bie = values();
  result.bie_high = values(1.0 + fine_error);
  result.weight = Vector::Ones(50);
  result.natural_size = 30.0;
  return result;
}

Verdict verdict(const ComparedField& field, double required = 0.02) {
  return compare(field, levels(), {required}).verdict;
}

}  // namespace

BOOST_AUTO_TEST_CASE(right_numbers_agree_and_errors_are_differences_of_levels_and_orders) {
  const FieldComparison result = compare(compared(), levels(), {0.02});
  BOOST_TEST((result.verdict == Verdict::agree));
  BOOST_TEST(result.difference.l2 == fine_error, boost::test_tools::tolerance(1e-3));
  BOOST_TEST(result.levels_change.l2 == 9.0 * fine_error, boost::test_tools::tolerance(1e-3));
  // Not the ninth that would remain if errors kept falling by 10: two changes do not establish the rate.
  BOOST_TEST(result.fem_error() == 9.0 * fine_error, boost::test_tools::tolerance(1e-2));
  BOOST_TEST(result.bie_error() == fine_error, boost::test_tools::tolerance(1e-3));
  BOOST_TEST(result.order.value() == 3.0 * std::log(10.0) / std::log(8.0), boost::test_tools::tolerance(1e-3));
}

BOOST_AUTO_TEST_CASE(wrong_numbers_disagree_beyond_their_errors) {
  for (const double factor : {1.003, 0.997, -1.0, 0.5, 100.0, 0.0, std::numeric_limits<double>::quiet_NaN()}) {
    ComparedField wrong = compared();
    for (Eigen::MatrixXd* numbers : {&wrong.judged, &wrong.bie, &wrong.bie_high}) *numbers *= factor;
    BOOST_TEST((verdict(wrong) == Verdict::disagree), factor);
  }
}

// Both orders must be checked: if one correct order sufficed, the other half of the verdict could not fail.
BOOST_AUTO_TEST_CASE(neither_order_may_be_random) {
  ComparedField random = compared();
  random.bie_high = Eigen::MatrixXd::Random(1, 50);
  BOOST_TEST((verdict(random) == Verdict::undecided));
  random = compared();
  random.judged = random.bie = Eigen::MatrixXd::Random(1, 50);
  BOOST_TEST((verdict(random) != Verdict::agree));
}

BOOST_AUTO_TEST_CASE(errors_above_the_required_one_decide_nothing) {
  BOOST_TEST((verdict(compared(), 1e-3) == Verdict::agree));
  BOOST_TEST((verdict(compared(), 2e-4) == Verdict::undecided));
  ComparedField coarse = compared();
  coarse.bie_high = values(1.05);
  BOOST_TEST((verdict(coarse) == Verdict::undecided));
  coarse = compared();
  coarse.further_error = values(0.05);
  BOOST_TEST((verdict(coarse) == Verdict::undecided));
}

// A small field is a remainder of large ones: an error of half of it must not be hidden by their size.
BOOST_AUTO_TEST_CASE(small_fields_are_judged_by_their_own_size) {
  ComparedField small = compared();
  small.natural_size = 30.0e5;
  BOOST_TEST((verdict(small) == Verdict::agree));
  small.judged *= 1.01;
  BOOST_TEST((verdict(small) == Verdict::disagree));
}

BOOST_AUTO_TEST_CASE(zero_is_judged_by_the_natural_size) {
  ComparedField zero = compared();
  for (Eigen::MatrixXd* numbers : {&zero.judged, &zero.bie, &zero.bie_high}) numbers->setZero();
  BOOST_TEST((verdict(zero) == Verdict::disagree), "the elements have a field");
  zero.natural_size = 1e6;
  LevelSequence rounded = levels();
  for (Level* each : {&rounded.levels[0], &rounded.levels[1], &rounded.levels[2], &rounded.truncated, &rounded.loose}) {
    each->surface["q"].setZero();
  }
  BOOST_TEST((compare(zero, rounded, {0.02}).verdict == Verdict::agree));
  rounded.levels[2].surface["q"].setConstant(27.0);
  rounded.levels[1].surface["q"].setConstant(26.0);
  BOOST_TEST((compare(zero, rounded, {0.02}).verdict == Verdict::disagree), "27 times an error is no zero");
}

// The remainder of cancelling terms is only as accurate as the required share of those terms.
BOOST_AUTO_TEST_CASE(vanishing_fields_are_judged_by_the_natural_size) {
  for (const double size : {0.0, 1e-12, 1e-6, 1e-3}) {
    ComparedField remains = compared();
    remains.natural_size = 30.0 / std::max(size, 1e-12);
    // Errors of a twentieth of the field, or of 5e-14 of the natural size if the field is zero.
    remains.bie_high = values(1.05);
    if (size == 0.0) {
      for (Eigen::MatrixXd* numbers : {&remains.judged, &remains.bie}) numbers->setZero();
      remains.bie_high = 0.05 * values();
    }
    BOOST_TEST((verdict(remains) != Verdict::disagree), size);
    BOOST_TEST((verdict(remains) == Verdict::agree), size);
  }
  ComparedField whole = compared();
  whole.bie_high = values(1.05);
  BOOST_TEST((verdict(whole) == Verdict::undecided));
}

// Rounding and stopping tolerances of the solvers leave errors that no change shows: two equal computations share them.
BOOST_AUTO_TEST_CASE(rounding_and_solvers_are_no_disagreement) {
  const auto with_difference = [](double share, double solver_tolerance) {
    ComparedField field = compared();
    field.reference = Reference::boundary_integrals;
    field.bie_high = field.bie;
    field.natural_size = std::sqrt(values().squaredNorm() / 50.0);
    field.judged = values(1.0 + share);
    return compare(field, levels(), {0.02, solver_tolerance}).verdict;
  };
  BOOST_TEST((with_difference(5e-10, 0.0) == Verdict::agree));
  BOOST_TEST((with_difference(1e-8, 0.0) == Verdict::disagree));
  BOOST_TEST((with_difference(1e-8, 1e-7) == Verdict::agree));
  BOOST_TEST((with_difference(1e-5, 1e-7) == Verdict::disagree));
  // For a small remainder the rounding error is relative to its terms.
  ComparedField remains = compared();
  remains.natural_size = 30.0e9;
  remains.judged = remains.bie = remains.bie_high = values(1.5);
  BOOST_TEST((verdict(remains) == Verdict::agree));
}

// A force that is not resolved as a field may still be determined by its work.
BOOST_AUTO_TEST_CASE(undecided_force_does_not_count_beside_its_work) {
  ComparedField force = compared();
  force.has_work_row = true;
  BOOST_TEST(compare(force, levels(), {0.02}).counts());
  force.bie_high = values(1.1);
  BOOST_TEST(!compare(force, levels(), {0.02}).counts());
  force.judged *= 2.0;
  BOOST_TEST(compare(force, levels(), {0.02}).counts());
  force.has_work_row = false;
  force.judged = values();
  BOOST_TEST(compare(force, levels(), {0.02}).counts());
}

// At a conductivity ratio of 1e7 a residual of 1e-11 left an error of 5 % in q.
BOOST_AUTO_TEST_CASE(error_of_the_linear_solver_is_measured) {
  LevelSequence sequence = levels();
  sequence.loose = level(0.5, 1000);
  const FieldComparison result = compare(compared(), sequence, {0.02});
  BOOST_TEST(result.solver > 0.04);
  BOOST_TEST((result.verdict == Verdict::undecided));
}

BOOST_AUTO_TEST_CASE(background_does_not_hide_the_disturbance) {
  ComparedField field = compared();
  const Eigen::MatrixXd background = Eigen::MatrixXd::Constant(1, 50, 1e5);
  LevelSequence shifted = levels();
  for (Level* each : {&shifted.levels[0], &shifted.levels[1], &shifted.levels[2], &shifted.truncated, &shifted.loose}) {
    each->surface["q"] += background;
  }
  for (Eigen::MatrixXd* numbers : {&field.judged, &field.bie, &field.bie_high}) *numbers = 1.01 * *numbers + background;
  BOOST_TEST((compare(without(field, background), shifted, {0.02}).verdict == Verdict::disagree));
}

// A force is more accurate as a functional on smooth displacements than as a field: waves of high degree do not
// contribute, so an error of a thousandth that they would hide is visible.
BOOST_AUTO_TEST_CASE(work_on_smooth_displacements_is_that_of_the_whole_force) {
  const Discretisation space = discretise(shapes::shape_33(), {.cells_per_edge = 2, .shell_layers = 2, .degree = 3});
  const SurfacePoints points = space.quadrature_points(10);
  const Eigen::MatrixXd harmonics = shapes::all_harmonics(9).values(points.direction);
  const auto low = harmonics.topRows(25);
  const Eigen::MatrixXd smooth = Eigen::MatrixXd::Random(3, 25) * low;
  const Eigen::MatrixXd wave = 0.3 * Vector3(1.0, -2.0, 0.5) * harmonics.row(90);
  ComparedField field;
  field.values = "bending";
  field.weight = points.weight;
  field.judged = field.bie = field.bie_high = smooth;
  LevelSequence sequence = levels();
  for (Level& each : sequence.levels) each.surface["bending"] = smooth + wave;
  BOOST_TEST((compare(field, sequence, {0.02}).verdict == Verdict::disagree), "the wave is in the field");

  const ComparedField work = work_on_smooth(field, points);
  const Eigen::MatrixXd of_level = work.from_level(smooth + wave);
  const Eigen::MatrixXd moments = (smooth + wave) * points.weight.asDiagonal() * low.transpose();
  BOOST_TEST((of_level * points.weight.asDiagonal() * low.transpose() - moments).norm() < 1e-12 * moments.norm());
  BOOST_TEST((work.judged - smooth).norm() < 1e-12 * smooth.norm());
  BOOST_TEST((of_level - smooth).norm() < 0.5 * wave.norm());
}

// ∫ f_λ·w dA = −∫ λ ∇_γ·w dA: on the unit sphere f_λ of λ = z + z² is ∇_γ λ − 2 λ n.
BOOST_AUTO_TEST_CASE(work_of_a_tension_force_follows_from_the_tension) {
  const Eigen::MatrixXd sphere = shapes::project(1, [](const vehd::meshes::Point& r) { return r; });
  const Discretisation space =
      discretise(vehd::meshes::FrozenShape(sphere), {.cells_per_edge = 2, .shell_layers = 2, .degree = 5});
  const SurfacePoints points = space.quadrature_points(10);
  Eigen::MatrixXd tension(1, points.size());
  ComparedField field = compared();
  field.judged.resize(3, points.size());
  for (Eigen::Index i = 0; i < points.size(); ++i) {
    const Vector3 n = points.direction.col(i);
    tension(0, i) = n.z() + n.z() * n.z();
    field.judged.col(i) = (1.0 + 2.0 * n.z()) * (Vector3::UnitZ() - n.z() * n) - 2.0 * tension(0, i) * n;
  }
  field.bie = field.bie_high = field.judged;
  const ComparedField work = work_of_tension(field, sphere, points);
  BOOST_TEST((work.judged - field.judged).norm() < 1e-4 * field.judged.norm());
  BOOST_TEST((work.from_level(tension) - work.judged).norm() < 1e-4 * work.judged.norm());
}

BOOST_AUTO_TEST_CASE(numbers_without_finite_elements_are_judged_by_the_boundary_integrals) {
  ComparedField field = compared();
  field.reference = Reference::boundary_integrals;
  BOOST_TEST((verdict(field) == Verdict::agree));
  BOOST_TEST(compare(field, levels(), {0.02}).fem_error() == 0.0);
  field.judged *= 1.001;
  BOOST_TEST((verdict(field) == Verdict::disagree));
}

// If levels agree successively, the last change is no larger than the error itself.
BOOST_AUTO_TEST_CASE(difference_of_the_size_of_the_last_change_is_no_disagreement) {
  ComparedField field = compared();
  for (Eigen::MatrixXd* numbers : {&field.judged, &field.bie, &field.bie_high}) *numbers *= 1.0 + 9.0 * fine_error;
  BOOST_TEST((verdict(field) == Verdict::agree));
}

// If raising the degree of the elements converges no faster than refining them, the last change is smaller than the
// remaining error.
BOOST_AUTO_TEST_CASE(slow_convergence_leaves_more_than_the_last_change) {
  const auto with_order = [](double order) {
    LevelSequence slow = levels();
    for (int i = 0; i < 3; ++i) {
      slow.levels[i] = level(100 * fine_error * std::pow(2.0, -order * i / 3.0), 1000 << i);
    }
    return compare(compared(), slow, {0.02});
  };
  for (const double order : {1.0, 1.5, 2.0, 3.0}) {
    const FieldComparison result = with_order(order);
    BOOST_TEST(result.order.value() == order, boost::test_tools::tolerance(1e-2));
    BOOST_TEST(result.tail * result.levels_change.l2 == result.difference.l2, boost::test_tools::tolerance(1e-2));
    BOOST_TEST((result.verdict != Verdict::disagree), order);
  }
  BOOST_TEST(with_order(4.0).tail == 1.0);
  // An order below one is treated as one.
  BOOST_TEST(with_order(0.1).tail == with_order(1.0).tail, boost::test_tools::tolerance(1e-2));
}

BOOST_AUTO_TEST_CASE(a_magnified_tolerance_of_the_solvers_decides_nothing) {
  LevelSequence sequence = levels();
  sequence.tolerance = 1e-8;
  ComparedField steady = compared();
  steady.judged *= 1.05;
  BOOST_TEST((compare(steady, sequence, {0.02}).verdict == Verdict::disagree));
  steady.solver_magnification = 1e7;
  const FieldComparison result = compare(steady, sequence, {0.02});
  BOOST_TEST((result.verdict == Verdict::undecided));
  BOOST_TEST(result.fem_error() > 0.05);
  BOOST_TEST(result.bie_error() < 1e-3);
}

// An unresolved field may seem to converge, with changes smaller than its error.
BOOST_AUTO_TEST_CASE(levels_that_differ_by_much_of_the_field_show_no_order) {
  const auto with_errors = [](double coarse, double middle, double fine) {
    LevelSequence sequence = levels();
    sequence.levels = {level(coarse, 1000), level(middle, 2000), level(fine, 4000)};
    sequence.truncated = sequence.loose = sequence.levels.front();
    return compare(compared(), sequence, {0.02});
  };
  const FieldComparison far = with_errors(0.8, 0.45, 0.26);
  BOOST_TEST(far.order.value() > 2.5);
  BOOST_TEST(far.levels_change.l2 < far.difference.l2);
  BOOST_TEST((far.verdict == Verdict::undecided));
  const FieldComparison near = with_errors(0.08, 0.045, 0.026);
  BOOST_TEST(near.order.value() == far.order.value(), boost::test_tools::tolerance(1e-3));
  BOOST_TEST((near.verdict == Verdict::disagree));
}

// The elements give the work of f_b to 1e-11. The difference is then the whole truncation error of degree p, while the
// estimate comes from the other degree, which has a truncation error too.
BOOST_AUTO_TEST_CASE(error_of_boundary_integrals_includes_the_difference_to_the_other_degree) {
  const auto with_errors = [](int degree, double error, int other, double other_error) {
    ComparedField field = compared();
    field.judged = field.bie = values(1.0 - error);
    field.bie_high = values(1.0 - other_error);
    field.degrees = {degree, other, {}};
    LevelSequence exact = levels();
    for (Level* each : {&exact.levels[0], &exact.levels[1], &exact.levels[2], &exact.truncated, &exact.loose}) {
      each->surface["q"] = values();
    }
    return compare(field, exact, {0.05});
  };
  const auto geometric = [&](double rate, int degree, int other) {
    return with_errors(degree, std::pow(rate, degree), other, std::pow(rate, other));
  };
  // The estimate is exact for errors that decrease geometrically from the whole field at degree 0.
  for (const double rate : {0.86, 0.88}) {
    BOOST_TEST(geometric(rate, 24, 28).bie_error() == std::pow(rate, 24), boost::test_tools::tolerance(1e-6));
  }
  for (const double rate : {0.3, 0.7}) BOOST_TEST((geometric(rate, 24, 28).verdict == Verdict::agree), rate);
  // Slower decay, by a power of the degree, after a fast initial decrease of the error.
  for (const int other : {14, 18, 24}) {
    const double error = 3e-7, left = error * std::pow(12.0 / other, 4.1);
    const FieldComparison result = with_errors(12, error, other, left);
    BOOST_TEST((result.verdict == Verdict::agree), other);
    BOOST_TEST(result.bie_error() == error, boost::test_tools::tolerance(0.03));
  }
  // Faster decay of the coefficients gives a sharper estimate.
  ComparedField bulbs = compared();
  bulbs.bie_high = values(1.022);
  bulbs.degrees = {24, 28, {}};
  BOOST_TEST((compare(bulbs, levels(), {0.05}).verdict == Verdict::undecided));
  bulbs.degrees.decay = 0.2;
  BOOST_TEST((compare(bulbs, levels(), {0.05}).verdict == Verdict::agree));
  bulbs.degrees.decay = 0.95;
  BOOST_TEST((compare(bulbs, levels(), {0.05}).verdict == Verdict::undecided));
  // A change that is inconsistent with errors decreasing to the other degree gives no estimate.
  const FieldComparison unknown = with_errors(40, 0.44, 42, 0.40);
  BOOST_TEST((unknown.verdict == Verdict::undecided));
  BOOST_TEST(unknown.bie_error() >= 0.99);
  // A lower degree has a larger error than degree p: the change itself exceeds the error of p if that is small.
  BOOST_TEST(geometric(0.9, 64, 48).bie_error() == std::pow(0.9, 48) - std::pow(0.9, 64),
             boost::test_tools::tolerance(1e-6));
  BOOST_TEST(geometric(0.965, 64, 62).bie_error() == std::pow(0.965, 64), boost::test_tools::tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(decay_of_coefficients_is_that_from_band_to_band) {
  const Discretisation space = discretise(shapes::shape_33(), {.cells_per_edge = 2, .shell_layers = 2, .degree = 3});
  const ComparisonPoints at{space.quadrature_points(4)};
  // Amplitude r^n/√(2n+1) of each coefficient, hence r^n in each degree.
  const auto series = [](int degree, double rate) {
    Eigen::MatrixXd values((degree + 1) * (degree + 1), 1);
    for (int n = 0; n <= degree; ++n) {
      values.middleRows(n * n, 2 * n + 1).setConstant(std::pow(rate, n) / std::sqrt(2.0 * n + 1.0));
    }
    return values;
  };
  for (const auto& [judged, other] : {std::pair{8, 10}, std::pair{10, 8}}) {
    const ComparedField field =
        field_on_surface(at, "q", "q", "q", series(judged, 0.7), series(judged, 0.7), series(other, 0.7), 1.0);
    BOOST_TEST(field.degrees.judged == judged);
    BOOST_TEST(field.degrees.other == other);
    BOOST_TEST(field.degrees.decay.value() == 0.49, boost::test_tools::tolerance(1e-10));
  }
}

BOOST_AUTO_TEST_CASE(single_level_has_an_unknown_error) {
  LevelSequence one = levels();
  one.levels = {one.levels.back()};
  BOOST_TEST((compare(compared(), one, {0.02}).verdict == Verdict::undecided));
}

BOOST_AUTO_TEST_SUITE_END()
