#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "bie/physics/effects/spontaneous_curvature.hpp"
#include "bie/stepping/evaluation/diagnose.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

constexpr int kOrder = 12;

VesicleDiagnostics diagnostics_of(const Model& model, const State& state) {
  return evaluated(model, discretisation_of(kOrder), state).diagnostics;
}

VesicleDiagnostics diagnostics_of_shape(const Matrix& position) {
  const Model model = relaxation_model(0.1);
  return diagnostics_of(model, start(model, discretisation_of(kOrder), position, 0.1));
}

/// Diagnostics for V_m = z, without layers.
VesicleDiagnostics diagnostics_of_potential(const Matrix& position, const Model& model = {},
                                            const Matrix& velocity = {}) {
  const int order = order_of(position.rows());
  const SphereTransform fine(order, make_grid(2 * order));
  Surface surface = make_surface(fine, position);
  VesicleState vesicle = at_rest(position).vesicles[0];
  vesicle.transmembrane_potential = position.col(2);
  vesicle.reference_area = surface_area(surface);
  vesicle.reference_volume = enclosed_volume(surface);
  VesicleFields fields;
  fields.charge = position.col(2);
  NumericalSettings settings;
  settings.order = order;
  VesicleSolution solution;
  solution.rate.position = velocity;
  solution.membrane =
      std::make_shared<const Membrane>(Membrane{fine, std::move(surface), {}, 1.0, SymmetrySubspace({}, order)});
  return diagnose(model, model.vesicles[0], MembraneSpace(settings, {}), settings.quadrature_tolerance, vesicle,
                  solution, fields);
}

Matrix rotated_about_y(const Matrix& position, double degrees) {
  // Turns +x towards +z, i.e. against the right-handed turn about +y.
  return position *
         Eigen::AngleAxisd(-degrees * std::numbers::pi / 180.0, Vector3::UnitY()).toRotationMatrix().transpose();
}

}  // namespace

BOOST_AUTO_TEST_SUITE(diagnostics)

BOOST_AUTO_TEST_CASE(extents_are_those_of_the_surface_and_not_of_its_nodes) {
  const VesicleDiagnostics d = diagnostics_of_shape(translated(ellipsoid(kOrder, {1.0, 1.3, 2.0}), {5.0, -3.0, 1.0}));
  BOOST_TEST(std::abs(d.extent_x - 2.0) < 1e-13);
  BOOST_TEST(std::abs(d.extent_y - 2.6) < 1e-13);
  BOOST_TEST(std::abs(d.extent_z - 4.0) < 1e-13);
  // The extents of a tilted ellipsoid follow from its support function.
  const VesicleDiagnostics tilted = diagnostics_of_shape(rotated_about_y(ellipsoid(kOrder, {2.0, 1.0, 1.0}), 30.0));
  BOOST_TEST(std::abs(tilted.extent_x - 2.0 * std::sqrt(4.0 * 0.75 + 0.25)) < 1e-13);
  BOOST_TEST(std::abs(tilted.extent_z - 2.0 * std::sqrt(4.0 * 0.25 + 0.75)) < 1e-13);
}

BOOST_AUTO_TEST_CASE(inclination_is_the_angle_of_the_long_axis_from_x_towards_z) {
  for (const double degrees : {-80.0, -30.0, 0.0, 10.0, 45.0, 89.0}) {
    const Matrix position = translated(rotated_about_y(ellipsoid(kOrder, {2.0, 1.0, 1.2}), degrees), {1.0, 2.0, 3.0});
    BOOST_TEST(std::abs(diagnostics_of_shape(position).inclination_deg - degrees) < 1e-8);
  }
}

// Otherwise rounding would choose between the long axes of a disc, and between the ends of an axis normal to the plane.
BOOST_AUTO_TEST_CASE(inclination_of_a_body_with_many_long_axes_is_that_of_the_one_in_the_plane) {
  for (const double degrees : {-80.0, -30.0, 0.0, 10.0, 45.0, 89.0}) {
    const Matrix disc = translated(rotated_about_y(ellipsoid(kOrder, {1.3, 1.3, 0.7}), degrees), {1.0, 2.0, 3.0});
    BOOST_TEST(std::abs(diagnostics_of_potential(disc).inclination_deg - degrees) < 1e-8);
  }
  for (const Vector3& axes : {Vector3{1.0, 1.0, 1.0}, Vector3{1.3, 0.7, 1.3}, Vector3{1.0, 2.0, 1.0}}) {
    const Matrix body = translated(rotated_about_y(ellipsoid(kOrder, axes), 17.0), {1.0, 2.0, 3.0});
    BOOST_TEST(diagnostics_of_potential(body).inclination_deg == 0.0);
  }
}

BOOST_AUTO_TEST_CASE(place_of_the_vesicle_leaves_no_trace_in_its_extents) {
  const Matrix here = asymmetric_shape(kOrder);
  const VesicleDiagnostics expected = diagnostics_of_potential(here);
  const VesicleDiagnostics far = diagnostics_of_potential(translated(here, {1e4, -2e5, 3e3}));
  for (const auto member :
       {&VesicleDiagnostics::extent_x, &VesicleDiagnostics::extent_y, &VesicleDiagnostics::extent_z}) {
    BOOST_TEST(std::abs(far.*member - expected.*member) < 1e-13 * (expected.*member));
  }
}

BOOST_AUTO_TEST_CASE(reduced_volume_is_one_on_the_sphere_and_ignores_size) {
  BOOST_TEST(std::abs(diagnostics_of_shape(sphere(kOrder, 2.7)).reduced_volume - 1.0) < 1e-12);
  const double prolate_value = diagnostics_of_shape(prolate(kOrder)).reduced_volume;
  BOOST_TEST(std::abs(diagnostics_of_shape(3.0 * prolate(kOrder)).reduced_volume - prolate_value) < 1e-12);
  BOOST_TEST(prolate_value < 0.95);
}

BOOST_AUTO_TEST_CASE(spectrum_tail_is_the_share_of_degrees_above_two_thirds) {
  // p = 12: degrees 9 to 12 are the tail, degree 0 (the position) does not count.
  Matrix position = translated(sphere(kOrder), {4.0, 0.0, 0.0});
  BOOST_TEST(diagnostics_of_shape(position).spectrum_tail < 1e-15);
  position(coefficient_index(8, 3), 1) = 1e-3;
  BOOST_TEST(diagnostics_of_shape(position).spectrum_tail < 1e-15);
  position(coefficient_index(9, 3), 1) = 1e-3;
  position(coefficient_index(12, 0), 2) = 2e-3;
  const double size = std::sqrt(4.0 * std::numbers::pi);  // √ of three components, 4π/3 each
  BOOST_TEST(std::abs(diagnostics_of_shape(position).spectrum_tail * size / std::sqrt(5e-6) - 1.0) < 1e-5);
}

BOOST_AUTO_TEST_CASE(drift_is_relative_to_the_reference_with_its_sign) {
  const Model model = relaxation_model(0.1);
  State state = start(model, discretisation_of(kOrder), prolate(kOrder), 0.1);
  BOOST_TEST(diagnostics_of(model, state).area_drift == 0.0);
  state.vesicles[0].reference_area /= 1.001;
  state.vesicles[0].reference_volume /= 0.998;
  const VesicleDiagnostics d = diagnostics_of(model, state);
  BOOST_TEST(std::abs(d.area_drift - 0.001) < 1e-12);
  BOOST_TEST(std::abs(d.volume_drift + 0.002) < 1e-12);
}

BOOST_AUTO_TEST_CASE(strain_is_the_largest_magnitude_on_the_surface) {
  const Model model = relaxation_model(0.1);
  State state = start(model, discretisation_of(kOrder), sphere(kOrder), 0.1);
  BOOST_TEST(diagnostics_of(model, state).strain_max == 0.0);
  state.vesicles[0].area_strain = -3e-3 * std::sqrt(4.0 * std::numbers::pi) * harmonic(kOrder, 0, 0);
  BOOST_TEST(std::abs(diagnostics_of(model, state).strain_max - 3e-3) < 1e-14);
}

BOOST_AUTO_TEST_CASE(potential_and_charge_are_read_at_the_north_pole) {
  // V_m = V cos θ on the unit sphere: see electric_sphere for q.
  const Model model = field_model();
  State state = start(model, discretisation_of(kOrder), sphere(kOrder), 0.1);
  const double v = 0.4;
  state.vesicles[0].transmembrane_potential = v * sphere(kOrder).col(2);
  const VesicleDiagnostics d = diagnostics_of(model, state);
  const double interior = 2.0 * (3.0 - 2.0 * v) / 5.0;
  BOOST_TEST(std::abs(d.Vm_north - v) < 1e-12);
  BOOST_TEST(std::abs(d.Vm_max - v) < 1e-12);
  BOOST_TEST(std::abs(d.q_north + 0.5 * interior) < 1e-9);
}

// An ellipsoid bent into a horseshoe that opens along +x: its centroid and the axis through it lie in the gap.
BOOST_AUTO_TEST_CASE(where_the_axis_misses_the_membrane_nothing_is_read) {
  const SphereTransform transform(kOrder, make_grid(2 * kOrder));
  Matrix points = grid_directions(transform.grid());
  for (Index i = 0; i < points.rows(); ++i) {
    const double angle = 2.2 * points(i, 1);
    const double radius = 1.0 + 0.3 * points(i, 0);
    points.row(i) << -radius * std::cos(angle), radius * std::sin(angle), 0.3 * points(i, 2);
  }
  const VesicleDiagnostics d = diagnostics_of_potential(transform.analyze(points));
  BOOST_TEST(std::isnan(d.Vm_north));
  BOOST_TEST(std::isnan(d.q_north));
  BOOST_TEST(std::isfinite(d.Vm_max));
}

BOOST_AUTO_TEST_CASE(sign_at_the_north_pole_is_the_same_at_every_order) {
  for (int order = 4; order <= 24; ++order) {
    for (const Vector3& axes : {Vector3{1.0, 1.0, 1.0}, Vector3{1.2, 1.1, 0.4}}) {
      const Matrix position = ellipsoid(order, axes);
      BOOST_TEST(std::abs(diagnostics_of_potential(position).Vm_north - axes.z()) < 1e-12, "order " << order);
    }
  }
}

BOOST_AUTO_TEST_CASE(integrals_are_taken_over_the_surface) {
  const Model model = shear_model();
  const VesicleDiagnostics d = diagnostics_of(model, start(model, discretisation_of(kOrder), sphere(kOrder, 2.0), 0.1));
  BOOST_TEST(std::abs(d.area / (16.0 * std::numbers::pi) - 1.0) < 1e-12);
  BOOST_TEST(std::abs(d.volume / (32.0 / 3.0 * std::numbers::pi) - 1.0) < 1e-12);
  BOOST_TEST(std::abs(d.bending_energy_scaled / (4.0 * std::numbers::pi) - 1.0) < 1e-11);
}

// V_m = z on an ellipsoid, in fields along one of its axes and oblique to all of them.
BOOST_AUTO_TEST_CASE(potential_is_read_at_both_poles_of_the_field) {
  const Vector3 axes(1.0, 1.3, 2.0), centre(4.0, -3.0, 1.0);
  for (const Vector3& field : {Vector3(0.0, 0.0, 2.0), Vector3(0.0, 0.0, -3.0), Vector3(1.0, 0.5, -0.2)}) {
    Model model;
    model.electric.emplace().field = field;
    const VesicleDiagnostics d = diagnostics_of_potential(translated(ellipsoid(kOrder, axes), centre), model);
    // A pole x = s e satisfies |x/axes| = 1.
    const double reach = 1.0 / field.cwiseQuotient(axes).norm();
    BOOST_TEST(std::abs(d.Vm_pole_plus - (centre.z() + reach * field.z())) < 1e-12);
    BOOST_TEST(std::abs(d.Vm_pole_minus - (centre.z() - reach * field.z())) < 1e-12);
  }
  const VesicleDiagnostics without = diagnostics_of_potential(ellipsoid(kOrder, axes));
  BOOST_TEST(without.Vm_pole_plus == 0.0);
  BOOST_TEST(std::isnan(without.aspect_ratio_field));
  for (const double mode : without.shape_modes) BOOST_TEST(std::isnan(mode));
}

// Translation, rotation and sliding along the surface do not contribute.
BOOST_AUTO_TEST_CASE(shape_rate_is_that_of_the_shape_alone) {
  const Matrix sphere = ellipsoid(kOrder, {2.0, 2.0, 2.0});
  Matrix3 rotation;
  rotation << 0.0, -3.0, 1.0, 3.0, 0.0, 2.0, -1.0, -2.0, 0.0;
  for (const double stretching : {0.0, -0.5}) {
    const Matrix3 gradient = rotation + stretching * Matrix3::Identity();
    const Matrix velocity = translated(sphere * gradient.transpose(), {4.0, 5.0, 6.0});
    const VesicleDiagnostics d = diagnostics_of_potential(translated(sphere, {1.0, 2.0, 3.0}), {}, velocity);
    BOOST_TEST(std::abs(d.shape_rate + stretching) < 1e-12);
  }
}

// It rotates as a rigid one, by half of the vorticity, and has no long axis that could tumble.
BOOST_AUTO_TEST_CASE(an_inextensible_sphere_in_shear_treads_at_half_the_shear_rate) {
  const Model model = shear_model();
  const VesicleDiagnostics d = diagnostics_of(model, start(model, discretisation_of(kOrder), sphere(kOrder, 1.3), 0.1));
  BOOST_TEST(std::abs(d.treading_frequency - model.flow->gradient(0, 2) / (4.0 * std::numbers::pi)) < 1e-10);
  BOOST_TEST(d.tumbling_frequency == 0.0);
  BOOST_TEST(d.shape_rate < 1e-12);
}

BOOST_AUTO_TEST_CASE(aspect_ratios_of_an_ellipsoid_are_those_of_its_axes) {
  Model model;
  model.electric.emplace().field = Vector3(3.0, 0.0, 0.0);
  const Matrix disc = translated(ellipsoid(kOrder, {0.5, 1.5, 1.5}), {2.0, 0.0, -7.0});
  const VesicleDiagnostics d = diagnostics_of_potential(disc, model);
  BOOST_TEST(std::abs(d.aspect_ratio - 3.0) < 1e-10);
  BOOST_TEST(std::abs(d.aspect_ratio_field - 1.0 / 3.0) < 1e-10);
  BOOST_TEST(std::abs(d.centroid_x - 2.0) < 1e-12);
  BOOST_TEST(std::abs(d.centroid_z + 7.0) < 1e-12);
}

BOOST_AUTO_TEST_CASE(elastic_energy_is_that_about_the_spontaneous_curvature) {
  Model model = relaxation_model(0.1);
  const double c = -0.7;
  model.vesicles[0].effects.push_back(
      std::make_shared<SpontaneousCurvatureEffect>(SpontaneousCurvatureParameters{0.1, c}));
  const VesicleDiagnostics sphere_of_2 =
      diagnostics_of(model, start(model, discretisation_of(kOrder), sphere(kOrder, 2.0), 0.1));
  BOOST_TEST(std::abs(sphere_of_2.elastic_energy_scaled - 16.0 * std::numbers::pi * 0.2 * 0.2) < 1e-10);
  const VesicleDiagnostics plain = diagnostics_of_shape(prolate(kOrder));
  BOOST_TEST(std::abs(plain.elastic_energy_scaled - plain.bending_energy_scaled) < 1e-12);
}

BOOST_AUTO_TEST_CASE(largest_tension_is_between_the_nodes_too) {
  const Model model = shear_model();
  const Evaluated at_12 =
      evaluated(model, discretisation_of(12), start(model, discretisation_of(12), prolate(12), 0.1));
  const SphereTransform fine(12, make_grid(90));
  const double seen = fine.synthesize(at_12.fields.tension).maxCoeff();
  BOOST_TEST(at_12.diagnostics.tension_max >= seen);
  BOOST_TEST(at_12.diagnostics.tension_max < seen + 1e-3 * std::abs(seen));
}

BOOST_AUTO_TEST_SUITE_END()
