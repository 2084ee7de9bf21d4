#include "bie/stepping/state/rheology.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "bie/physics/effects/gravity.hpp"
#include "bie/stepping/evaluation/evaluation.hpp"
#include "bie/stepping/state/frame.hpp"
#include "tests/support/several_runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(rheology)

namespace {

constexpr double kPi = std::numbers::pi;

Rheology rheology_of(const Model& model, const Matrix& position, double order_of_time = 0.1) {
  const Discretisation discretisation = discretisation_of(order_of(position.rows()));
  return evaluated(model, discretisation, start(model, discretisation, position, order_of_time)).diagnostics.rheology;
}

double asymmetry(const Matrix3& moment) { return (moment - moment.transpose()).norm() / moment.norm(); }

/// r = 1 + amplitude P₂(cos θ), in an axisymmetric extension along z.
double viscosity_of_spheroid(double amplitude, double viscosity_ratio) {
  constexpr int kOrder = 10;
  Model model = relaxation_model(0.3);
  model.viscosity = 1.7;
  model.flow = axisymmetric_extension(0.4);
  model.vesicles[0].viscosity_ratio = viscosity_ratio;
  const SphereTransform transform(kOrder, make_grid(2 * kOrder));
  const Vector radius = Vector::Ones(transform.grid().n_points()) +
                        amplitude * std::sqrt(4.0 * kPi / 5.0) * transform.synthesize(harmonic(kOrder, 2, 0));
  const Matrix position = transform.analyze(radius.asDiagonal() * grid_directions(transform.grid()));
  return rheology_of(model, position).intrinsic_viscosity();
}

/// Fluid and membrane of a sphere, charged or not.
Model sphere_in_field(double ratio) {
  Model model;
  set_electric(model, {{0.3, 0.0, 0.4}, 2.0 * ratio, 2.0, 1.5}, {0.7, 0.0});
  return model;
}

}  // namespace

BOOST_AUTO_TEST_CASE(spheres_have_the_viscosity_of_einstein_in_every_linear_flow) {
  for (const BackgroundFlow& flow : {shear_flow(1.3), planar_extension(-0.8), axisymmetric_extension(0.7)}) {
    for (const double ratio : {1.0, 5.0}) {
      Model model = relaxation_model(0.1);
      model.viscosity = 2.5;
      model.flow = flow;
      model.vesicles[0].viscosity_ratio = ratio;
      const Rheology found = rheology_of(model, translated(sphere(8, 1.4), {0.4, -1.0, 2.0}));
      BOOST_TEST(std::abs(found.intrinsic_viscosity() - 2.5) < 1e-11, found.intrinsic_viscosity());
      // Stresslet 20π/3 μa³E, up to a pressure.
      const Matrix3 strain = 0.5 * (flow.gradient + flow.gradient.transpose());
      const Matrix3 expected = 20.0 * kPi / 3.0 * model.viscosity * std::pow(1.4, 3) * strain;
      const Matrix3 pressure = found.moment().trace() / 3.0 * Matrix3::Identity();
      BOOST_TEST((found.moment() - pressure - expected).norm() < 1e-11 * expected.norm());
      BOOST_TEST(std::abs(found.power() - expected.cwiseProduct(flow.gradient).sum()) < 1e-10 * expected.norm());
      BOOST_TEST(found.dipole.norm() == 0.0);
    }
  }
}

// [η] = 5/2 (1 + 3α/7) for r = 1 + αP₂, independent of the viscosity inside: docs/suspensions.md.
BOOST_AUTO_TEST_CASE(viscosity_of_a_quasi_spherical_vesicle_has_the_slope_that_the_page_derives) {
  constexpr double kAmplitude = 1e-3;
  for (const double ratio : {1.0, 8.0}) {
    const double prolate = viscosity_of_spheroid(kAmplitude, ratio);
    const double oblate = viscosity_of_spheroid(-kAmplitude, ratio);
    BOOST_TEST(std::abs((prolate - oblate) / (2.0 * kAmplitude) - 15.0 / 14.0) < 1e-5,
               (prolate - oblate) / (2.0 * kAmplitude));
    BOOST_TEST(std::abs(0.5 * (prolate + oblate) - 2.5) < 10.0 * kAmplitude * kAmplitude);
  }
}

BOOST_AUTO_TEST_CASE(bending_and_tension_exert_no_torque) {
  Model model = relaxation_model(0.1);
  model.flow = shear_flow(1.0);
  model.vesicles[0].viscosity_ratio = 3.0;
  const Rheology coarse = rheology_of(model, asymmetric_shape(10)), fine = rheology_of(model, asymmetric_shape(16));
  BOOST_TEST(asymmetry(fine.tension) < 1e-3);
  BOOST_TEST(asymmetry(fine.bending) < 0.3 * asymmetry(coarse.bending));
  BOOST_TEST(asymmetry(fine.moment()) < 0.3 * asymmetry(coarse.moment()));
  BOOST_TEST(asymmetry(fine.moment()) < 1e-3, asymmetry(fine.moment()));
  BOOST_TEST(asymmetry(fine.viscosity) < 1e-15);
}

// β = (k − 1)/(k + 2), k the ratio of conductivities, for an uncharged membrane, −1/2 for a fully charged one.
BOOST_AUTO_TEST_CASE(dipole_of_a_sphere_goes_from_that_of_its_inside_to_that_of_an_insulator) {
  constexpr double kRadius = 1.2;
  for (const double ratio : {0.2, 3.0}) {
    const Model model = sphere_in_field(ratio);
    const Vector3 field = model.electric->field;
    const auto check = [&](const Rheology& found, double beta, double mean, double tolerance) {
      const Vector3 expected = 4.0 * kPi * 1.5 * beta * std::pow(kRadius, 3) * field;
      BOOST_TEST((found.dipole - expected).norm() < tolerance * expected.norm());
      BOOST_TEST(std::abs(found.electric_power - mean * 2.0 / 1.5 * expected.dot(field)) < tolerance);
    };
    const double conducting = (ratio - 1.0) / (ratio + 2.0);
    check(rheology_of(model, sphere(8, kRadius)), conducting, 1.0, 1e-10);
    const Discretisation discretisation = discretisation_of(8);
    const std::vector<Matrix> shape{sphere(8, kRadius)};
    const State charged = start(model, discretisation, shape, 0.1, true);
    check(evaluated(model, discretisation, charged).diagnostics.rheology, -0.5, 1.0, 1e-10);
    Model averaged = model;
    averaged.electric->averaged_frequency = 1e9;
    check(rheology_of(averaged, shape.front()), conducting, 0.5, 1e-7);
    averaged.electric->averaged_frequency = 1e-9;
    check(rheology_of(averaged, shape.front()), -0.5, 0.5, 1e-7);
  }
}

BOOST_AUTO_TEST_CASE(several_vesicles_are_seen_from_the_centroid_of_all) {
  Model model = shear_model();
  set_electric(model, {{0.3, 0.1, 0.8}, 2.0, 1.0, 0.9}, {0.8, 0.5});
  model = with_vesicles(model, 2);
  model.vesicles[1].effects.push_back(std::make_shared<GravityEffect>(GravityParameters{0.5, {0.1, 0.2, -1.0}}));
  const std::vector<Matrix> shapes{translated(ellipsoid(8, {1.0, 0.8, 1.2}), {-1.3, 0.2, 0.0}),
                                   translated(ellipsoid(8, {0.9, 1.0, 0.8}), {1.2, 0.0, 0.6})};
  const Discretisation discretisation = discretisation_of(shapes);
  Instruments instruments;
  const Evaluation e = evaluate(model, discretisation, start(model, discretisation, shapes, 0.1), instruments);
  std::vector<Rheology> own;
  for (const VesicleDiagnostics& vesicle : e.diagnostics.vesicles) own.push_back(vesicle.rheology);
  const Rheology all = together(own);
  // Integrated over both surfaces at once, about that centroid.
  Matrix3 electric = Matrix3::Zero();
  Vector3 force = Vector3::Zero(), dipole = Vector3::Zero();
  for (std::size_t a = 0; a < 2; ++a) {
    const Membrane& membrane = *e.vesicles[a].membrane;
    const Surface& s = membrane.surface;
    const Matrix f = s.quadrature.asDiagonal() * membrane.fine.synthesize(e.fields.vesicles[a].force_electric);
    electric += f.transpose() * (s.position.rowwise() - all.centre.transpose());
    force -= f.colwise().sum().transpose();
    dipole += own[a].dipole;
  }
  BOOST_TEST((all.electric - electric).norm() < 1e-12 * electric.norm());
  BOOST_TEST((all.electric_force - force).norm() < 1e-13);
  // The forces between the two cancel: action and reaction.
  BOOST_TEST(own[0].electric_force.norm() > 100.0 * force.norm());
  BOOST_TEST((all.dipole - dipole).norm() < 1e-14);
  const double weight = 0.5 * own[1].volume * Vector3(0.1, 0.2, -1.0).norm();
  BOOST_TEST(std::abs(all.other_force.norm() - weight) < 1e-10 * weight);
  // Under a translation and a rotation all quantities transform accordingly.
  const Matrix3 rotation = general_rotation();
  std::vector<Rheology> moved;
  for (const Rheology& one : own) moved.push_back(rotated(rotation, {3.0, 1.0, -2.0}, one));
  const Rheology there = together(moved);
  BOOST_TEST((there.moment() - rotation * all.moment() * rotation.transpose()).norm() < 1e-12 * all.moment().norm());
  BOOST_TEST((there.dipole - rotation * all.dipole).norm() < 1e-13);
  BOOST_TEST(std::abs(there.intrinsic_viscosity() - all.intrinsic_viscosity()) < 1e-12);
  BOOST_TEST(std::abs(there.power() - all.power()) < 1e-12 * std::abs(all.power()));
}

BOOST_AUTO_TEST_SUITE_END()
