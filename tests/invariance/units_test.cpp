#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/invariance/columns.hpp"
#include "tests/invariance/scaled_scene.hpp"
#include "tests/invariance/scenes.hpp"
#include "tests/invariance/short_run.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(units_of_a_scene, *boost::unit_test::label("slow"))

namespace {

constexpr int kSteps = 3;

/// Powers of two are exact, so a bit can change only if a number with a dimension is combined with one without.
const UnitFactors kPowersOfTwo{std::ldexp(1.0, -17), std::ldexp(1.0, 23), std::ldexp(1.0, -10), std::ldexp(1.0, 13)};

/// First difference in any bit; empty if all bits agree.
std::string first_difference(const ShortRun& base, const ShortRun& scaled, const UnitFactors& factors) {
  if (base.stopped != scaled.stopped) return "one stops: " + base.reason + scaled.reason;
  if (base.rows.size() != scaled.rows.size()) return "numbers of steps";
  for (std::size_t i = 0; i < base.rows.size(); ++i) {
    const RunRow& a = base.rows[i];
    const RunRow& b = scaled.rows[i];
    const auto differs = [](const auto& x, const auto& y, double factor) {
      return x.size() != y.size() || !(x * factor).isApprox(y, 0.0);
    };
    std::string what;
    const auto find = [&](bool found, const std::string& name) {
      if (found && what.empty()) what = name;
    };
    find(a.state.time * factors.time != b.state.time, "time");
    find(differs(a.state.vesicles[0].position, b.state.vesicles[0].position, factors.length), "position");
    find(differs(a.state.vesicles[0].transmembrane_potential, b.state.vesicles[0].transmembrane_potential,
                 factors.potential),
         "V_m");
    find(differs(a.state.vesicles[0].tension, b.state.vesicles[0].tension, factors.of(1, -1, 1, 0)), "tension");
    find(differs(a.state.vesicles[0].area_strain, b.state.vesicles[0].area_strain, 1.0), "strain");
    find(a.step.rejected != b.step.rejected, "rejected steps");
    find(a.step.iterations_flow != b.step.iterations_flow, "flow iterations");
    find(a.step.iterations_electric != b.step.iterations_electric, "electric iterations");
    for (const Column& column : columns()) {
      const double x = column.value(a.diagnostics) * column.factor(factors), y = column.value(b.diagnostics);
      find(x != y && !(std::isnan(x) && std::isnan(y)), column.name);
    }
    if (!what.empty()) return what + " after step " + std::to_string(i);
  }
  return "";
}

UnitFactors random_factors(std::mt19937_64 random) {
  std::uniform_real_distribution<double> exponent(-9.0, 9.0);
  const auto draw = [&] { return std::pow(10.0, exponent(random)); };
  return {draw(), draw(), draw(), draw()};
}

}  // namespace

BOOST_AUTO_TEST_CASE(powers_of_two_change_no_bit_and_other_factors_nothing_but_rounding) {
  for (const NamedScene& of : all_scenes()) {
    const auto& [name, scene] = of;
    const ShortRun base = short_run(scene, kSteps);
    const ShortRun by_powers = short_run(in_units(scene, kPowersOfTwo), kSteps);
    const std::string difference = first_difference(base, by_powers, kPowersOfTwo);
    BOOST_TEST(difference == "", name << ": " << difference);

    const UnitFactors factors = random_factors(random_of(of, "units"));
    const ShortRun scaled = short_run(in_units(scene, factors), kSteps);
    const double rounding = scene.numerics.tolerance ? 1e-6 : 1e-9;
    if (largest_deviation(base, scaled, factors).size < rounding) continue;
    // Residuals of solvers depend on rounding, so the solves go on to rounding.
    const Deviation worst =
        largest_deviation(solved_run(scene, kSteps), solved_run(in_units(scene, factors), kSteps), factors);
    BOOST_TEST(worst.size < 1e-6, name << ": " << worst.column << " by " << worst.size);
  }
}

BOOST_AUTO_TEST_SUITE_END()
