#include "bie/physics/effects/contact.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "bie/support/errors.hpp"
#include "tests/support/membrane.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(contact)

namespace {

constexpr int kOrder = 12;

/// Two shapes without symmetry, about 0.1 apart.
std::vector<Matrix> two_shapes() {
  const Matrix turned = ellipsoid(kOrder, {0.8, 1.0, 0.9}) * general_rotation().transpose();
  return {ellipsoid(kOrder, {1.0, 0.9, 1.2}), translated(turned, {1.9, 0.4, 0.3})};
}

/// Shapes with their space and membranes.
struct Membranes {
  Space space{kOrder};
  std::vector<Matrix> positions;
  std::vector<Membrane> membranes;

  explicit Membranes(std::vector<Matrix> shapes) : positions(std::move(shapes)) {
    for (const Matrix& position : positions) membranes.push_back(make_membrane(space, position, {}));
  }
  [[nodiscard]] std::vector<ContactMembrane> all() const {
    std::vector<ContactMembrane> result;
    for (std::size_t a = 0; a < positions.size(); ++a) result.push_back({positions[a], membranes[a]});
    return result;
  }
};

double energy_of(const ContactParameters& contact, const std::vector<Matrix>& shapes) {
  const Membranes membranes(shapes);
  return contact_energy(contact, membranes.all());
}

}  // namespace

BOOST_AUTO_TEST_CASE(force_is_minus_the_gradient_of_the_energy) {
  for (const ContactParameters& potential : {ContactParameters{0.7, 0.5}, ContactParameters{-0.3, 0.25}}) {
    const std::vector<Matrix> shapes = two_shapes();
    const Membranes membranes(shapes);
    const std::vector<Matrix> forces = contact_forces(potential, membranes.all());
    for (std::size_t a = 0; a < 2; ++a) {
      const Matrix direction = smooth_coefficients(kOrder, 4, 3, 17 + static_cast<unsigned>(a));
      constexpr double kStep = 1e-4;
      const auto energy_at = [&](double amount) {
        std::vector<Matrix> moved = shapes;
        moved[a] += amount * direction;
        return energy_of(potential, moved);
      };
      const double slope = (energy_at(kStep) - energy_at(-kStep)) / (2.0 * kStep);
      const Matrix displacement = membranes.space.fine.synthesize(direction);
      const Vector work = forces[a].cwiseProduct(displacement).rowwise().sum();
      const double expected = -work.dot(membranes.membranes[a].surface.quadrature);
      BOOST_TEST(std::abs(slope - expected) < 1e-6 * std::abs(expected), slope << " " << expected);
    }
  }
}

BOOST_AUTO_TEST_CASE(action_is_reaction) {
  const Membranes membranes(two_shapes());
  const std::vector<Matrix> forces = contact_forces({0.7, 0.4}, membranes.all());
  const auto total = [&](std::size_t a) -> Vector3 {
    return forces[a].transpose() * membranes.membranes[a].surface.quadrature;
  };
  BOOST_TEST((total(0) + total(1)).norm() < 1e-7 * total(0).norm(), (total(0) + total(1)).norm() / total(0).norm());
  // The second shape is at larger x, and a positive energy repels.
  BOOST_TEST(total(0).x() < 0.0);
}

BOOST_AUTO_TEST_CASE(energy_of_two_spheres_is_that_of_one_integral) {
  constexpr double kDistance = 2.2, kRange = 0.3, kEnergy = 1.3;
  // W(s) = (2π/s) ∫ r w dr from s − 1 to s + 1 at distance s from the centre of a unit sphere.
  const auto of_point = [](double s) {
    const auto part = [](double r) { return std::exp(-r * r / (kRange * kRange)); };
    return kEnergy / s * (part(s - 1.0) - part(s + 1.0));
  };
  // The same substitution over the other sphere gives 2π/d ∫ W(s) s ds.
  const int n = 200;
  const GaussLegendre rule = gauss_legendre(n);
  double exact = 0.0;
  for (int i = 0; i < n; ++i) {
    const double s = kDistance + rule.nodes[i];
    exact += rule.weights[i] * 2.0 * std::numbers::pi / kDistance * s * of_point(s);
  }
  const double found =
      energy_of({kEnergy, kRange}, {sphere(kOrder), translated(sphere(kOrder), {0.0, kDistance, 0.0})});
  BOOST_TEST(std::abs(found / exact - 1.0) < 1e-8, found / exact - 1.0);
}

BOOST_AUTO_TEST_CASE(far_vesicles_feel_nothing_and_too_short_ranges_are_refused) {
  const Membranes far({sphere(kOrder), translated(sphere(kOrder), {0.0, 0.0, 4.0})});
  for (const Matrix& force : contact_forces({1.0, 0.3}, far.all())) BOOST_TEST(force.norm() == 0.0);
  const Membranes near({sphere(kOrder), translated(sphere(kOrder), {0.0, 0.0, 2.003})});
  BOOST_CHECK_THROW(contact_forces({1.0, 1e-3}, near.all()), ConvergenceError);
}

BOOST_AUTO_TEST_SUITE_END()
