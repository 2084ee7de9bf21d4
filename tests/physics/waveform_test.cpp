#include "bie/physics/waveform.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "bie/support/errors.hpp"

using namespace vehd;

BOOST_AUTO_TEST_SUITE(waveform)

BOOST_AUTO_TEST_CASE(default_is_one_for_ever) {
  BOOST_TEST(Waveform().at(7.0) == 1.0);
  BOOST_TEST(!Waveform().next_discontinuity(0.0).has_value());
  BOOST_TEST(!Waveform().is_quiet(0.0));
}

BOOST_AUTO_TEST_CASE(alternating_is_a_cosine_with_phase) {
  const Waveform w = Waveform::alternating(2.0, 0.5, -std::numbers::pi / 2.0);
  BOOST_TEST(std::abs(w.at(0.0)) < 1e-15);
  BOOST_TEST(std::abs(w.at(0.5) - 2.0) < 1e-15);
  BOOST_TEST(std::abs(w.at(1.5) + 2.0) < 1e-14);
  BOOST_TEST(!w.is_quiet(0.0));
}

BOOST_AUTO_TEST_CASE(pulse_jumps_where_it_says) {
  const Waveform w = Waveform::pulse(3.0, 1.0, 0.5);
  BOOST_TEST(w.at(0.0) == 0.0);
  BOOST_TEST(w.at(1.0, Limit::before) == 0.0);
  BOOST_TEST(w.at(1.0, Limit::after) == 3.0);
  BOOST_TEST(w.at(1.5, Limit::before) == 3.0);
  BOOST_TEST(w.at(1.5, Limit::after) == 0.0);
  BOOST_TEST(w.next_discontinuity(0.0).value() == 1.0);
  BOOST_TEST(w.next_discontinuity(1.0).value() == 1.5);
  BOOST_TEST(!w.next_discontinuity(1.5).has_value());
  BOOST_TEST(w.is_quiet(0.0));
  BOOST_TEST(!w.is_quiet(1.0));
  BOOST_TEST(w.is_quiet(1.5));
}

BOOST_AUTO_TEST_CASE(burst_alternates_while_it_lasts) {
  const Waveform burst = Waveform::burst(2.0, 0.5, 0.3, 1.0, 4.0), always = Waveform::alternating(2.0, 0.5, 0.3);
  for (const double time : {1.1, 2.3, 4.9}) BOOST_TEST(burst.at(time) == always.at(time));
  BOOST_TEST(burst.at(1.0, Limit::before) == 0.0);
  BOOST_TEST(burst.at(1.0, Limit::after) == always.at(1.0));
  BOOST_TEST(burst.at(5.0, Limit::before) == always.at(5.0));
  BOOST_TEST(burst.at(5.0, Limit::after) == 0.0);
  BOOST_TEST(burst.next_discontinuity(0.0).value() == 1.0);
  BOOST_TEST(burst.next_discontinuity(1.0).value() == 5.0);
  BOOST_TEST(!burst.next_discontinuity(5.0).has_value());
  BOOST_TEST(burst.is_quiet(0.0));
  BOOST_TEST(burst.is_quiet(5.0));
  // The value is zero here and at the end of the burst, but not in between.
  BOOST_TEST(!Waveform::burst(1.0, 0.5, -std::numbers::pi / 2.0, 0.0, 4.0).is_quiet(0.0));
}

BOOST_AUTO_TEST_CASE(train_repeats_the_pulse) {
  const Waveform w = Waveform::pulse_train(1.0, 0.2, 0.1, 0.3);
  for (int k = 0; k < 50; ++k) {
    const double start = 0.2 + 0.3 * k;
    BOOST_TEST(w.at(start, Limit::before) == 0.0);
    BOOST_TEST(w.at(start, Limit::after) == 1.0);
    BOOST_TEST(w.at(start + 0.1, Limit::before) == 1.0);
    BOOST_TEST(w.at(start + 0.1, Limit::after) == 0.0);
    BOOST_TEST(std::abs(w.next_discontinuity(start).value() - (start + 0.1)) < 1e-12);
    BOOST_TEST(std::abs(w.next_discontinuity(start + 0.1).value() - (start + 0.3)) < 1e-12);
  }
  BOOST_CHECK_THROW(Waveform::pulse_train(1.0, 0.0, 0.5, 0.4), InputError);
}

BOOST_AUTO_TEST_CASE(table_is_linear_with_jumps_at_double_times) {
  const Waveform w = Waveform::table({0.0, 1.0, 1.0, 2.0, 3.0}, {0.0, 2.0, -1.0, 0.0, 0.0});
  BOOST_TEST(w.at(-1.0) == 0.0);
  BOOST_TEST(std::abs(w.at(0.25) - 0.5) < 1e-15);
  BOOST_TEST(w.at(1.0, Limit::before) == 2.0);
  BOOST_TEST(w.at(1.0, Limit::after) == -1.0);
  BOOST_TEST(w.at(9.0) == 0.0);
  BOOST_TEST(w.next_discontinuity(0.0).value() == 1.0);
  BOOST_TEST(!w.is_quiet(1.5));
  BOOST_TEST(w.is_quiet(2.0));
  BOOST_CHECK_THROW(Waveform::table({0.0}, {1.0}), InputError);
  BOOST_CHECK_THROW(Waveform::table({1.0, 0.0}, {1.0, 1.0}), InputError);
}

BOOST_AUTO_TEST_CASE(factor_jumps_where_its_limits_differ) {
  BOOST_TEST(!Waveform().jumps_at(0.0));
  BOOST_TEST(!Waveform::alternating(2.0, 3.0, 0.5).jumps_at(0.1));
  const Waveform pulse = Waveform::pulse(3.0, 1.0, 0.5);
  for (const double time : {1.0, 1.5}) BOOST_TEST(pulse.jumps_at(time));
  for (const double time : {0.0, 0.999, 1.2, 2.0}) BOOST_TEST(!pulse.jumps_at(time));
  const Waveform table = Waveform::table({0.0, 0.7, 1.3, 1.3, 2.0}, {0.0, 1e-3, -2.1e-3, 0.0, 0.9e-3});
  BOOST_TEST(table.jumps_at(1.3));
  for (const double time : {0.0, 0.7, 1.0, 2.0}) BOOST_TEST(!table.jumps_at(time));
  BOOST_TEST(Waveform::table({0.0, 1.0}, {0.0, 1.0}).jumps_at(5.0) == false);
}

BOOST_AUTO_TEST_CASE(unit_of_time_does_not_matter) {
  for (const double unit : {1e-9, 1e-3, 1.0, 1e9}) {
    const std::vector<Waveform> waveforms{
        Waveform::pulse(1.0, 0.0, 0.1 * unit), Waveform::pulse(1.0, 0.3 * unit, 1e-4 * unit),
        Waveform::pulse_train(1.0, 0.0, 0.1 * unit, 0.3 * unit),
        Waveform::table({0.0, 0.1 * unit, 0.1 * unit, 0.2 * unit}, {1.0, 1.0, 0.0, 2.0})};
    const std::vector<Waveform> same{Waveform::pulse(1.0, 0.0, 0.1), Waveform::pulse(1.0, 0.3, 1e-4),
                                     Waveform::pulse_train(1.0, 0.0, 0.1, 0.3),
                                     Waveform::table({0.0, 0.1, 0.1, 0.2}, {1.0, 1.0, 0.0, 2.0})};
    for (std::size_t i = 0; i < same.size(); ++i) {
      for (const double time : {0.0, 0.05, 0.1, 0.15, 0.3, 0.3001, 0.7}) {
        for (const Limit limit : {Limit::before, Limit::after}) {
          BOOST_TEST(std::abs(waveforms[i].at(time * unit, limit) - same[i].at(time, limit)) < 1e-12,
                     "waveform " << i << " at " << time << " in the unit " << unit);
        }
        const std::optional<double> discontinuity = same[i].next_discontinuity(time);
        const std::optional<double> scaled = waveforms[i].next_discontinuity(time * unit);
        BOOST_TEST_REQUIRE(discontinuity.has_value() == scaled.has_value());
        if (discontinuity) BOOST_TEST(std::abs(*scaled / unit - *discontinuity) < 1e-12);
      }
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
