#include "bie/stepping/evaluation/operator_checks.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "bie/stepping/evolution.hpp"
#include "bie/support/errors.hpp"
#include "tests/support/membrane.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

LayerCheck check_of(int order, const Matrix& position, double oversampling, const LayerSelection& selection) {
  const Space space(order, NumericalSettings{}.upsampling, oversampling);
  return check_layers(make_membrane(space, position, selection));
}

double separation_of(int order, const Matrix& position) {
  return separation(SphereTransform(order, make_grid(order)), position, false);
}

EvolutionSetup setup_of(const Model& model, int order, double dt) {
  NumericalSettings settings;
  settings.order = order;
  return {model, settings, {}, fixed_steps(dt)};
}

/// A model that contracts the rim of a disc.
Model drawing_model() {
  Model model = relaxation_model(0.05);
  model.flow = axisymmetric_extension(1.0);
  return model;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(operator_checks)

BOOST_AUTO_TEST_CASE(both_layers_are_checked_against_exact_values) {
  const Matrix shape = asymmetric_shape(12);
  const double exactness = 1e-6;
  BOOST_TEST(check_of(12, shape, 1.15, kStokesLayer).error < exactness);
  BOOST_TEST(check_of(12, shape, 1.15, kLaplaceLayers).error < exactness);
  // Half the nodes: an error that either layer must show.
  BOOST_TEST(check_of(12, shape, 0.5, kStokesLayer).error > 1e-5);
  BOOST_TEST(check_of(12, shape, 0.5, kLaplaceLayers).error > 1e-5);
}

BOOST_AUTO_TEST_CASE(near_parts_are_seen_and_finer_quadrature_helps) {
  const Matrix disc = dimpled_disc(16, 0.05);
  const double coarse = check_of(16, disc, 1.15, kStokesLayer).error;
  const double fine = check_of(16, disc, 2.0, kStokesLayer).error;
  BOOST_TEST(coarse > 5e-5);
  BOOST_TEST(fine < 0.1 * coarse);
  BOOST_TEST(check_of(16, disc, 1.15, kStokesLayer).truncation < 0.01 * coarse);
}

BOOST_AUTO_TEST_CASE(truncation_is_distinguished_from_quadrature) {
  // Not band-limited: at order 10 the truncation error dominates, whatever the quadrature.
  const Matrix shape = shape_33(10);
  const LayerCheck coarse = check_of(10, shape, 1.5, kStokesLayer);
  const LayerCheck fine = check_of(10, shape, 3.0, kStokesLayer);
  BOOST_TEST(std::abs(fine.error - coarse.error) < 0.01 * fine.error);
  BOOST_TEST(fine.error < 3.0 * fine.truncation);
}

BOOST_AUTO_TEST_CASE(separation_is_the_distance_of_facing_parts_over_the_spacing) {
  constexpr int kOrder = 16;
  const double n_nodes = 2.0 * (kOrder + 1) * (kOrder + 1);
  const double spacing = std::sqrt(4.0 * std::numbers::pi / n_nodes);
  BOOST_TEST(std::abs(separation_of(kOrder, sphere(kOrder, 3.0)) / (2.0 / spacing) - 1.0) < 0.14);
  // In the middle of the disc the area element is that of its projection, sin²θ dφ … → 1.
  for (const double c : {0.1, 0.02}) {
    const double expected = 2.0 * c / spacing;
    const double found = separation_of(kOrder, dimpled_disc(kOrder, c));
    BOOST_TEST(found >= 0.95 * expected);
    BOOST_TEST(found < expected + 0.15);
  }
}

BOOST_AUTO_TEST_CASE(separation_is_independent_of_place_and_size_and_seen_from_one_meridian) {
  constexpr int kOrder = 12;
  const Matrix disc = dimpled_disc(kOrder, 0.1);
  const double expected = separation_of(kOrder, disc);
  BOOST_TEST(std::abs(separation_of(kOrder, translated(Matrix(2.5 * disc), {1.0, -2.0, 0.5})) - expected) < 1e-9);
  BOOST_TEST(std::abs(separation_of(kOrder, disc * general_rotation().transpose()) - expected) < 1e-9);
  BOOST_TEST(separation(SphereTransform(kOrder, make_grid(kOrder)), disc, true) == expected);
}

BOOST_AUTO_TEST_CASE(quadrature_follows_the_distance_of_the_parts) {
  Instruments instruments;
  Evolution evolution(setup_of(relaxation_model(0.05), 12, 0.01), {StartMembrane{dimpled_disc(12, 0.25)}}, instruments);
  evolution.evaluate_start();
  BOOST_TEST(evolution.state().vesicles[0].quadrature_level == 0);
  BOOST_TEST(evolution.evaluation().diagnostics.vesicles[0].quadrature_error <
             NumericalSettings{}.quadrature_tolerance);

  Evolution near(setup_of(relaxation_model(0.05), 12, 0.01), {StartMembrane{dimpled_disc(12, 0.04)}}, instruments);
  near.evaluate_start();
  BOOST_TEST(near.state().vesicles[0].quadrature_level > 0);
  BOOST_TEST(near.evaluation().diagnostics.vesicles[0].quadrature_error < NumericalSettings{}.quadrature_tolerance);
  BOOST_TEST(near.evaluation().diagnostics.vesicles[0].separation < 1.0);

  // Continued from that state, a run uses the same quadrature at once.
  Evolution continued(setup_of(relaxation_model(0.05), 12, 0.01), near.state(), instruments);
  continued.evaluate_start();
  BOOST_TEST((continued.evaluation().fields.vesicles[0].velocity == near.evaluation().fields.vesicles[0].velocity));
}

BOOST_AUTO_TEST_CASE(a_start_in_contact_is_refused) {
  Instruments instruments;
  Evolution evolution(setup_of(relaxation_model(0.05), 12, 0.01), {StartMembrane{dimpled_disc(12, 0.002)}},
                      instruments);
  BOOST_CHECK_EXCEPTION(evolution.evaluate_start(), ConvergenceError, [](const ConvergenceError& error) {
    return std::string(error.what()).find("grid spacings from each other") != std::string::npos;
  });
}

BOOST_AUTO_TEST_CASE(a_disc_whose_sides_meet_is_stopped_before_they_cross) {
  Instruments instruments;
  Evolution evolution(setup_of(drawing_model(), 10, 0.05), {StartMembrane{dimpled_disc(10, 0.05)}}, instruments);
  evolution.evaluate_start();
  std::string reason;
  for (int i = 0; i < 400 && reason.empty(); ++i) {
    try {
      evolution.step({{}, 1e3});
    } catch (const ConvergenceError& error) {
      reason = error.what();
    }
  }
  BOOST_TEST_CONTEXT(reason) {
    BOOST_TEST(!reason.empty());
    const VesicleDiagnostics& last = evolution.evaluation().diagnostics.vesicles[0];
    BOOST_TEST(last.separation >= 0.1);
    BOOST_TEST(std::abs(last.area_drift) < 1e-6);
  }
}

BOOST_AUTO_TEST_SUITE_END()
