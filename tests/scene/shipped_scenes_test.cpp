#include "bie/scene/shipped_scenes.hpp"

#include <boost/test/unit_test.hpp>

#include "bie/scene/reader.hpp"

BOOST_AUTO_TEST_SUITE(shipped_scenes)

BOOST_AUTO_TEST_CASE(have_a_title_and_can_be_read) {
  BOOST_TEST(vehd::shipped_scenes().size() >= 6u);
  for (const vehd::ShippedScene& scene : vehd::shipped_scenes()) {
    BOOST_CHECK_NO_THROW(vehd::parse_scene(std::string(scene.text), std::string(scene.name), "."));
    const std::string title = vehd::title_of(scene);
    BOOST_TEST(title.size() > 20u, scene.name);
    BOOST_TEST(title.size() < 140u, scene.name << ": " << title);
  }
}

BOOST_AUTO_TEST_CASE(titles_are_the_first_sentence) {
  BOOST_TEST(vehd::title_of({"a", "# A shape\n#  in 2.5 um. More\n\n[shape]\n"}) == "A shape in 2.5 um");
  BOOST_TEST(vehd::title_of({"a", "# Alone"}) == "Alone");
  BOOST_TEST(vehd::title_of({"a", "[shape]\n# no title\n"}) == "");
}

BOOST_AUTO_TEST_SUITE_END()
