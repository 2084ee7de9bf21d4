#include "bie/scene/nearest_name.hpp"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(nearest_name)

BOOST_AUTO_TEST_CASE(edit_distance_counts_edits) {
  BOOST_TEST(vehd::edit_distance("", "abc") == 3);
  BOOST_TEST(vehd::edit_distance("order", "order") == 0);
  BOOST_TEST(vehd::edit_distance("oder", "order") == 1);
  BOOST_TEST(vehd::edit_distance("oredr", "order") == 1);
  BOOST_TEST(vehd::edit_distance("viscocity", "viscosity") == 1);
}

BOOST_AUTO_TEST_CASE(far_words_get_the_whole_list) {
  BOOST_TEST(vehd::suggestion("zzzzzzzz", {"rate", "kind"}) == "accepted: rate, kind");
  BOOST_TEST(vehd::suggestion("rates", {"rate", "kind"}) == "did you mean \"rate\"?");
}

BOOST_AUTO_TEST_CASE(very_long_words_are_harmless) {
  BOOST_TEST(vehd::suggestion(std::string(1000000, 'x'), {"rate"}) == "accepted: rate");
}

BOOST_AUTO_TEST_SUITE_END()
