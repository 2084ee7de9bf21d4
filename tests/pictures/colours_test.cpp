#include "bie/pictures/colours.hpp"

#include <boost/test/unit_test.hpp>

#include "bie/pictures/colour_bar.hpp"
#include "bie/pictures/shape_field.hpp"

using namespace vehd;

namespace {

ColourRange range_of(const Vector& values) {
  const Vector weights = Vector::Ones(values.size());
  return robust_range(std::vector<FieldReach>{reach_of(values, weights)}, false);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(colour_range)

BOOST_AUTO_TEST_CASE(values_of_both_signs_have_a_range_about_zero) {
  const ColourRange both = range_of(Vector::LinSpaced(101, -0.5, 2.0));
  BOOST_TEST(both.both_signs);
  BOOST_TEST(both.lower == -2.0);
  BOOST_TEST(both.upper == 2.0);
  const ColourRange one = range_of(Vector::LinSpaced(101, 0.5, 2.0));
  BOOST_TEST(!one.both_signs);
  BOOST_TEST(one.lower == 0.5);
  BOOST_TEST(one.upper == 2.0);
  // Hardly any value is negative: a diverging map would leave only half of the colours to the others.
  BOOST_TEST(!range_of(Vector::LinSpaced(101, -0.05, 2.0)).both_signs);
}

BOOST_AUTO_TEST_CASE(one_spot_does_not_take_the_colours_from_all_others) {
  Vector values = Vector::LinSpaced(10000, 1.0, 2.0);
  values[9999] = 500.0;
  const ColourRange range = range_of(values);
  BOOST_TEST(range.upper < 2.1);
  BOOST_TEST(range.above);
  BOOST_TEST(!range.below);
  BOOST_TEST(range.lower == 1.0);
}

BOOST_AUTO_TEST_CASE(constants_have_a_range_too) {
  for (const double constant : {0.0, 3.0, -2e-7}) {
    Vector values = Vector::Constant(50, constant);
    values[7] *= 1.0 + 1e-13;
    const ColourRange range = range_of(values);
    BOOST_TEST(range.lower < constant);
    BOOST_TEST(range.upper > constant);
  }
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  BOOST_TEST(range_of(Vector::Constant(5, not_a_number)).upper == 1.0);
}

// Regression: a value of 1e-15 was treated as zero, whatever the units.
BOOST_AUTO_TEST_CASE(the_range_goes_with_the_unit) {
  const Vector values = Vector::LinSpaced(101, 0.5, 2.0);
  for (const double scale : {1e-30, 1e-15, 1e12}) {
    const ColourRange range = range_of(scale * values);
    BOOST_TEST(range.lower == scale * 0.5);
    BOOST_TEST(range.upper == scale * 2.0);
  }
}

BOOST_AUTO_TEST_CASE(the_first_instants_do_not_take_the_colours_from_all_others) {
  std::vector<FieldReach> times(40, FieldReach{1.0, 2.0, 1.0, 2.0});
  times[0] = {-300.0, 500.0, -300.0, 500.0};
  const ColourRange range = robust_range(times, false);
  BOOST_TEST(range.lower == 1.0);
  BOOST_TEST(range.upper == 2.0);
  BOOST_TEST(range.below);
  BOOST_TEST(range.above);
  // A twentieth of a few times is less than one of them.
  times.resize(6);
  BOOST_TEST(robust_range(times, false).upper == 500.0);
}

BOOST_AUTO_TEST_CASE(colours_diverge_where_the_sign_matters) {
  const ColourRange range = robust_range(std::vector<FieldReach>{FieldReach{0.5, 2.0, 0.5, 2.0}}, true);
  BOOST_TEST(range.both_signs);
  BOOST_TEST(range.lower == -2.0);
  BOOST_TEST(robust_range(std::vector<FieldReach>{FieldReach{3.0, 3.0, 3.0, 3.0}}, true).lower == -3.0);
}

BOOST_AUTO_TEST_CASE(every_colour_bar_has_three_ticks_and_texts_that_keep_apart) {
  for (const auto& [lower, upper] :
       {std::pair{-0.24, 0.24}, {-12.7, 3.1e3}, {1e-9, 2.7e-9}, {-1.003, -0.998}, {0.0, 5.0}}) {
    const ColourBar bar = colour_bar({lower, upper}, "tension λ", "µN/m");
    BOOST_TEST(bar.ticks.size() >= 3);
    Page page;
    const Box box{0.0, 0.0, width_of(bar), 84.0};
    draw_colour_bar(page, bar, ColourMap::sequential(), box);
    BOOST_TEST(page.texts.size() == bar.ticks.size() + bar.title.size());
    for (std::size_t i = 0; i < page.texts.size(); ++i) {
      const Box text = box_of(page.texts[i]);
      BOOST_TEST(text.right <= box.right + 1e-9, page.texts[i].text);
      for (std::size_t k = 0; k < i; ++k) {
        // Lines may touch: half of the reserved height is the space between lines.
        const double apart = std::abs(page.texts[i].at[1] - page.texts[k].at[1]);
        BOOST_TEST(apart >= 0.9 * page.texts[i].size, page.texts[i].text + " over " + page.texts[k].text);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(poration_has_the_symbol_of_its_model) {
  vehd::Scene scene;
  scene.poration.emplace().model = vehd::PorationModel::porosity;
  BOOST_TEST(vehd::field_text(vehd::shape_field("poration"), scene) == "X");
  scene.poration->model = vehd::PorationModel::pores;
  BOOST_TEST(vehd::field_text(vehd::shape_field("poration"), scene) == "ln(N/N₀)");
  BOOST_TEST(vehd::field_text(vehd::shape_field("tension"), scene) == "tension λ");
}

BOOST_AUTO_TEST_CASE(diverging_colours_are_white_at_their_place) {
  for (const double white : {0.1, 0.5, 0.8}) {
    const Colour at = ColourMap::diverging(white).at(white), middle = ColourMap::diverging().at(0.5);
    for (int c = 0; c < 3; ++c) BOOST_TEST(at[c] == middle[c], boost::test_tools::tolerance(1e-12));
  }
}

BOOST_AUTO_TEST_SUITE_END()
