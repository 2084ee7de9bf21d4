#include "bie/app/summary.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "bie/app/versions.hpp"

namespace vehd {
namespace {

/// A run that exceeds one of these is reported as not trustworthy.
struct TrustLimit {
  const char* column;
  double largest;
};
/// Parts of the membrane that are nearer to each other, in grid spacings, are one to the grid.
constexpr double least_separation = 1.0;
constexpr std::array limits = {TrustLimit{"area_drift", 1e-6}, TrustLimit{"volume_drift", 1e-6},
                               TrustLimit{"strain_max", 0.05}, TrustLimit{"spectrum_tail", 5e-3},
                               TrustLimit{"quadrature_error", 1e-3}};

double largest_magnitude(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double value : values) {
    if (std::isnan(value)) return value;
    largest = std::max(largest, std::abs(value));
  }
  return largest;
}

double last(const std::vector<double>& values) { return values.empty() ? 0.0 : values.back(); }

}  // namespace

std::string verdict_of(const HistoryTable& history, std::optional<double> tolerance) {
  std::string findings;
  std::vector<TrustLimit> all(limits.begin(), limits.end());
  // The highest degree that the scene allows was not enough.
  if (tolerance) all.push_back({"truncation", *tolerance});
  for (const TrustLimit& limit : all) {
    const std::vector<double>& values = history.column(limit.column);
    const auto first =
        std::find_if(values.begin(), values.end(), [&](double value) { return !(std::abs(value) <= limit.largest); });
    if (first == values.end()) continue;
    const double time = history.column("time")[static_cast<std::size_t>(first - values.begin())];
    findings += fmt::format("{}{} above {:g} since time {:g} (worst {:.3g})", findings.empty() ? "" : "; ",
                            limit.column, limit.largest, time, largest_magnitude(values));
  }
  const std::vector<double>& separation = history.column("separation");
  const auto near =
      std::find_if(separation.begin(), separation.end(), [](double value) { return !(value >= least_separation); });
  if (near != separation.end()) {
    const double time = history.column("time")[static_cast<std::size_t>(near - separation.begin())];
    findings += fmt::format("{}separation below {:g} since time {:g} (worst {:.3g})", findings.empty() ? "" : "; ",
                            least_separation, time, *std::min_element(separation.begin(), separation.end()));
  }
  return findings.empty() ? "trustworthy" : findings;
}

nlohmann::json summary_of(const HistoryTable& history, std::optional<double> tolerance, const RunTotals& totals,
                          bool completed, const std::string& reason) {
  const auto& rejected = history.column("rejected");
  const std::int64_t steps = history.n_steps();
  nlohmann::json json;
  json["completed"] = completed;
  json["verdict"] = verdict_of(history, tolerance);
  if (!reason.empty()) json["reason"] = reason;
  json["time"] = last(history.column("time"));
  json["steps"] = steps;
  json["rejected_steps"] = static_cast<std::int64_t>(std::accumulate(rejected.begin(), rejected.end(), 0.0));
  json["seconds"] = totals.seconds;
  json["seconds_per_step"] = steps == 0 ? 0.0 : totals.seconds / static_cast<double>(steps);
  json["seconds_of_parts"] = totals.seconds_of_parts;
  json["peak_memory_bytes"] = peak_memory_bytes();
  for (const TrustLimit& limit : limits) json[limit.column] = largest_magnitude(history.column(limit.column));
  json["order_max"] = largest_magnitude(history.column("order"));
  json["truncation"] = largest_magnitude(history.column("truncation"));
  const auto& separation = history.column("separation");
  // JSON has no infinity: absent where no part of the membrane faces another.
  if (const auto least = std::min_element(separation.begin(), separation.end());
      least != separation.end() && std::isfinite(*least)) {
    json["separation"] = *least;
  }
  json["bending_energy_scaled"] = last(history.column("bending_energy_scaled"));
  json["kernel_evaluations"] = totals.kernel_evaluations;
  json["version"] = program_version();
  return json;
}

std::int64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::int64_t{usage.ru_maxrss} * 1024;
}

}  // namespace vehd
