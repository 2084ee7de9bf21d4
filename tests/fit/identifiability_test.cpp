#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/fit/fit_file.hpp"
#include "bie/fit/synthesis.hpp"
#include "bie/support/thread_count.hpp"
#include "tests/fit/fit_folder.hpp"

// Designs whose undetermined combinations of keys are known.
BOOST_AUTO_TEST_SUITE(identifiability, *boost::unit_test::label("slow") * boost::unit_test::label("extended"))

namespace {

struct Design : vehd::testing::FitFolder {
  vehd::ThreadCount one{1};

  /// Data of a scene with the noise of a seed, and the fit of these keys to them.
  [[nodiscard]] vehd::FitResult fitted(const std::string& scene, vehd::Synthesis synthesis,
                                       const std::string& keys) const {
    write_text(directory / "scene.toml", scene);
    synthesis.source.file = directory / "scene.toml";
    const vehd::Experiment experiment = vehd::experiment_of(synthesis);
    {
      vehd::Interruption interruption;
      const vehd::Vector values = vehd::simulated_values(experiment, {.directory = directory / "made"}, interruption);
      write_text(directory / "data.csv", vehd::synthetic_data(synthesis, experiment, values));
    }
    write_text(directory / "fit.toml", "[[experiment]]\nscene = \"scene.toml\"\ndata = \"data.csv\"\nquantity = \"" +
                                           synthesis.quantity + "\"\n[free]\n" + keys);
    return result(vehd::read_fit(directory / "fit.toml"));
  }
};

/// Requires that one combination, along this direction, is undetermined and that no key in it has an interval.
void require_undetermined(const vehd::FitResult& result, const vehd::Vector& direction) {
  BOOST_TEST_REQUIRE(result.statistics.undetermined.size() == 1u);
  BOOST_TEST(std::abs(result.statistics.undetermined.front().direction.dot(direction.normalized())) > 0.99);
  for (const double error : result.statistics.errors) BOOST_TEST(!std::isfinite(error));
}

/// A shape whose excess area goes from the fourth mode to the second.
const std::string relaxing =
    "[shape]\nkind = \"radial\"\nmodes = [{n = 2, m = 0, a = 0.1}, {n = 4, m = 0, a = 0.2}]\n"
    "[membrane]\nbending_modulus = 1.0\n"
    "[fluid]\nviscosity = 1.0\n[numerics]\ndegree = 10\ntolerance = 1e-3\nend_time = 0.4\n[output]\nevery = 0.02\n";

}  // namespace

BOOST_AUTO_TEST_CASE(relaxation_without_a_field_determines_bending_over_viscosity) {
  const Design design;
  require_undetermined(design.fitted(relaxing, {.quantity = "aspect_ratio", .noise = "0.005"},
                                     "\"membrane.bending_modulus\" = {from = 0.1, to = 10}\n"
                                     "\"fluid.viscosity\" = {from = 0.1, to = 10}\n"),
                       vehd::Vector{{1.0, 1.0}});
}

BOOST_AUTO_TEST_CASE(relaxation_with_a_known_viscosity_determines_bending) {
  const Design design;
  const vehd::FitResult result = design.fitted(relaxing, {.quantity = "aspect_ratio", .noise = "0.005", .seed = 2},
                                               "\"membrane.bending_modulus\" = {from = 0.1, to = 10}\n");
  BOOST_TEST(std::abs(std::log(result.values[0])) < 3.5 * result.statistics.errors[0]);
  BOOST_TEST(result.statistics.errors[0] < 0.05);
}

// The phase of V_m on a sphere is atan(ω a C_m (1/σ_i + 1/(2σ_e))).
BOOST_AUTO_TEST_CASE(phases_over_frequency_determine_the_product_of_capacitance_and_radius) {
  const Design design;
  const std::string scene =
      "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 1.0, 1.0]\nscale = 1.0\n[membrane]\ncapacitance = 1.0\n"
      "[electric]\nfield = [0.0, 0.0, 0.1]\nconductivity_in = 1.0\nconductivity_out = 1.0\n"
      "[electric.waveform]\nkind = \"ac\"\nfrequency = 0.1\naverage = true\n"
      "[numerics]\ndegree = 4\ntolerance = 1e-3\nend_time = 0.0\n";
  require_undetermined(design.fitted(scene,
                                     {.quantity = "Vm_phase_deg",
                                      .key = "electric.waveform.frequency",
                                      .values = {"0.02", "0.05", "0.1", "0.2", "0.5"},
                                      .noise = "1"},
                                     "\"membrane.capacitance\" = {from = 0.1, to = 10}\n"
                                     "\"shape.scale\" = {from = 0.1, to = 10}\n"),
                       vehd::Vector{{1.0, -1.0}});
}

BOOST_AUTO_TEST_SUITE_END()
