#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include "bie/physics/electric.hpp"
#include "bie/physics/membrane_charging.hpp"
#include "tests/physics/coupled_spheres.hpp"
#include "tests/support/electric.hpp"
#include "tests/support/several.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(charge_density)

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

SeveralMembranes two_spheres(int order, double gap) {
  const Vector3 up(0.0, 0.0, 1.0 + gap / 2.0);
  return {order, {translated(sphere(order), -up), translated(sphere(order), up)}, kLaplaceLayers, kLaplacePairs};
}

/// Parameters with the conductivity ratio σ_i/σ_e = k.
ElectricParameters with_ratio(const Vector3& field, double k) {
  return std::isinf(k) ? ElectricParameters{field, 1.0, 0.0, 1.0} : ElectricParameters{field, k, 1.0, 1.0};
}

struct Forces {
  std::vector<Vector3> on;  ///< force on each membrane
  int iterations;
};

Forces electric_forces(const SeveralMembranes& several, const ElectricParameters& electric,
                       const std::vector<Vector>& potentials) {
  const std::vector<ElectricMembrane> members = several.in_field(electric);
  const std::vector<Vector> rhs = weighted_fluxes(members, several.interaction, potentials);
  const std::vector<SecondKindSolution> found = solve_second_kind(members, several.interaction, rhs, 1e-12);
  require_converged(found.front().report, "charge densities");
  const std::vector<Vector> others = potentials_of_others(members, several.interaction, potentials, found);
  Forces forces{{}, found.front().report.iterations};
  for (std::size_t a = 0; a < members.size(); ++a) {
    const Membrane& membrane = several.membranes[a];
    const ElectricTraces traces = electric_traces(electric, membrane, potentials[a], found[a], others[a]);
    forces.on.push_back(-total(membrane, electric_force(1.0, membrane, traces)));
  }
  return forces;
}

std::vector<Unknowns> uncharged(const SeveralMembranes& several) {
  std::vector<Unknowns> all;
  for (const Vector& zero : several.zeros()) all.push_back({{}, zero});
  return all;
}

std::vector<Vector> potentials_of(const std::vector<Unknowns>& charged) {
  std::vector<Vector> all;
  for (const Unknowns& one : charged) all.push_back(one.transmembrane_potential);
  return all;
}

/// Attraction of two membranes, one above the other.
double attraction(const Forces& forces) { return forces.on[0].z(); }

}  // namespace

// Published digits of the forces of the multipole system.
BOOST_AUTO_TEST_CASE(multipole_systems_have_the_published_forces) {
  struct Row {
    double gap, ratio, along, across;
  };
  for (const Row& row : {Row{2.0, 0.0, 0.0707383121, -0.0376343810}, Row{2.0, kInfinite, 0.318239619, -0.141476624},
                         Row{0.5, 0.0, 0.3795307307, -0.2839306118}, Row{0.5, kInfinite, 3.173019487, -0.7590614615}}) {
    const SphereForces forces = sphere_forces(row.gap, row.ratio);
    BOOST_TEST(std::abs(forces.along - row.along) < 1e-9);
    BOOST_TEST(std::abs(forces.across - row.across) < 1e-9);
  }
}

BOOST_AUTO_TEST_CASE(two_spheres_in_a_field_attract_along_it_and_repel_across_it_as_their_multipoles_say) {
  for (const double gap : {2.0, 0.5}) {
    const SeveralMembranes spheres = two_spheres(gap < 1.0 ? 20 : 12, gap);
    for (const double ratio : {0.0, 10.0, kInfinite}) {
      const SphereForces exact = sphere_forces(gap, ratio);
      const Forces along = electric_forces(spheres, with_ratio({0.0, 0.0, 1.0}, ratio), spheres.zeros());
      const Forces across = electric_forces(spheres, with_ratio({1.0, 0.0, 0.0}, ratio), spheres.zeros());
      BOOST_TEST_CONTEXT("gap " << gap << " ratio " << ratio) {
        BOOST_TEST(std::abs(attraction(along) - exact.along) < 1e-9);
        BOOST_TEST(std::abs(attraction(across) - exact.across) < 1e-9);
        BOOST_TEST((along.on[0] + along.on[1]).norm() < 1e-9);
        BOOST_TEST((across.on[0] + across.on[1]).norm() < 1e-9);
        BOOST_TEST(along.iterations <= 10);
      }
    }
  }
}

// 24πβ²/d⁴ along the field and minus half of that across it, up to the third power of 1/d.
BOOST_AUTO_TEST_CASE(distant_spheres_attract_as_dipoles) {
  constexpr double d = 30.0, k = 10.0, beta = (k - 1.0) / (k + 2.0);
  const SeveralMembranes spheres = two_spheres(6, d - 2.0);
  const double along = 24.0 * std::numbers::pi * beta * beta / std::pow(d, 4);
  const auto found = [&](const Vector3& field) {
    return attraction(electric_forces(spheres, with_ratio(field, k), spheres.zeros()));
  };
  BOOST_TEST(std::abs(found({0.0, 0.0, 1.0}) / along - 1.0) < 10.0 / std::pow(d, 3));
  BOOST_TEST(std::abs(found({1.0, 0.0, 0.0}) / along + 0.5) < 10.0 / std::pow(d, 3));
}

BOOST_AUTO_TEST_CASE(steady_membranes_act_as_insulators) {
  for (const double gap : {2.0, 0.5}) {
    const SeveralMembranes spheres = two_spheres(gap < 1.0 ? 20 : 12, gap);
    const SphereForces exact = sphere_forces(gap, 0.0);
    for (const double ratio : {0.3, 10.0}) {
      const ElectricParameters electric = with_ratio({0.0, 0.0, 1.0}, ratio);
      std::vector<Vector> potentials(2);
      const SolveReport report = steady_potentials(spheres.charging(electric, {{1.0, 0.0}, {1.0, 0.0}}),
                                                   spheres.interaction, 1e-12, potentials);
      require_converged(report, "steady potentials");
      const double found = attraction(electric_forces(spheres, electric, potentials));
      BOOST_TEST(std::abs(found - exact.along) < 1e-8, "gap " << gap << " ratio " << ratio);
      BOOST_TEST(report.iterations <= 25);
    }
  }
}

// One step from zero charge is the steady state of a membrane whose conductance is larger by C_m/dt.
BOOST_AUTO_TEST_CASE(two_spheres_charge_in_steps_as_their_multipoles_do) {
  const SeveralMembranes spheres = two_spheres(16, 0.5);
  const ElectricParameters electric = with_ratio({0.0, 0.0, 1.0}, 4.0);
  const std::vector<ChargingMembrane> members = spheres.charging(electric, {{0.8, 0.3}, {0.8, 0.3}});
  for (const double dt : {1e-3, 0.2, 10.0}) {
    std::vector<Unknowns> charged;
    const SolveReport report =
        charge_membranes(members, spheres.interaction, dt, 1e-12, uncharged(spheres), nullptr, charged);
    BOOST_TEST(report.converged());
    BOOST_TEST(report.iterations <= 25);
    const SphereForces exact = charged_sphere_forces(0.5, 4.0, 0.8 / dt + 0.3);
    BOOST_TEST(std::abs(attraction(electric_forces(spheres, electric, potentials_of(charged))) - exact.along) < 1e-7);
  }
}

BOOST_AUTO_TEST_CASE(steady_potentials_stay_as_they_are) {
  const Matrix one = asymmetric_shape(10), other = translated(ellipsoid(10, {0.6, 0.5, 0.8}), {2.4, 0.1, 0.7});
  const SeveralMembranes pair(10, {one, other}, kLaplaceLayers, kLaplacePairs);
  const ElectricParameters electric{{0.4, -0.6, 1.0}, 5.0, 1.0, 1.0};
  const std::vector<ChargingMembrane> members = pair.charging(electric, {{0.8, 0.3}, {0.5, 0.0}});
  std::vector<Vector> potentials(2);
  require_converged(steady_potentials(members, pair.interaction, 1e-12, potentials), "steady potentials");
  const std::vector<Unknowns> steady{{{}, potentials[0]}, {{}, potentials[1]}};
  std::vector<Unknowns> later;
  require_converged(charge_membranes(members, pair.interaction, 0.2, 1e-12, steady, nullptr, later), "charging");
  for (const std::size_t a : {0, 1}) {
    BOOST_TEST(relative_difference(later[a].transmembrane_potential, potentials[a]) < 1e-10);
  }
}

BOOST_AUTO_TEST_CASE(the_order_of_membranes_does_not_matter) {
  const Matrix one = asymmetric_shape(10), other = translated(ellipsoid(10, {0.6, 0.5, 0.8}), {2.4, 0.1, 0.7});
  const SeveralMembranes pair(10, {one, other}, kLaplaceLayers, kLaplacePairs);
  const SeveralMembranes swapped(10, {other, one}, kLaplaceLayers, kLaplacePairs);
  const std::vector<Vector> potentials{smooth_coefficients(10, 4, 1, 21), smooth_coefficients(10, 4, 1, 22)};
  const ElectricParameters electric{{0.4, -0.6, 1.0}, 5.0, 1.0, 1.0};
  const Forces forces = electric_forces(pair, electric, potentials);
  const Forces of_swapped = electric_forces(swapped, electric, {potentials[1], potentials[0]});
  BOOST_TEST((forces.on[0] - of_swapped.on[1]).norm() < 1e-10 * forces.on[0].norm());
  BOOST_TEST((forces.on[1] - of_swapped.on[0]).norm() < 1e-10 * forces.on[0].norm());
}

BOOST_AUTO_TEST_CASE(copies_far_apart_are_each_alone_in_as_many_iterations) {
  const int order = 10;
  const Matrix shape = shape_33(order);
  std::vector<Matrix> copies;
  for (int i = 0; i < 5; ++i) copies.push_back(translated(shape, 1e4 * Vector3(i, 0.3 * i * i, std::sin(i))));
  const SeveralMembranes several(order, copies, kLaplaceLayers, kLaplacePairs);
  const ElectricParameters electric{{0.4, -0.6, 1.0}, 5.0, 1.0, 1.0};
  const Vector potential = smooth_coefficients(order, 4, 1, 23);
  const SecondKindSolution alone = solve_density(electric, several.membranes[0], potential);
  const std::vector<ElectricMembrane> members = several.in_field(electric);
  const std::vector<Vector> potentials(5, potential);
  const std::vector<SecondKindSolution> found =
      solve_second_kind(members, several.interaction, weighted_fluxes(members, several.interaction, potentials), 1e-12);
  BOOST_TEST(found.front().report.converged());
  BOOST_TEST(found.front().report.iterations <= alone.report.iterations + 1);
  for (const SecondKindSolution& density : found) {
    BOOST_TEST(relative_difference(density.weighted, alone.weighted) < 1e-9);
  }
}

BOOST_AUTO_TEST_SUITE_END()
