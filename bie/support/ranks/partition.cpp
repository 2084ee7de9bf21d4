#include "bie/support/ranks/partition.hpp"

#include <algorithm>
#include <numeric>

namespace vehd {

Partition::Partition(Ranks ranks, const std::vector<double>& costs, std::vector<std::size_t> originals)
    : ranks_(std::move(ranks)), originals_(std::move(originals)) {
  if (ranks_.is_alone()) return;
  std::vector<double> done = costs;
  for (std::size_t part = 0; part < done.size(); ++part) {
    if (is_image(part)) done[part] = 0.0;
  }
  const double all = std::accumulate(done.begin(), done.end(), 0.0);
  double before = 0.0;
  for (std::size_t part = 0; part < done.size(); ++part) {
    // The midpoint of its interval of costs decides.
    const int rank = static_cast<int>((before + 0.5 * done[part]) / all * ranks_.size());
    owners_.push_back(is_image(part) ? owners_[originals_[part]] : std::clamp(rank, 0, ranks_.size() - 1));
    before += done[part];
  }
}

std::vector<std::size_t> Partition::local_indices(std::size_t n) const {
  std::vector<std::size_t> local;
  for (std::size_t part = 0; part < n; ++part) {
    if (is_local(part)) local.push_back(part);
  }
  return local;
}

}  // namespace vehd
