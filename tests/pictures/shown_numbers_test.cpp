#include "bie/pictures/shown_numbers.hpp"

#include <boost/test/unit_test.hpp>
#include <set>

#include "bie/pictures/page.hpp"

using namespace vehd;

BOOST_AUTO_TEST_SUITE(shown_numbers)

BOOST_AUTO_TEST_CASE(every_scale_has_three_round_ticks_at_least) {
  for (const double size : {1e-12, 3.3e-7, 0.017, 0.5, 1.0, 7.7, 1234.5, 8.1e11}) {
    for (const auto& [lower, upper] :
         {std::pair{-1.0, 1.0}, {0.0, 1.0}, {-5.03, -4.96}, {0.9999, 1.0001}, {-1.0, 17.0}}) {
      const std::vector<double> ticks = round_ticks(size * lower, size * upper);
      BOOST_TEST(ticks.size() >= 3);
      BOOST_TEST(ticks.size() <= 12);
      BOOST_TEST(std::is_sorted(ticks.begin(), ticks.end()));
      const double room = 1e-6 * size * (upper - lower);
      BOOST_TEST(ticks.front() >= size * lower - room);
      BOOST_TEST(ticks.back() <= size * upper + room);
      int power = 0;
      const std::vector<std::string> texts = tick_texts(ticks, power);
      BOOST_TEST(std::set<std::string>(texts.begin(), texts.end()).size() == ticks.size());
      for (const std::string& text : texts) BOOST_TEST(text.size() <= 11, text);
    }
  }
}

BOOST_AUTO_TEST_CASE(texts_of_ticks_are_those_of_their_numbers) {
  int power = 1;
  BOOST_TEST(tick_texts({-0.2, 0.0, 0.2}, power) == (std::vector<std::string>{"\u22120.2", "0.0", "0.2"}));
  BOOST_TEST(power == 0);
  BOOST_TEST(tick_texts({0.0, 2e-6, 4e-6}, power) == (std::vector<std::string>{"0", "2", "4"}));
  BOOST_TEST(power == -6);
  BOOST_TEST(tick_texts({100.0, 200.0}, power) == (std::vector<std::string>{"100", "200"}));
  BOOST_TEST(power == 0);
}

BOOST_AUTO_TEST_CASE(powers_of_ten_between_a_tenth_and_a_thousand_are_decimals) {
  BOOST_TEST(power_texts({-1, 0, 1, 2, 3}) == (std::vector<std::string>{"0.1", "1", "10", "100", "1000"}));
  BOOST_TEST(power_texts({-2, 0}) == (std::vector<std::string>{"10^{-2}", "10^{0}"}));
  BOOST_TEST(power_texts({2, 4}) == (std::vector<std::string>{"10^{2}", "10^{4}"}));
}

BOOST_AUTO_TEST_CASE(different_times_have_different_texts) {
  BOOST_TEST(distinct_texts({0.0, 0.5, 10.0}) == (std::vector<std::string>{"0", "0.5", "10"}));
  BOOST_TEST(distinct_texts({1.0, 1.0001}) == (std::vector<std::string>{"1", "1.0001"}));
  BOOST_TEST(distinct_texts({0.0, 1.563e-5}) == (std::vector<std::string>{"0", "1.56 × 10^{\u22125}"}));
}

BOOST_AUTO_TEST_CASE(units_are_those_of_the_run) {
  UnitsScene scales;
  scales.length = 1e-5;
  scales.time = 1e-3;
  const OutputUnits units(scales, {{"length", "um"}, {"time", "us"}});
  const auto is = [](const ShownUnit& shown, const std::string& unit, double factor) {
    BOOST_TEST(shown.unit == unit);
    BOOST_TEST(shown.factor == factor, boost::test_tools::tolerance(1e-12));
  };
  is(shown_unit(units, "length"), "µm", 10.0);
  is(shown_unit(units, "1/length"), "1/µm", 0.1);
  is(shown_unit(units, "time"), "µs", 1000.0);
  is(shown_unit(units, "potential"), "", 1.0);
  is(shown_unit(OutputUnits(), "length"), "", 1.0);
}

BOOST_AUTO_TEST_CASE(texts_take_no_more_room_than_is_reserved) {
  // Measured with gnuplot and DejaVu Sans of size 1: each is at most this wide.
  BOOST_TEST(text_width("0123456789") >= 6.36);
  BOOST_TEST(text_width("t = 12.5 ms") >= 6.2);
  BOOST_TEST(text_width("curvature H") >= 6.3);
  BOOST_TEST(text_width("tension λ") >= 4.9);
  BOOST_TEST(text_width("V_m") >= 1.2);
  BOOST_TEST(text_width("ac\\_field") > text_width("ac_field"));
  const Box box = box_of({"t = 1", {100.0, 50.0}, 8.0, TextAnchor::centre, "#000000"});
  BOOST_TEST(box.left + box.right == 200.0, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(box.bottom + box.top == 100.0, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_SUITE_END()
