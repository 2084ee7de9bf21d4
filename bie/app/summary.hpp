#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "bie/app/checkpoint.hpp"
#include "bie/app/history.hpp"

namespace vehd {

/// Whether the numbers of a run can be relied on, judged from its whole history.
/// @param tolerance  of the scene, which the share left out by the degree must keep
/// @return "trustworthy", or which number is not and since when
std::string verdict_of(const HistoryTable& history, std::optional<double> tolerance);

/// Content of summary.json.
/// @param reason  why the run stopped before its end; empty if it did not
nlohmann::json summary_of(const HistoryTable& history, std::optional<double> tolerance, const RunTotals& totals,
                          bool completed, const std::string& reason);

/// Most memory that this process has held.
std::int64_t peak_memory_bytes();

}  // namespace vehd
