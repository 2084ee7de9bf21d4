#include "bie/physics/interaction.hpp"

#include <boost/test/unit_test.hpp>
#include <list>

#include "bie/support/errors.hpp"
#include "tests/support/point_potential.hpp"
#include "tests/support/several.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(interaction)

// Outside a membrane that encloses all sources, φ = D[φ] − S[∂φ/∂n].
BOOST_AUTO_TEST_CASE(potential_and_flux_of_sources_within_others_follow_from_their_traces) {
  struct Row {
    double gap, error, flux_error;
  };
  // Truncation to degree 20 limits the accuracy of the field of another membrane at this gap.
  for (const auto& [gap, most, most_of_flux] : {Row{0.05, 1e-6, 2e-4}, Row{0.5, 1e-7, 2e-5}, Row{3.0, 1e-9, 2e-7}}) {
    const int order = 20;
    const Matrix one = asymmetric_shape(order);
    const Matrix two = translated(ellipsoid(order, {0.7, 0.8, 0.9}), {2.5 + gap, -0.2, 0.4});
    const SeveralMembranes several(order, {one, two, translated(two, {0.0, 3.5, 0.3})}, {}, kLaplacePairs);
    const Vector3 sources[] = {{0.3, -0.2, 0.5}, {2.5 + gap, -0.2, 0.4}, {2.5 + gap, 3.3, 0.7}};
    std::vector<Vector> potentials, fluxes, exact, exact_fluxes;
    for (std::size_t a = 0; a < 3; ++a) {
      const Surface& surface = several.membranes[a].surface;
      const SphereTransform& fine = several.space.fine;
      PointPotential other{Vector::Zero(surface.n_points()), Vector::Zero(surface.n_points())};
      for (std::size_t b = 0; b < 3; ++b) {
        const PointPotential of_b = point_potential(surface, sources[b]);
        if (b == a) {
          potentials.emplace_back(fine.analyze(of_b.value));
          fluxes.emplace_back(several.membranes[a].weighted(of_b.flux));
        } else {
          other.value += of_b.value;
          other.flux += of_b.flux;
        }
      }
      exact.emplace_back(fine.analyze(other.value));
      exact_fluxes.emplace_back(several.membranes[a].weighted(other.flux));
    }
    const std::vector<Vector> single = several.interaction.single_potential(fluxes);
    const std::vector<Vector> jump = several.interaction.double_potential(potentials);
    const std::vector<Vector> single_flux = several.interaction.weighted_single_flux(fluxes);
    const std::vector<Vector> jump_flux = several.interaction.weighted_double_flux(potentials);
    for (std::size_t a = 0; a < 3; ++a) {
      BOOST_TEST(relative_difference(jump[a] - single[a], exact[a]) < most, "gap " << gap);
      BOOST_TEST(relative_difference(jump_flux[a] - single_flux[a], exact_fluxes[a]) < most_of_flux, "gap " << gap);
    }
  }
}

// Nine membranes on a lattice, some pairs too near for expansions; two membranes use no expansions.
BOOST_AUTO_TEST_CASE(many_membranes_are_the_sums_of_their_pairs) {
  constexpr int kOrder = 6;
  constexpr std::size_t kCount = 9;
  const SphereTransform nodes(kOrder, make_grid(kOrder));
  const Matrix shape = asymmetric_shape(kOrder);
  std::vector<Matrix> positions, vectors;
  std::vector<Vector> scalars;
  for (unsigned i = 0; i < kCount; ++i) {
    positions.push_back(translated((0.8 + 0.02 * i) * shape, {3.2 * (i % 3), 3.3 * (i / 3), 0.2 * i}));
    vectors.push_back(smooth_coefficients(kOrder, 5, 3, 70 + i));
    scalars.emplace_back(vectors.back().col(1));
  }
  const auto interaction_of = [&](const std::vector<std::size_t>& chosen) {
    std::vector<InteractingMembrane> all;
    for (const std::size_t i : chosen) all.push_back({positions[i], nodes, {true, true, true, true, true, true}});
    Instruments instruments;
    return Interaction(all, {}, instruments);
  };
  const Interaction many = interaction_of({0, 1, 2, 3, 4, 5, 6, 7, 8});
  const PairCounts counts = many.counts();
  BOOST_TEST(counts.expanded > 0);
  BOOST_TEST(counts.near + counts.far > 0);
  BOOST_TEST(counts.near + counts.far + counts.expanded == Index(kCount * (kCount - 1)) * nodes.grid().n_points());
  struct Pair {
    std::size_t a, b;
    Interaction interaction;
  };
  std::list<Pair> pairs;
  for (std::size_t a = 0; a < kCount; ++a) {
    for (std::size_t b = 0; b < a; ++b) pairs.push_back({a, b, interaction_of({a, b})});
  }
  const auto check = [&](double most, const auto& densities, const auto& layer) {
    const auto found = layer(many, densities);
    auto exact = found;
    for (auto& sum : exact) sum.setZero();
    for (const Pair& pair : pairs) {
      const auto of_pair = layer(pair.interaction, {densities[pair.a], densities[pair.b]});
      exact[pair.a] += of_pair[0];
      exact[pair.b] += of_pair[1];
    }
    for (std::size_t a = 0; a < kCount; ++a) BOOST_TEST(relative_difference(found[a], exact[a]) < most);
  };
  // The rules are accurate relative to the densities; the fluxes induced on other membranes are a tenth of those.
  using Scalars = std::vector<Vector>;
  using Vectors = std::vector<Matrix>;
  check(1e-9, scalars, [](const Interaction& i, const Scalars& f) { return i.single_potential(f); });
  check(1e-8, scalars, [](const Interaction& i, const Scalars& f) { return i.weighted_single_flux(f); });
  check(1e-9, scalars, [](const Interaction& i, const Scalars& f) { return i.double_potential(f); });
  check(1e-8, scalars, [](const Interaction& i, const Scalars& f) { return i.weighted_double_flux(f); });
  check(1e-9, vectors, [](const Interaction& i, const Vectors& f) { return i.stokes_single(f); });
  check(1e-9, vectors, [](const Interaction& i, const Vectors& f) { return i.stokes_double(f); });
}

BOOST_AUTO_TEST_CASE(membranes_that_intersect_are_refused) {
  const Matrix one = asymmetric_shape(8);
  BOOST_CHECK_THROW(SeveralMembranes(8, {one, translated(one, {0.7, 0.0, 0.0})}, {}, kLaplacePairs), ConvergenceError);
}

BOOST_AUTO_TEST_CASE(an_empty_density_counts_as_zero) {
  const Matrix one = asymmetric_shape(8);
  const SeveralMembranes pair(8, {one, translated(one, {3.5, 0.0, 0.0})}, {}, kLaplacePairs);
  const Vector density = smooth_coefficients(8, 4, 1, 31);
  const std::vector<Vector> found = pair.interaction.single_potential({density, {}});
  BOOST_TEST(found[0].isZero(0.0));
  BOOST_TEST(max_difference(found[1], pair.interaction.single_potential({density, Vector::Zero(81)})[1]) == 0.0);
}

BOOST_AUTO_TEST_SUITE_END()
