#pragma once

#include <cstddef>
#include <stdexcept>
#include <vector>

#include "bie/support/parallel.hpp"
#include "bie/support/ranks/parcel.hpp"
#include "bie/support/ranks/ranks.hpp"

namespace vehd {

/// Distribution of the parts of some work, such as vesicles, over ranks. A rank owns consecutive parts, so that
/// messages in the order of ranks are in the order of parts: sums in that order have the same bits for any number of
/// ranks. Parts that are images of others are not computed but mapped from the results of their originals.
class Partition {
 public:
  /// One rank owns all parts, whatever their number.
  Partition() = default;
  /// @param costs      of each part; every rank gets about the same total
  /// @param originals  for each part the one that it is an image of, or itself; empty if there are no images
  Partition(Ranks ranks, const std::vector<double>& costs, std::vector<std::size_t> originals = {});

  [[nodiscard]] const Ranks& ranks() const { return ranks_; }
  /// Rank that owns a part; an image belongs to the rank of its original.
  [[nodiscard]] int owner(std::size_t part) const { return owners_.empty() ? 0 : owners_[part]; }
  /// Does this rank compute the part? No rank computes an image.
  [[nodiscard]] bool is_local(std::size_t part) const { return !is_image(part) && has(part); }
  [[nodiscard]] bool is_image(std::size_t part) const { return !originals_.empty() && originals_[part] != part; }
  /// Indices of those of n parts that this rank computes.
  [[nodiscard]] std::vector<std::size_t> local_indices(std::size_t n) const;

  /// Gathers the values of all parts from their owners; other values are ignored on input. Collective.
  /// @param image  (value of the original, part) ↦ value of the image
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
  /// Gathers values of parts without images.
  /// @throws std::logic_error if there are images
  template <typename T>
  void gather(std::vector<T>& values) const {
    gather(values, [](const T&, std::size_t) -> T { throw std::logic_error("nothing makes images of these values"); });
  }

  /// Values of n parts on all ranks: `part(a)`, or `image(value of the original, a)` of an image. Each rank calls them
  /// for its own parts, `part` on threads as in for_each_member. If one rank throws, all ranks throw.
  template <typename Part, typename Image>
  auto of_all(std::size_t n, const Part& part, const Image& image) const {
    std::vector<std::invoke_result_t<const Part&, std::size_t>> values(n);
    ranks_.collective([&] {
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
