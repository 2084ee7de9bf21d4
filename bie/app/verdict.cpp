#include "bie/app/verdict.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

namespace vehd {
namespace {

/// A run that exceeds one of these is reported as not trustworthy.
struct TrustLimit {
  const char* column;
  double largest;
};
constexpr std::array limits = {TrustLimit{"area_drift", 1e-6}, TrustLimit{"volume_drift", 1e-6},
                               TrustLimit{"strain_max", 0.05}, TrustLimit{"spectrum_tail", 5e-3},
                               TrustLimit{"quadrature_error", 1e-3}};
/// Parts of the membrane that are nearer to each other, in grid spacings, are one to the grid.
constexpr double least_separation = 1.0;

/// The value furthest from what is good; not a number where there is one.
template <typename IsWorse>
double worst(const std::vector<double>& values, const IsWorse& is_worse) {
  double result = values.front();
  for (const double value : values) {
    if (std::isnan(value)) return value;
    if (is_worse(value, result)) result = value;
  }
  return result;
}

/// Time of the first row whose value is not good, or nothing.
template <typename IsGood>
std::optional<double> first_time(const HistoryTable& history, const std::vector<double>& values,
                                 const IsGood& is_good) {
  const auto first = std::find_if_not(values.begin(), values.end(), is_good);
  if (first == values.end()) return std::nullopt;
  return history.column("time")[static_cast<std::size_t>(first - values.begin())];
}

std::vector<std::string> beyond_limits(const HistoryTable& history, std::optional<double> tolerance) {
  std::vector<TrustLimit> all(limits.begin(), limits.end());
  // The highest degree that the scene allows was not enough.
  if (tolerance) all.push_back({"truncation", *tolerance});
  std::vector<std::string> findings;
  for (const TrustLimit& limit : all) {
    const std::vector<double>& values = history.column(limit.column);
    const auto time = first_time(history, values, [&](double value) { return std::abs(value) <= limit.largest; });
    if (!time) continue;
    const double most = std::abs(worst(values, [](double a, double b) { return std::abs(a) > std::abs(b); }));
    findings.push_back(
        fmt::format("{} above {:g} since time {:g} (worst {:.3g})", limit.column, limit.largest, *time, most));
  }
  const std::vector<double>& separation = history.column("separation");
  if (const auto time = first_time(history, separation, [](double value) { return value >= least_separation; })) {
    findings.push_back(fmt::format("separation below {:g} since time {:g} (worst {:.3g})", least_separation, *time,
                                   worst(separation, std::less<>())));
  }
  return findings;
}

}  // namespace

std::string verdict_of(const HistoryTable& history, std::optional<double> tolerance, const std::string& stop_reason) {
  const std::vector<std::string> findings = beyond_limits(history, tolerance);
  const std::string text = fmt::format("{}", fmt::join(findings, "; "));
  if (stop_reason.empty()) return text.empty() ? trustworthy : text;
  return text.empty() ? "stopped: " + stop_reason : fmt::format("stopped: {}; until then {}", stop_reason, text);
}

}  // namespace vehd
