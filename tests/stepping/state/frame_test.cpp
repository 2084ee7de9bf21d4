#include "bie/stepping/state/frame.hpp"

#include <boost/test/unit_test.hpp>

#include "bie/physics/effects/gravity.hpp"
#include "bie/physics/effects/poiseuille_flow.hpp"
#include "bie/stepping/evaluation/lab_frame_output.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(frame)

namespace {

constexpr int kOrder = 12;

Discretisation with(const Symmetry& symmetry) { return Discretisation(solved_to_rounding(kOrder), symmetry); }

/// A model and a shape in the lab frame and in the frame that is found for them.
struct Scenario {
  Model model;
  State state;
  Frame frame;
  Model model_there;
  State state_there;
  Symmetry symmetry;

  Scenario(const Model& lab_frame_model, const Matrix& position)
      : model(lab_frame_model), state(start(model, with({}), position, 0.1)), frame(find_frame(model, state)) {
    model_there = in_frame(frame, model);
    state_there = in_frame(frame, state);
    symmetry = find_symmetry(model_there, state_there);
  }

  /// Largest difference per step between the final states of n steps with and without use of the symmetry.
  [[nodiscard]] double difference_per_step(double dt, int n_steps) const {
    const Discretisation reduced = with(symmetry);
    const Discretisation full = with({});
    return testing::difference_per_step(model_there, state_there.vesicles[0].position, reduced, full, dt, n_steps);
  }

  /// Difference per step between the frame and the lab frame, whose grid has its poles elsewhere.
  [[nodiscard]] double difference_from_lab_frame(double dt, int n_steps) const {
    const Discretisation reduced = with(symmetry);
    const State a =
        run(model_there, reduced, start(model_there, reduced, state_there.vesicles[0].position, dt), dt, n_steps);
    const State b = run(model, with({}), state, dt, n_steps);
    return max_difference(in_laboratory(frame, a).vesicles[0].position, b.vesicles[0].position) / n_steps;
  }
};

Matrix rotated_shape(const Matrix3& rotation, const Matrix& position) {
  State body;
  body.vesicles.emplace_back();
  body.vesicles[0].position = position;
  return rotated(rotation, body).vesicles[0].position;
}

Model in_field(const Vector3& field) {
  Model model = field_model();
  model.electric->field = field;
  return model;
}

const Matrix3& oblique() {
  static const Matrix3 rotation = general_rotation();
  return rotation;
}

Matrix pear(int order) {
  Matrix shape = prolate(order);
  shape(coefficient_index(2, 0), 2) = 0.2;
  return shape;
}

std::uint64_t stokes_evaluations(const Scenario& scenario) {
  const Discretisation discretisation = with(scenario.symmetry);
  Instruments instruments;
  evaluate(scenario.model_there, discretisation,
           start(scenario.model_there, discretisation, scenario.state_there.vesicles[0].position, 0.1), instruments);
  return instruments.kernel_evaluations().at("stokes_single");
}

}  // namespace

BOOST_AUTO_TEST_CASE(coordinate_axes_are_reached_by_exact_right_handed_permutations) {
  for (int i = 0; i < 3; ++i) {
    const Matrix3 axes = frame_along(-2.0 * Vector3::Unit(i)).axes;
    BOOST_TEST((axes.col(2) == Vector3::Unit(i)));
    BOOST_TEST((axes.array() == 0.0 || axes.array() == 1.0).all());
    BOOST_TEST(axes.determinant() == 1.0);
  }
  BOOST_TEST(frame_along(Vector3::UnitZ()).is_laboratory());
  const Vector3 direction(1.0, -2.0, 0.5);
  const Matrix3 axes = frame_along(direction).axes;
  BOOST_TEST((axes.col(2) - direction.normalized()).norm() < 1e-15);
  BOOST_TEST((axes.transpose() * axes - Matrix3::Identity()).norm() < 1e-15);
  BOOST_TEST(axes.determinant() == 1.0, boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(turning_moves_the_body_with_its_parameters_and_back) {
  const Matrix shape = asymmetric_shape(kOrder);
  const Matrix there = rotated_shape(oblique(), shape);
  const Vector3 s(0.48, -0.6, 0.64);
  const Vector3 moved = oblique() * s;
  const auto at = [](const Matrix& x, const Vector3& direction) {
    return Vector3(
        evaluate_harmonics(x, Vector{{std::acos(direction.z())}}, Vector{{std::atan2(direction.y(), direction.x())}})
            .row(0));
  };
  BOOST_TEST((at(there, moved) - oblique() * at(shape, s)).norm() < 1e-13);
  BOOST_TEST(max_difference(rotated_shape(oblique().transpose(), there), shape) < 1e-13);
}

BOOST_AUTO_TEST_CASE(axis_is_found_in_the_field_the_flow_gravity_or_the_shape) {
  const auto name = [](const Model& model, const Matrix& position) {
    const Scenario scenario(model, position);
    BOOST_TEST(scenario.symmetry.axisymmetric);
    return symmetry_text(scenario.symmetry, scenario.frame);
  };
  BOOST_TEST(name(in_field({1.0, 0.0, 0.0}), ellipsoid(kOrder, {2.0, 1.0, 1.0})) == "axisymmetric about x, mirror x");
  BOOST_TEST(name(relaxation_model(0.1), ellipsoid(kOrder, {1.0, 0.6, 1.0})) == "axisymmetric about y, mirror y");
  const Vector3 axis = oblique().col(2);
  const Symmetry about_axis{true};
  const std::string expected = symmetry_text(about_axis, frame_along(axis));
  BOOST_TEST(name(in_field(axis), sphere(kOrder)).starts_with(expected));
  BOOST_TEST(name(in_field(0.3 * axis), rotated_shape(oblique(), pear(kOrder))) == expected);
  Model model = relaxation_model(0.1);
  model.effects.push_back(std::make_shared<GravityEffect>(GravityParameters{1.0, axis}));
  BOOST_TEST(name(model, sphere(kOrder)) == expected);
  model = relaxation_model(0.1);
  model.effects.push_back(std::make_shared<PoiseuilleFlowEffect>(PoiseuilleParameters{}));
  BOOST_TEST(name(model, ellipsoid(kOrder, {2.0, 1.0, 1.0})) == "axisymmetric about x");
  model = relaxation_model(0.1);
  model.flow = BackgroundFlow{oblique() * axisymmetric_extension(1.0).gradient * oblique().transpose()};
  BOOST_TEST(Scenario(model, sphere(kOrder)).symmetry.axisymmetric);
  // Only the shape has a direction.
  BOOST_TEST(Scenario(relaxation_model(0.1), rotated_shape(oblique(), pear(kOrder))).symmetry.axisymmetric);
}

BOOST_AUTO_TEST_CASE(scene_whose_axis_is_gone_stays_in_the_lab_frame) {
  const auto stays = [](const Model& model, const Matrix& position) {
    const Scenario scenario(model, position);
    return scenario.frame.is_laboratory() && !scenario.symmetry.axisymmetric;
  };
  const Matrix lying = ellipsoid(kOrder, {2.0, 1.0, 1.0});
  BOOST_TEST(stays(in_field({1.0, 1e-6, 0.0}), lying));
  BOOST_TEST(stays(in_field({1.0, 0.0, 0.0}), ellipsoid(kOrder, {2.0, 1.0, 1.0 + 1e-9})));
  Matrix bump = lying;
  bump(coefficient_index(4, 3), 1) = 1e-9;
  BOOST_TEST(stays(in_field({1.0, 0.0, 0.0}), bump));
  Model stretched = in_field({1.0, 0.0, 0.0});
  stretched.flow = BackgroundFlow{};
  stretched.flow->gradient.diagonal() << 1.0, -0.5, -0.5;
  BOOST_TEST(!stays(stretched, lying));
  BOOST_TEST(stays(stretched, translated(lying, {0.0, 1e-6, 0.0})));
  Model model = in_field({1.0, 0.0, 0.0});
  model.flow = shear_flow(1e-6);
  BOOST_TEST(stays(model, lying));
  const Matrix tilted = rotated_shape(oblique(), prolate(kOrder));
  BOOST_TEST(stays(in_field(oblique().col(2) + Vector3(1e-6, 0.0, 0.0)), tilted));
  BOOST_TEST(!stays(in_field(oblique().col(2)), tilted));
}

BOOST_AUTO_TEST_CASE(axis_may_miss_the_origin_where_nothing_depends_on_the_place) {
  const Vector3 centre(0.3, -2.0, 0.7);
  const Scenario upright(in_field({0.0, 0.0, 1.0}), translated(prolate(kOrder), centre));
  BOOST_TEST(symmetry_text(upright.symmetry, upright.frame) ==
             "axisymmetric about z, mirror z, through (0.3, -2, 0.7)");
  BOOST_TEST(upright.difference_per_step(0.2, 3) < 1e-9);
  BOOST_TEST(upright.difference_from_lab_frame(0.2, 3) < 1e-9);
  const Scenario tilted(in_field(oblique().col(2)), translated(rotated_shape(oblique(), pear(kOrder)), centre));
  BOOST_TEST(tilted.symmetry.axisymmetric);
  BOOST_TEST(tilted.difference_per_step(0.2, 3) < 1e-9);
  // Output in the lab frame is at the original position.
  const LabFrameOutput lab_frame(upright.frame, with({}).settings());
  BOOST_TEST(max_difference(lab_frame.state(upright.state_there).vesicles[0].position,
                            upright.state.vesicles[0].position) < 1e-15);
  Model heavy = relaxation_model(0.1);
  heavy.effects.push_back(std::make_shared<GravityEffect>(GravityParameters{1.0, {0.0, 0.0, -1.0}}));
  BOOST_TEST(Scenario(heavy, translated(prolate(kOrder), centre)).frame.is_laboratory());
}

BOOST_AUTO_TEST_CASE(reduced_solver_makes_the_same_steps_about_any_axis) {
  const Scenario lying(in_field({1.0, 0.0, 0.0}), ellipsoid(kOrder, {2.0, 1.0, 1.0}));
  BOOST_TEST(lying.difference_per_step(0.5, 4) < 1e-9);
  const Scenario tilted(in_field(oblique().col(2)), rotated_shape(oblique(), pear(kOrder)));
  BOOST_TEST(tilted.symmetry.axisymmetric);
  BOOST_TEST(tilted.difference_per_step(0.2, 4) < 1e-9);
  Model stretched = relaxation_model(0.1);
  stretched.flow = BackgroundFlow{};
  stretched.flow->gradient.diagonal() << 1.0, -0.5, -0.5;
  const Scenario extension(stretched, ellipsoid(kOrder, {1.5, 1.0, 1.0}));
  BOOST_TEST(extension.symmetry.axisymmetric);
  BOOST_TEST(extension.difference_per_step(0.2, 4) < 1e-9);
}

// Truncation at degree p does not depend on the poles, but quadratures do: they agree as well as each is resolved.
BOOST_AUTO_TEST_CASE(frame_and_lab_frame_agree_to_the_accuracy_of_the_order) {
  const Scenario lying(in_field({1.0, 0.0, 0.0}), ellipsoid(kOrder, {1.4, 1.0, 1.0}));
  BOOST_TEST(lying.difference_from_lab_frame(0.2, 3) < 1e-8);
  const Scenario tilted(in_field(oblique().col(2)), rotated_shape(oblique(), ellipsoid(kOrder, {1.0, 1.0, 1.4})));
  BOOST_TEST(tilted.symmetry.axisymmetric);
  BOOST_TEST(tilted.difference_from_lab_frame(0.2, 3) < 1e-8);
}

BOOST_AUTO_TEST_CASE(as_few_targets_are_evaluated_as_about_z) {
  const Scenario upright(in_field({0.0, 0.0, 1.0}), prolate(kOrder));
  BOOST_TEST(stokes_evaluations(Scenario(in_field({1.0, 0.0, 0.0}), ellipsoid(kOrder, {2.0, 1.0, 1.0}))) ==
             stokes_evaluations(upright));
  BOOST_TEST(stokes_evaluations(Scenario(in_field(oblique().col(2)), rotated_shape(oblique(), prolate(kOrder)))) ==
             stokes_evaluations(upright));
}

BOOST_AUTO_TEST_CASE(history_quantities_are_those_of_the_lab_frame) {
  const Scenario scenario(in_field(oblique().col(2)), rotated_shape(oblique(), pear(kOrder)));
  const auto charged = [](const Model& model, const Discretisation& discretisation, const State& from) {
    return run(model, discretisation, start(model, discretisation, from.vesicles[0].position, 0.2), 0.2, 1);
  };
  const Discretisation reduced = with(scenario.symmetry);
  const State there = charged(scenario.model_there, reduced, scenario.state_there);
  const Evaluated evaluation = evaluated(scenario.model_there, reduced, there);
  const LabFrameOutput lab_frame(scenario.frame, reduced.settings());
  const VesicleDiagnostics d =
      lab_frame.diagnostics({{evaluation.diagnostics}}, there, {{evaluation.fields}}).vesicles[0];
  const VesicleDiagnostics expected =
      evaluated(scenario.model, with({}), rotated(scenario.frame.axes, there)).diagnostics;
  const auto close = boost::test_tools::tolerance(1e-4);
  BOOST_TEST(d.extent_x == expected.extent_x, close);
  BOOST_TEST(d.extent_y == expected.extent_y, close);
  BOOST_TEST(d.extent_z == expected.extent_z, close);
  BOOST_TEST(d.inclination_deg == expected.inclination_deg, close);
  BOOST_TEST(d.Vm_north == expected.Vm_north, close);
  BOOST_TEST(d.q_north == expected.q_north, close);
  BOOST_TEST(d.area == expected.area, close);
  BOOST_TEST(std::abs(d.extent_x - evaluation.diagnostics.extent_x) > 0.01);
  const VesicleFields fields = lab_frame.fields({{evaluation.fields}}).vesicles[0];
  const VesicleFields expected_fields = evaluated(scenario.model, with({}), lab_frame.state(there)).fields;
  BOOST_TEST(relative_difference(fields.velocity, expected_fields.velocity) < 1e-3);
  BOOST_TEST(relative_difference(fields.force_electric, expected_fields.force_electric) < 1e-3);
  BOOST_TEST(relative_difference(fields.charge, expected_fields.charge) < 1e-3);
}

BOOST_AUTO_TEST_SUITE_END()
