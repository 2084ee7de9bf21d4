#include <boost/test/unit_test.hpp>

#include "bie/physics/effects/bending.hpp"
#include "bie/physics/effects/tension.hpp"
#include "tests/support/electric.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

struct Resultant {
  double force, torque;  ///< length of ∫f dA and of ∫x×f dA, relative to ∫|f| dA and ∫|x||f| dA
};

Resultant resultant(const Surface& s, const Matrix& force) {
  Vector3 sum = Vector3::Zero();
  Vector3 moment = Vector3::Zero();
  for (Index i = 0; i < s.n_points(); ++i) {
    const Vector3 f = s.quadrature[i] * force.row(i);
    sum += f;
    moment += Vector3(s.position.row(i)).cross(f);
  }
  const Vector magnitude = force.rowwise().norm().cwiseProduct(s.quadrature);
  return {sum.norm() / magnitude.sum(), moment.norm() / magnitude.dot(s.position.rowwise().norm())};
}

Matrix force_of_field(const ElectricParameters& electric, const Membrane& membrane, const Vector& potential) {
  return electric_force(electric.permittivity, membrane, solve_traces(electric, membrane, potential));
}

}  // namespace

BOOST_AUTO_TEST_SUITE(force_balance)

BOOST_AUTO_TEST_CASE(bending_exerts_no_force_and_no_torque_beyond_truncation) {
  const auto bending_resultant = [](int order) {
    const Space space(order);
    const Membrane membrane = make_membrane(space, asymmetric_shape(order), {});
    return resultant(membrane.surface, bending_force({1.0}, membrane));
  };
  const Resultant coarse = bending_resultant(12);
  const Resultant fine = bending_resultant(32);
  BOOST_TEST(fine.force < 1e-4 * coarse.force);
  BOOST_TEST(fine.torque < 1e-4 * coarse.torque);
  BOOST_TEST(fine.force < 1e-7);
  BOOST_TEST(fine.torque < 1e-7);
}

BOOST_AUTO_TEST_CASE(tension_exerts_no_force_and_no_torque) {
  const Space space(24);
  const Membrane membrane = make_membrane(space, asymmetric_shape(24), {});
  const Resultant tension = resultant(membrane.surface, tension_force(membrane, smooth_coefficients(24, 6, 1, 80)));
  BOOST_TEST(tension.force < 1e-13);
  BOOST_TEST(tension.torque < 1e-13);
}

BOOST_AUTO_TEST_CASE(field_exerts_no_force_on_a_membrane_without_net_charge) {
  const auto net_force = [](int order, double ratio) {
    const Space space(order);
    const Membrane membrane = make_membrane(space, asymmetric_shape(order), kLaplaceLayers);
    const ElectricParameters electric{{0.4, -0.6, 1.0}, ratio, 1.0, 1.0};
    const Vector potential = smooth_coefficients(order, 4, 1, 81);
    return resultant(membrane.surface, force_of_field(electric, membrane, potential)).force;
  };
  for (const double ratio : {0.5, 2.0}) {
    const double fine = net_force(24, ratio);
    BOOST_TEST(fine < 1e-3 * net_force(8, ratio));
    BOOST_TEST(fine < 1e-9);
  }
}

BOOST_AUTO_TEST_CASE(electric_force_ignores_size_at_equal_field) {
  const int order = 12;
  const double scale = 3.0;
  const Space space(order);
  const Matrix position = asymmetric_shape(order);
  const Vector potential = smooth_coefficients(order, 4, 1, 82);
  const ElectricParameters electric{{0.4, -0.6, 1.0}, 2.0, 1.0, 1.0};
  const Matrix small = force_of_field(electric, make_membrane(space, position, kLaplaceLayers), potential);
  const Matrix large =
      force_of_field(electric, make_membrane(space, scale * position, kLaplaceLayers), scale * potential);
  BOOST_TEST(relative_difference(large, small) < 1e-9);
}

BOOST_AUTO_TEST_CASE(electric_force_is_quadratic_in_the_field_and_linear_in_the_permittivity) {
  const Space space(10);
  const Membrane membrane = make_membrane(space, asymmetric_shape(10), kLaplaceLayers);
  const Vector potential = smooth_coefficients(10, 4, 1, 83);
  const ElectricParameters weak{{0.4, -0.6, 1.0}, 2.0, 1.0, 1.0};
  ElectricParameters strong = weak;
  strong.field *= -2.0;
  strong.permittivity = 1.5;
  BOOST_TEST(relative_difference(force_of_field(strong, membrane, -2.0 * potential),
                                 6.0 * force_of_field(weak, membrane, potential)) < 1e-9);
}

BOOST_AUTO_TEST_SUITE_END()
