#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/files/hdf5_reader.hpp"
#include "bie/runs/history.hpp"
#include "tests/app/reference_run.hpp"

namespace {

const std::string pumping_vesicle =
    "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 1.0, 1.4]\n[membrane]\nbending_modulus = 0.1\nconductance = 1\n"
    "spontaneous_curvature = -0.4\n"
    "[electric]\nfield = [0, 0, 0]\nconductivity_in = 1\nconductivity_out = 2\npermittivity = 1\n"
    "[membrane.varying_curvature]\nkind = \"cap\"\nangle_deg = 80\nwidth_deg = 60\ninside = 2\n"
    "[membrane.pump]\nkind = \"harmonics\"\nbase = 0\nmodes = [{n = 1, m = 0, a = 2}, {n = 2, m = 0, a = 1}]\n"
    "current = 1.5\n[membrane.pump.waveform]\nkind = \"ac\"\nfrequency = 0.4\n";
const std::string pumping_steps = "[numerics]\norder = 8\ndt = 0.1\nend_time = 1\n[output]\nevery = 0.2\n";

}  // namespace

BOOST_AUTO_TEST_SUITE(varying_run, *boost::unit_test::label("slow") * boost::unit_test::label("once"))

BOOST_AUTO_TEST_CASE(a_pump_goes_on_bit_for_bit_without_a_force_and_has_pictures) {
  const RunPair pair(pumping_vesicle + pumping_steps);
  pair.run_reference();
  pair.run_until("0.4");
  pair.finish();
  const vehd::HistoryTable history(pair.output + "/history.csv");
  BOOST_TEST(history.column("Vm_max").back() > 0.05);
  BOOST_TEST(history.column("elastic_energy").front() > history.column("elastic_energy").back());
  // The forces themselves are of order one.
  for (const char* axis : {"net_force_x", "net_force_y", "net_force_z"}) {
    for (const double force : history.column(axis)) BOOST_TEST(std::abs(force) < 1e-3, axis << " " << force);
  }
  const vehd::Hdf5Reader file(pair.output + "/run.h5");
  const auto largest = [&](const std::string& name) { return file.vector("/snapshots/000005/" + name).maxCoeff(); };
  BOOST_TEST((largest("pump_current") > 1.0 && largest("pump_current") < 3.0), largest("pump_current"));
  BOOST_TEST(std::abs(largest("bending_modulus") - 0.1) < 1e-9);
  BOOST_TEST(largest("spontaneous_curvature") < -0.3);
  BOOST_TEST(!file.has("/snapshots/000005/conductance"));
  const ProgramResult finer = run_vehd({"run", pair.scene, "-o", pair.output, "--resume", "--no-plot", "--set",
                                        "numerics.end_time=1.2", "--set", "numerics.degree=10"});
  BOOST_TEST(finer.exit_code == 0, finer.errors);
  for (const char* field : {"pump_current", "spontaneous_curvature", "bending_modulus"}) {
    const ProgramResult result = run_vehd({"plot", pair.output, "--field", field, "-o", pair.directory / "shapes.svg"});
    BOOST_TEST(result.exit_code == 0, result.errors);
  }
  const ProgramResult refused = run_vehd({"check", pair.output + "/run.h5"});
  BOOST_TEST(refused.exit_code == 1);
  BOOST_TEST(refused.errors.find("spatially varying bending modulus") != std::string::npos, refused.errors);
}

BOOST_AUTO_TEST_SUITE_END()
