#pragma once

#include <cstddef>
#include <stdexcept>
#include <vector>

#include "bie/support/parallel.hpp"
#include "bie/support/ranks/parcel.hpp"
#include "bie/support/ranks/ranks.hpp"

namespace vehd {

/// Which of several parts of a work, such as vesicles, each rank does. A rank owns neighbours in their order, so that
/// what ranks send one after the other is in the order of the parts: sums in that order have the same bits for any
/// number of ranks. Parts that are images of others are not computed but mapped from the results of their originals.
class Partition {
 public:
  /// One rank does all, however many there are.
  Partition() = default;
  /// @param costs      of each part; every rank gets about the same
  /// @param originals  of each part the one that it is an image of, or itself; empty where there are no images
  Partition(Ranks ranks, const std::vector<double>& costs, std::vector<std::size_t> originals = {});

  [[nodiscard]] const Ranks& ranks() const { return ranks_; }
  /// Rank of a part; an image has that of its original.
  [[nodiscard]] int owner(std::size_t part) const { return owners_.empty() ? 0 : owners_[part]; }
  /// Does this rank do the part? None does an image.
  [[nodiscard]] bool is_local(std::size_t part) const { return !is_image(part) && has(part); }
  [[nodiscard]] bool is_image(std::size_t part) const { return !originals_.empty() && originals_[part] != part; }
  /// The indices of those of n parts that this rank owns.
  [[nodiscard]] std::vector<std::size_t> local_indices(std::size_t n) const;

  /// The values of all parts from their owners; those of others count for nothing before. Collective.
  /// @param image  (value of the original, part) ↦ value of an image
  template <typename T, typename Image>
  void gather(std::vector<T>& values, const Image& image) const {
    for (std::size_t a = 0; a < originals_.size(); ++a) {
      if (is_image(a) && has(a)) values[a] = image(values[originals_[a]], a);
    }
    if (ranks_.is_alone()) return;
    Packing packing;
    for (std::size_t a = 0; a < values.size(); ++a) {
      if (has(a)) packing(values[a]);
    }
    const std::vector<std::string> all = ranks_.gather(packing.take());
    for (int rank = 0; rank < ranks_.size(); ++rank) {
      Unpacking sent(all[static_cast<std::size_t>(rank)]);
      for (std::size_t a = 0; a < values.size() && rank != ranks_.rank(); ++a) {
        if (owner(a) == rank) sent(values[a]);
      }
    }
  }
  /// Gathers values where there are no images.
  /// @throws std::logic_error where there are
  template <typename T>
  void gather(std::vector<T>& values) const {
    gather(values, [](const T&, std::size_t) -> T { throw std::logic_error("nothing makes images of these values"); });
  }

  /// The value of `part(a)` for each of n parts, and `image(value of the original, a)` for images, on all ranks, which
  /// call them for their own, `part` on threads as for_each_member does. If they throw, all ranks throw.
  template <typename Part, typename Image>
  auto of_all(std::size_t n, const Part& part, const Image& image) const {
    std::vector<std::invoke_result_t<const Part&, std::size_t>> values(n);
    ranks_.together([&] {
      for_each_member(local_indices(n), [&](std::size_t a) { values[a] = part(a); });
      gather(values, image);
    });
    return values;
  }

 private:
  /// Does the part or its original belong to this rank?
  [[nodiscard]] bool has(std::size_t part) const { return ranks_.is_alone() || owners_[part] == ranks_.rank(); }

  Ranks ranks_;
  std::vector<int> owners_;
  std::vector<std::size_t> originals_;
};

}  // namespace vehd
