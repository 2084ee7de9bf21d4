#include <boost/test/unit_test.hpp>

#include "bie/fit/fit_file.hpp"
#include "bie/support/thread_count.hpp"
#include "tests/fit/fit_folder.hpp"

BOOST_AUTO_TEST_SUITE(fit_round_trips, *boost::unit_test::label("slow") * boost::unit_test::label("extended"))

namespace {

namespace fs = std::filesystem;
using vehd::testing::ChargingSphere;

constexpr double deviation_mV = 5.0;

/// The charging of a sphere, measured every 40 us.
struct ChargingFit : vehd::testing::FitFolder {
  vehd::ThreadCount one{1};
  ChargingSphere sphere;

  explicit ChargingFit(std::uint64_t seed = 1) {
    write_text(directory / "charging.toml", ChargingSphere::scene());
    std::vector<double> times;
    for (int i = 0; i <= 25; ++i) times.push_back(0.04 * i);
    const auto exact = [this](double ms) { return 1e3 * sphere.potential(1e-3 * ms); };
    write_data("charging.csv", "time [ms],Vm_north [mV],deviation [mV]", times, exact, deviation_mV, seed);
  }

  [[nodiscard]] vehd::FitFile fit(const std::string& keys) const {
    write_text(
        directory / "fit.toml",
        "[[experiment]]\nscene = \"charging.toml\"\ndata = \"charging.csv\"\nquantity = \"Vm_north\"\n[free]\n" + keys);
    return vehd::read_fit(directory / "fit.toml");
  }
  [[nodiscard]] vehd::FitFile fit() const {
    return fit(
        "\"membrane.capacitance\" = {from = \"0.2 uF/cm^2\", to = \"5 uF/cm^2\"}\n"
        "\"membrane.conductance\" = {from = \"1 S/m^2\", to = \"200 S/m^2\"}\n");
  }
};

std::vector<fs::file_time_type> times_of_results(const fs::path& runs) {
  std::vector<fs::file_time_type> times;
  for (const auto& entry : fs::directory_iterator(runs))
    times.push_back(fs::last_write_time(entry.path() / "result.json"));
  std::ranges::sort(times);
  return times;
}

}  // namespace

BOOST_AUTO_TEST_CASE(charging_of_a_sphere_gives_capacitance_and_conductance) {
  const ChargingFit charging;
  const vehd::FitFile fit = charging.fit();
  const vehd::FitResult result = charging.result(fit);
  BOOST_TEST(result.minimum.converged);
  BOOST_TEST(result.minimum.n_evaluations <= 60);
  BOOST_TEST(result.statistics.undetermined.empty());
  const auto& errors = result.statistics.errors;
  BOOST_TEST(std::abs(std::log(result.values[0] / 1.0)) < 3.5 * errors[0]);
  BOOST_TEST(std::abs(std::log(result.values[1] / 20.0)) < 3.5 * errors[1]);
  // From 26 values of 250 mV with 5 mV each.
  BOOST_TEST(errors[0] < 0.03);
  BOOST_TEST(errors[1] < 0.03);
  // χ² with 24 degrees of freedom: between these in all but one case of a thousand.
  BOOST_TEST(result.minimum.chi2() < 51.2);
  BOOST_TEST(result.minimum.chi2() > 8.1);
  // The errors follow from the closed form as well.
  const auto slope = [&](double capacitance, double conductance) {
    vehd::Vector change(26);
    for (int i = 0; i <= 25; ++i) {
      const double up = ChargingSphere{0.01 * capacitance, 20.0 * conductance}.potential(4e-5 * i);
      const double down = ChargingSphere{0.01 / capacitance, 20.0 / conductance}.potential(4e-5 * i);
      change[i] = 1e3 * (up - down) / (2e-3 * deviation_mV);
    }
    return change;
  };
  vehd::Matrix jacobian(26, 2);
  jacobian << slope(std::exp(1e-3), 1.0), slope(1.0, std::exp(1e-3));
  const vehd::Statistics exact = vehd::statistics_of(jacobian, {});
  BOOST_TEST(errors[0] == exact.errors[0], boost::test_tools::tolerance(0.05));
  BOOST_TEST(errors[1] == exact.errors[1], boost::test_tools::tolerance(0.05));
  BOOST_TEST(std::abs(result.statistics.correlation(0, 1) - exact.correlation(0, 1)) < 0.05);
}

BOOST_AUTO_TEST_CASE(any_number_of_workers_finds_the_same_and_a_second_call_computes_only_lost_runs) {
  const ChargingFit charging;
  const vehd::FitFile fit = charging.fit();
  const std::string first = vehd::json_of(fit, charging.result(fit)).dump();
  BOOST_TEST(vehd::json_of(fit, charging.result(fit, "one", 1)).dump() == first);
  const fs::path runs = charging.directory / "out/runs";
  const auto times = times_of_results(runs);
  BOOST_TEST(vehd::json_of(fit, charging.result(fit)).dump() == first);
  BOOST_TEST((times_of_results(runs) == times));
  // As after a kill: a run without a result, and another one without any file.
  std::vector<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(runs)) folders.push_back(entry.path());
  fs::remove(folders.at(0) / "result.json");
  fs::remove_all(folders.at(1));
  BOOST_TEST(vehd::json_of(fit, charging.result(fit)).dump() == first);
  const auto later = times_of_results(runs);
  BOOST_TEST(std::ranges::count_if(later, [&](auto time) { return time > times.back(); }) == 2);
}

BOOST_AUTO_TEST_CASE(two_fits_do_not_work_in_one_directory) {
  const ChargingFit charging;
  const vehd::FitFile fit = charging.fit();
  vehd::Interruption interruption;
  const vehd::ModelRuns first(fit.experiments, {.directory = charging.directory / "out"}, interruption);
  BOOST_CHECK_THROW(static_cast<void>(charging.result(fit)), vehd::DirectoryBusy);
}

BOOST_AUTO_TEST_CASE(combinations_that_charging_does_not_determine_are_reported) {
  // The data determine a time and an amplitude, but the fit has three keys.
  const ChargingFit charging;
  const vehd::FitFile fit = charging.fit(
      "\"membrane.capacitance\" = {from = \"0.2 uF/cm^2\", to = \"5 uF/cm^2\"}\n"
      "\"membrane.conductance\" = {from = \"1 S/m^2\", to = \"200 S/m^2\"}\n"
      "\"electric.conductivity_in\" = {from = \"1 uS/cm\", to = \"50 uS/cm\"}\n");
  const vehd::FitResult result = charging.result(fit);
  BOOST_TEST(result.statistics.undetermined.size() == 1u);
  for (const double error : result.statistics.errors) BOOST_TEST(!std::isfinite(error));
  const nlohmann::json json = vehd::json_of(fit, result);
  BOOST_TEST(json["errors"]["membrane.capacitance"].is_null());
  BOOST_TEST(json["intervals_68"]["membrane.capacitance"].is_null());
  BOOST_TEST(json["undetermined"].size() == 1u);
  BOOST_TEST(json["at_end"].empty());
}

BOOST_AUTO_TEST_CASE(keys_at_an_end_of_their_intervals_have_no_intervals_of_errors) {
  const ChargingFit charging;
  const vehd::FitFile fit = charging.fit("\"membrane.conductance\" = {from = \"25 S/m^2\", to = \"200 S/m^2\"}\n");
  const nlohmann::json json = vehd::json_of(fit, charging.result(fit));
  BOOST_TEST(json["at_end"] == nlohmann::json({"membrane.conductance"}));
  BOOST_TEST(json["errors"]["membrane.conductance"].is_null());
  BOOST_TEST(json["intervals_95"]["membrane.conductance"].is_null());
}

BOOST_AUTO_TEST_SUITE_END()
