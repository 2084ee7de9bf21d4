#include <boost/test/unit_test.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bie/files/hdf5_reader.hpp"
#include "bie/files/run_file.hpp"
#include "bie/runs/history.hpp"
#include "bie/scene/effective_scene.hpp"
#include "bie/scene/reader.hpp"
#include "tests/app/program.hpp"

BOOST_AUTO_TEST_SUITE(run_output)

namespace {

struct Run {
  TemporaryDirectory directory;
  std::string scene = directory / "scene.toml";
  std::string output = directory / "out";

  void run(const std::string& text, const std::vector<std::string>& more = {"--no-plot"}) {
    write_text(scene, text);
    std::vector<std::string> arguments = {"run", scene, "-o", output, "--json", directory / "result.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult result = run_vehd(arguments);
    BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
  }
};

}  // namespace

BOOST_FIXTURE_TEST_CASE(history_has_the_stable_columns_and_lands_on_snapshot_times, Run) {
  run(quick_scene());
  const std::string text = file_text(output + "/history.csv");
  BOOST_TEST(text.substr(0, text.find('\n')) ==
             "time,dt,area,volume,reduced_volume,bending_energy_scaled,tension_integral,Vm_north,q_north,Vm_max,"
             "extent_x,extent_y,extent_z,inclination_deg,area_drift,volume_drift,strain_max,spectrum_tail,"
             "iterations_flow,iterations_electric,rejected,order,truncation,error_estimate,quadrature_error,separation,"
             "raw_area,wrinkle_degree,centroid_x,centroid_y,centroid_z,centroid_velocity_x,centroid_velocity_y,"
             "centroid_velocity_z,tension_max,elastic_energy_scaled,aspect_ratio,aspect_ratio_field,Vm_pole_plus,"
             "Vm_pole_minus,Vm_phase_deg,stress_xx,stress_yy,stress_zz,stress_xy,stress_xz,stress_yz,"
             "effective_viscosity_intrinsic,dipole_x,dipole_y,dipole_z,power,power_electric,"
             "stress_bending_xx,stress_bending_yy,stress_bending_zz,stress_bending_xy,stress_bending_xz,"
             "stress_bending_yz,stress_tension_xx,stress_tension_yy,stress_tension_zz,stress_tension_xy,"
             "stress_tension_xz,stress_tension_yz,stress_electric_xx,stress_electric_yy,stress_electric_zz,"
             "stress_electric_xy,stress_electric_xz,stress_electric_yz,stress_viscosity_xx,stress_viscosity_yy,"
             "stress_viscosity_zz,stress_viscosity_xy,stress_viscosity_xz,stress_viscosity_yz,wrinkle_growth,"
             "shape_rate,shape_mode_2,shape_mode_3,shape_mode_4,shape_mode_5,shape_mode_6,normal_stress_1,"
             "normal_stress_2,tumbling_angle_deg,tumbling_frequency,treading_frequency,checksum");
  const vehd::HistoryTable history(output + "/history.csv");
  BOOST_TEST(history.column("time").front() == 0.0);
  BOOST_TEST(history.column("time").back() == 3.0);
  double time = 0.0;
  for (const double dt : history.column("dt")) time += dt;
  BOOST_TEST(std::abs(time - 3.0) < 1e-12);
}

BOOST_FIXTURE_TEST_CASE(snapshots_come_on_time_though_decimal_steps_do_not_add_up, Run) {
  // Ten times 0.1 is not 1.0 in binary: the last step before a snapshot must be stretched by a rounding error.
  run("[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 1.0, 1.2]\n[membrane]\nbending_modulus = 0.1\n"
      "[flow]\nkind = \"shear\"\nrate = 0.1\n[numerics]\norder = 4\ndt = 0.1\nend_time = 5.0\n"
      "[output]\nevery = 1.0\n");
  const vehd::Hdf5Reader file(output + "/run.h5");
  BOOST_TEST(file.members("/snapshots").size() == 6);
  for (int number = 0; number < 6; ++number) {
    BOOST_TEST(file.number_attribute("/snapshots/" + vehd::snapshot_name(number), "time") == 1.0 * number);
  }
  BOOST_TEST(vehd::HistoryTable(output + "/history.csv").n_rows() == 51);
}

BOOST_FIXTURE_TEST_CASE(a_run_that_cannot_go_on_keeps_its_last_state, Run) {
  const auto scene_file = std::filesystem::path(VEHD_SOURCE_DIR) / "tests/hard/scenes/disc_drawn_together.toml";
  std::vector<std::string> arguments = {"run", scene_file, "-o", output, "--no-plot"};
  for (int session = 0; session < 2; ++session) {
    const ProgramResult result = run_vehd(arguments);
    BOOST_TEST(result.exit_code == 3, result.errors);
    arguments.emplace_back("--resume");
    const vehd::Hdf5Reader file(output + "/run.h5");
    const std::vector<std::string> names = file.members("/snapshots");
    BOOST_TEST(names.size() == 2);
    const double last = file.number_attribute("/snapshots/" + names.back(), "time");
    BOOST_TEST(last == vehd::HistoryTable(output + "/history.csv").column("time").back());
    BOOST_TEST(last > 0.0);
  }
}

BOOST_FIXTURE_TEST_CASE(run_file_keeps_its_layout, Run) {
  run(quick_scene());
  const vehd::Hdf5Reader file(output + "/run.h5");
  BOOST_TEST(file.integer_attribute("/", "schema_version") == 1);
  const std::string fftw = file.text_attribute("/", "version_fftw");
  BOOST_TEST(run_vehd({"--version"}).output.find("\nfftw " + fftw + "\n") != std::string::npos, fftw);
  BOOST_TEST(file.vector("/grid/theta").size() == 7);
  BOOST_TEST(file.vector("/grid/phi").size() == 14);
  BOOST_TEST(file.vector("/grid/weight").size() == 7);
  BOOST_TEST(file.members("/snapshots").size() == 7);
  const vehd::HistoryTable history(output + "/history.csv");
  for (int number = 0; number < 7; ++number) {
    const std::string group = "/snapshots/" + vehd::snapshot_name(number);
    BOOST_TEST(file.number_attribute(group, "time") == 0.5 * number);
    for (const char* field : {"x", "velocity", "force_bending", "force_tension", "force_electric"}) {
      BOOST_TEST(file.matrix(group + "/" + field).rows() == 7 * 14);
      BOOST_TEST(file.matrix(group + "/" + field).cols() == 3);
      BOOST_TEST(file.matrix(group + "/coefficients/" + field).rows() == 49);
    }
    for (const char* field : {"Vm", "q", "tension", "area_element"}) {
      BOOST_TEST(file.vector(group + "/" + field).size() == 7 * 14);
    }
  }
  // ∫ dγ = Σ weight · area_element
  const vehd::Vector weight = file.vector("/grid/weight"), element = file.vector("/snapshots/000000/area_element");
  double area = 0.0;
  for (int j = 0; j < 7; ++j) area += weight(j) * element.segment(j * 14, 14).sum();
  BOOST_TEST(std::abs(area / history.column("area").front() - 1.0) < 1e-3);
}

BOOST_FIXTURE_TEST_CASE(effective_scene_is_written_and_equivalent, Run) {
  run(quick_scene("0.0"));
  BOOST_TEST((vehd::read_scene(output + "/scene.toml") == vehd::read_scene(scene)));
  BOOST_TEST(vehd::Hdf5Reader(output + "/run.h5").text("/scene") == file_text(output + "/scene.toml"));
}

BOOST_FIXTURE_TEST_CASE(end_time_zero_writes_the_initial_state_once, Run) {
  run(quick_scene("0.0"));
  BOOST_TEST(vehd::HistoryTable(output + "/history.csv").n_rows() == 1);
  BOOST_TEST(vehd::Hdf5Reader(output + "/run.h5").members("/snapshots").size() == 1);
}

BOOST_FIXTURE_TEST_CASE(absent_effects_write_no_datasets, Run) {
  run("[shape]\nkind='ellipsoid'\naxes=[1,1,1.2]\n[membrane]\nbending_modulus=1\n"
      "[numerics]\norder=6\ndt=0.1\nend_time=0\n");
  const vehd::Hdf5Reader file(output + "/run.h5");
  for (const char* field : {"Vm", "q", "force_electric"}) {
    BOOST_TEST(!file.has(std::string("/snapshots/000000/") + field));
  }
  BOOST_TEST(file.has("/snapshots/000000/force_bending"));
}

BOOST_FIXTURE_TEST_CASE(summary_has_the_stable_keys, Run) {
  run(quick_scene());
  const auto summary = json_of(output + "/summary.json");
  for (const char* key : {"completed", "verdict", "steps", "rejected_steps", "seconds", "seconds_per_step",
                          "peak_memory_bytes", "area_drift", "volume_drift", "strain_max", "kernel_evaluations"}) {
    BOOST_TEST(summary.contains(key), key);
  }
  BOOST_TEST(summary.at("completed").get<bool>());
  BOOST_TEST(summary.at("steps").get<int>() ==
             static_cast<int>(vehd::HistoryTable(output + "/history.csv").n_rows()) - 1);
  BOOST_TEST(summary == json_of(directory / "result.json"));
}

BOOST_FIXTURE_TEST_CASE(a_snapshot_serves_as_initial_shape, Run) {
  run(quick_scene("0.5"));
  write_text(directory / "next.toml",
             "[shape]\nkind = \"file\"\npath = \"out/run.h5\"\ntime = 0.5\n"
             "[numerics]\norder = 8\ndt = 1\nend_time = 0\n");
  const ProgramResult next = run_vehd({"run", directory / "next.toml", "-o", directory / "next", "--no-plot"});
  BOOST_TEST_REQUIRE(next.exit_code == 0, next.errors);
  const vehd::Matrix before = vehd::Hdf5Reader(output + "/run.h5").matrix("/snapshots/000001/coefficients/x");
  const vehd::Matrix after = vehd::Hdf5Reader(directory / "next/run.h5").matrix("/snapshots/000000/coefficients/x");
  BOOST_TEST((after.topRows(49) == before));
  BOOST_TEST(after.bottomRows(81 - 49).isZero(0.0));
}

BOOST_FIXTURE_TEST_CASE(pictures_are_drawn_without_a_display, Run) {
  run(quick_scene("0.5"), {});
  for (const char* picture : {"/plots/shapes.png", "/plots/history.png"}) {
    const std::string bytes = file_text(output + picture);
    BOOST_TEST(bytes.size() > 10000, picture);
    BOOST_TEST(bytes.substr(1, 3) == "PNG", picture);
  }
  const ProgramResult plot =
      run_vehd({"plot", output, "-o", directory / "pictures", "--times", "0,0.5", "--json", directory / "plot.json"});
  BOOST_TEST(plot.exit_code == 0, plot.errors);
  BOOST_TEST(json_of(directory / "plot.json").at("pictures").size() == 2);
}

BOOST_AUTO_TEST_SUITE_END()
