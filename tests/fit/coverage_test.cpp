#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "bie/fit/fit_file.hpp"
#include "bie/fit/synthesis.hpp"
#include "bie/support/thread_count.hpp"
#include "tests/fit/fit_folder.hpp"

// How often intervals contain the true value, in 100 repetitions with different noise.
BOOST_AUTO_TEST_SUITE(fit_coverage, *boost::unit_test::label("slow") * boost::unit_test::label("extended"))

namespace {

using vehd::Index;
using vehd::Matrix;
using vehd::Vector;

/// Predictions of runs over two keys, interpolated by polynomials between runs at n x n Chebyshev nodes. So 100 fits
/// cost the runs of two.
class Interpolated {
 public:
  Interpolated(const vehd::FitFile& fit, const vehd::ModelRuns& runs, const vehd::LeastSquares& problem)
      : middle_(0.5 * (problem.lower + problem.upper)), half_(0.5 * (problem.upper - problem.lower)) {
    std::vector<std::vector<std::string>> settings;
    for (Index i = 0; i < n; ++i) {
      for (Index j = 0; j < n; ++j) {
        const Vector p = middle_ + half_.cwiseProduct(Vector{{node(i), node(j)}});
        settings.push_back(
            {fit.keys[0].setting_of(fit.keys[0].number_of(p[0])), fit.keys[1].setting_of(fit.keys[1].number_of(p[1]))});
      }
    }
    for (const vehd::Prediction& prediction : runs.predict(settings)) values_.push_back(prediction.values.value());
  }

  [[nodiscard]] Vector operator()(const Vector& p) const {
    const Vector x = (p - middle_).cwiseQuotient(half_);
    const Vector a = weights(x[0]), b = weights(x[1]);
    Vector sum = Vector::Zero(values_.front().size());
    for (Index i = 0; i < n; ++i) {
      for (Index j = 0; j < n; ++j) sum += a[i] * b[j] * values_[static_cast<std::size_t>(i * n + j)];
    }
    return sum;
  }

 private:
  static constexpr Index n = 5;
  static double node(Index i) { return std::cos(std::numbers::pi * (static_cast<double>(i) + 0.5) / n); }
  /// Lagrange weights of the nodes at x.
  static Vector weights(double x) {
    Vector weights = Vector::Ones(n);
    for (Index i = 0; i < n; ++i) {
      for (Index k = 0; k < n; ++k) weights[i] *= k == i ? 1.0 : (x - node(k)) / (node(i) - node(k));
    }
    return weights;
  }

  Vector middle_, half_;
  std::vector<Vector> values_;
};

/// An experiment with two keys, and data computed with the scene's own values.
struct Design : vehd::testing::FitFolder {
  vehd::ThreadCount one{1};

  void require_coverage(const std::string& scene, vehd::Synthesis synthesis, const std::string& keys,
                        const Vector& truth) const {
    write_text(directory / "scene.toml", scene);
    synthesis.source.file = directory / "scene.toml";
    vehd::Interruption interruption;
    const vehd::Experiment experiment = vehd::experiment_of(synthesis);
    const Vector exact = vehd::simulated_values(experiment, {.directory = directory / "made"}, interruption);
    write_text(directory / "data.csv", vehd::synthetic_data(synthesis, experiment, exact));
    write_text(directory / "fit.toml", "[[experiment]]\nscene = \"scene.toml\"\ndata = \"data.csv\"\nquantity = \"" +
                                           synthesis.quantity + "\"\n[free]\n" + keys);
    const vehd::FitFile fit = vehd::read_fit(directory / "fit.toml");
    const vehd::ModelRuns runs(fit.experiments, {.directory = directory / "out", .n_workers = 2}, interruption);
    vehd::LeastSquares problem = vehd::least_squares_of(fit);
    const Interpolated model(fit, runs, problem);
    const Vector p{{fit.keys[0].coordinate_of(truth[0]), fit.keys[1].coordinate_of(truth[1])}};
    // The errors of the runs and of the interpolation are much smaller than the noise of the data.
    BOOST_TEST((model(p) - exact).cwiseQuotient(problem.deviations).norm() < 0.5);
    problem.model = [&](const std::vector<Vector>& points) {
      std::vector<vehd::Prediction> predictions;
      for (const Vector& point : points) predictions.push_back({model(point), ""});
      return predictions;
    };
    Eigen::Array2i within_one = Eigen::Array2i::Zero(), within_two = within_one;
    for (int seed = 1; seed <= 100; ++seed) {
      vehd::NormalNumbers normal(static_cast<std::uint64_t>(seed));
      for (Index i = 0; i < exact.size(); ++i) problem.data[i] = exact[i] + problem.deviations[i] * normal();
      vehd::Minimum minimum = vehd::minimum_of(problem);
      BOOST_TEST(minimum.converged);
      BOOST_TEST(minimum.n_evaluations <= 60);
      const vehd::Statistics found =
          vehd::statistics_of(minimum.jacobian, vehd::undetermined_combinations(problem, minimum));
      BOOST_TEST(found.undetermined.empty());
      const Eigen::Array2d miss = (minimum.point - p).cwiseQuotient(found.errors).cwiseAbs();
      within_one += (miss <= 1.0).cast<int>();
      within_two += (miss <= 1.959964).cast<int>();
    }
    for (Index k = 0; k < 2; ++k) {
      BOOST_TEST_MESSAGE(fit.keys[static_cast<std::size_t>(k)].name << ": " << within_one[k] << " within 68 %, "
                                                                    << within_two[k] << " within 95 %");
      BOOST_TEST(within_one[k] >= 55);
      BOOST_TEST(within_one[k] <= 80);
      BOOST_TEST(within_two[k] >= 88);
    }
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(charging_in_a_pulse_for_capacitance_and_conductance) {
  const std::string scene = vehd::testing::ChargingSphere::scene() + "[output]\nevery = \"40 us\"\n";
  Design().require_coverage(scene, {.quantity = "Vm_north", .noise = "10 mV"},
                            "\"membrane.capacitance\" = {from = \"0.4 uF/cm^2\", to = \"0.9 uF/cm^2\"}\n"
                            "\"membrane.conductance\" = {from = \"5 S/m^2\", to = \"13 S/m^2\"}\n",
                            Vector{{0.6, 8.0}});
}

// Weak fields, whose stress is balanced by bending: shapes at the end of a run over frequency.
BOOST_AUTO_TEST_CASE(shapes_over_frequency_for_bending_and_capacitance) {
  const std::string scene =
      "[shape]\nkind = \"radial\"\nmodes = [{n = 2, m = 0, a = 0.1}, {n = 4, m = 0, a = 0.2}]\n"
      "[membrane]\nbending_modulus = 1.0\ncapacitance = 1.0\n"
      "[fluid]\nviscosity = 1.0\n[electric]\nfield = [0.0, 0.0, 3.0]\nconductivity_in = 1.0\nconductivity_out = 1.0\n"
      "permittivity = 1.0\n[electric.waveform]\nkind = \"ac\"\nfrequency = 0.1\naverage = true\n"
      "[numerics]\ndegree = 8\ntolerance = 1e-3\nend_time = 0.4\n";
  Design().require_coverage(scene,
                            {.quantity = "aspect_ratio_field",
                             .key = "electric.waveform.frequency",
                             .values = {"0.03", "0.1", "0.2", "0.3", "0.5", "1", "3"},
                             .noise = "0.003"},
                            "\"membrane.bending_modulus\" = {from = 0.5, to = 2}\n"
                            "\"membrane.capacitance\" = {from = 0.5, to = 2}\n",
                            Vector{{1.0, 1.0}});
}

// A field has stretched the vesicle: tension pulls it back in the first tenth of a second, bending in the seconds
// after.
BOOST_AUTO_TEST_CASE(relaxation_with_undulations_for_bending_and_tension) {
  const std::string scene =
      "[units]\nlength = \"10 um\"\ntime = \"1 s\"\n"
      "[shape]\nkind = \"radial\"\narea = \"1270 um^2\"\nmodes = [{n = 2, m = 0, a = 0.25}]\n"
      "[membrane]\nbending_modulus = \"2e-19 J\"\nundulations = true\ntemperature = \"298 K\"\n"
      "stretching_modulus = \"0.24 N/m\"\nreference_tension = \"1e-6 N/m\"\n"
      "[fluid]\nviscosity = \"1 mPa s\"\n[output]\nevery = \"0.05 s\"\n"
      "[numerics]\ndegree = 8\ntolerance = 1e-3\nend_time = \"2 s\"\n";
  Design().require_coverage(scene, {.quantity = "aspect_ratio", .noise = "0.003"},
                            "\"membrane.bending_modulus\" = {from = \"1.4e-19 J\", to = \"2.8e-19 J\"}\n"
                            "\"membrane.reference_tension\" = {from = \"5e-7 N/m\", to = \"2e-6 N/m\"}\n",
                            Vector{{2e-19, 1e-6}});
}

BOOST_AUTO_TEST_SUITE_END()
