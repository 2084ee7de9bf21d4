#include "bie/runs/sweep/sweep_runs.hpp"

#include <boost/test/unit_test.hpp>
#include <set>

#include "bie/support/errors.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scenes.hpp"

BOOST_AUTO_TEST_SUITE(sweep_runs)

namespace {

std::vector<vehd::SweepRun> runs_with(const std::string& scene, const std::string& keys) {
  const TemporaryDirectory directory;
  write_text(directory / "base.toml", scene);
  write_text(directory / "sweep.toml", "scene = \"base.toml\"\n[vary]\n" + keys);
  return vehd::runs_of(vehd::read_sweep(directory / "sweep.toml"));
}

}  // namespace

BOOST_AUTO_TEST_CASE(directories_are_named_by_the_content_of_a_scene_and_not_its_form) {
  const auto runs = runs_with(quick_scene(), "\"numerics.dt\" = {values = [0.25, 0.5]}\n");
  const auto others = runs_with("# The same.\n" + quick_scene("3"), "\"numerics.dt\" = {values = [0.50]}\n");
  BOOST_TEST(runs[0].name.size() == 16u);
  BOOST_TEST(runs[0].name != runs[1].name);
  BOOST_TEST(runs[1].name == others[0].name);
}

BOOST_AUTO_TEST_CASE(many_scenes_have_as_many_names) {
  std::set<std::string> names;
  for (int i = 0; i < 100000; ++i) names.insert(vehd::hash_of("rate = 0." + std::to_string(i)));
  BOOST_TEST(names.size() == 100000u);
}

BOOST_AUTO_TEST_CASE(values_that_the_whole_scene_refuses_are_refused_with_its_reason) {
  // Each value is valid for its key; the scene as a whole lacks a frequency if the waveform is "ac".
  const auto runs = runs_with(quick_scene(),
                              "\"electric.initial_Vm\" = {values = [\"zero\", \"steady\"]}\n"
                              "\"membrane.conductance\" = {values = [1.0]}\n"
                              "\"electric.waveform.kind\" = {values = [\"dc\", \"ac\"]}\n");
  BOOST_TEST(runs.size() == 4u);
  BOOST_TEST(runs[0].scene.has_value());
  BOOST_TEST(!runs[1].scene.has_value());
  BOOST_TEST(runs[1].refusal.find("frequency") != std::string::npos, runs[1].refusal);
  BOOST_TEST(runs[1].name == "");
}

BOOST_AUTO_TEST_CASE(columns_are_those_of_the_history) {
  const TemporaryDirectory directory;
  write_text(directory / "base.toml", quick_scene());
  const auto columns = [&](const std::string& names) {
    write_text(directory / "sweep.toml",
               "scene = \"base.toml\"\ncolumns = [" + names + "]\n[vary]\n\"numerics.dt\" = {values = [0.25]}\n");
    return vehd::columns_of(vehd::read_sweep(directory / "sweep.toml"));
  };
  BOOST_TEST(columns("\"extent_z\"").size() == 1u);
  BOOST_TEST(columns("").size() == 5u);
  BOOST_CHECK_EXCEPTION(static_cast<void>(columns("\"extent_q\"")), vehd::InputError, [&](const auto& error) {
    return std::string(error.what()) == directory / "sweep.toml" +
                                            ":2: \"columns\" has \"extent_q\", which history.csv of "
                                            "this scene does not have; did you mean \"extent_x\"?";
  });
}

BOOST_AUTO_TEST_SUITE_END()
