#include "bie/pictures/sweep_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>

BOOST_AUTO_TEST_SUITE(sweep_axis)

namespace {

std::vector<std::string> texts_of(const std::vector<double>& values, const std::string& unit) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(fmt::format("{} {}", value, unit));
  return texts;
}

}  // namespace

// Twenty cells a row over six decades: no cell belongs to a round number, the ticks do.
BOOST_AUTO_TEST_CASE(cells_of_even_factors_have_ticks_at_powers_of_ten) {
  std::vector<double> values;
  for (int i = 0; i < 20; ++i) values.push_back(std::pow(10.0, 2.0 + 6.0 * i / 19.0));
  const vehd::SweepAxis axis = vehd::axis_of_cells("electric.waveform.frequency", texts_of(values, "Hz"));
  BOOST_TEST_REQUIRE(axis.places.size() == values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    BOOST_TEST(axis.places[i] == (static_cast<double>(i) + 0.5) / 20.0, boost::test_tools::tolerance(1e-9));
  }
  BOOST_TEST_REQUIRE(axis.ticks.size() >= 3U);
  BOOST_TEST(axis.ticks.front().text == "10^{2}");
  BOOST_TEST(axis.ticks.front().place == axis.places.front(), boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(cells_of_even_steps_have_ticks_at_round_numbers) {
  std::vector<double> values;
  for (int i = 0; i < 9; ++i) values.push_back(0.75 + 0.03 * i);
  const vehd::SweepAxis axis = vehd::axis_of_cells("shape.reduced_volume", texts_of(values, ""));
  BOOST_TEST_REQUIRE(!axis.ticks.empty());
  for (const vehd::SweepTick& tick : axis.ticks) {
    const double value = std::stod(tick.text);
    // Nine cells of 0.03 from 0.735 to 1.005.
    BOOST_TEST(tick.place == (value - 0.735) / 0.27, boost::test_tools::tolerance(1e-6));
  }
}

BOOST_AUTO_TEST_CASE(other_cells_have_the_value_that_is_theirs) {
  const std::vector<double> values{1.0, 2.0, 3.0, 5.0, 8.0, 9.0, 20.0, 100.0};
  const vehd::SweepAxis axis = vehd::axis_of_cells("fluid.viscosity_ratio", texts_of(values, ""));
  for (const vehd::SweepTick& tick : axis.ticks) {
    BOOST_TEST(std::ranges::any_of(values, [&](double value) { return fmt::format("{}", value) == tick.text; }),
               tick.text);
  }
}

BOOST_AUTO_TEST_CASE(numbers_of_several_units_keep_them) {
  const std::vector<std::string> values{"0.2 ms", "300 us", "0.4", "1 ms"};
  for (const vehd::SweepAxis& axis :
       {vehd::axis_of_cells("shape.time", values), vehd::axis_of_values("shape.time", values, false)}) {
    BOOST_TEST_REQUIRE(axis.ticks.size() == values.size());
    for (std::size_t i = 0; i < values.size(); ++i) BOOST_TEST(axis.ticks[i].text == values[i]);
  }
}

// Regression: whole vectors ran out of the picture.
BOOST_AUTO_TEST_CASE(vectors_that_differ_in_one_component_are_that_number) {
  std::vector<std::string> values, components;
  for (const char* component : {"2 V/cm", "5 V/cm", "20 V/cm", "400 V/cm", "1000 V/cm"}) {
    components.emplace_back(component);
    values.push_back(fmt::format("[0, 0.5, \"{}\"]", component));
  }
  const auto compare = [](const vehd::SweepAxis& axis, const vehd::SweepAxis& expected) {
    BOOST_TEST(axis.label == expected.label);
    BOOST_TEST(axis.label.ends_with("(V/cm)"), axis.label);
    BOOST_TEST(axis.places == expected.places, boost::test_tools::per_element());
    BOOST_TEST_REQUIRE(axis.ticks.size() == expected.ticks.size());
    for (std::size_t i = 0; i < axis.ticks.size(); ++i) BOOST_TEST(axis.ticks[i].text == expected.ticks[i].text);
  };
  compare(vehd::axis_of_cells("electric.field", values), vehd::axis_of_cells("electric.field", components));
  compare(vehd::axis_of_values("electric.field", values, false),
          vehd::axis_of_values("electric.field", components, false));
  const std::vector<std::string> several{"[0, 0, 1]", "[0, 1, 0]"};
  BOOST_TEST(vehd::axis_of_cells("electric.field", several).ticks[1].text == several[1]);
}

BOOST_AUTO_TEST_SUITE_END()
