#include "bie/stepping/evaluation/evaluation.hpp"

#include <omp.h>

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <memory>
#include <numbers>
#include <type_traits>

#include "bie/geometry/surface.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

/// Field and shear together: every effect is present.
Model full_model() {
  Model model = field_model();
  model.flow = shear_flow(1.0);
  return model;
}

Matrix side_by_side(const VesicleFields& f) {
  Matrix all(f.velocity.rows(), 14);
  all << f.velocity, f.force_bending, f.force_tension, f.force_electric, f.tension, f.charge;
  return all;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(evaluation)

BOOST_AUTO_TEST_CASE(velocity_keeps_every_area_element_and_has_no_flux) {
  const Discretisation discretisation = discretisation_of(16);
  const SphereTransform& fine = discretisation.vesicle(0).fine_transform();
  const Matrix position = asymmetric_shape(16);
  const Surface surface = make_surface(fine, position);
  for (const Model& model : {shear_model(), field_model(), full_model()}) {
    const Evaluated e = evaluated(model, discretisation, start(model, discretisation, position, 0.1));
    const SphereDerivatives u = fine.synthesize_gradient(e.fields.velocity);
    const Vector divergence = surface.area_element.cwiseProduct(surface_divergence(surface, u));
    const double speed = u.value.rowwise().norm().maxCoeff();
    BOOST_TEST(fine.analyze(divergence).cwiseAbs().maxCoeff() < 1e-7 * speed);
    const Vector through = row_dot(u.value, surface.normal);
    BOOST_TEST(std::abs(through.dot(surface.quadrature)) < 1e-6 * through.cwiseAbs().dot(surface.quadrature));
  }
}

BOOST_AUTO_TEST_CASE(inextensible_sphere_has_the_exact_velocity_and_tension_in_linear_flows) {
  // With v = Ωx + Ex and Y = x·Ex on the unit sphere, the tension −35/22 μ Y turns the strain into a velocity that
  // keeps area elements: 12/11 Y n + 4/11 ∇_γ Y. Constant tension does nothing on a sphere.
  const Discretisation discretisation = discretisation_of(12);
  const SphereTransform& fine = discretisation.vesicle(0).fine_transform();
  const Surface surface = make_surface(fine, sphere(12));
  for (const BackgroundFlow& flow : {shear_flow(1.3), planar_extension(1.0), axisymmetric_extension(0.7)}) {
    Model model = relaxation_model(0.1);
    model.viscosity = 2.5;
    model.flow = flow;
    const Evaluated e = evaluated(model, discretisation, start(model, discretisation, sphere(12), 0.1));
    const Matrix3 strain = 0.5 * (flow.gradient + flow.gradient.transpose());
    const Matrix3 spin = 0.5 * (flow.gradient - flow.gradient.transpose());
    const Matrix& x = surface.position;
    const Vector y = row_dot(x, x * strain.transpose());
    const Matrix gradient = 2.0 * (x * strain.transpose() - y.asDiagonal() * x);
    const Matrix expected = x * spin.transpose() + 12.0 / 11.0 * y.asDiagonal() * x + 4.0 / 11.0 * gradient;
    BOOST_TEST(max_difference(fine.synthesize(e.fields.velocity), expected) < 1e-12);
    Vector tension = e.fields.tension;
    tension[0] = 0.0;
    BOOST_TEST(max_difference(fine.synthesize(tension), -35.0 / 22.0 * model.viscosity * y) < 1e-11);
  }
}

BOOST_AUTO_TEST_CASE(velocity_without_constraint_falls_with_viscosity_and_adds_the_background) {
  const Discretisation discretisation = discretisation_of(12);
  const Matrix position = asymmetric_shape(12);
  Model model = relaxation_model(0.4);
  model.vesicles[0].inextensible = false;
  const auto velocity = [&] {
    return evaluated(model, discretisation, start(model, discretisation, position, 0.1)).fields.velocity;
  };
  const Matrix thin = velocity();
  model.viscosity = 2.5;
  BOOST_TEST(relative_difference(2.5 * velocity(), thin) < 1e-13);
  model.flow = shear_flow(0.8);
  BOOST_TEST(relative_difference(velocity(), thin / 2.5 + position * model.flow->gradient.transpose()) < 1e-13);
}

BOOST_AUTO_TEST_CASE(electric_force_enters_the_velocity_with_minus_sign) {
  // f = f_b + f_λ − f_E: a sphere that conducts less than its surroundings is compressed along the field.
  const Discretisation discretisation = discretisation_of(12);
  Model model = field_model();
  model.vesicles[0].inextensible = false;
  const Evaluated e = evaluated(model, discretisation, start(model, discretisation, sphere(12), 0.1));
  const Vector pole = evaluate_harmonics(e.fields.velocity, Vector::Zero(1), Vector::Zero(1)).row(0);
  BOOST_TEST(pole[2] < -0.01);
}

BOOST_AUTO_TEST_CASE(absent_effects_leave_their_fields_empty) {
  const Discretisation discretisation = discretisation_of(8);
  const Model model = relaxation_model(0.1);
  const Evaluated relaxing = evaluated(model, discretisation, start(model, discretisation, prolate(8), 0.1));
  BOOST_TEST(relaxing.fields.force_electric.size() == 0);
  BOOST_TEST(relaxing.fields.charge.size() == 0);
  Model fluid;
  fluid.vesicles[0].inextensible = false;
  fluid.flow = shear_flow(1.0);
  const Evaluated carried = evaluated(fluid, discretisation, start(fluid, discretisation, prolate(8), 0.1));
  BOOST_TEST(carried.fields.force_bending.size() == 0);
  BOOST_TEST(carried.fields.force_tension.size() == 0);
  BOOST_TEST(carried.fields.tension.size() == 0);
  BOOST_TEST(max_difference(carried.fields.velocity, prolate(8) * fluid.flow->gradient.transpose()) < 1e-15);
}

BOOST_AUTO_TEST_CASE(result_is_reproducible_and_does_not_depend_on_threads) {
  const Discretisation discretisation = discretisation_of(12);
  const Model model = full_model();
  const State state = start(model, discretisation, asymmetric_shape(12), 0.1);
  const auto result = [&](int threads) {
    omp_set_num_threads(threads);
    return side_by_side(evaluated(model, discretisation, state).fields);
  };
  const int threads = omp_get_max_threads();
  const Matrix alone = result(1);
  const Matrix shared = result(2);
  const Matrix again = result(2);
  omp_set_num_threads(threads);
  BOOST_TEST(relative_difference(shared, alone) < 1e-12);
  BOOST_TEST((again.array() == shared.array()).all());
}

// A reference would dangle, which a run without sanitizers might not show.
static_assert(std::is_same_v<decltype(Membrane::fine), SphereTransform>);

BOOST_AUTO_TEST_CASE(evaluation_outlives_the_discretisation_that_it_was_made_with) {
  const Model model = shear_model();
  NumericalSettings settings;
  settings.order = 6;
  auto discretisation = std::make_unique<const Discretisation>(settings);
  const Evaluated evaluation = evaluated(model, *discretisation, start(model, *discretisation, prolate(6), 0.1));
  const Matrix values = discretisation->vesicle(0).fine_transform().synthesize(evaluation.fields.velocity);
  discretisation.reset();
  const Membrane& membrane = *evaluation.solution.membrane;
  BOOST_TEST((membrane.fine.synthesize(evaluation.fields.velocity) == values));
  BOOST_TEST(max_difference(membrane.fine.analyze(values), evaluation.fields.velocity) < 1e-12);
}

BOOST_AUTO_TEST_SUITE_END()
