#include <fmt/format.h>

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/scene/effective_scene.hpp"
#include "bie/scene/model_of.hpp"
#include "tests/scene/scene_text.hpp"

BOOST_AUTO_TEST_SUITE(wall_scene)

namespace {

constexpr const char* kFloor = "[wall]\npoint = [0, 0, -3]\nnormal = [0, 0, 2]\n";

const std::string conducting = "conductivity_in = 1\nconductivity_out = 2\n";

/// Whether a scene with these tables is refused in a one-line message containing `what`.
bool refuses(const std::string& tables, const std::string& what) {
  const std::string message = message_of(with_appended(tables));
  BOOST_TEST_MESSAGE(message);
  return message.find(what) != std::string::npos && message.starts_with("scene.toml:") &&
         message.find('\n') == std::string::npos;
}

std::string in_field(const std::string& field) { return "[electric]\nfield = " + field + "\n" + conducting; }

}  // namespace

BOOST_AUTO_TEST_CASE(a_wall_reaches_the_model) {
  const vehd::Scene scene =
      parsed(with_appended(in_field("[0, 0, 1]") + kFloor + "flow = \"no-slip\"\nfield = \"electrode\"\n"));
  const vehd::Wall wall = *vehd::model_of(scene).wall;
  BOOST_TEST((wall.point == vehd::Vector3(0.0, 0.0, -3.0)));
  BOOST_TEST((wall.normal == vehd::Vector3::UnitZ()));
  BOOST_TEST((wall.flow == vehd::WallFlow::no_slip));
  BOOST_TEST((wall.field == vehd::WallField::electrode));
  BOOST_TEST((parsed(vehd::effective_scene(scene)) == scene));
}

BOOST_AUTO_TEST_CASE(its_place_has_units) {
  std::string shape_in_units = si_scene();
  const std::string flow = "[flow]\nkind = \"shear\"\nrate = \"2 1/s\"\n";
  shape_in_units.erase(shape_in_units.find(flow), flow.size());
  const vehd::Scene scene =
      parsed(shape_in_units + "[wall]\npoint = [0, 0, \"-30 um\"]\nnormal = [0, 0, 1]\nflow = \"no-slip\"\n");
  BOOST_TEST(std::abs(scene.wall->point[2] + 3.0) < 1e-12);
}

BOOST_AUTO_TEST_CASE(walls_without_effect_or_normal_are_refused) {
  BOOST_TEST(refuses("[wall]\nflow = \"no-slip\"\n", "missing key \"normal\" in [wall]"));
  BOOST_TEST(refuses("[wall]\nnormal = [0, 0, 0]\nflow = \"no-slip\"\n", "\"normal\" in [wall] is 0, 0, 0"));
  BOOST_TEST(refuses(kFloor, "[wall] has no effect"));
  BOOST_TEST(refuses(kFloor + std::string("flow = \"slip\"\n"), "did you mean \"no-slip\"?"));
  BOOST_TEST(refuses(kFloor + std::string("field = \"insulating\"\n"), "has no effect without [electric]"));
  BOOST_TEST(refuses(
      "[membrane]\nmobile = false\n" + in_field("[1, 0, 0]") + kFloor + "flow = \"no-slip\"\nfield = \"insulating\"\n",
      "while \"mobile\" in [membrane] is false"));
}

BOOST_AUTO_TEST_CASE(vesicles_are_on_the_side_of_the_normal_and_not_too_near) {
  const auto below = [](const char* height) {
    return "[wall]\npoint = [0, 0, " + std::string(height) + "]\nnormal = [0, 0, 1]\nflow = \"no-slip\"\n";
  };
  BOOST_TEST(message_of(with_appended(below("-2.1"))).empty());
  BOOST_TEST(refuses(below("-2.0005"), "radii from the wall; accepted: at least 0.001"));
  BOOST_TEST(refuses(below("0"), "radii beyond the wall; accepted: all of it on the side that \"normal\" points to"));
  BOOST_TEST(refuses(below("-2.1") + "[[vesicle]]\nname = \"high\"\nshape.centre = [0, 0, 6]\n[[vesicle]]\nname = "
                                     "\"low\"\nshape.centre = [0, 0, -0.5]\n",
                     "vesicle \"low\" extends "));
}

BOOST_AUTO_TEST_CASE(fields_meet_the_condition_at_the_wall) {
  const std::string insulating = kFloor + std::string("field = \"insulating\"\n");
  const std::string electrode = kFloor + std::string("field = \"electrode\"\n");
  BOOST_TEST(message_of(with_appended(in_field("[1, 2, 0]") + insulating)).empty());
  BOOST_TEST(message_of(with_appended(in_field("[0, 0, -3]") + electrode)).empty());
  BOOST_TEST(refuses(in_field("[1, 2, 0.1]") + insulating, "crosses an insulating wall"));
  BOOST_TEST(refuses(in_field("[0, 1, 1]") + electrode, "has a part along an electrode"));
  BOOST_TEST(refuses("[electric]\nfield = [0, 0, 1]\nconductivity_in = 0\nconductivity_out = 2\n" + electrode,
                     "is 0; accepted with \"field\" in [wall]"));
}

BOOST_AUTO_TEST_CASE(flows_meet_the_condition_at_the_wall) {
  const auto wall = [](const char* height, const char* normal, const char* flow) {
    return fmt::format("[wall]\npoint = [0, 0, {}]\nnormal = {}\nflow = \"{}\"\n", height, normal, flow);
  };
  const std::string above = "[[vesicle]]\nshape.centre = [0, 0, 4]\n[[vesicle]]\nshape.centre = [4, 0, 4]\n";
  const std::string shear = "[flow]\nkind = \"shear\"\nrate = 1\n";
  BOOST_TEST(message_of(with_appended(shear + wall("0", "[0, 0, 1]", "no-slip") + above)).empty());
  BOOST_TEST(refuses(shear + wall("-3", "[0, 0, 1]", "no-slip") + above, "[flow] does not vanish on the wall"));
  BOOST_TEST(refuses(shear + wall("0", "[0, 0.1, 1]", "no-slip") + above, "[flow] does not vanish on the wall"));
  BOOST_TEST(
      refuses(shear + wall("0", "[0, 0, 1]", "stress-free") + above, "crosses the stress-free wall or shears it"));
  const std::string extension = "[flow]\nkind = \"axisymmetric_extension\"\nrate = 1\n";
  BOOST_TEST(message_of(with_appended(extension + wall("0", "[0, 0, 1]", "stress-free") + above)).empty());
  BOOST_TEST(refuses(extension + wall("-1", "[0, 0, 1]", "stress-free") + above, "crosses the stress-free wall"));
  const std::string tube = "[flow]\nkind = \"poiseuille\"\ncentre_velocity = 1\nradius = 8\n";
  BOOST_TEST(message_of(with_appended(tube + wall("0", "[0, 0, 1]", "stress-free") + above)).empty());
  BOOST_TEST(refuses(tube + wall("0", "[0, 0, 1]", "no-slip") + above, "[flow] does not vanish on the wall"));
  const std::string slit = tube + "section = \"slit\"\n";
  BOOST_TEST(message_of(with_appended(slit + wall("-8", "[0, 0, 1]", "no-slip") + above)).empty());
  BOOST_TEST(message_of(with_appended(slit + wall("0", "[0, 0, 1]", "stress-free") + above)).empty());
  BOOST_TEST(refuses(slit + wall("-7", "[0, 0, 1]", "no-slip") + above, "[flow] does not vanish on the wall"));
}

BOOST_AUTO_TEST_SUITE_END()
