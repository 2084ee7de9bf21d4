#pragma once

#include <optional>
#include <string>

#include "bie/runs/history.hpp"

namespace vehd {

/// The word for a run that reached its end and whose numbers nothing speaks against.
constexpr const char* trustworthy = "trustworthy";

/// Whether the numbers of a run can be relied on, judged from its whole history.
/// @param tolerance    of the scene, which the share left out by the degree must keep; none: fixed steps
/// @param stop_reason  why the run ended before its time; empty if it did not
/// @return "trustworthy", or which number is not and since when; for a run that stopped early "stopped: " with the
///         reason, and behind it what is not to be trusted of the time until then
std::string verdict_of(const HistoryTable& history, std::optional<double> tolerance,
                       const std::string& stop_reason = {});

}  // namespace vehd
