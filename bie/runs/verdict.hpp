#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bie/runs/history.hpp"
#include "bie/scene/scene.hpp"

namespace vehd {

/// The word for a run that reached its end and whose numbers nothing speaks against.
constexpr const char* trustworthy = "trustworthy";

/// A run in whose history the magnitude of a column exceeds this is not trustworthy.
struct TrustLimit {
  const char* column;
  double largest;
};

/// Properties of a scene that determine the limits of its verdict.
struct TrustDemands {
  std::optional<double> tolerance{};  ///< which the share left out by the degree must keep; none: fixed steps
  bool keeps_area = true;             ///< every membrane is inextensible
  bool porates = false;               ///< it conducts more where it is porated
};
/// The properties of a scene.
TrustDemands trust_demands(const Scene& scene);

/// All that are judged in this way.
std::vector<TrustLimit> trust_limits(const TrustDemands& demands);

/// Parts of the membrane that are nearer to each other, in grid spacings, are one to the grid.
constexpr double least_trusted_separation = 1.0;

/// Whether the numbers of a run can be relied on, judged from its whole history.
/// @param stop_reason  why the run ended before its time; empty if it did not
/// @return "trustworthy", or which number is not and since when; for a run that stopped early "stopped: " with the
///         reason, and behind it what is not to be trusted of the time until then
std::string verdict_of(const HistoryTable& history, const TrustDemands& demands, const std::string& stop_reason = {});

}  // namespace vehd
