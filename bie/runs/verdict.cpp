#include "bie/runs/verdict.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "bie/scene/vesicles.hpp"

namespace vehd {
namespace {

constexpr std::array limits = {TrustLimit{"volume_drift", 1e-6}, TrustLimit{"spectrum_tail", 5e-3},
                               TrustLimit{"quadrature_error", 1e-3}};
/// Limits of an inextensible membrane.
constexpr std::array limits_of_area = {TrustLimit{"area_drift", 1e-6}, TrustLimit{"strain_max", 0.05}};

/// Steps ring if the tension alternates from one to the next by this share of its largest value, and the tail of the
/// spectrum changes by this factor at the same time. A jump of the field changes the tension but not the shape, and a
/// collapse raises the tail smoothly.
constexpr double least_swing = 0.01;
constexpr double least_tail_swing = 2.0;
/// Smaller tails are rounding.
constexpr double least_tail = 1e-9;
/// A single event is not ringing. Runs that ring near the sphere have at least 28 such swings in 230 steps; all scenes
/// of docs/scenes and all hard cases have none.
constexpr std::size_t most_swings = 4;
/// A few fixed steps may need to be halved; dt is too large if attempts fail before more than this share of the steps
/// and before more than this number. Runs that ring have at least 0.12, other hard cases that reach their end 0.03.
constexpr double largest_rejecting_share = 0.1;
constexpr std::ptrdiff_t most_rejecting = 10;

/// Limit, with fixed steps, of the truncation error that unresolved wrinkles may have amplified: that of spectrum_tail.
/// With a tolerance it is the tolerance: pulses that meet it stay below it; those that miss it tenfold, or depend on
/// the degree, are a thousand times above (docs/hard_cases.md).
constexpr double most_unseen = 5e-3;
/// An error that has grown by less than a digit is covered by the truncation column.
constexpr double least_unseen_growth = 10.0;

/// The worst value; NaN if there is one.
template <typename IsWorse>
double worst(const std::vector<double>& values, const IsWorse& is_worse) {
  double result = values.front();
  for (const double value : values) {
    if (std::isnan(value)) return value;
    if (is_worse(value, result)) result = value;
  }
  return result;
}

/// Time of the first row whose value is not good; nullopt if there is none.
template <typename IsGood>
std::optional<double> first_time(const HistoryTable& history, const std::vector<double>& values,
                                 const IsGood& is_good) {
  const auto first = std::find_if_not(values.begin(), values.end(), is_good);
  if (first == values.end()) return std::nullopt;
  return history.column("time")[static_cast<std::size_t>(first - values.begin())];
}

std::vector<std::string> beyond_limits(const HistoryTable& history, const TrustDemands& demands) {
  std::vector<std::string> findings;
  for (const TrustLimit& limit : trust_limits(demands)) {
    const std::vector<double>& values = history.column(limit.column);
    const auto time = first_time(history, values, [&](double value) { return std::abs(value) <= limit.largest; });
    if (!time) continue;
    const double most = std::abs(worst(values, [](double a, double b) { return std::abs(a) > std::abs(b); }));
    findings.push_back(fmt::format("{} above {:g} since time {} (worst {:.3g})", limit.column, limit.largest,
                                   history.time_text(*time), most));
  }
  const std::vector<double>& separation = history.column("separation");
  if (const auto time =
          first_time(history, separation, [](double value) { return value >= least_trusted_separation; })) {
    findings.push_back(fmt::format("separation below {:g} since time {} (worst {:.3g})", least_trusted_separation,
                                   history.time_text(*time), worst(separation, std::less<>())));
  }
  return findings;
}

/// A compressed membrane whose fastest-growing wrinkles are finer than the degree can represent.
struct UnseenWrinkles {
  double since = 0.0;
  std::size_t worst_row = 0;
  /// Truncation at the start of an interval of such wrinkles, and exp of the sum of wrinkle_growth in it, at the row
  /// where their product is largest.
  double seed = 0.0, growth = 1.0;

  [[nodiscard]] bool matters(double limit) const { return growth > least_unseen_growth && seed * growth > limit; }
  [[nodiscard]] std::string text(const HistoryTable& history, double limit) const {
    const double round = 2.0 * std::numbers::pi;
    const double wrinkle = history.column("wrinkle_degree")[worst_row], order = history.column("order")[worst_row];
    std::string result = fmt::format(
        "compressed since time {}: wrinkles of wavelength {:.2g} radii grow fastest "
        "(degree {:g} resolves wavelengths down to {:.2g})",
        history.time_text(since), round / wrinkle, order, round / order);
    if (matters(limit)) {
      result += fmt::format(", and a truncation error of {:.1g} may have grown {:.0e} times", seed, growth);
    }
    return result;
  }
};

std::optional<UnseenWrinkles> unseen_wrinkles(const HistoryTable& history) {
  const std::vector<double>& times = history.column("time");
  const std::vector<double>& wrinkles = history.column("wrinkle_degree");
  const std::vector<double>& order = history.column("order");
  const std::vector<double>& truncation = history.column("truncation");
  // Histories of earlier versions lack this column.
  const std::vector<double>* const growth = history.has("wrinkle_growth") ? &history.column("wrinkle_growth") : nullptr;
  std::optional<UnseenWrinkles> found;
  double seed = 0.0, exponent = 0.0;
  bool wrinkled = false;
  for (std::size_t i = 0; i < wrinkles.size(); ++i) {
    const bool had_wrinkles = std::exchange(wrinkled, wrinkles[i] > order[i]);
    if (!wrinkled) continue;
    if (!found) found = UnseenWrinkles{.since = times[i], .worst_row = i};
    if (wrinkles[i] > wrinkles[found->worst_row]) found->worst_row = i;
    if (!had_wrinkles) {
      seed = truncation[i];
      exponent = 0.0;
    }
    if (growth != nullptr) exponent += (*growth)[i];
    if (seed * std::exp(exponent) > found->seed * found->growth) {
      found->seed = seed;
      found->growth = std::exp(exponent);
    }
  }
  return found;
}

/// Deviation of each value from the straight line between its neighbours; 0 at the ends and at repeated times.
std::vector<double> kinks(const std::vector<double>& times, const std::vector<double>& values) {
  std::vector<double> result(values.size(), 0.0);
  for (std::size_t i = 1; i + 1 < values.size(); ++i) {
    const double before = times[i] - times[i - 1];
    const double after = times[i + 1] - times[i];
    if (!(before > 0.0 && after > 0.0)) continue;
    result[i] = values[i] - values[i - 1] - (values[i + 1] - values[i - 1]) * before / (before + after);
  }
  return result;
}

/// Detects steps between which tension and spectrum tail swing together.
std::optional<std::string> ringing(const HistoryTable& history) {
  const std::vector<double>& times = history.column("time");
  const std::vector<double>& tension = history.column("tension_integral");
  const std::vector<double>& tail = history.column("spectrum_tail");
  const std::vector<double>& order = history.column("order");
  double largest = 0.0;
  for (const double value : tension) largest = std::max(largest, std::abs(value));
  const std::vector<double> kink = kinks(times, tension);
  std::vector<double> swings;  // times
  for (std::size_t i = 1; i + 2 < times.size(); ++i) {
    // Tails at different degrees cannot be compared.
    if (order[i] != order[i - 1] || order[i] != order[i + 1]) continue;
    const bool alternates = kink[i] * kink[i + 1] < 0.0;
    const double swing = std::min(std::abs(kink[i]), std::abs(kink[i + 1]));
    const auto [less, more] = std::minmax(tail[i], tail[i + 1]);
    if (alternates && swing > least_swing * largest && less > least_tail && more > least_tail_swing * less) {
      swings.push_back(times[i]);
    }
  }
  if (swings.size() <= most_swings) return std::nullopt;
  return fmt::format("tension_integral and spectrum_tail swing from step to step since time {} ({} times)",
                     history.time_text(swings.front()), swings.size());
}

/// Detects a gap between two vesicles, or to a wall, that requires a higher degree than they have.
std::optional<std::string> narrow_gap(const HistoryTable& history) {
  if (!history.has("gap_degree")) return std::nullopt;
  const std::vector<double>& degree = history.column("gap_degree");
  const std::vector<double>& order = history.column("order");
  std::optional<std::size_t> first, worst_row;
  for (std::size_t i = 0; i < degree.size(); ++i) {
    if (degree[i] <= order[i]) continue;
    if (!first) first = i;
    if (!worst_row || degree[i] > degree[*worst_row]) worst_row = i;
  }
  if (!first) return std::nullopt;
  return fmt::format("{} needs a higher degree than {:g} since time {} (up to {:.0f})",
                     history.has("smallest_gap") ? "smallest_gap" : "gap_wall", order[*first],
                     history.time_text(history.column("time")[*first]), degree[*worst_row]);
}

/// Detects fixed steps that fail repeatedly.
std::optional<std::string> rejections(const HistoryTable& history) {
  const std::vector<double>& rejected = history.column("rejected");
  const auto fails = [](double attempts) { return attempts > 0.0; };
  const auto count = std::ranges::count_if(rejected, fails);
  const std::size_t n_steps = std::max<std::size_t>(rejected.size(), 1) - 1;
  if (count <= most_rejecting || static_cast<double>(count) <= largest_rejecting_share * static_cast<double>(n_steps)) {
    return std::nullopt;
  }
  const auto first = std::ranges::find_if(rejected, fails) - rejected.begin();
  return fmt::format("attempts failed before {} of {} steps, first at time {}", count, n_steps,
                     history.time_text(history.column("time")[static_cast<std::size_t>(first)]));
}

}  // namespace

TrustDemands trust_demands(const Scene& scene) {
  const auto keeps_area = [](const Scene& one) { return one.membrane.inextensible; };
  return {scene.numerics.tolerance, std::ranges::all_of(each_alone(scene), keeps_area),
          scene.poration && scene.poration->model != PorationModel::criterion};
}

std::vector<TrustLimit> trust_limits(const TrustDemands& demands) {
  std::vector<TrustLimit> all;
  if (demands.keeps_area) all.assign(limits_of_area.begin(), limits_of_area.end());
  all.insert(all.end(), limits.begin(), limits.end());
  // Exceeded only if the highest degree that the scene allows is too low.
  if (demands.tolerance) all.push_back({"truncation", *demands.tolerance});
  return all;
}

std::string verdict_of(const HistoryTable& history, const TrustDemands& demands, const std::string& stop_reason) {
  std::vector<std::string> findings = beyond_limits(history, demands);
  if (auto finding = ringing(history)) findings.push_back(std::move(*finding));
  // With a tolerance, rejected attempts are part of the choice of the step.
  if (!demands.tolerance) {
    if (auto finding = rejections(history)) findings.push_back(std::move(*finding));
  }
  // Not a fault on their own: a pulse can compress the membrane and end before wrinkles have grown.
  const double unseen = demands.tolerance.value_or(most_unseen);
  if (const auto wrinkles = unseen_wrinkles(history);
      wrinkles && (wrinkles->matters(unseen) || !findings.empty() || !stop_reason.empty())) {
    findings.push_back(wrinkles->text(history, unseen));
  }
  if (auto finding = narrow_gap(history)) findings.push_back(std::move(*finding));
  if (demands.tolerance && demands.porates) {
    findings.emplace_back("poration is not covered by the tolerance: the degree follows shape and V_m alone");
  }
  const std::string text = fmt::format("{}", fmt::join(findings, "; "));
  if (stop_reason.empty()) return text.empty() ? trustworthy : text;
  return text.empty() ? "stopped: " + stop_reason : fmt::format("stopped: {}; until then {}", stop_reason, text);
}

}  // namespace vehd
