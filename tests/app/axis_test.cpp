#include <boost/test/unit_test.hpp>
#include <map>
#include <nlohmann/json.hpp>

#include "bie/files/hdf5_reader.hpp"
#include "bie/runs/history.hpp"
#include "bie/sphere/harmonics.hpp"
#include "tests/app/program.hpp"

using vehd::Matrix;

namespace {

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  BOOST_TEST_REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), by);
}

/// The quick scene with x, y, z in the place of z, x, y.
std::string scene_about_x(const std::string& end_time = "3.0") {
  return replaced(replaced(quick_scene(end_time), "[1.0, 1.0, 1.5]", "[1.5, 1.0, 1.0]"), "[0.0, 0.0, 0.5]",
                  "[0.5, 0.0, 0.0]");
}

std::string finished_run(const TemporaryDirectory& directory, const std::string& name, const std::string& scene,
                         bool resume = false) {
  write_text(directory / (name + ".toml"), scene);
  std::vector<std::string> arguments = {"run", directory / (name + ".toml"), "-o", directory / name, "--no-plot"};
  if (resume) arguments.emplace_back("--resume");
  const ProgramResult result = run_vehd(arguments);
  BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
  return directory / name;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  BOOST_TEST_REQUIRE(a.size() == b.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

const std::vector<std::string> kInvariant = {"time",   "area",       "volume",     "bending_energy_scaled",
                                             "Vm_max", "strain_max", "area_drift", "tension_integral"};

/// Solves stop at a relative tolerance of 1e-9, and rounding may change the last iteration; twelve steps add up.
constexpr double kSolvers = 1e-7;

/// Values of a vector field at the poles of the three axes, [x, y, z directions x components].
Matrix on_the_axes(const Matrix& coefficients) {
  const double half_pi = std::acos(0.0);
  return vehd::evaluate_harmonics(coefficients, vehd::Vector{{half_pi, half_pi, 0.0}},
                                  vehd::Vector{{0.0, half_pi, 0.0}});
}

}  // namespace

BOOST_AUTO_TEST_SUITE(axis)

BOOST_AUTO_TEST_CASE(scene_about_x_is_the_scene_about_z_with_coordinates_permuted) {
  const TemporaryDirectory directory;
  const std::string z = finished_run(directory, "z", quick_scene());
  const std::string x = finished_run(directory, "x", scene_about_x());
  const vehd::HistoryTable upright(z + "/history.csv"), lying(x + "/history.csv");
  for (const std::string& name : kInvariant) {
    BOOST_TEST(largest_difference(upright.column(name), lying.column(name)) < kSolvers, name);
  }
  const std::map<std::string, std::string> image = {
      {"extent_z", "extent_x"}, {"extent_x", "extent_y"}, {"extent_y", "extent_z"}};
  for (const auto& [before, after] : image) {
    BOOST_TEST(largest_difference(upright.column(before), lying.column(after)) < kSolvers, after);
  }
  BOOST_TEST(std::abs(lying.column("inclination_deg").back()) < kSolvers);
  // The field is normal to the z axis, so V_m vanishes there.
  BOOST_TEST(std::abs(lying.column("Vm_north").back()) < 1e-12);

  const vehd::Hdf5Reader file_z(z + "/run.h5"), file_x(x + "/run.h5");
  const std::string snapshot = "/snapshots/000006/coefficients/";
  for (const char* name : {"x", "velocity", "force_bending", "force_tension", "force_electric"}) {
    const Matrix a = on_the_axes(file_z.matrix(snapshot + name)), b = on_the_axes(file_x.matrix(snapshot + name));
    // Forces are fourth derivatives of x, which amplify its rounding errors by three powers of the degree.
    const double bound = std::string(name).starts_with("force") ? 100.0 * kSolvers : kSolvers;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        BOOST_TEST(std::abs(b((i + 1) % 3, (j + 1) % 3) - a(i, j)) < bound,
                   name << " " << b((i + 1) % 3, (j + 1) % 3) - a(i, j));
      }
    }
  }
  for (const char* name : {"Vm", "q", "tension"}) {
    const Matrix a = on_the_axes(file_z.matrix(snapshot + name)), b = on_the_axes(file_x.matrix(snapshot + name));
    for (int i = 0; i < 3; ++i) BOOST_TEST(std::abs(b((i + 1) % 3, 0) - a(i, 0)) < kSolvers, name);
  }
}

BOOST_AUTO_TEST_CASE(reduced_run_about_x_is_the_full_run_and_needs_fewer_kernels) {
  const TemporaryDirectory directory;
  const std::string off = replaced(scene_about_x(), "[numerics]\n", "[numerics]\nsymmetry = \"off\"\n");
  const std::string reduced = finished_run(directory, "auto", scene_about_x());
  const std::string full = finished_run(directory, "off", off);
  const vehd::HistoryTable a(reduced + "/history.csv"), b(full + "/history.csv");
  for (const char* name : {"extent_x", "extent_y", "extent_z", "Vm_max", "Vm_north", "q_north", "volume"}) {
    BOOST_TEST(largest_difference(a.column(name), b.column(name)) < 1e-9 * static_cast<double>(a.n_rows()), name);
  }
  const auto evaluations = [](const std::string& run) {
    const auto summary = json_of(run + "/summary.json");
    return summary["kernel_evaluations"]["stokes_single"].get<double>();
  };
  // Order 6: the full solver evaluates 7 x 14 targets with all nodes; the reduced one evaluates 4 targets, those of one
  // longitude that the mirror symmetry leaves, with half of the nodes.
  BOOST_TEST(evaluations(full) / evaluations(reduced) == 98.0 / 2.0, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(run_about_x_resumes_bit_for_bit) {
  const TemporaryDirectory directory;
  const std::string reference = finished_run(directory, "reference", scene_about_x());
  finished_run(directory, "resumed", scene_about_x("1.5"));
  const std::string resumed = finished_run(directory, "resumed", scene_about_x(), true);
  BOOST_TEST((file_text(resumed + "/history.csv") == file_text(reference + "/history.csv")));
  const vehd::Hdf5Reader a(resumed + "/run.h5"), b(reference + "/run.h5");
  for (const char* name : {"x", "velocity", "Vm", "force_electric"}) {
    const std::string dataset = std::string("/snapshots/000006/") + name;
    BOOST_TEST((a.vector(dataset).array() == b.vector(dataset).array()).all(), name);
  }
}

BOOST_AUTO_TEST_SUITE_END()
