#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/stepping/evaluation/evaluation.hpp"
#include "tests/stepping/stimson_jeffery.hpp"
#include "tests/support/several_runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(several_fields)

namespace {

/// Membranes without conductance in a field along z, conductivity σ_i/σ_e = 10.
Model in_axial_field(std::size_t n) {
  Model model = relaxation_model(0.1);
  set_electric(model, {{0.0, 0.0, 1.0}, 10.0, 1.0, 1.0}, {1.0, 0.0});
  return with_vesicles(model, n);
}

Vector3 total_force(const Membrane& membrane, const Matrix& force) {
  return membrane.fine.synthesize(force).transpose() * membrane.surface.quadrature;
}

/// Total torque ∫ x × f dA.
Vector3 total_torque(const Membrane& membrane, const Matrix& force) {
  const Matrix values = membrane.fine.synthesize(force);
  Vector3 torque = Vector3::Zero();
  for (Index i = 0; i < values.rows(); ++i) {
    torque += membrane.surface.quadrature[i] * Vector3(membrane.surface.position.row(i)).cross(Vector3(values.row(i)));
  }
  return torque;
}

std::vector<Matrix> two_shapes(int order) {
  return {asymmetric_shape(order), translated(ellipsoid(order, {0.6, 0.5, 0.8}), {2.4, 0.1, 0.7})};
}

Model full_model() {
  Model model = field_model();
  model.flow = shear_flow(1.0);
  return with_vesicles(model, 2);
}

}  // namespace

// The exact speed is the force of the field over the drag of Stimson and Jeffery.
BOOST_AUTO_TEST_CASE(spheres_in_an_axial_field_approach_each_other_with_the_exact_speed) {
  struct Row {
    double gap, charged, uncharged;
  };
  for (const Row& row : {Row{2.0, 0.00235036408, 0.00583500261}, Row{0.5, 0.00726251441, 0.030062936}}) {
    const Vector3 up(0.0, 0.0, 1.0 + row.gap / 2.0);
    const std::vector<Matrix> spheres{translated(sphere(16), -up), translated(sphere(16), up)};
    const Model model = in_axial_field(2);
    const Discretisation discretisation = discretisation_of(spheres, {}, find_symmetry(model, at_rest(spheres)));
    BOOST_TEST(discretisation.symmetry().axisymmetric);
    for (const bool steady : {true, false}) {
      const State state = start(model, discretisation, spheres, 0.1, steady);
      const SolvedFields found = solved(model, discretisation, state);
      const double exact = steady ? row.charged : row.uncharged;
      const double below = translation(found.fields.vesicles[0].velocity).z();
      const double above = translation(found.fields.vesicles[1].velocity).z();
      BOOST_TEST(std::abs(below - exact) < 3e-8 * exact);
      BOOST_TEST(std::abs(above + exact) < 3e-8 * exact);
    }
  }
}

// Minus the slope of the energy of two unit spheres over the drag of Stimson and Jeffery. ∫∫ w over the distance d of
// the centres is (2π/d) ∫ (energy/s)(part(s − 1) − part(s + 1)) s ds from d − 1 to d + 1, part(r) = exp(−r²/range²).
BOOST_AUTO_TEST_CASE(spheres_in_contact_approach_each_other_with_the_exact_speed) {
  constexpr double kGap = 0.5, kEnergy = -0.2, kRange = 0.4;
  const auto energy = [&](double d) {
    const GaussLegendre rule = gauss_legendre(100);
    const auto part = [](double r) { return std::exp(-r * r / (kRange * kRange)); };
    double sum = 0.0;
    for (Index i = 0; i < rule.nodes.size(); ++i) {
      const double s = d + rule.nodes[i];
      sum += rule.weights[i] * (part(s - 1.0) - part(s + 1.0));
    }
    return 2.0 * std::numbers::pi / d * kEnergy * sum;
  };
  constexpr double kStep = 1e-4, d = 2.0 + kGap;
  const double force = (energy(d + kStep) - energy(d - kStep)) / (2.0 * kStep);
  const Vector3 up(0.0, 0.0, d / 2.0);
  const std::vector<Matrix> spheres{translated(sphere(16), -up), translated(sphere(16), up)};
  Model model = with_vesicles(relaxation_model(0.1), 2);
  model.viscosity = 1.7;
  model.contact = ContactParameters{kEnergy, kRange};
  const Discretisation discretisation = discretisation_of(spheres, {}, find_symmetry(model, at_rest(spheres)));
  const SolvedFields found = solved(model, discretisation, start(model, discretisation, spheres, 0.1));
  const double exact = force / (6.0 * std::numbers::pi * 1.7 * stimson_jeffery(kGap).opposite);
  BOOST_TEST(exact > 0.0);
  BOOST_TEST(std::abs(translation(found.fields.vesicles[0].velocity).z() / exact - 1.0) < 1e-6);
  BOOST_TEST(std::abs(translation(found.fields.vesicles[1].velocity).z() / exact + 1.0) < 1e-6);
}

BOOST_AUTO_TEST_CASE(forces_between_two_shapes_have_no_resultant_and_the_torque_of_their_dipole) {
  const std::vector<Matrix> shapes = two_shapes(16);
  const Model model = full_model();
  const Discretisation discretisation = discretisation_of(shapes);
  const SolvedFields found = solved(model, discretisation, start(model, discretisation, shapes, 0.1));
  Vector3 electric = Vector3::Zero(), torque = Vector3::Zero(), dipole = Vector3::Zero();
  double scale = 0.0;
  for (const std::size_t a : {0, 1}) {
    const Membrane& membrane = *found.vesicles[a].membrane;
    const VesicleFields& f = found.fields.vesicles[a];
    electric += total_force(membrane, f.force_electric);
    scale = std::max(scale, total_force(membrane, f.force_electric).norm());
    torque += total_torque(membrane, f.force_electric);
    dipole += membrane.surface.position.transpose() *
              Vector(membrane.fine.synthesize(f.charge)).cwiseProduct(membrane.surface.quadrature);
    // Truncation error of the forces at degree 16.
    BOOST_TEST(total_force(membrane, f.force_tension).norm() < 3e-5);
    BOOST_TEST(total_torque(membrane, f.force_tension).norm() < 5e-5);
  }
  BOOST_TEST(scale > 1e-3);
  BOOST_TEST(electric.norm() < 2e-4 * scale);
  // The uniform field exerts a torque on the dipole of both, V_m is zero; f_E is minus the force on a membrane.
  const Vector3 expected = -dipole.cross(model.electric->field);
  BOOST_TEST(expected.norm() > 1e-2);
  BOOST_TEST((torque - expected).norm() < 2e-4 * expected.norm(), torque.transpose() << "; " << expected.transpose());
}

BOOST_AUTO_TEST_CASE(the_order_of_vesicles_does_not_matter) {
  const std::vector<Matrix> shapes = two_shapes(8);
  const Model model = full_model();
  const std::vector<Matrix> swapped{shapes[1], shapes[0]};
  const Discretisation discretisation = discretisation_of(shapes);
  const SolvedFields found = solved(model, discretisation, start(model, discretisation, shapes, 0.1));
  const SolvedFields other = solved(model, discretisation, start(model, discretisation, swapped, 0.1));
  for (const std::size_t a : {0, 1}) {
    const VesicleFields& one = found.fields.vesicles[a];
    const VesicleFields& same = other.fields.vesicles[1 - a];
    BOOST_TEST(relative_difference(one.velocity, same.velocity) < 1e-8);
    BOOST_TEST(relative_difference(one.force_electric, same.force_electric) < 1e-9);
  }
}

BOOST_AUTO_TEST_CASE(copies_far_apart_are_each_alone_in_as_many_iterations) {
  const Matrix shape = asymmetric_shape(8);
  Model one = field_model();
  one.vesicles[0].viscosity_ratio = 2.0;
  std::vector<Matrix> shapes;
  for (int i = 0; i < 4; ++i) shapes.push_back(translated(shape, 1e5 * Vector3(i, 0.3 * i * i, std::sin(i))));
  const Model model = with_vesicles(one, shapes.size());
  const Discretisation discretisation = discretisation_of(shapes);
  const SolvedFields found = solved(model, discretisation, start(model, discretisation, shapes, 0.1));
  const Discretisation space = discretisation_of(8);
  const SolvedFields alone = solved(one, space, start(one, space, shape, 0.1));
  BOOST_TEST(found.iterations_flow <= alone.iterations_flow + 2);
  BOOST_TEST(found.iterations_electric <= alone.iterations_electric + 2);
  const VesicleFields& expected = alone.fields.vesicles[0];
  for (const VesicleFields& f : found.fields.vesicles) {
    // The bending force amplifies the rounding of positions, 1e-11.
    BOOST_TEST(relative_difference(f.velocity, expected.velocity) < 1e-6);
    BOOST_TEST(relative_difference(f.force_electric, expected.force_electric) < 1e-7);
    BOOST_TEST(relative_difference(f.tension, expected.tension) < 1e-6);
  }
}

BOOST_AUTO_TEST_SUITE_END()
