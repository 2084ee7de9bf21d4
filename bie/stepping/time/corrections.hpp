#pragma once

#include <cstddef>
#include <vector>

namespace vehd {

/// Sizes δ_k of successive corrections of one quantity, and the error that they leave.
///
/// If corrections contract by ρ = δ_k/δ_{k−1}, those to come add up to δ_k ρ/(1−ρ), the sum of a geometric series: the
/// error after correction k. For ρ ≥ 1/2 they hardly converge and the sum is uncertain; the error is taken as δ_k, that
/// before correction k.
class Corrections {
 public:
  void add(double change) { changes_.push_back(change); }
  [[nodiscard]] std::size_t count() const { return changes_.size(); }

  /// Estimated error after correction j = 1, 2, …, made or yet to be made; 0 if there is none.
  [[nodiscard]] double error_after(std::size_t j) const { return error_after(j, contraction()); }
  /// The same if each correction to come contracts by this.
  [[nodiscard]] double error_after(std::size_t j, double ratio) const;

  /// δ_j of correction j = 1, 2, …, one that was made.
  [[nodiscard]] double change(std::size_t j) const { return changes_[j - 1]; }
  /// ρ of the last correction, 1 as long as it is not known; at least best_contraction.
  [[nodiscard]] double contraction() const;
  /// ρ as it was measured, 1 as long as it is not known.
  [[nodiscard]] double measured_contraction() const;
  /// Whether each correction is less than half of the one before.
  [[nodiscard]] bool converge() const { return contraction() < 0.5; }

 private:
  std::vector<double> changes_;
};

}  // namespace vehd
