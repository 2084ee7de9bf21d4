#pragma once

#include <cstddef>
#include <vector>

#include "bie/support/parallel.hpp"
#include "bie/support/ranks/parcel.hpp"
#include "bie/support/ranks/ranks.hpp"

namespace vehd {

/// Which of several parts of a work, such as vesicles, each rank does. A rank owns neighbours in their order, so that
/// what ranks send one after the other is in the order of the parts: sums in that order have the same bits for any
/// number of ranks.
class Shares {
 public:
  /// One rank does all, however many there are.
  Shares() = default;
  /// @param costs  of each part; every rank gets about the same
  Shares(Ranks ranks, const std::vector<double>& costs);

  [[nodiscard]] const Ranks& ranks() const { return ranks_; }
  [[nodiscard]] int owner(std::size_t part) const { return owners_.empty() ? 0 : owners_[part]; }
  [[nodiscard]] bool owns(std::size_t part) const { return ranks_.is_alone() || owners_[part] == ranks_.rank(); }
  /// Those of n parts that this rank owns.
  [[nodiscard]] std::vector<std::size_t> own(std::size_t n) const;

  /// The values of all parts from their owners; those of others count for nothing before. Collective.
  template <typename T>
  void gather(std::vector<T>& values) const {
    if (ranks_.is_alone()) return;
    Packing packing;
    for (const std::size_t a : own(values.size())) packing(values[a]);
    const std::vector<std::string> all = ranks_.gather(packing.take());
    std::size_t a = 0;
    for (int rank = 0; rank < ranks_.size(); ++rank) {
      Unpacking sent(all[static_cast<std::size_t>(rank)]);
      for (; a < values.size() && owner(a) == rank; ++a) {
        if (rank != ranks_.rank()) sent(values[a]);
      }
    }
  }

  /// What `part(a)` gives for each of n parts, on all ranks, which call it for their own, on threads as for_each_member
  /// does. What it throws all throw.
  template <typename Part>
  auto of_all(std::size_t n, const Part& part) const {
    std::vector<std::invoke_result_t<const Part&, std::size_t>> values(n);
    ranks_.together([&] {
      for_each_member(own(n), [&](std::size_t a) { values[a] = part(a); });
      gather(values);
    });
    return values;
  }

 private:
  Ranks ranks_;
  std::vector<int> owners_;
};

}  // namespace vehd
