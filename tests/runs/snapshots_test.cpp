#include <boost/test/unit_test.hpp>
#include <cmath>
#include <map>

#include "bie/scene/accuracy.hpp"
#include "bie/scene/reader.hpp"
#include "tests/support/recorded_history.hpp"

BOOST_AUTO_TEST_SUITE(snapshots)

namespace {

/// Values of a column at the snapshots of a pulse that stretches a vesicle until it is taut, by snapshot number.
std::map<int, double> values_at_snapshots(double tolerance, const std::string& column) {
  vehd::Scene scene = vehd::at_tolerance(vehd::read_scene(VEHD_SOURCE_DIR "/docs/scenes/dc_pulse.toml"), tolerance);
  scene.numerics.dt.reset();
  scene.numerics.end_time = 0.18;
  const vehd::HistoryTable history = vehd::testing::history_of(scene);
  std::map<int, double> values;
  for (std::size_t i = 0; i < history.n_rows(); ++i) {
    const double number = 9.0 * history.column("time")[i] / history.column("time").back();
    const int nearest = static_cast<int>(std::lround(number));
    if (std::abs(number - nearest) < 1e-7) values[nearest] = history.column(column)[i];
  }
  return values;
}

}  // namespace

BOOST_AUTO_TEST_CASE(those_within_a_step_have_the_tension_of_their_time) {
  // A taut membrane magnifies errors of its shape.
  constexpr double tolerance = 1e-5;
  const auto found = values_at_snapshots(tolerance, "tension_integral");
  const auto expected = values_at_snapshots(1e-2 * tolerance, "tension_integral");
  BOOST_TEST_REQUIRE(found.size() == 10U);
  BOOST_TEST_REQUIRE(expected.size() == found.size());
  const double size = std::abs(expected.rbegin()->second);
  for (const auto& [number, value] : expected) {
    BOOST_TEST(std::abs(found.at(number) - value) < 2.0 * tolerance * size,
               "snapshot " << number << ": " << found.at(number) << " for " << value);
  }
}

BOOST_AUTO_TEST_SUITE_END()
