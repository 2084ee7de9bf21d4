#include "bie/stepping/time/corrections.hpp"

#include <algorithm>
#include <cmath>

#include "bie/stepping/thresholds.hpp"

namespace vehd {

double Corrections::error_after(std::size_t j, double ratio) const {
  const std::size_t n = changes_.size();
  if (n == 0) return 0.0;
  if (j < n) return changes_[j];
  return changes_.back() * std::pow(ratio, static_cast<double>(j - n)) * (ratio < 0.5 ? ratio / (1.0 - ratio) : 1.0);
}

double Corrections::contraction() const { return std::max(measured_contraction(), thresholds::best_contraction); }

double Corrections::measured_contraction() const {
  const std::size_t n = changes_.size();
  if (n < 2 || changes_[n - 2] <= 0.0) return 1.0;
  return std::min(changes_[n - 1] / changes_[n - 2], 1.0);
}

}  // namespace vehd
