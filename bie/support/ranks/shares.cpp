#include "bie/support/ranks/shares.hpp"

#include <algorithm>
#include <numeric>

namespace vehd {

Shares::Shares(Ranks ranks, const std::vector<double>& costs) : ranks_(std::move(ranks)) {
  if (ranks_.is_alone()) return;
  const double all = std::accumulate(costs.begin(), costs.end(), 0.0);
  double before = 0.0;
  for (const double cost : costs) {
    // By the middle of the part.
    const int rank = static_cast<int>((before + 0.5 * cost) / all * ranks_.size());
    owners_.push_back(std::clamp(rank, 0, ranks_.size() - 1));
    before += cost;
  }
}

std::vector<std::size_t> Shares::own(std::size_t n) const {
  std::vector<std::size_t> own;
  for (std::size_t part = 0; part < n; ++part) {
    if (owns(part)) own.push_back(part);
  }
  return own;
}

}  // namespace vehd
