#pragma once

#include <vector>

#include "bie/support/types.hpp"

namespace vehd {

/// Several vectors of which only some entries can differ from zero, one behind the other as a solver sees them.
class StackedEntries {
 public:
  /// @param sizes    of each vector
  /// @param entries  of each vector, ascending
  StackedEntries(std::vector<Index> sizes, std::vector<std::vector<Index>> entries)
      : sizes_(std::move(sizes)), entries_(std::move(entries)) {
    for (const std::vector<Index>& of_one : entries_) size_ += static_cast<Index>(of_one.size());
  }

  [[nodiscard]] Index size() const { return size_; }

  [[nodiscard]] std::size_t n_parts() const { return entries_.size(); }
  /// Where the entries of a vector begin, and how many it has.
  [[nodiscard]] Index first_of(std::size_t part) const {
    Index first = 0;
    for (std::size_t a = 0; a < part; ++a) first += count_of(a);
    return first;
  }
  [[nodiscard]] Index count_of(std::size_t part) const { return static_cast<Index>(entries_[part].size()); }

  [[nodiscard]] Vector stack(const std::vector<Vector>& parts) const {
    Vector result(size_);
    Index first = 0;
    for (std::size_t a = 0; a < entries_.size(); ++a) {
      const auto n = static_cast<Index>(entries_[a].size());
      result.segment(first, n) = parts[a](entries_[a]);
      first += n;
    }
    return result;
  }

  /// The other way, zero elsewhere.
  [[nodiscard]] std::vector<Vector> parts(const Vector& stacked) const {
    std::vector<Vector> result;
    Index first = 0;
    for (std::size_t a = 0; a < entries_.size(); ++a) {
      const auto n = static_cast<Index>(entries_[a].size());
      result.emplace_back(Vector::Zero(sizes_[a]))(entries_[a]) = stacked.segment(first, n);
      first += n;
    }
    return result;
  }

  /// A number of each vector, at all of its entries.
  [[nodiscard]] Vector spread(const std::vector<double>& numbers) const {
    std::vector<Vector> all;
    for (std::size_t a = 0; a < sizes_.size(); ++a) all.emplace_back(Vector::Constant(sizes_[a], numbers[a]));
    return stack(all);
  }

 private:
  std::vector<Index> sizes_;
  std::vector<std::vector<Index>> entries_;
  Index size_ = 0;
};

}  // namespace vehd
