#include "bie/fit/fit_file.hpp"

#include <boost/test/unit_test.hpp>

#include "bie/support/errors.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scenes.hpp"

BOOST_AUTO_TEST_SUITE(fit_files, *boost::unit_test::label("once"))

namespace {

const std::string units = "length = \"10 um\"\ntime = \"1 ms\"\nviscosity = \"1 mPa s\"\npotential = \"1 V\"\n";
const std::string experiment = "[[experiment]]\nscene = \"scene.toml\"\ndata = \"data.csv\"\nquantity = \"extent_z\"\n";
const std::string free_keys = "[free]\n\"membrane.bending_modulus\" = {from = \"1e-20 J\", to = \"1e-18 J\"}\n";

struct Folder {
  TemporaryDirectory directory;

  Folder() {
    write_text(directory / "scene.toml", quick_scene_with_units(units));
    write_data("time [ms],extent_z [um],deviation [nm]\n0.5,21.5,100\n1,21,100\n");
  }
  void write_data(const std::string& text) const { write_text(directory / "data.csv", text); }
  [[nodiscard]] vehd::FitFile fit(const std::string& text = experiment + free_keys) const {
    return vehd::parse_fit(text, "fit.toml", directory / "");
  }
  /// Message with which a fit is refused, without the folder.
  [[nodiscard]] std::string refusal(const std::string& text = experiment + free_keys) const {
    try {
      static_cast<void>(fit(text));
    } catch (const vehd::InputError& error) {
      std::string message = error.what();
      for (std::size_t at = message.find(directory / ""); at != std::string::npos; at = message.find(directory / "")) {
        message.erase(at, (directory / "").size());
      }
      return message;
    }
    return "accepted";
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(data_are_read_in_their_units) {
  const vehd::FitFile fit = Folder().fit();
  BOOST_TEST_REQUIRE(fit.experiments.size() == 1u);
  const vehd::Experiment& read = fit.experiments.front();
  BOOST_TEST(read.name == "data");
  BOOST_TEST_REQUIRE(read.data.size() == 2u);
  BOOST_TEST(read.data[0].time == 5e-4, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(read.data[0].value == 21.5e-6, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(read.data[0].deviation == 1e-7, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(read.runs.size() == 1u);
  // A tenth of the deviation, relative to the largest extent.
  BOOST_TEST(read.tolerance == 0.1 * 1e-7 / 21.5e-6, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(fit.keys.front().is_logarithmic);
  BOOST_TEST(fit.keys.front().setting_of(2e-19) == "membrane.bending_modulus=\"2e-19 J\"");
  // The scene's 0.1 of length³ viscosity/time is far above the interval, so the fit starts at its middle.
  BOOST_TEST(fit.keys.front().start == 1e-19, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(energies_are_the_same_in_all_their_units) {
  const Folder folder;
  write_text(folder.directory / "scene.toml", quick_scene_with_units(units + "temperature = \"300 K\"\n"));
  const std::string of_energy =
      "[[experiment]]\nscene = \"scene.toml\"\ndata = \"data.csv\"\nquantity = \"tension_integral\"\n";
  constexpr double energy = 2e-18, kBT = 300.0 * vehd::boltzmann_constant;
  const std::pair<const char*, double> all_units[] = {{"J", 1.0}, {"fJ", 1e-15}, {"aJ", 1e-18}, {"kBT", kBT}};
  for (const auto& [unit, size] : all_units) {
    const std::string number = fmt::format("{:.17g}", energy / size);
    folder.write_data(fmt::format("time [ms],tension_integral [{0}],deviation [{0}]\n1,{1},{1}\n", unit, number));
    const vehd::Datum read = folder.fit(of_energy + free_keys).experiments.front().data.front();
    BOOST_TEST(read.value == energy, boost::test_tools::tolerance(1e-14));
    BOOST_TEST(read.deviation == energy, boost::test_tools::tolerance(1e-14));
    folder.write_data("time [ms],tension_integral [J]\n1,0\n");
    const std::string given = fmt::format("deviation = \"{} {}\"\n", number, unit);
    BOOST_TEST(folder.fit(of_energy + given + free_keys).experiments.front().data.front().deviation == energy,
               boost::test_tools::tolerance(1e-14));
  }
  write_text(folder.directory / "scene.toml", quick_scene_with_units(units));
  folder.write_data("time [ms],tension_integral [kBT],deviation [J]\n1,1,1\n");
  BOOST_TEST(
      folder.refusal(of_energy + free_keys) ==
      "data.csv:1: has the unit \"kBT\", but the scene has no temperature; accepted: \"temperature\" in [units] with "
      "the unit K");
}

BOOST_AUTO_TEST_CASE(data_against_a_key_are_one_run_for_each_of_its_values) {
  const Folder folder;
  folder.write_data(
      "# V_m at the end\nelectric.conductivity_in [mS/m],extent_z [um],deviation "
      "[um]\n1,21,0.1\n\n2,22,0.1\n1,21.1,0.1\n");
  const vehd::Experiment read = folder.fit().experiments.front();
  BOOST_TEST_REQUIRE(read.runs.size() == 2u);
  BOOST_TEST(read.runs[0].setting == "electric.conductivity_in=\"1 mS/m\"");
  BOOST_TEST(read.runs[0].data == (std::vector<std::size_t>{0, 2}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(many_data_make_runs_more_exact) {
  BOOST_TEST(vehd::run_error_in_deviations(25) == 0.1);
  BOOST_TEST(vehd::run_error_in_deviations(2500) == 0.01);
}

BOOST_AUTO_TEST_CASE(mistakes_in_the_data_name_their_line) {
  const Folder folder;
  const auto refusal_of = [&](const std::string& data) {
    folder.write_data(data);
    return folder.refusal();
  };
  BOOST_TEST(refusal_of("time [ms],extent_z [um],deviation [um]\n1,21,0.1\n2,x21,0.1\n") ==
             "data.csv:3: \"extent_z\" is \"x21\"; accepted: a finite number");
  BOOST_TEST(refusal_of("time [ms],extent_z [um],deviation [um]\n1,21\n") ==
             "data.csv:2: has 2 cells; accepted: 3, as many as the header has");
  BOOST_TEST(refusal_of("time [ms],extend_z [um],deviation [um]\n1,21,1\n") ==
             "data.csv:1: has no column \"extent_z\"; did you mean \"extend_z\"?");
  BOOST_TEST(refusal_of("time [ms],extent_z [um],deviation [um]\n1,21,0\n") ==
             "data.csv:2: \"deviation\" is 0; accepted: a number above 0");
  BOOST_TEST(refusal_of("time [ms],extent_z [mV],deviation [um]\n1,21,1\n") ==
             "data.csv:1: has the unit \"mV\" for a length; accepted: m, mm, um, nm");
  BOOST_TEST(refusal_of("time [ms],extent_z,deviation\n1,21,1\n") ==
             "data.csv:1: has no unit for a length; accepted: m, mm, um, nm");
  BOOST_TEST(refusal_of("time [ms],extent_z [um],deviation [um]\n-1,21,1\n") ==
             "data.csv:2: \"time\" is -1; accepted: 0 or later");
  BOOST_TEST(refusal_of("time [ms],extent_z [um]\n1,21\n").starts_with("data.csv:1: has no column \"deviation\""));
  BOOST_TEST(refusal_of("electric.conductivity_inn [mS/m],extent_z [um],deviation [um]\n1,21,1\n")
                 .find("did you mean \"conductivity_in\"?") != std::string::npos);
  BOOST_TEST(refusal_of("electric.conductivity_in [mV],extent_z [um],deviation [um]\n1,21,1\n")
                 .starts_with("data.csv:1: has the unit \"mV\" for a conductivity; accepted: S/m"));
  BOOST_TEST(refusal_of("electric.conductivity_in,extent_z [um],deviation [um]\n1,21,1\n")
                 .starts_with("data.csv:1: has no unit for a conductivity; accepted: S/m"));
  BOOST_TEST(refusal_of("electric.conductivity_in [mS/m],extent_z [um],deviation [um]\n-1,21,1\n")
                 .starts_with("data.csv:2: --set electric.conductivity_in="));
  BOOST_TEST(refusal_of("time [ms],extent_z [um],extent_z [nm],deviation [um]\n1,21,21,1\n") ==
             "data.csv:1: columns 2 and 3 are \"extent_z\"; accepted: one of them");
  BOOST_TEST(refusal_of("time [ms];extent_z [um];deviation [um]\n1;21;1\n") ==
             "data.csv:1: has cells between semicolons; accepted: commas");
  BOOST_TEST(refusal_of("time [ms],extent_z [um],deviation [um]\n") ==
             "data.csv: holds no numbers; accepted: a header and rows below it");
  folder.write_data("time [ms],extent_z [um],deviation [um]\n1,21,1\n");
  BOOST_TEST(folder.refusal(experiment + "deviation = \"1 um\"\n" + free_keys) ==
             "data.csv:1: has a column \"deviation\", and the experiment a \"deviation\"; accepted: one of them");
}

BOOST_AUTO_TEST_CASE(mistakes_in_the_fit_name_their_line) {
  const Folder folder;
  BOOST_TEST(folder.refusal("[free]\n") ==
             "fit.toml:1: no table [[experiment]]; accepted: one or more, with scene, data and quantity");
  BOOST_TEST(folder.refusal(experiment) ==
             "fit.toml:1: missing table [free]; accepted: \"table.key\" = {from, to, scale}");
  BOOST_TEST(folder.refusal(experiment + "deviations = 1\n") ==
             "fit.toml:5: unknown key \"deviations\" in [[experiment]]; did you mean \"deviation\"?");
  BOOST_TEST(folder.refusal("[[experiment]]\nscene = \"none.toml\"\ndata = \"data.csv\"\n") ==
             "fit.toml:2: \"scene\" in [[experiment]] is the text 'none.toml': no such file");
  BOOST_TEST(
      folder.refusal("[[experiment]]\nscene = \"scene.toml\"\ndata = \"data.csv\"\nquantity = \"extent_q\"\n")
          .starts_with("fit.toml:4: \"quantity\" is \"extent_q\", which history.csv of the scene does not have"));
  BOOST_TEST(folder.refusal("[[experiment]]\nscene = \"scene.toml\"\ndata = \"data.csv\"\nquantity = \"time\"\n") ==
             "fit.toml:4: \"quantity\" is \"time\"; accepted: another column of history.csv");
  BOOST_TEST(folder.refusal(experiment + experiment)
                 .starts_with("fit.toml:5: an experiment has the name \"data\", as another one has"));
  const auto refusal_of = [&](const std::string& key) { return folder.refusal(experiment + "[free]\n" + key); };
  BOOST_TEST(refusal_of("\"membrane.bending_moduls\" = {from = 1, to = 2}\n") ==
             "fit.toml:6: unknown key \"bending_moduls\" of [membrane] in [free]; did you mean \"bending_modulus\"?");
  BOOST_TEST(refusal_of("\"membrane.bending_modulus\" = {from = \"2e-19 J\", to = \"1e-19 J\"}\n") ==
             "fit.toml:6: \"membrane.bending_modulus\" in [free] goes from 2e-19 to 1e-19; accepted: from < to");
  BOOST_TEST(refusal_of("\"membrane.bending_modulus\" = {from = \"1e-19 J\", to = \"2 aJ\"}\n") ==
             "fit.toml:6: \"membrane.bending_modulus\" in [free] goes from \"J\" to \"aJ\"; accepted: one unit");
  BOOST_TEST(refusal_of("\"membrane.bending_modulus\" = {from = \"0 J\", to = \"2 J\"}\n") ==
             "fit.toml:6: \"membrane.bending_modulus\" in [free] goes from 0; accepted: a number above 0, or scale = "
             "\"linear\"");
  BOOST_TEST(
      refusal_of("\"shape.kind\" = {from = 1, to = 2}\n").starts_with("fit.toml:6: \"shape.kind\" in [free] is "));
  BOOST_TEST(refusal_of("\"membrane.bending_modulus\" = {from = \"1 V\", to = \"2 V\"}\n")
                 .starts_with("fit.toml:6: \"membrane.bending_modulus\" in [free]: has the unit \"V\" for a energy"));
  BOOST_TEST(refusal_of("\"membrane.bending_modulus\" = {from = 1, to = 2}\n")
                 .starts_with("fit.toml:6: \"membrane.bending_modulus\" in [free]: has no unit for a energy"));
  BOOST_TEST(refusal_of("\"membrane.bending_modulus\" = {from = \"-1 J\", to = \"2 J\", scale = \"linear\"}\n")
                 .starts_with("fit.toml:6: --set membrane.bending_modulus="));
  BOOST_TEST(refusal_of("\"membrane.bending_modulus\" = {from = \"1 J\", to = \"2 J\"}\n"
                        "[free.membrane]\nbending_modulus = {from = \"1 J\", to = \"2 J\"}\n") ==
             "fit.toml:6: \"membrane.bending_modulus\" in [free] is also at fit.toml:8; accepted: once");
  BOOST_TEST(refusal_of("membrane.bending_modulus = 1\n") ==
             "fit.toml:6: \"membrane.bending_modulus\" in [free] is 1; accepted: {from, to, scale}");
  BOOST_TEST(refusal_of("\"membrane.bending_modulus\" = {from = 1}\n") ==
             "fit.toml:6: missing key \"to\" in \"membrane.bending_modulus\" in [free]; accepted: a number");
  BOOST_TEST(refusal_of("\"membrane.bending_modulus\" = {from = 1, till = 2}\n") ==
             "fit.toml:6: unknown key \"till\" in \"membrane.bending_modulus\" in [free]; accepted: from, to, scale");
}

BOOST_AUTO_TEST_CASE(a_key_that_the_data_vary_is_not_free) {
  const Folder folder;
  folder.write_data("membrane.bending_modulus [J],extent_z [um],deviation [um]\n1e-19,21,0.1\n2e-19,22,0.1\n");
  BOOST_TEST(
      folder.refusal() ==
      "fit.toml:6: \"membrane.bending_modulus\" in [free] is varied by the data of \"data\"; accepted: another key");
}

// In units of each scene's own scales, a free key would have another value in each scene.
BOOST_AUTO_TEST_CASE(a_free_key_has_a_unit_if_any_scene_has_units) {
  const Folder folder;
  write_text(folder.directory / "plain.toml", quick_scene());
  write_text(folder.directory / "plain.csv", "time,extent_z,deviation\n1,2,0.1\n");
  const std::string plain = "[[experiment]]\nscene = \"plain.toml\"\ndata = \"plain.csv\"\nquantity = \"extent_z\"\n";
  const std::string numbers = "[free]\n\"membrane.bending_modulus\" = {from = 0.05, to = 5}\n";
  BOOST_TEST(folder.refusal(plain + numbers) == "accepted");
  BOOST_TEST(folder.refusal(plain + experiment + numbers)
                 .starts_with("fit.toml:10: \"membrane.bending_modulus\" in [free]: has no unit for a energy"));
}

BOOST_AUTO_TEST_CASE(contours_are_those_of_one_vesicle) {
  const Folder folder;
  write_text(folder.directory / "scene.toml",
             quick_scene() +
                 "[[vesicle]]\nname = \"a\"\n[vesicle.shape]\ncentre = [0.0, 0.0, -3.0]\n"
                 "[[vesicle]]\nname = \"b\"\n[vesicle.shape]\ncentre = [0.0, 0.0, 3.0]\n");
  BOOST_TEST(folder.refusal("[[experiment]]\nscene = \"scene.toml\"\ndata = \"data.csv\"\nquantity = \"contour\"\n") ==
             "fit.toml:4: \"quantity\" is \"contour\", and the scene has 2 vesicles; accepted: one");
}

BOOST_AUTO_TEST_SUITE_END()
