#include "bie/stepping/evaluation/growth.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/evaluation/wrinkling.hpp"
#include "bie/stepping/thresholds.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

constexpr int kCompressedOrder = 12;

/// A field that flattens a prolate, as Figure 3 of the paper has it.
Model compressed() {
  Model model = field_model();
  model.vesicles[0].bending = BendingParameters{0.01};
  return model;
}

struct CompressedStart {
  Discretisation discretisation = discretisation_of(kCompressedOrder);
  State state;
  Evaluation evaluation;

  explicit CompressedStart(const Model& model, const Matrix& position = prolate(kCompressedOrder))
      : state(start(model, discretisation, position, 0.1)) {
    Instruments instruments;
    evaluation = evaluate(model, discretisation, state, instruments);
  }
  /// To V_m = amplitude cos θ.
  void charge(const Model& model, double amplitude) {
    Vector& potential = state.vesicles[0].transmembrane_potential;
    potential[coefficient_index(1, 0)] = amplitude * std::sqrt(4.0 * std::numbers::pi / 3.0);
    Instruments instruments;
    evaluation = evaluate(model, discretisation, state, instruments);
  }
  /// Without a look ahead.
  [[nodiscard]] double growth(const Model& model, double until) const { return growth(model, Outlook{until}).steps; }
  [[nodiscard]] ErrorGrowth growth(const Model& model, const Outlook& outlook) const {
    return expected_growth(model, discretisation, state, evaluation, outlook);
  }
  [[nodiscard]] Outlook outlook(const Model& model, double until, double delay) const {
    Instruments instruments;
    return look_ahead(model, discretisation, state, evaluation, until, delay, instruments);
  }
};

}  // namespace

BOOST_AUTO_TEST_SUITE(growth)

BOOST_AUTO_TEST_CASE(errors_of_a_compressed_membrane_grow_at_the_rate_of_its_wrinkles) {
  const Model model = compressed();
  const CompressedStart found(model);
  const VesicleDiagnostics& now = found.evaluation.diagnostics.vesicles[0];
  const double radius = std::sqrt(found.state.vesicles[0].reference_area / (4.0 * std::numbers::pi));
  const double rate = wrinkling_rate(flow_parameters(model, model.vesicles[0]), now.tension_integral / now.area, radius,
                                     kCompressedOrder);
  BOOST_TEST(rate > 0.3);
  for (const double time : {0.1, 1.0}) {
    BOOST_TEST(found.growth(model, time) == std::exp(rate * time), boost::test_tools::tolerance(1e-12));
  }
  BOOST_TEST(found.growth(model, 20.0) == thresholds::most_growth_of_steps, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(found.growth(model, std::numeric_limits<double>::infinity()) == thresholds::most_growth_of_steps,
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST(found.growth(model, 0.0) == 1.0);
}

BOOST_AUTO_TEST_CASE(nothing_grows_on_membranes_that_are_stretched_or_frozen) {
  Model stretched = relaxation_model(0.1);
  stretched.flow = axisymmetric_extension(10.0);
  BOOST_TEST(CompressedStart(stretched).growth(stretched, 1e3) == 1.0);
  Model frozen = compressed();
  frozen.mobile = false;
  BOOST_TEST(CompressedStart(frozen).growth(frozen, 1e3) == 1.0);
}

// The field charges the membrane, whose stress weakens the compression.
BOOST_AUTO_TEST_CASE(a_compression_that_weakens_lasts_until_it_would_be_gone) {
  const Model model = compressed();
  const CompressedStart found(model);
  constexpr double kDelay = 1e-3;
  Outlook outlook = found.outlook(model, 1e3, kDelay);
  BOOST_REQUIRE(outlook.soon.has_value());
  const VesicleDiagnostics& now = found.evaluation.diagnostics.vesicles[0];
  const Membrane& membrane = *outlook.soon->vesicles[0].membrane;
  const double soon =
      membrane.fine.synthesize(outlook.soon->fields.vesicles[0].tension).col(0).dot(membrane.surface.quadrature) /
      now.area;
  const double tension = now.tension_integral / now.area;
  BOOST_REQUIRE(soon > tension);
  const double time = 0.5 * tension * kDelay / (tension - soon);
  BOOST_REQUIRE(time > 0.0);
  BOOST_TEST(time < 20.0);
  const double sure = std::exp(now.wrinkling_rate * time);
  const double expected = std::max(sure, thresholds::unsure_growth);
  BOOST_TEST(found.growth(model, outlook).steps == expected, boost::test_tools::tolerance(1e-6));
  outlook.soon.reset();
  BOOST_TEST(found.growth(model, outlook).steps == thresholds::most_growth_of_steps,
             boost::test_tools::tolerance(1e-12));
}

// The field becomes thirty times as strong.
BOOST_AUTO_TEST_CASE(a_jump_that_will_compress_is_seen_before) {
  Model model = compressed();
  model.electric->waveform = Waveform::table({0.0, 1.0, 1.0, 20.0}, {1.0, 1.0, 30.0, 30.0});
  CompressedStart found(model);
  found.charge(model, 1.0);
  const Outlook outlook = found.outlook(model, 2.0, 1e-3);
  BOOST_REQUIRE(outlook.jump.has_value());
  BOOST_TEST(*outlook.jump == 1.0);
  BOOST_REQUIRE(outlook.after_jump.has_value());
  Outlook blind = outlook;
  blind.after_jump.reset();
  BOOST_TEST(found.growth(model, outlook).steps > 2.0 * found.growth(model, blind).steps);
}

// Of a membrane that a flow draws out, until a field compresses it.
BOOST_AUTO_TEST_CASE(what_a_tension_smooths_last_grows_after_a_jump) {
  const Model model = compressed();
  CompressedStart later(model);
  later.charge(model, 0.1);
  Model drawn = model;
  drawn.flow = axisymmetric_extension(0.3);
  CompressedStart now(drawn);
  now.charge(drawn, 0.1);
  const VesicleDiagnostics& taut = now.evaluation.diagnostics.vesicles[0];
  const VesicleDiagnostics& loose = later.evaluation.diagnostics.vesicles[0];
  BOOST_REQUIRE(taut.tension_integral > 0.0);
  BOOST_REQUIRE(loose.tension_integral < 0.0);
  const double radius = std::sqrt(now.state.vesicles[0].reference_area / (4.0 * std::numbers::pi));
  const auto fastest = [&](const VesicleDiagnostics& of) {
    double rate = -std::numeric_limits<double>::infinity();
    for (int degree = 2; degree <= kCompressedOrder; ++degree) {
      rate = std::max(rate, disturbance_rate(flow_parameters(model, model.vesicles[0]), of.tension_integral / of.area,
                                             radius, degree));
    }
    return rate;
  };
  constexpr double kJump = 0.02, kAfter = 0.1;
  Outlook outlook{kJump + kAfter};
  outlook.jump = kJump;
  outlook.after_jump = later.evaluation;
  const double exponent = fastest(taut) * kJump + fastest(loose) * kAfter;
  BOOST_REQUIRE(fastest(taut) < 0.0);
  BOOST_REQUIRE(exponent > 0.02);
  BOOST_TEST(now.growth(drawn, outlook).steps == std::exp(exponent), boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(what_degrees_leave_out_is_not_felt_by_the_lowest) {
  const Model model = compressed();
  const CompressedStart found(model);
  const VesicleDiagnostics& now = found.evaluation.diagnostics.vesicles[0];
  const double radius = std::sqrt(found.state.vesicles[0].reference_area / (4.0 * std::numbers::pi));
  double fastest = 0.0;
  for (int degree = kCompressedOrder / thresholds::degrees_that_feel_the_cut; degree <= kCompressedOrder; ++degree) {
    fastest = std::max(fastest, disturbance_rate(flow_parameters(model, model.vesicles[0]),
                                                 now.tension_integral / now.area, radius, degree));
  }
  BOOST_TEST(found.growth(model, Outlook{1.0}).degrees == std::max(1.0, std::exp(fastest)),
             boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(errors_are_remembered_until_points_have_moved_by_the_radius) {
  const Model model = shear_model();
  const CompressedStart found(model, ellipsoid(kCompressedOrder, {2.0, 1.0, 1.0}));
  const double long_time = memory_of_shapes(model, found.state, found.evaluation, 1e6);
  BOOST_TEST(long_time > 1.0);
  BOOST_TEST(long_time < 4.0);
  BOOST_TEST(memory_of_shapes(model, found.state, found.evaluation, 0.25) == 0.25);
  Model frozen = model;
  frozen.mobile = false;
  BOOST_TEST(memory_of_shapes(frozen, found.state, found.evaluation, 1e6) == 0.0);
}

// The shear that compresses a prolate along its axis at first soon has it turned.
BOOST_AUTO_TEST_CASE(compression_lasts_until_the_shape_has_changed) {
  const Model model = shear_model();
  const CompressedStart found(model, ellipsoid(kCompressedOrder, {2.0, 1.0, 1.0}));
  const double growth = found.growth(model, 1e6);
  BOOST_TEST(growth > 1.0);
  BOOST_TEST(growth < 1.2);
}

BOOST_AUTO_TEST_SUITE_END()
