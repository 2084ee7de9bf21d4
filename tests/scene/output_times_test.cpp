#include <boost/test/unit_test.hpp>

#include "bie/scene/effective_scene.hpp"
#include "bie/scene/problem.hpp"
#include "bie/scene/run_times.hpp"
#include "tests/scene/scene_text.hpp"

BOOST_AUTO_TEST_SUITE(output_times)

BOOST_AUTO_TEST_CASE(windows_and_times_are_read_with_their_units) {
  const vehd::Scene scene = parsed(si_scene() +
                                   "[output]\nevery = \"100 ms\"\ntimes = [\"5 ms\", 0.25]\n"
                                   "[[output.window]]\nfrom = 0\nto = \"10 ms\"\nevery = \"1 ms\"\n"
                                   "[[output.window]]\nfrom = \"50 ms\"\nto = 1\nevery = \"10 ms\"\n");
  BOOST_TEST(scene.output.times == (std::vector<double>{0.01, 0.25}), boost::test_tools::per_element());
  BOOST_TEST_REQUIRE(scene.output.windows.size() == 2U);
  BOOST_TEST((scene.output.windows[0] == vehd::OutputWindow{0.0, 0.02, 0.002}));
  BOOST_TEST((scene.output.windows[1] == vehd::OutputWindow{0.1, 1.0, 0.02}));
  BOOST_TEST((parsed(vehd::effective_scene(scene)) == scene));
  const vehd::SnapshotTimes& times = vehd::events_of(scene).snapshots;
  BOOST_TEST(*times.next(0.0, 2.0) == 0.002);
  BOOST_TEST(*times.next(0.02, 2.0) == 0.1);
}

BOOST_AUTO_TEST_CASE(messages_about_wrong_windows_and_times_name_the_accepted_ones) {
  const auto message = [](const std::string& output) { return message_of(with_appended("[output]\n" + output)); };
  BOOST_TEST(message("window = [{from = 1, to = 1, every = 0.1}]\n") ==
             "scene.toml:9: \"window\" in [output] goes from 1 to 1 every 0.1; accepted: a later \"to\" and an "
             "\"every\" > 0");
  BOOST_TEST(message("window = [{from = 0, to = 1, every = 0}]\n") ==
             "scene.toml:9: \"window\" in [output] goes from 0 to 1 every 0; accepted: a later \"to\" and an "
             "\"every\" > 0");
  BOOST_TEST(
      message("window = [{from = 0, to = 1}]\n") ==
      "scene.toml:9: \"window\" in [output] has an entry without \"every\"; accepted: entries {from = time, to = "
      "time, every = time}, each >= 0");
  BOOST_TEST(message("window = [{from = 0, to = 1, every = 1, until = 2}]\n") ==
             "scene.toml:9: unknown key \"until\" in an entry of \"window\" in [output]; accepted: from, to, every");
  BOOST_TEST(
      message("window = 3\n") ==
      "scene.toml:9: \"window\" in [output] is 3; accepted: entries {from = time, to = time, every = time}, each "
      ">= 0");
  BOOST_TEST(message("times = [0.5, 0.25]\n") ==
             "scene.toml:9: \"times\" in [output] falls to 0.25; accepted: ascending times");
  BOOST_TEST(message("window = [{from = 0, to = 1, every = 1e-9}]\n") ==
             "scene.toml:9: \"window\" in [output] makes 1e+09 snapshots; accepted: at most 999999");
}

BOOST_AUTO_TEST_CASE(times_of_a_run_are_sorted_and_compared_with_it) {
  const vehd::Scene scene = parsed(si_scene() + "[electric.waveform]\nkind = \"ac\"\nfrequency = \"5 Hz\"\n");
  const auto times = vehd::run_times(scene, vehd::dimensionless_groups(scene));
  std::vector<std::string> symbols;
  for (const vehd::RunTime& time : times) symbols.push_back(time.symbol);
  const std::vector<std::string> expected = {"t_MW", "t_m", "t_el", "1/f", "t_γ", "t_end", "t_κ"};
  BOOST_TEST(symbols == expected, boost::test_tools::per_element());
  BOOST_TEST(times[5].text() == "1 s");
  BOOST_TEST(*times[5].seconds == 1.0, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(times[6].meaning == "μa³/κ_B: shapes relax by bending; the run lasts 0.02 t_κ");
  BOOST_TEST(!vehd::run_times(parsed(with_appended("")), {})[0].seconds.has_value());
}

BOOST_AUTO_TEST_SUITE_END()
