#include <boost/test/unit_test.hpp>

#include "bie/runs/history.hpp"
#include "tests/app/program.hpp"

namespace {

/// A vesicle in the middle of a pulse, in SI units whatever the reference scales.
std::string pulsed_scene(const std::string& units, const std::string& shape, const std::string& start,
                         const std::string& times) {
  return "[units]\n" + units + shape +
         "[membrane]\nbending_modulus = \"1e-19 J\"\ncapacitance = \"10 mF/m^2\"\n"
         "[fluid]\nviscosity = \"1 mPa s\"\n"
         "[electric]\nfield = [0, 0, \"0.3 kV/cm\"]\nconductivity_in = \"0.5 mS/cm\"\nconductivity_out = \"1 mS/cm\"\n"
         "permittivity = \"80 eps0\"\n"
         "[electric.waveform]\nkind = \"pulse\"\nduration = \"60 us\"\nstart = \"" +
         start + "\"\n[numerics]\norder = 6\ndt = \"5 us\"\n" + times;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(shape_file)

// A run continued from its middle, in other units and with the membrane half charged, ends as the whole run does.
BOOST_AUTO_TEST_CASE(a_run_goes_on_from_the_middle_of_a_pulse_in_other_units) {
  const TemporaryDirectory directory;
  const auto run = [&](const std::string& name, const std::string& text) {
    write_text(directory / (name + ".toml"), text);
    const ProgramResult result = run_vehd({"run", directory / (name + ".toml"), "-o", directory / name, "--no-plot"});
    BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
    return vehd::HistoryTable(directory / (name + "/history.csv"));
  };
  const auto whole =
      run("whole", pulsed_scene("length = \"10 um\"\ntime = \"10 us\"\npotential = \"1 V\"\n",
                                "[shape]\nkind = \"prolate\"\nreduced_volume = 0.9\narea = \"1257 um^2\"\n", "0 us",
                                "end_time = \"100 us\"\n[output]\nevery = \"50 us\"\n"));
  const auto rest = run("rest", pulsed_scene("length = \"3 um\"\ntime = \"40 us\"\npotential = \"20 mV\"\n",
                                             "[shape]\nkind = \"file\"\npath = \"whole/run.h5\"\ntime = \"50 us\"\n",
                                             "-50 us", "end_time = \"50 us\"\n"));
  // Both histories are in the units of an experiment, whatever the reference scales.
  for (const char* column : {"extent_x", "extent_z", "volume", "Vm_max", "Vm_north"}) {
    BOOST_TEST(rest.header(column) == whole.header(column));
    BOOST_TEST(rest.column(column).back() == whole.column(column).back(), boost::test_tools::tolerance(1e-6));
  }
  BOOST_TEST(rest.header("Vm_max") == "Vm_max [mV]");
  BOOST_TEST(rest.column("Vm_max").front() > 100.0);
}

BOOST_AUTO_TEST_SUITE_END()
