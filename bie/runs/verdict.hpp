#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bie/runs/history.hpp"
#include "bie/scene/scene.hpp"

namespace vehd {

/// Verdict of a run that reached its end and passed every check.
constexpr const char* trustworthy = "trustworthy";

/// A run is not trustworthy if the magnitude of a column of its history exceeds this.
struct TrustLimit {
  const char* column;
  double largest;
};

/// Properties of a scene that determine the limits of its verdict.
struct TrustDemands {
  std::optional<double> tolerance{};  ///< limit of the truncation; absent: fixed steps
  bool keeps_area = true;             ///< every membrane is inextensible
  bool porates = false;               ///< the conductance increases where a membrane is porated
};
/// The properties of a scene.
TrustDemands trust_demands(const Scene& scene);

/// All limits of columns under these demands.
std::vector<TrustLimit> trust_limits(const TrustDemands& demands);

/// Facing parts of the membrane that are nearer than this, in grid spacings, are not resolved by the grid.
constexpr double least_trusted_separation = 1.0;

/// Whether the numbers of a run can be relied on, judged from its whole history.
/// @param stop_reason  why the run ended early; empty if it did not
/// @return "trustworthy", or which number is not and since when; for a run that stopped early "stopped: " with the
/// reason, followed by the numbers that are not trustworthy until then
std::string verdict_of(const HistoryTable& history, const TrustDemands& demands, const std::string& stop_reason = {});

}  // namespace vehd
