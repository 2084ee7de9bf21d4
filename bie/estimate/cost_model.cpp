#include "bie/estimate/cost_model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iterator>
#include <limits>

#include "bie/scene/accuracy.hpp"
#include "bie/scene/problem.hpp"
#include "bie/stepping/state/composition.hpp"
#include "bie/stepping/time/deferred_correction.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/memory.hpp"

namespace vehd {
namespace {

constexpr const char* shape_cost_entry = "seconds per shape";
constexpr std::array kOrders{8, 12, 16, 24, 32};
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
double step_size(const Scene& scene, Deadline& deadline) {
  constexpr double kTolerance = 1e-3;
  const Problem problem = problem_of(at_tolerance(scene, kTolerance));
  Instruments instruments(&deadline);
  Evolution evolution(setup_of(problem), problem.start, instruments);
  evolution.evaluate_start();
  return std::min(evolution.state().dt_next, scene.output.every.value_or(scene.numerics.end_time));
}

/// The scene with a few fixed steps of that size, whatever happens meanwhile.
Scene with_few_steps(Scene scene, double dt) {
  constexpr int kTimeOrder = 2;
  scene.numerics.tolerance.reset();
  scene.numerics.dt = dt;
  scene.numerics.time_order = kTimeOrder;
  scene.numerics.end_time = 10.0 * dt;
  scene.output = {};
  return scene;
}

std::vector<CostModel::Point> measure(const Scene& scene, double budget, Deadline& deadline) {
  constexpr int kSteps = 3, kHighest = 48;
  const auto start = std::chrono::steady_clock::now();
  const auto left = [&] {
    return budget - std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  Scene timed = with_few_steps(scene, step_size(scene, deadline));
  std::vector<CostModel::Point> points;
  std::string reason;
  time_rising_degrees(kHighest, left(), [&](int order) {
    timed.numerics.order = order;
    const TimedSteps steps = timed_steps(timed, kSteps, std::numeric_limits<double>::infinity(), deadline);
    if (steps.point) points.push_back(*steps.point);
    if (!steps.point && !steps.stops.empty()) reason = steps.stops;
  });
  if (!points.empty()) return points;
  if (reason.empty()) throw OutOfTime("the first steps");
  throw ConvergenceError(reason);
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

TimedSteps timed_steps(const Scene& scene, int most_steps, double seconds, Deadline& deadline) {
  constexpr std::size_t kWarmUp = 2;
  using Clock = std::chrono::steady_clock;
  TimedSteps result;
  std::vector<Clock::time_point> ends;
  const auto took = [](Clock::duration duration) { return std::chrono::duration<double>(duration).count(); };
  try {
    const Problem problem = problem_of(scene);
    Instruments instruments(&deadline);
    Evolution evolution(setup_of(problem), problem.start, instruments);
    evolution.evaluate_start();
    const EventTimes events = events_of(scene);
    ends.push_back(Clock::now());
    while (evolution.state().time < events.end_time && std::ssize(ends) <= most_steps &&
           (ends.size() < 2 || took(Clock::now() - ends.front()) < seconds)) {
      evolution.step(events);
      ends.push_back(Clock::now());
    }
  } catch (const ConvergenceError& error) {
    result.stops = error.what();
  } catch (const OutOfTime&) {
    // The steps before it count.
  }
  if (ends.size() < 2) return result;
  const std::size_t first = ends.size() > kWarmUp + 1 ? kWarmUp : 0;
  const double per_step = took(ends.back() - ends[first]) / static_cast<double>(ends.size() - 1 - first);
  result.point = {scene.numerics.order, per_step / evaluations_per_step(scene.numerics.time_order),
                  static_cast<double>(peak_memory_bytes())};
  return result;
}

int time_rising_degrees(int highest, double seconds, const std::function<void(int order)>& time_at) {
  const auto start = std::chrono::steady_clock::now();
  const auto spent = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  int last = 0;
  double of_last = 0.0;
  std::vector<int> orders;
  std::ranges::copy_if(kOrders, std::back_inserter(orders), [=](int order) { return order < highest; });
  orders.push_back(highest);
  for (const int order : orders) {
    const double next = last == 0 ? 0.0 : of_last * std::pow(double(order) / last, kMostGrowth);
    if (last != 0 && spent() + next > seconds) break;
    const double before = spent();
    time_at(order);
    of_last = spent() - before;
    last = order;
  }
  return last;
}

CostModel cost_model_of(const Scene& scene, double seconds, CostCache& cache, Deadline& deadline) {
  const std::string kind = kind_of(problem_of(at_tolerance(scene, 1e-1)));
  if (const auto entry = cache.find(shape_cost_entry, kind)) {
    if (std::vector<CostModel::Point> points = points_of(*entry); !points.empty()) return CostModel(std::move(points));
  }
  std::vector<CostModel::Point> points = measure(scene, seconds, deadline);
  nlohmann::json entry = nlohmann::json::array();
  for (const CostModel::Point& point : points) entry.push_back({point.order, point.seconds, point.bytes});
  cache.keep(shape_cost_entry, kind, entry);
  return CostModel(std::move(points));
}

}  // namespace vehd
