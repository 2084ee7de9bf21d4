#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "bie/stepping/evolution.hpp"
#include "bie/stepping/space/resolution.hpp"
#include "bie/stepping/state/state.hpp"
#include "bie/stepping/thresholds.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

struct DrivenScene {
  std::string name;
  Model model;
  Vector3 axes;
  double end_time;
  StartPotential potential{};
};

Model driven_by(double field, double flow, const Waveform& waveform) {
  Model model = field_model();
  model.electric->field = {0.0, 0.0, field};
  model.electric->waveform = waveform;
  if (flow > 0.0) model.flow = shear_flow(flow);
  return model;
}

std::vector<DrivenScene> driven_scenes() {
  const Vector3 oblate{1.0, 1.0, 0.78}, prolate{1.0, 1.0, 1.6};
  return {
      {"ac that V_m follows", driven_by(4.0, 0.0, Waveform::alternating(1.0, 0.25, 0.0)), oblate, 4.0},
      {"ac that V_m lags behind", driven_by(8.0, 0.0, Waveform::alternating(1.0, 2.0, 0.7)), oblate, 1.5},
      {"pulse", driven_by(6.0, 0.0, Waveform::pulse(1.0, 0.1, 0.3)), prolate, 1.0},
      {"steady start", driven_by(5.0, 0.0, {}), prolate, 0.4, {.steady = true}},
      {"shear", driven_by(1.0, 1.0, Waveform::pulse_train(2.0, 0.0, 0.1, 0.3)), prolate, 0.7},
  };
}

EvolutionSetup setup_of(const DrivenScene& scene, const Matrix& position, double tolerance) {
  State start = at_rest(position);
  EvolutionSetup setup;
  setup.model = scene.model;
  setup.settings.order = order_of(position.rows());
  setup.settings.time_order = 3;
  setup.symmetry = find_symmetry(scene.model, start);
  setup.control = {scene.end_time, 1e-9 * scene.end_time, tolerance};
  return setup;
}

Vector bounds_in_degrees(const Vector& of_degree) {
  Vector coefficients = Vector::Zero(n_coefficients(static_cast<int>(of_degree.size()) - 1));
  for (int n = 1; n < of_degree.size(); ++n) {
    coefficients[coefficient_index(n, 0)] = of_degree[n] / std::sqrt((2.0 * n + 1.0) / (4.0 * std::acos(-1.0)));
  }
  return coefficients;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(truncation)

BOOST_AUTO_TEST_CASE(no_state_leaves_out_more_than_its_share_below_the_highest_degree) {
  constexpr int kHighest = 24;
  for (const DrivenScene& scene : driven_scenes()) {
    for (const double tolerance : {1e-2, 1e-3}) {
      const Matrix position = ellipsoid(kHighest, scene.axes);
      Instruments instruments;
      Evolution evolution(setup_of(scene, position, tolerance), {StartMembrane{position, scene.potential}},
                          instruments);
      evolution.evaluate_start();
      int lowest = kHighest, highest = 0, n_steps = 0;
      for (;; ++n_steps) {
        lowest = std::min(lowest, evolution.order(0));
        highest = std::max(highest, evolution.order(0));
        if (evolution.order(0) < kHighest) {
          BOOST_TEST(evolution.truncation() <= thresholds::truncation_share * tolerance,
                     scene.name << " at tolerance " << tolerance << ", time " << evolution.state().time << ", degree "
                                << evolution.order(0) << ": " << evolution.truncation());
        }
        if (evolution.state().time >= scene.end_time) break;
        evolution.step({{}, scene.end_time});
      }
      BOOST_TEST_MESSAGE(scene.name << " at tolerance " << tolerance << ": " << n_steps << " steps, degrees " << lowest
                                    << " to " << highest);
    }
  }
}

BOOST_AUTO_TEST_CASE(degree_is_enough_only_where_the_cut_state_says_so_too) {
  // Seeded spectra with plateaus and gaps: the remainder of the truncated state must not exceed the target.
  std::mt19937 random(15);
  constexpr int kOrder = 24;
  Model model;
  for (int sample = 0; sample < 200; ++sample) {
    Vector of_degree = Vector::Zero(kOrder + 1);
    double level = 1.0;
    for (int n = 1; n <= kOrder; ++n) {
      const auto kind = random() % 4;
      if (kind == 1) level *= 0.5;
      if (kind == 2) level *= 0.02;
      of_degree[n] = kind == 3 ? 0.0 : level;
    }
    State state;
    state.vesicles.emplace_back();
    state.vesicles[0].reference_area = 4.0 * std::acos(-1.0);
    state.vesicles[0].position = Matrix::Zero(n_coefficients(kOrder), 3);
    state.vesicles[0].position.col(0) = bounds_in_degrees(of_degree);
    for (const double target : {1e-2, 1e-4, 1e-6}) {
      const int order = Resolution(model, state.vesicles[0]).order_for(target, 4, kOrder);
      if (order == kOrder) continue;
      BOOST_TEST(Resolution(model, resized(state.vesicles[0], order)).remainder() <= target);
    }
  }
}

BOOST_AUTO_TEST_CASE(unit_of_a_potential_without_a_field_does_not_matter) {
  Model model = field_model();
  model.electric->field.setZero();
  State state;
  state.vesicles.emplace_back();
  state.vesicles[0].reference_area = 4.0 * std::acos(-1.0);
  state.vesicles[0].position = ellipsoid(12, {1.0, 1.0, 1.2});
  const Vector potential = bounds_in_degrees(Vector::LinSpaced(13, 2.0, 0.1));
  state.vesicles[0].transmembrane_potential = potential;
  const double remainder = Resolution(model, state.vesicles[0]).remainder();
  BOOST_TEST(remainder > 0.0);
  for (const double unit : {0x1p-30, 0x1p30}) {
    state.vesicles[0].transmembrane_potential = unit * potential;
    BOOST_TEST(Resolution(model, state.vesicles[0]).remainder() == remainder);
  }
}

BOOST_AUTO_TEST_SUITE_END()
