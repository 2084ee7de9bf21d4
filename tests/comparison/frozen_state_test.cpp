#include "bie/comparison/frozen_state.hpp"

#include <boost/test/unit_test.hpp>

#include "bie/support/errors.hpp"
#include "tests/support/files.hpp"

BOOST_AUTO_TEST_SUITE(frozen_state)

BOOST_AUTO_TEST_CASE(fields_that_the_elements_do_not_know_are_refused) {
  const TemporaryDirectory directory;
  const std::string start =
      "[shape]\nkind = \"ellipsoid\"\naxes = [1, 1, 1.2]\n[numerics]\ndegree = 4\ndt = 0.1\nend_time = 1\n"
      "[electric]\nfield = [0, 0, 1]\nconductivity_in = 1\nconductivity_out = 2\npermittivity = 1\n";
  const auto message = [&](const std::string& more) {
    write_text(directory / "scene.toml", start + more);
    try {
      vehd::read_frozen_state({directory / "scene.toml", {}}, std::nullopt);
    } catch (const vehd::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  BOOST_TEST(message("") == "");
  const std::string waveform = "[electric.waveform]\nkind = \"ac\"\nfrequency = 1\n";
  BOOST_TEST(message(waveform) == "");
  BOOST_TEST(message(waveform + "average = true\n").find("averaged ac field") != std::string::npos);
  BOOST_TEST(message("displacement_current = true\n") == "");
  const std::string poration = "[poration]\nthreshold_Vm = 1\nmodel = ";
  BOOST_TEST(message(poration + "\"porosity\"\nporated_conductance = 1\nporation_time = 1\nresealing_time = 2\n") ==
             "");
  BOOST_TEST(message(poration + "\"criterion\"\n") == "");
  const auto by_place = [](const std::string& property) {
    return "[membrane]\nbending_modulus = 0.1\nconductance = 1\n[membrane." + property +
           "_by_place]\nkind = \"harmonics\"\nmodes = [{n = 1, m = 0, a = 0.1}]\n";
  };
  BOOST_TEST(message(by_place("capacitance")) == "");
  BOOST_TEST(message(by_place("conductance")) == "");
  BOOST_TEST(message("displacement_current = true\n" + by_place("conductance")) == "");
  BOOST_TEST(message(by_place("bending")).find("bends differently") != std::string::npos);
  BOOST_TEST(message("displacement_current = true\n" + by_place("capacitance")).find("displacement currents") !=
             std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
