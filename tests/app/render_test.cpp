#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include "tests/app/program.hpp"

namespace {

/// The set-up for tests installs all of this; a manual build may lack it.
bool can_render() {
  const bool available = run_command({"sh", "-c", "command -v xvfb-run && command -v pvpython"}).exit_code == 0;
  if (!available)
    BOOST_TEST_MESSAGE("skipped: xvfb-run or pvpython (Debian packages xvfb, python3-paraview) is missing");
  return available;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(xdmf, *boost::unit_test::label("once"))

namespace {

/// A run to time 1 with snapshots every 0.5.
/// @return  data that the viewer finds
nlohmann::json viewer_sees(const std::string& scene, int n_vesicles) {
  const TemporaryDirectory directory;
  write_text(directory / "scene.toml", scene);
  const ProgramResult run = run_vehd({"run", directory / "scene.toml", "-o", directory / "out", "--no-plot"});
  BOOST_TEST_REQUIRE(run.exit_code == 0, run.errors);
  const ProgramResult render =
      run_command({"xvfb-run", "-a", "pvpython", std::string(VEHD_SOURCE_DIR) + "/tests/app/render_xdmf.py",
                   directory / "out", directory / "picture.png"});
  BOOST_TEST_REQUIRE(render.exit_code == 0, render.output + render.errors);
  const auto result = nlohmann::json::parse(render.output);
  BOOST_TEST(result.at("times").get<std::vector<double>>() == (std::vector<double>{0.0, 0.5, 1.0}),
             boost::test_tools::per_element());
  BOOST_TEST(result.at("boundary_edges").get<int>() == 0);
  BOOST_TEST(result.at("points").get<int>() == n_vesicles * (7 * 14 + 2));
  // Flat triangles inside a smooth surface: a few per cent too small at order 6.
  const double ratio = result.at("area_ratio").get<double>();
  BOOST_TEST((ratio > 0.93 && ratio < 1.0), ratio);
  BOOST_TEST(result.at("foreground_fraction").get<double>() > 0.05);
  BOOST_TEST(result.at("colours").get<int>() > 20);
  const auto fields = result.at("fields").get<std::vector<std::string>>();
  for (const char* field : {"Vm", "q", "tension", "velocity", "force_bending", "force_tension", "force_electric"}) {
    BOOST_TEST((std::find(fields.begin(), fields.end(), field) != fields.end()), field);
  }
  return result;
}

}  // namespace

BOOST_AUTO_TEST_CASE(viewer_sees_a_closed_surface_with_its_fields) {
  if (can_render()) viewer_sees(quick_scene("1.0"), 1);
}

BOOST_AUTO_TEST_CASE(viewer_sees_every_vesicle) {
  const std::string above = "[[vesicle]]\n[[vesicle]]\nshape.centre = [0, 0, 4]\n";
  if (can_render()) viewer_sees(quick_scene("1.0") + above, 2);
}

BOOST_AUTO_TEST_CASE(viewer_sees_the_wall_below_the_vesicle) {
  if (!can_render()) return;
  const nlohmann::json result =
      viewer_sees(quick_scene("1.0") +
                      "[wall]\npoint = [0, 0, -3]\nnormal = [0, 0, 1]\nflow = \"no-slip\"\nfield = \"electrode\"\n",
                  1);
  BOOST_TEST_REQUIRE(result.at("walls").size() == 1);
  const auto& wall = result.at("walls")[0];
  BOOST_TEST(wall.at("cells") == 1);
  const auto bounds = wall.at("bounds").get<std::vector<double>>();
  BOOST_TEST(bounds[0] < -5.0);
  BOOST_TEST(bounds[1] > 5.0);
  BOOST_TEST(std::max(std::abs(bounds[4] + 3.0), std::abs(bounds[5] + 3.0)) < 1e-6);
}

BOOST_AUTO_TEST_SUITE_END()
