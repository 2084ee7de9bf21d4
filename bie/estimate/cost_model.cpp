#include "bie/estimate/cost_model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "bie/scene/accuracy.hpp"
#include "bie/scene/problem.hpp"
#include "bie/stepping/state/composition.hpp"
#include "bie/stepping/time/deferred_correction.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/memory.hpp"

namespace vehd {
namespace {

constexpr const char* shape_cost_entry = "seconds per shape";
constexpr std::array kOrders{8, 12, 16, 24, 32, 48};
/// Powers of the degree where nothing was timed. Measured of shapes: 3.5 of sheared ones from 14 to 26, 2.9 of those
/// with an axis from 48 to 56.
constexpr double kSecondsGrowth = 3.5, kBytesGrowth = 4.0;
/// And no more than this for what it takes to time the next degree.
constexpr double kMostGrowth = 4.5;

std::string kind_of(const Problem& problem) {
  std::vector<std::string> effects;
  for (const EffectDescription& effect : effects_of(problem.model)) effects.push_back(effect.name);
  const std::size_t n = problem.model.vesicles.size();
  return fmt::format("{}; {}{}{}", fmt::join(effects, ", "), symmetry_text(problem.symmetry),
                     problem.model.mobile ? "" : "; frozen", n > 1 ? fmt::format("; {} vesicles", n) : "");
}

/// A first step of the scene that suits any accuracy.
double step_size(const Scene& scene) {
  constexpr double kTolerance = 1e-3;
  const Problem problem = problem_of(at_tolerance(scene, kTolerance));
  Instruments instruments;
  Evolution evolution(setup_of(problem), problem.start, instruments);
  evolution.evaluate_start();
  const double longest = scene.output.every.value_or(std::max(scene.numerics.end_time, kTolerance));
  return std::min(evolution.state().dt_next, longest);
}

CostModel::Point timed(Scene scene, int order, double dt) {
  constexpr int kTimeOrder = 2;
  scene.numerics.tolerance.reset();
  scene.numerics.dt = dt;
  scene.numerics.order = order;
  scene.numerics.time_order = kTimeOrder;
  const Problem problem = problem_of(scene);
  Instruments instruments;
  Evolution evolution(setup_of(problem), problem.start, instruments);
  evolution.evaluate_start();
  evolution.step({{}, 10.0 * dt});
  const auto start = std::chrono::steady_clock::now();
  evolution.step({{}, 10.0 * dt});
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return {order, seconds / evaluations_per_step(kTimeOrder), static_cast<double>(peak_memory_bytes())};
}

std::vector<CostModel::Point> measure(const Scene& scene, double budget) {
  const auto start = std::chrono::steady_clock::now();
  const auto spent = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  const double dt = step_size(scene);
  std::vector<CostModel::Point> points;
  double last_level = 0.0;
  std::string reason;
  for (const int order : kOrders) {
    if (!points.empty()) {
      const double next = last_level * std::pow(double(order) / points.back().order, kMostGrowth);
      if (spent() + next > budget) break;
    }
    const double before = spent();
    try {
      points.push_back(timed(scene, order, dt));
    } catch (const ConvergenceError& error) {
      // What a degree cannot resolve a higher one may.
      reason = error.what();
      continue;
    }
    last_level = spent() - before;
  }
  if (points.empty()) throw ConvergenceError(reason);
  return points;
}

/// Empty where the entry is not what is expected.
std::vector<CostModel::Point> points_of(const nlohmann::json& entry) {
  std::vector<CostModel::Point> points;
  if (!entry.is_array()) return points;
  for (const auto& point : entry) {
    const bool numbers =
        point.is_array() && point.size() == 3 &&
        std::all_of(point.begin(), point.end(), [](const auto& value) { return value.is_number() && value > 0.0; });
    if (!numbers || (!points.empty() && point[0] <= points.back().order)) return {};
    points.push_back({point[0], point[1], point[2]});
  }
  return points;
}

}  // namespace

double CostModel::at(int order, double Point::*value, double growth) const {
  const auto above =
      std::find_if(points_.begin(), points_.end(), [order](const Point& point) { return point.order >= order; });
  if (above == points_.end()) return points_.back().*value * std::pow(double(order) / points_.back().order, growth);
  // Below the lowest degree overhead rules, which does not depend on it.
  if (above == points_.begin()) return (*above).*value;
  const Point& below = *(above - 1);
  const double share = std::log(double(order) / below.order) / std::log(double(above->order) / below.order);
  return below.*value * std::pow((*above).*value / below.*value, share);
}

double CostModel::seconds_per_shape(int order) const { return at(order, &Point::seconds, kSecondsGrowth); }
double CostModel::bytes(int order) const { return at(order, &Point::bytes, kBytesGrowth); }

CostModel cost_model_of(const Scene& scene, double seconds, CostCache& cache) {
  const std::string kind = kind_of(problem_of(at_tolerance(scene, 1e-1)));
  if (const auto entry = cache.find(shape_cost_entry, kind)) {
    if (std::vector<CostModel::Point> points = points_of(*entry); !points.empty()) return CostModel(std::move(points));
  }
  std::vector<CostModel::Point> points = measure(scene, seconds);
  nlohmann::json entry = nlohmann::json::array();
  for (const CostModel::Point& point : points) entry.push_back({point.order, point.seconds, point.bytes});
  cache.keep(shape_cost_entry, kind, entry);
  return CostModel(std::move(points));
}

}  // namespace vehd
