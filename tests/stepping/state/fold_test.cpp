#include <boost/test/unit_test.hpp>

#include "bie/stepping/state/frame.hpp"
#include "bie/stepping/state/symmetry.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(fold)

namespace {

constexpr int kOrder = 12;

Matrix star(int fold, double chirality) { return star_shape(kOrder, fold, chirality); }

Model extension_model() {
  Model model = relaxation_model(0.1);
  model.flow = axisymmetric_extension(0.5);
  return model;
}

Symmetry found(const Model& model, const Matrix& position) {
  return find_symmetry(model, start(model, discretisation_of(kOrder), position, 0.1));
}

NumericalSettings settings_for(const Symmetry& symmetry) {
  NumericalSettings settings = solved_to_rounding(kOrder);
  settings.longitude_fold = symmetry.fold;
  return settings;
}

/// Largest difference per step between the final states of n steps with and without use of the symmetry.
double difference_per_step(const Model& model, const Matrix& position, double dt, int n_steps) {
  const Symmetry symmetry = found(model, position);
  const Discretisation reduced(settings_for(symmetry), symmetry);
  const Discretisation full(settings_for(symmetry));
  return testing::difference_per_step(model, position, reduced, full, dt, n_steps);
}

std::uint64_t evaluations(const Model& model, const Matrix& position, const Symmetry& used, const Symmetry& grid) {
  const Discretisation discretisation(settings_for(grid), used);
  Instruments instruments;
  evaluate(model, discretisation, start(model, discretisation, position, 0.1), instruments);
  return instruments.kernel_evaluations().at("stokes_single");
}

/// Ratio of kernel evaluations with the symmetry to those without, on the same grid.
double reduction(const Model& model, const Matrix& position) {
  const Symmetry symmetry = found(model, position);
  return double(evaluations(model, position, symmetry, symmetry)) / double(evaluations(model, position, {}, symmetry));
}

}  // namespace

BOOST_AUTO_TEST_CASE(largest_number_of_turns_is_found) {
  BOOST_TEST(symmetry_text(found(field_model(), star(3, 1.0))) == "3-fold about z");
  BOOST_TEST(symmetry_text(found(extension_model(), star(5, 1.0))) == "5-fold about z");
  BOOST_TEST(symmetry_text(found(relaxation_model(0.1), star(6, 1.0))) == "6-fold about z");
  BOOST_TEST(symmetry_text(found(field_model(), star(3, 0.0))) ==
             "3-fold about z, mirror y, mirror z, half turn about x");
  // An axisymmetric shape in a swirling flow.
  Model swirling = relaxation_model(0.1);
  swirling.flow = BackgroundFlow{};
  swirling.flow->gradient(0, 1) = -0.3;
  swirling.flow->gradient(1, 0) = 0.3;
  const Symmetry swirl = found(swirling, prolate(kOrder));
  BOOST_TEST(!swirl.axisymmetric);
  BOOST_TEST(swirl.fold == 2 * kOrder + 2);
}

// A body with turns about another axis is computed in a frame that has its poles on that axis.
BOOST_AUTO_TEST_CASE(turns_about_any_axis_are_found_and_change_no_step) {
  for (const Vector3& axis : {Vector3(1.0, 0.0, 0.0), Vector3(0.3, -0.5, 0.8)}) {
    Frame body = frame_along(axis);
    body.origin = {0.4, 0.0, -1.0};
    Model model = field_model();
    model.electric->field = 0.5 * body.axes.col(2);
    const State laboratory = in_laboratory(body, start(field_model(), discretisation_of(kOrder), star(3, 1.0), 0.1));
    const Frame frame = find_frame(model, laboratory);
    const Model there = in_frame(frame, model);
    const Matrix position = in_frame(frame, laboratory).vesicles[0].position;
    BOOST_TEST(symmetry_text(found(there, position), frame).starts_with("3-fold about "));
    BOOST_TEST(difference_per_step(there, position, 0.1, 3) < 1e-9);
    // The grid of the laboratory has its poles elsewhere and is only as accurate as this order.
    const Discretisation full(settings_for({}));
    const State a = run(there, full, start(there, full, position, 0.1), 0.1, 3);
    const State b = run(model, full, start(model, full, laboratory.vesicles[0].position, 0.1), 0.1, 3);
    BOOST_TEST(max_difference(in_laboratory(frame, a).vesicles[0].position, b.vesicles[0].position) < 1e-5);
  }
  // Too few turns to justify leaving the axes of the laboratory.
  const State prism =
      in_laboratory(frame_along({1.0, 0.0, 0.0}), start(field_model(), discretisation_of(kOrder), star(2, 1.0), 0.1));
  BOOST_TEST(find_frame(relaxation_model(0.1), prism).is_laboratory());
}

BOOST_AUTO_TEST_CASE(turns_that_are_gone_are_not_used) {
  Matrix bump = star(3, 1.0);
  bump(coefficient_index(4, 3), 1) += 1e-9;
  BOOST_TEST(found(field_model(), bump).fold == 1);
  bump = star(3, 1.0);
  bump(coefficient_index(4, 2), 2) += 1e-9;
  BOOST_TEST(found(field_model(), bump).fold == 1);
  Model tilted = field_model();
  tilted.electric->field = {1e-6, 0.0, 1.0};
  BOOST_TEST(found(tilted, star(3, 1.0)).fold == 1);
  Model sheared = extension_model();
  sheared.flow->gradient(0, 2) = 1e-6;
  BOOST_TEST(found(sheared, star(3, 1.0)).fold == 1);
  State charged = start(field_model(), discretisation_of(kOrder), star(3, 1.0), 0.1);
  charged.vesicles[0].transmembrane_potential[coefficient_index(2, 1)] = 1e-9;
  charged.vesicles[0].transmembrane_potential[coefficient_index(1, 0)] = 1.0;
  BOOST_TEST(find_symmetry(field_model(), charged).fold == 1);
}

BOOST_AUTO_TEST_CASE(reduced_solver_makes_the_same_steps) {
  for (const int n : {3, 5}) {
    for (const double chirality : {0.0, 1.0}) {
      BOOST_TEST(difference_per_step(field_model(), star(n, chirality), 0.1, 3) < 1e-9);
      BOOST_TEST(difference_per_step(extension_model(), star(n, chirality), 0.1, 3) < 1e-9);
    }
  }
  Model swirling = relaxation_model(0.1);
  swirling.flow = BackgroundFlow{};
  swirling.flow->gradient << -0.1, -0.3, 0.0, 0.3, -0.1, 0.0, 0.0, 0.0, 0.2;
  BOOST_TEST(difference_per_step(swirling, prolate(kOrder), 0.1, 3) < 1e-9);
}

// 30 longitudes suit 3 and 5 turns. A mirror leaves the six azimuths 0, 1, ..., 5 of 3 turns, 0, ..., 3 of 5 turns;
// mirror z leaves 7 of 13 latitudes.
BOOST_AUTO_TEST_CASE(only_independent_targets_are_evaluated) {
  const auto close = boost::test_tools::tolerance(1e-12);
  BOOST_TEST(reduction(field_model(), star(3, 1.0)) == 1.0 / 3.0, close);
  BOOST_TEST(reduction(field_model(), star(5, 1.0)) == 1.0 / 5.0, close);
  BOOST_TEST(reduction(field_model(), star(3, 0.0)) == 6.0 / 30.0 * 7.0 / 13.0, close);
  BOOST_TEST(reduction(field_model(), star(5, 0.0)) == 4.0 / 30.0 * 7.0 / 13.0, close);
}

BOOST_AUTO_TEST_CASE(contrast_of_viscosities_may_be_there) {
  Model model = extension_model();
  model.vesicles[0].viscosity_ratio = 5.0;
  BOOST_TEST(difference_per_step(model, star(3, 0.0), 0.1, 2) < 1e-9);
}

BOOST_AUTO_TEST_SUITE_END()
