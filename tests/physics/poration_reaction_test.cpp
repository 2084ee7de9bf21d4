#include <boost/test/unit_test.hpp>
#include <cmath>
#include <memory>
#include <vector>

#include "bie/physics/effects/poration.hpp"

BOOST_AUTO_TEST_SUITE(poration_reaction)

using namespace vehd;

namespace {

/// Reactions published for cells (DeBruin and Krassowska 1999), and one with a steep porosity.
std::vector<std::shared_ptr<const PorationReaction>> published_reactions() {
  const double conductance = pore_conductance(0.8e-9, 5e-9, 0.1);
  return {std::make_shared<PoreDensity>(PoreParameters{1e9, 0.258, 1.5e9, 2.46, conductance}),
          std::make_shared<MembranePorosity>(PorosityParameters{1e4, 0.8, 12.0, 1e-6, 1e-1})};
}

}  // namespace

BOOST_AUTO_TEST_CASE(an_implicit_step_solves_its_equation_at_every_size) {
  for (const auto& reaction : published_reactions()) {
    for (const double dt : {1e-12, 1e-7, 1e-3, 10.0}) {
      for (const double potential : {-1.6, -0.3, 0.0, 0.7, 1.2, 3.0}) {
        for (const double known : {0.0, 0.4, 1.0, 9.0}) {
          const auto [s, slope] = reaction->implicit_step(known, dt, potential);
          const double change = dt * reaction->rate(s, potential);
          const double size = std::abs(s) + std::abs(known) + std::abs(change);
          BOOST_TEST(std::abs(s - known - change) <= 1e-11 * (1.0 + size) * (1.0 + dt / 1e-3),
                     reaction->description().adds << ": " << dt << " " << potential << " " << known << " " << s);
          constexpr double kStep = 1e-6;
          const double above = reaction->implicit_step(known, dt, potential + kStep).value;
          const double below = reaction->implicit_step(known, dt, potential - kStep).value;
          if (potential != 0.0) {
            BOOST_TEST(std::abs((above - below) / (2.0 * kStep) - slope) <= 1e-4 * (std::abs(slope) + 1e-3),
                       dt << " " << potential << " " << known << ": " << slope);
          }
          BOOST_TEST(slope * potential >= 0.0);
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(the_logarithm_of_a_density_follows_its_equation) {
  const PoreParameters p{1e9, 0.258, 1.5e9, 2.46, 1e-11};
  const PoreDensity reaction(p);
  for (const double potential : {0.0, 0.5, -1.1}) {
    for (const double s : {0.0, 3.0, 12.0}) {
      const double n = p.rest_density * std::exp(s), square = std::pow(potential / p.potential, 2);
      const double by_time =
          p.creation_rate * std::exp(square) * (1.0 - n / p.rest_density * std::exp(-p.exponent * square));
      BOOST_TEST(std::abs(n * reaction.rate(s, potential) - by_time) <=
                 1e-12 * p.creation_rate * std::exp(square) * n / p.rest_density);
      BOOST_TEST(std::abs(reaction.measure(s) / n - 1.0) < 1e-14);
      BOOST_TEST(std::abs(reaction.conductance(s).value / (n * p.pore_conductance) - 1.0) < 1e-14);
    }
  }
  // In equilibrium N = N_0 exp(q (V/V_ep)²).
  BOOST_TEST(std::abs(reaction.rate(2.46 * std::pow(0.4 / 0.258, 2), 0.4)) < 1e-12);
}

BOOST_AUTO_TEST_CASE(a_pore_conducts_as_published) {
  // 2π r² σ/(π r + 2h) at r = 0.8 nm, h = 5 nm, σ = 1 S/m: 4.0212e-18/1.25133e-8.
  BOOST_TEST(std::abs(pore_conductance(0.8e-9, 5e-9, 1.0) / 3.21357e-10 - 1.0) < 1e-5);
  BOOST_TEST(std::abs(pore_conductivity(0.5, 5.0) - 4.5 / std::log(10.0)) < 1e-14);
  BOOST_TEST(pore_conductivity(0.7, 0.7) == 0.7);
  BOOST_TEST(std::abs(pore_conductivity(0.7, 0.7 * (1.0 + 1e-9)) / 0.7 - 1.0 - 0.5e-9) < 1e-15);
}

BOOST_AUTO_TEST_CASE(porosity_opens_around_its_threshold_and_closes_slowly) {
  const MembranePorosity reaction({1e4, 0.8, 12.0, 1e-6, 1e-1});
  BOOST_TEST(std::abs(reaction.rate(0.0, 0.8) - 0.5 / 1e-6) < 1e-3);
  BOOST_TEST(reaction.rate(0.0, 0.8) == reaction.rate(0.0, -0.8));
  BOOST_TEST(std::abs(reaction.rate(1.0, 0.0) + 1.0 / 1e-1) < 1e-8);
  BOOST_TEST(reaction.conductance(0.25).value == 2500.0);
  BOOST_TEST(reaction.conductance(-1e-3).value == 0.0);
}

BOOST_AUTO_TEST_SUITE_END()
