#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/scene/effective_scene.hpp"
#include "bie/scene/model_of.hpp"
#include "bie/scene/problem.hpp"
#include "bie/stepping/state/composition.hpp"
#include "tests/scene/scene_text.hpp"
#include "tests/support/files.hpp"

BOOST_AUTO_TEST_SUITE(effects_of_a_scene)

namespace {

/// An electric scene; the first appended line is line 12.
std::string electric(const std::string& more, const std::string& field = "0, 0, 1") {
  return with_appended("[electric]\nfield = [" + field + "]\nconductivity_in = 1\nconductivity_out = 2\n" + more);
}

std::string message_with(const std::string& more) { return message_of(with_appended(more)); }

double factor(const std::string& waveform, double time) {
  return vehd::model_of(parsed(electric("[electric.waveform]\n" + waveform))).electric->waveform.at(time);
}

bool has_effect(const std::string& more, const std::string& name) {
  const auto effects = vehd::effects_of(vehd::model_of(parsed(with_appended(more))));
  return std::any_of(effects.begin(), effects.end(), [&](const auto& effect) { return effect.name == name; });
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_waveform_is_made_of_its_keys) {
  BOOST_TEST(factor("kind = 'dc'", 7.0) == 1.0);
  BOOST_TEST(factor("kind = 'ac'\nfrequency = 0.5\nphase = 0.3", 0.25) == std::cos(0.25 * std::acos(-1.0) + 0.3));
  BOOST_TEST(factor("kind = 'pulse'\nstart = 1\nduration = 2", 2.0) == 1.0);
  BOOST_TEST(factor("kind = 'pulse'\nstart = 1\nduration = 2", 3.5) == 0.0);
  BOOST_TEST(factor("kind = 'pulse_train'\nduration = 1\nperiod = 3", 6.5) == 1.0);
  BOOST_TEST(factor("kind = 'pulse_train'\nduration = 1\nperiod = 3", 7.5) == 0.0);
  BOOST_TEST(factor("kind = 'table'\ntimes = [0, 1, 1, 2]\nvalues = [0, 1, -2, -4]", 1.5) == -3.0);
  BOOST_TEST(vehd::model_of(parsed(electric(""))).electric->waveform.at(3.0) == 1.0);
}

BOOST_AUTO_TEST_CASE(flow_has_a_waveform_of_its_own) {
  const vehd::Model model = vehd::model_of(
      parsed(electric("[flow]\nkind = 'shear'\nrate = 1\n[flow.waveform]\nkind = 'pulse'\nduration = 1\n")));
  BOOST_TEST(model.flow->waveform.at(2.0) == 0.0);
  BOOST_TEST(model.electric->waveform.at(2.0) == 1.0);
}

BOOST_AUTO_TEST_CASE(table_is_read_from_a_file_and_kept_in_the_scene) {
  const TemporaryDirectory folder;
  const std::string text = electric("[electric.waveform]\nkind = 'table'\npath = 'factor.csv'\n");
  write_text(folder / "factor.csv", "# time, factor\n0, 0\n0.5, 2.5  # peak\n\n1 0\n");
  const vehd::Scene scene = vehd::parse_scene(text, "scene.toml", folder / "");
  BOOST_TEST(vehd::model_of(scene).electric->waveform.at(0.25) == 1.25);
  BOOST_TEST((parsed(vehd::effective_scene(scene)) == scene));
  const auto message = [&] {
    try {
      vehd::parse_scene(text, "scene.toml", folder / "");
    } catch (const vehd::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  write_text(folder / "factor.csv", "0, 0\n1, high\n");
  BOOST_TEST(message().ends_with("factor.csv:2: is \"1, high\"; accepted: two finite numbers, time and factor"),
             message());
  std::filesystem::remove(folder / "factor.csv");
  BOOST_TEST(message().starts_with("scene.toml:"), message());
  BOOST_TEST(message().find("\"path\" in [electric.waveform] is /") != std::string::npos, message());
  BOOST_TEST(message().ends_with("factor.csv: no such file"), message());
}

BOOST_AUTO_TEST_CASE(every_effect_reads_back_to_the_same_scene) {
  for (const std::string& more :
       {std::string("[fluid]\nviscosity_ratio = 5\ndensity_difference = -1\n[gravity]\nacceleration = [0, 0, -9]\n"),
        std::string("[flow]\nkind = 'poiseuille'\ncentre_velocity = 2\nradius = 3\n[flow.waveform]\nkind = 'ac'\n"
                    "frequency = 1\n"),
        std::string("[membrane]\nbending_modulus = 1\nspontaneous_curvature = -0.4\n"),
        std::string("[membrane]\nmobile = false\n[electric]\nfield = [1, 0, 0]\nconductivity_in = 1\n"
                    "conductivity_out = 1\npermittivity_ratio = 0.5\n[electric.waveform]\nkind = 'table'\n"
                    "times = [0, 1]\nvalues = [1, 0]\n")}) {
    const vehd::Scene scene = parsed(with_appended(more));
    const std::string written = vehd::effective_scene(scene);
    BOOST_TEST((parsed(written) == scene), written);
  }
}

BOOST_AUTO_TEST_CASE(effects_are_those_that_the_scene_names) {
  const std::string gravity = "[fluid]\ndensity_difference = 1\n[gravity]\nacceleration = [0, 0, -1]\n";
  const std::string poiseuille = "[flow]\nkind = 'poiseuille'\ncentre_velocity = 1\nradius = 2\n";
  BOOST_TEST(has_effect(gravity, "gravity"));
  BOOST_TEST(has_effect(poiseuille, "Poiseuille flow"));
  BOOST_TEST(!has_effect(poiseuille, "background flow"));
  BOOST_TEST(has_effect("[fluid]\nviscosity_ratio = 2\n", "viscosity contrast"));
  BOOST_TEST(!has_effect("[fluid]\nviscosity_ratio = 1\n", "viscosity contrast"));
  BOOST_TEST(has_effect("[membrane]\nbending_modulus = 1\nspontaneous_curvature = 1\n", "spontaneous curvature"));
  for (const char* absent : {"bending", "gravity", "electric field", "background flow", "spontaneous curvature"}) {
    BOOST_TEST(!has_effect("", absent), absent);
  }
}

BOOST_AUTO_TEST_CASE(combinations_without_an_effect_are_refused_in_one_line) {
  BOOST_TEST(
      message_with("[gravity]\nacceleration = [0, 0, -1]\n") ==
      "scene.toml:9: [gravity] has no effect: \"density_difference\" in [fluid] is 0; accepted: any other value");
  BOOST_TEST(message_with("[fluid]\ndensity_difference = 1\n") ==
             "scene.toml:9: \"density_difference\" in [fluid] has no effect without [gravity]");
  BOOST_TEST(message_with("[fluid]\ndensity_difference = 1\n[gravity]\nacceleration = [0, 0, 0]\n") ==
             "scene.toml:11: \"acceleration\" in [gravity] is 0; accepted: a vector that is not zero");
  BOOST_TEST(message_with("[membrane]\nspontaneous_curvature = 1\n") ==
             "scene.toml:9: \"spontaneous_curvature\" in [membrane] has no effect without \"bending_modulus\"");
  BOOST_TEST(message_with("[membrane]\nmobile = false\n") ==
             "scene.toml:9: \"mobile\" in [membrane] is false without [electric]: nothing would ever change");
}

BOOST_AUTO_TEST_CASE(waveform_needs_something_to_act_on) {
  const std::string ac = "[electric.waveform]\nkind = 'ac'\nfrequency = 1\n";
  BOOST_TEST(message_with(ac) ==
             "scene.toml:8: [electric.waveform] without [electric]: there is nothing that it could act on");
  BOOST_TEST(message_of(electric("waveform = 'ac'\n")) ==
             "scene.toml:12: \"waveform\" in [electric] is the text 'ac'; accepted: a table [electric.waveform]");
}

// The control row of a sweep over a field or flow has the value zero.
BOOST_AUTO_TEST_CASE(a_zero_waveform_requires_no_step) {
  const std::string train = "kind = 'pulse_train'\nduration = 1e-12\nperiod = 2e-12\n";
  const std::string ac = "kind = 'ac'\nfrequency = 1e12\n";
  for (const std::string& waveform : {train, ac}) {
    const vehd::Scene still = parsed(electric("[electric.waveform]\n" + waveform, "0, -0.0, 0"));
    const vehd::Model model = vehd::model_of(still);
    BOOST_TEST(model.electric->waveform.is_quiet(0.0));
    BOOST_TEST(!vehd::next_discontinuity(model, 0.0));
    const vehd::Scene at_rest = parsed(with_appended("[flow]\nkind = 'shear'\nrate = 0\n[flow.waveform]\n" + waveform));
    BOOST_TEST(!vehd::next_discontinuity(vehd::model_of(at_rest), 0.0));
  }
  BOOST_TEST(message_of(electric("[electric.waveform]\nkind = 'pulse_train'\nduration = 2\nperiod = 1\n", "0, 0, 0"))
                 .find("\"period\" in [electric.waveform] is 1; accepted: ") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(waveform_that_makes_no_sense_is_refused) {
  const auto message = [](const std::string& keys) { return message_of(electric("[electric.waveform]\n" + keys)); };
  BOOST_TEST(message("kind = 'ac'\nfrequency = 5\n") ==
             "scene.toml:14: \"dt\" in [numerics] takes 2 steps a period of [electric.waveform]; accepted: at least 4");
  BOOST_TEST(message("kind = 'ac'\n").find("missing key \"frequency\" in [electric.waveform]") != std::string::npos);
  BOOST_TEST(message("kind = 'pulse'\nduration = 1\nperiod = 3\n") ==
             "scene.toml:15: key \"period\" in [electric.waveform] belongs to kind \"pulse_train\", not to \"pulse\"");
  BOOST_TEST(message("kind = 'pulse_train'\nduration = 3\nperiod = 3\n") ==
             "scene.toml:15: \"period\" in [electric.waveform] is 3; accepted: more than the duration 3");
  BOOST_TEST(message("kind = 'table'\ntimes = [0, 1]\nvalues = [1]\n") ==
             "scene.toml:14: the table of [electric.waveform] has 2 times and 1 values; accepted: as many of either");
  BOOST_TEST(message("kind = 'table'\ntimes = [0]\nvalues = [1]\n") ==
             "scene.toml:14: the table of [electric.waveform] has 1 entries; accepted: at least 2");
  BOOST_TEST(message("kind = 'table'\ntimes = [1, 0]\nvalues = [1, 1]\n") ==
             "scene.toml:14: the table of [electric.waveform] falls to the time 0; accepted: ascending times");
  BOOST_TEST(
      message("kind = 'table'\ntimes = [0, 0, 0]\nvalues = [1, 2, 3]\n") ==
      "scene.toml:14: the table of [electric.waveform] has the time 0 three times; accepted: twice, which makes a "
      "jump");
}

BOOST_AUTO_TEST_CASE(requested_symmetry_must_exist) {
  BOOST_TEST(message_with("symmetry = 'axisymmetric'\n") == "");
  BOOST_TEST(
      message_with("symmetry = 'axisymmetric'\n[flow]\nkind = 'shear'\nrate = 1\n") ==
      "scene.toml:8: \"symmetry\" in [numerics] is axisymmetric, but shape, flow and field have no common axis of "
      "symmetry; symmetry found: mirror y, half turn about y, inversion");
  const std::string along_x = "[shape]\nkind='ellipsoid'\naxes=[2,1,1]\n[numerics]\ndt=1\nend_time=1\norder=8\n";
  BOOST_TEST(message_of(along_x + "symmetry='axisymmetric'\n") == "");
  const vehd::Problem lying = vehd::problem_of(parsed(along_x + "symmetry='off'\n"));
  BOOST_TEST((lying.frame.axes.col(2) == vehd::Vector3::UnitX()));
  BOOST_TEST(!lying.symmetry.any());
  BOOST_TEST(vehd::problem_of(parsed(with_appended("symmetry = 'axisymmetric'\n"))).symmetry.axisymmetric);
}

BOOST_AUTO_TEST_SUITE_END()
