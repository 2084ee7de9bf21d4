#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/files/hdf5_reader.hpp"
#include "bie/runs/history.hpp"
#include "tests/app/reference_run.hpp"

namespace {

const std::string averaged_scene =
    "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 1.0, 1.2]\n[membrane]\nbending_modulus = 0.1\n"
    "[electric]\nfield = [0, 0, 1]\nconductivity_in = 1\nconductivity_out = 2\npermittivity = 0.5\n"
    "displacement_current = true\n[electric.waveform]\nkind = \"ac\"\nfrequency = 0.3\naverage = true\n"
    "[numerics]\norder = 6\ndt = 0.1\nend_time = 0.4\n[output]\nevery = 0.2\n";

struct AveragedRun : FinishedRun {
  AveragedRun() : FinishedRun(averaged_scene) {}
};

}  // namespace

BOOST_AUTO_TEST_SUITE(averaged_run_output, *boost::unit_test::label("slow") * boost::unit_test::label("once"))

BOOST_FIXTURE_TEST_CASE(snapshots_hold_amplitudes_and_no_values_of_a_moment, AveragedRun) {
  const vehd::Hdf5Reader file(output + "/run.h5");
  const std::string snapshot = "/snapshots/000002/";
  for (const char* name : {"Vm", "q", "coefficients/Vm"}) BOOST_TEST(!file.has(snapshot + name), name);
  const vehd::Vector real = file.vector(snapshot + "Vm_real"), imaginary = file.vector(snapshot + "Vm_imaginary");
  const vehd::Vector amplitude = file.vector(snapshot + "Vm_amplitude"), phase = file.vector(snapshot + "Vm_phase_deg");
  BOOST_TEST_REQUIRE(real.size() == amplitude.size());
  for (vehd::Index i = 0; i < real.size(); ++i) {
    BOOST_TEST(std::abs(amplitude[i] - std::hypot(real[i], imaginary[i])) < 1e-14);
    if (amplitude[i] < 1e-6) continue;
    BOOST_TEST(std::abs(phase[i] - std::atan2(imaginary[i], real[i]) * 180.0 / std::acos(-1.0)) < 1e-9);
  }
  BOOST_TEST(file.vector(snapshot + "surface/q_amplitude").size() == real.size() + 2);
  BOOST_TEST(file.has(snapshot + "coefficients/q_imaginary"));
  const vehd::HistoryTable history(output + "/history.csv");
  BOOST_TEST(history.column("Vm_max").back() >= amplitude.maxCoeff());
  BOOST_TEST(history.column("Vm_phase_deg").back() < 0.0);
}

BOOST_FIXTURE_TEST_CASE(pictures_show_amplitude_and_phase, AveragedRun) {
  for (const char* field : {"V_m_amplitude", "V_m_phase", "q_amplitude"}) {
    const ProgramResult result = run_vehd({"plot", output, "--field", field, "-o", directory / "shapes.svg"});
    BOOST_TEST(result.exit_code == 0, result.errors);
  }
  const ProgramResult refused = run_vehd({"plot", output, "--field", "V_m", "-o", directory / "shapes.svg"});
  BOOST_TEST(refused.exit_code == 1);
  BOOST_TEST(refused.errors.find("V_m_amplitude") != std::string::npos, refused.errors);
}

BOOST_AUTO_TEST_CASE(charges_of_the_faces_go_on_bit_for_bit) {
  std::string scene = averaged_scene;
  scene.replace(scene.find("average = true\n"), 15, "");
  const RunPair pair(scene);
  pair.run_reference();
  pair.run_until("0.2");
  pair.finish();
  const vehd::Hdf5Reader file(pair.output + "/run.h5");
  BOOST_TEST(file.has("/snapshots/000001/Vm"));
}

BOOST_AUTO_TEST_CASE(a_stopped_run_goes_on_bit_for_bit_and_in_another_degree) {
  const RunPair pair(averaged_scene);
  pair.run_reference();
  pair.run_until("0.2");
  pair.finish();
  const ProgramResult finer = run_vehd({"run", pair.scene, "-o", pair.output, "--resume", "--no-plot", "--set",
                                        "numerics.end_time=0.6", "--set", "numerics.degree=8"});
  BOOST_TEST(finer.exit_code == 0, finer.errors);
}

BOOST_AUTO_TEST_SUITE_END()
