#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "bie/potentials/nearest_points.hpp"
#include "bie/scene/effective_scene.hpp"
#include "bie/scene/shapes/initial_shape.hpp"
#include "bie/scene/shapes/placement.hpp"
#include "bie/scene/vesicles.hpp"
#include "tests/scene/scene_text.hpp"

BOOST_AUTO_TEST_SUITE(suspension)

namespace {

/// A scene whose lines 1 to 7 are fixed; [suspension] is line 8.
std::string with(const std::string& keys) {
  return "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 1.0, 1.5]\n[numerics]\ndt = 0.1\nend_time = 1.0\norder = 8\n"
         "[suspension]\n" +
         keys;
}

}  // namespace

BOOST_AUTO_TEST_CASE(vesicles_lie_apart_and_within_the_region) {
  const vehd::Scene scene =
      parsed(with("kind = \"box\"\nsize = [8, 9, 10]\ncentre = [1, 0, 0]\ncount = 12\ngap = 0.2\n"));
  BOOST_TEST(scene.vesicles.size() == 12);
  BOOST_TEST(!scene.suspension.has_value());
  std::vector<vehd::Matrix> positions;
  for (const vehd::Scene& one : vehd::each_alone(scene)) {
    positions.push_back(vehd::initial_position(one));
    BOOST_TEST(std::abs(one.shape.centre[0] - 1.0) <= 2.5);
    BOOST_TEST(std::abs(one.shape.centre[1]) <= 3.0);
    BOOST_TEST(std::abs(one.shape.centre[2]) <= 3.5);
  }
  // √(area/4π) of the prolate is above 1.
  BOOST_TEST(vehd::close_pairs(positions, 0.0).front().points.gap >= 0.2);
  // The effective scene contains the placed vesicles, and placement is reproducible.
  const std::string text = vehd::effective_scene(scene);
  BOOST_TEST(text.find("[suspension]") == std::string::npos);
  BOOST_TEST((parsed(text) == scene));
  BOOST_TEST((parsed(with("kind = \"box\"\nsize = [8, 9, 10]\ncentre = [1, 0, 0]\ncount = 12\ngap = 0.2\n")) == scene));
  BOOST_TEST(
      (parsed(with("kind = \"box\"\nsize = [8, 9, 10]\ncentre = [1, 0, 0]\ncount = 12\ngap = 0.2\nseed = 2\n")) !=
       scene));
}

BOOST_AUTO_TEST_CASE(a_volume_fraction_is_that_of_the_region) {
  // Each vesicle takes 1.5 · 4π/3 in a ball of 4π/3 · 125.
  const vehd::Scene scene =
      parsed(with("kind = \"ball\"\nradius = 5\nvolume_fraction = 0.1\norientation = \"aligned\"\n"));
  BOOST_TEST(scene.vesicles.size() == 8);
  for (const vehd::VesicleScene& vesicle : scene.vesicles) {
    BOOST_TEST(!vesicle.shape.rotation.has_value());
    BOOST_TEST(std::hypot(vesicle.shape.centre[0], vesicle.shape.centre[1], vesicle.shape.centre[2]) <= 3.5);
  }
}

// The mean of cos² of the angle with any axis is checked.
BOOST_AUTO_TEST_CASE(random_orientations_prefer_none) {
  const vehd::Scene scene = parsed(with("kind = \"box\"\nsize = [60, 60, 60]\ncount = 300\n"));
  vehd::Matrix3 mean = vehd::Matrix3::Zero();
  for (const vehd::Scene& one : vehd::each_alone(scene)) {
    const vehd::Vector3 axis = vehd::rotation_matrix(*one.shape.rotation).col(2);
    mean += axis * axis.transpose() / 300.0;
  }
  BOOST_TEST((mean - vehd::Matrix3::Identity() / 3.0).cwiseAbs().maxCoeff() < 0.06);
}

BOOST_AUTO_TEST_CASE(suspensions_that_do_not_fit_are_refused) {
  const std::string box = "kind = \"box\"\nsize = [8, 8, 8]\n";
  BOOST_TEST(message_of(with(box + "count = 1000000\n")) ==
             "scene.toml:11: \"count\" in [suspension] is 1000000; accepted: at most 500");
  BOOST_TEST(message_of(with("kind = \"box\"\nsize = [8e3, 8e3, 8e3]\nvolume_fraction = 0.1\n")) ==
             "scene.toml:11: \"volume_fraction\" in [suspension] makes 8.14873e+09 vesicles; accepted: 1 to 500");
  BOOST_TEST(message_of(with(box + "volume_fraction = 0\n"))
                 .ends_with("\"volume_fraction\" in [suspension] is 0; accepted: a number > 0 and <= 1"));
  BOOST_TEST(message_of(with(box)) == "scene.toml:9: [suspension] accepts one of \"count\" and \"volume_fraction\"");
  BOOST_TEST(message_of(with("kind = \"box\"\nsize = [2.5, 8, 8]\ncount = 2\n")) ==
             "scene.toml:10: the region of [suspension] is 2.5 wide; accepted: at least 3, the width of a vesicle");
  BOOST_TEST(
      message_of(with(box + "count = 100\n")) ==
      "scene.toml:11: 100 vesicles have 1.23 times the volume of the region of [suspension]; accepted: less than 1");
  const std::string full = message_of(with(box + "volume_fraction = 0.6\n"));
  BOOST_TEST(full.starts_with("scene.toml:11: no room for the vesicles of [suspension]: "), full);
  BOOST_TEST(message_of(with(box + "count = 2\n[[vesicle]]\nshape.centre = [0, 0, 0]\n")) ==
             "scene.toml:8: [suspension] beside tables [[vesicle]]; accepted: one of them");
}

BOOST_AUTO_TEST_SUITE_END()
