#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "bie/runs/history.hpp"
#include "bie/runs/resumption.hpp"
#include "bie/runs/scene_changes.hpp"
#include "bie/runs/session.hpp"
#include "bie/scene/reader.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/interruption.hpp"
#include "tests/support/files.hpp"

// Runs that continue others under another field, flow or waveform.
BOOST_AUTO_TEST_SUITE(continued_from)

namespace {

const std::string field_along_x = "field = [0.5, 0.0, 0.0]\n", no_field = "field = [0.0, 0.0, 0.0]\n";
const std::string undulating =
    "undulations = true\ntemperature = 0.2\nstretching_modulus = 20\nreference_tension = 3\n";
const std::string shear = "[flow]\nkind = \"shear\"\nrate = 0.5\n";

/// An ellipsoid that charges; in a field along x its poles are off the axis of symmetry.
std::string scene_text(const std::string& field, double end, const std::string& more = {},
                       const std::string& membrane = {}) {
  return "[shape]\nkind = \"ellipsoid\"\naxes = [1.3, 1.0, 1.0]\n[membrane]\nbending_modulus = 0.5\n" + membrane +
         "[electric]\nconductivity_in = 0.5\nconductivity_out = 1.0\n" + field +
         "[numerics]\ndegree = 8\ndt = 0.0625\ntime_order = 1\nend_time = " + std::to_string(end) + "\n" + more;
}

struct Runs {
  TemporaryDirectory directory;

  [[nodiscard]] vehd::SceneSource source(const std::string& text) const {
    write_text(directory / "scene.toml", text);
    return {directory / "scene.toml", {}};
  }
  /// @param from  name of the run that it continues; empty: none
  nlohmann::json run(const std::string& name, const std::string& text, const std::string& from = {},
                     bool resume = false) const {
    const vehd::SceneSource given = source(text);
    const vehd::RunSession session(vehd::read_scene(given), given, directory / name, resume, {}, false,
                                   from.empty() ? std::filesystem::path() : std::filesystem::path(directory / from));
    vehd::Interruption interruption;
    return session.summarise(vehd::simulate(session.task({}, vehd::longest_lag_of_files), interruption));
  }
  [[nodiscard]] std::string history(const std::string& name) const { return directory / (name + "/history.csv"); }
  [[nodiscard]] std::string refusal(const std::string& text, const std::string& from = "first") const {
    try {
      run("refused", text, from);
    } catch (const vehd::InputError& error) {
      return error.what();
    }
    return {};
  }
};

void check_same_end(const vehd::HistoryTable& a, const vehd::HistoryTable& b) {
  for (const char* column : {"time", "extent_x", "extent_y", "extent_z", "inclination_deg", "Vm_max",
                             "tension_integral", "bending_energy_scaled"}) {
    const double x = a.column(column).back(), y = b.column(column).back();
    BOOST_TEST(std::abs(x - y) <= 1e-8 * (1.0 + std::abs(x)), column << ": " << x << " and " << y);
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(changes_have_the_units_of_their_values) {
  const auto scene = [](const std::string& modulus, const std::string& height) {
    return vehd::parse_scene(
        "[units]\nlength = \"10 um\"\ntime = \"10 ms\"\n[shape]\nkind = \"ellipsoid\"\naxes = [1, 1, 1.2]\n"
        "centre = [0, 0, \"" +
            height + "\"]\n[membrane]\nbending_modulus = \"" + modulus +
            "\"\n"
            "[fluid]\nviscosity = \"1 mPa s\"\n[numerics]\ndegree = 8\ntolerance = 1e-3\nend_time = 1\n",
        "scene.toml", ".");
  };
  const auto changes = vehd::changes_between(scene("2e-19 J", "0 um"), scene("0.3 aJ", "30 um"), 0.5, 7);
  BOOST_TEST_REQUIRE(changes.size() == 2U);
  const bool shape_first = changes[0].key.starts_with("shape");
  const vehd::SceneChange &place = changes[shape_first ? 0 : 1], &modulus = changes[shape_first ? 1 : 0];
  BOOST_TEST(modulus.before == "200 zJ");
  BOOST_TEST(modulus.after == "300 zJ");
  BOOST_TEST((place.after == nlohmann::json{"0 m", "0 m", "30 um"}), place.after.dump());
}

BOOST_FIXTURE_TEST_CASE(an_unchanged_scene_goes_on_as_if_never_interrupted, Runs) {
  run("whole", scene_text(field_along_x, 0.5));
  run("first", scene_text(field_along_x, 0.25));
  run("second", scene_text(field_along_x, 0.5), "first");
  const vehd::HistoryTable second(history("second"));
  BOOST_TEST(second.column("time").front() == 0.25, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(second.n_rows() == 5U);
  check_same_end(vehd::HistoryTable(history("whole")), second);
}

namespace {

/// Runs "first" and "second", which are a pulse. @return the change of ∫λ dA at its end
double switch_off(const Runs& runs, const std::string& membrane) {
  const std::string waveform = "[electric.waveform]\nkind = \"pulse\"\nduration = 0.25\n";
  runs.run("pulse", scene_text(field_along_x + waveform, 0.5, {}, membrane));
  runs.run("first", scene_text(field_along_x, 0.25, {}, membrane));
  runs.run("second", scene_text(no_field, 0.5, {}, membrane), "first");
  const vehd::HistoryTable pulse(runs.history("pulse")), second(runs.history("second"));
  check_same_end(pulse, second);
  // The second run starts with the row just after the jump.
  constexpr std::size_t jump = 5;
  const std::vector<double>& tension = pulse.column("tension_integral");
  BOOST_TEST(pulse.column("time")[jump] == second.column("time").front(), boost::test_tools::tolerance(1e-12));
  BOOST_TEST(tension[jump] == second.column("tension_integral").front(), boost::test_tools::tolerance(1e-8));
  return tension[jump] - tension[jump - 1];
}

}  // namespace

BOOST_FIXTURE_TEST_CASE(a_field_that_is_switched_off_is_a_pulse, Runs) {
  BOOST_TEST(std::abs(switch_off(*this, {})) > 1e-3);
  const auto summary = json_of(directory / "second/summary.json");
  BOOST_TEST(summary.at("from").at("run") == directory / "first");
  BOOST_TEST(summary.at("from").at("step") == 4);
  BOOST_TEST(summary.at("from").at("time").get<double>() == 0.25, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(summary.at("changes").at(0).at("key") == "electric.field");
  BOOST_TEST(file_text(directory / "second/scene.toml").starts_with("# from " + directory / "first" + " at time 0.25"));
}

// The mean tension follows the area, which does not jump.
BOOST_FIXTURE_TEST_CASE(a_field_that_is_switched_off_is_a_pulse_with_undulations, Runs) {
  BOOST_TEST(std::abs(switch_off(*this, undulating)) < 1e-8);
}

// Zero field is the reference of a series of strengths. Its direction is no axis of the symmetry that is used.
BOOST_FIXTURE_TEST_CASE(a_field_of_magnitude_0_keeps_its_direction, Runs) {
  const auto field = [](const std::string& magnitude) {
    return "field = [0.4, 0.0, 0.3]\nfield_magnitude = " + magnitude + "\n";
  };
  const double along = 0.64 * 1.69 + 0.36, across = 1.69 + 2.0 - along;
  for (const std::string name : {"0", "0.001", "0.5"}) {
    run(name, scene_text(field(name), 0.125));
    const vehd::HistoryTable series(history(name));
    BOOST_TEST(series.column("aspect_ratio_field").front() == std::sqrt(2.0 * along / across),
               boost::test_tools::tolerance(1e-10));
    BOOST_TEST(series.column("shape_mode_2").front() > 0.05);
  }
  run("off", scene_text(field("0"), 0.25), "0.5");
  const vehd::HistoryTable before(history("0.5")), after(history("off"));
  for (const char* column : {"aspect_ratio_field", "shape_mode_2", "Vm_pole_plus"}) {
    const double last = before.column(column).back();
    BOOST_TEST(last != 0.0);
    BOOST_TEST(after.column(column).front() == last, boost::test_tools::tolerance(1e-6));
  }
  run("without", scene_text(no_field, 0.25), "0.5");
  BOOST_TEST(std::isnan(vehd::HistoryTable(history("without")).column("aspect_ratio_field").front()));
}

// The symmetry axis of the first run is no symmetry of the second.
BOOST_FIXTURE_TEST_CASE(symmetry_is_that_of_the_state_under_the_new_flow, Runs) {
  const std::string off = "symmetry = \"off\"\n";
  BOOST_TEST(run("first", scene_text(field_along_x, 0.125)).at("symmetry") != "none");
  BOOST_TEST(run("second", scene_text(field_along_x, 0.375, shear), "first").at("symmetry") != "none");
  run("first_off", scene_text(field_along_x, 0.125, off));
  run("second_off", scene_text(field_along_x, 0.375, off + shear), "first_off");
  check_same_end(vehd::HistoryTable(history("second")), vehd::HistoryTable(history("second_off")));
  BOOST_TEST(std::abs(vehd::HistoryTable(history("second")).column("inclination_deg").back()) > 0.1);
}

BOOST_FIXTURE_TEST_CASE(continued_runs_resume_bit_for_bit, Runs) {
  run("first", scene_text(field_along_x, 0.25));
  run("whole", scene_text(no_field, 0.5, shear), "first");
  run("parts", scene_text(no_field, 0.375, shear), "first");
  run("parts", scene_text(no_field, 0.4375, shear), "", true);
  run("parts", scene_text(no_field, 0.5, shear), "./first", true);
  BOOST_TEST(file_text(history("parts")) == file_text(history("whole")));
  for (const std::string name : {"first", "parts"}) {
    BOOST_CHECK_EXCEPTION(run(name, scene_text(no_field, 0.75, shear), "whole", true), vehd::InputError,
                          [&](const vehd::InputError& error) {
                            const std::string origin = name == "first" ? "no other run" : directory / "first";
                            return error.what() == "--from " + directory / "whole" + ": the run in " +
                                                       directory / name + " continues " + origin +
                                                       "; accepted: that, or no --from";
                          });
  }
  // A third run continues the second one.
  run("third", scene_text(field_along_x, 0.75), "whole");
  BOOST_TEST(vehd::HistoryTable(history("third")).column("time").front() == 0.5, boost::test_tools::tolerance(1e-12));
}

BOOST_FIXTURE_TEST_CASE(keys_that_define_the_state_may_not_change, Runs) {
  const std::string text = scene_text(field_along_x, 0.25);
  run("first", text);
  const auto has = [](const std::string& message, const std::string& part) {
    BOOST_TEST(message.find(part) != std::string::npos, message);
  };
  std::string stiffer = scene_text(field_along_x, 0.5);
  stiffer.replace(stiffer.find("= 0.5"), 5, "= 0.6");
  has(refusal(stiffer), "scene.toml:5: \"membrane.bending_modulus\" is 0.6, but the run in " + directory / "first" +
                            " has 0.5; --from accepts changes of [flow], of field and waveform in [electric]");
  has(refusal(scene_text(field_along_x, 0.125)), "\"numerics.end_time\" is 0.125, but the run in ");
  has(refusal(scene_text(field_along_x, 0.5, "error_bars = true\n")), "\"numerics.error_bars\" is true");
  has(refusal(scene_text(field_along_x + "[electric.waveform]\nkind = \"ac\"\nfrequency = 9.0\naverage = true\n", 0.5)),
      "\"electric.waveform.average\" is true, but the run in ");
  has(refusal(text, "nothing"), "nothing: holds no run that can be continued: it has no checkpoint.h5");
}

// Reference times follow from a pulse.
BOOST_FIXTURE_TEST_CASE(reference_scales_are_those_of_the_first_run, Runs) {
  const auto text = [](const std::string& duration) {
    return "[units]\n[shape]\nkind = \"prolate\"\nreduced_volume = 0.95\narea = \"1257 um^2\"\n"
           "[membrane]\nbending_modulus = \"1e-19 J\"\ncapacitance = \"10 mF/m^2\"\n[fluid]\nviscosity = \"1 mPa s\"\n"
           "[electric]\nfield = [0, 0, \"0.3 kV/cm\"]\nconductivity_in = \"0.5 mS/cm\"\nconductivity_out = \"1 "
           "mS/cm\"\n"
           "permittivity = \"80 eps0\"\n[electric.waveform]\nkind = \"pulse\"\nduration = \"" +
           duration + "\"\n[numerics]\ndegree = 8\ndt = \"10 us\"\nend_time = \"40 us\"\n";
  };
  run("first", text("20 us"));
  const vehd::SceneSource longer = source(text("300 ns"));
  const vehd::SceneSource stored{directory / "first/scene.toml", {}};
  const auto time = [](const vehd::SceneSource& of) { return vehd::read_scene(of).units->time.value(); };
  BOOST_TEST(time(longer) != time(stored));
  BOOST_TEST(time(vehd::in_scales_of(longer, vehd::RunPaths{directory / "first"})) == time(stored));
  BOOST_TEST(vehd::in_scales_of(longer, vehd::RunPaths{directory / "nothing"}).settings.empty());
}

BOOST_AUTO_TEST_SUITE_END()
