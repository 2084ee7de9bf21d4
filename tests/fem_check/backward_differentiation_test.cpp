#include "fem_check/backward_differentiation.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "tests/fem_check/cases.hpp"

BOOST_AUTO_TEST_SUITE(backward_differentiation)

namespace {

using vehd::fem_check::TimeLaw;
using vehd::fem_check::Vector;

/// V' = −λ (V − cos t) − sin t for a slow and a very fast λ, with the solution cos t + c exp(−λt); the non-stiff part
/// may be taken explicitly.
TimeLaw relaxation(const Vector& lambda, bool splits) {
  TimeLaw law;
  const auto drift = [](double time) { return -std::sin(time); };
  law.implicit = [=](const Vector& from, double step, double time) {
    const Vector given = (step * lambda.array() * std::cos(time) + (splits ? 0.0 : step * drift(time))).matrix();
    return Vector((from + given).array() / (1.0 + step * lambda.array()));
  };
  if (splits) {
    law.explicit_rate = [=](const Vector& value, double time) {
      return Vector(Vector::Constant(value.size(), drift(time)));
    };
  }
  return law;
}

}  // namespace

BOOST_AUTO_TEST_CASE(errors_fall_with_the_square_of_the_step_however_stiff) {
  const Vector lambda = (Vector(2) << 1.0, 1e8).finished();
  const Vector start = (Vector(2) << 1.5, 1.0).finished();
  const double begin = 0.2, end = 1.7;
  const Vector exact =
      (std::cos(end) + (start.array() - std::cos(begin)) * (-lambda.array() * (end - begin)).exp()).matrix();
  for (const bool splits : {false, true}) {
    double before = 0.0;
    for (const int number : {16, 32, 64, 128}) {
      const Vector value = advance(relaxation(lambda, splits), start, {begin, end, number});
      const double error = std::abs(value[0] - exact[0]);
      BOOST_TEST(std::abs(value[1] - exact[1]) < 1e-7);
      if (before > 0.0) {
        const double order = vehd::fem_check::testing::observed_order(before, error, 2.0);
        BOOST_TEST_CONTEXT((splits ? "explicit" : "implicit") << ", " << number << " steps: " << order) {
          BOOST_TEST(order > 1.8);
          BOOST_TEST(order < 2.3);
        }
      }
      before = error;
    }
    BOOST_TEST(before < 5e-5);
  }
}

BOOST_AUTO_TEST_CASE(one_size_of_implicit_step_serves_all) {
  const vehd::fem_check::TimeSteps steps{0.5, 2.0, 6};
  TimeLaw law = relaxation(Vector::Ones(1), false);
  int calls = 0;
  law.implicit = [&, inner = law.implicit](const Vector& from, double step, double time) {
    ++calls;
    BOOST_TEST(step == vehd::fem_check::implicit_step(steps));
    BOOST_TEST(time <= steps.end);
    return inner(from, step, time);
  };
  advance(law, Vector::Ones(1), steps);
  BOOST_TEST(calls == steps.number + 1);
  BOOST_CHECK_THROW(advance(law, Vector::Ones(1), {0.0, 1.0, 0}), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
