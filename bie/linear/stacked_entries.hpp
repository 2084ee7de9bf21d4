#pragma once

#include <numeric>
#include <utility>
#include <vector>

#include "bie/support/types.hpp"

namespace vehd {

/// The unknowns of a solver, stacked in one vector: the coefficients of the fields of several bodies that can differ
/// from zero. A field has one or more columns: the parts of a complex scalar, the components of a vector.
class StackedEntries {
 public:
  /// One more field, [n_rows x n_columns].
  /// @param entries  positions of those in the column-major field, ascending
  void add(Index n_rows, Index n_columns, std::vector<Index> entries) {
    const Index first = size_;
    size_ += std::ssize(entries);
    fields_.push_back({n_rows, n_columns, first, std::move(entries)});
  }
  /// Adds a field whose entries can all differ from zero.
  void add(Index n_rows, Index n_columns) {
    std::vector<Index> all(static_cast<std::size_t>(n_rows * n_columns));
    std::iota(all.begin(), all.end(), Index{0});
    add(n_rows, n_columns, std::move(all));
  }

  /// Number of entries of all fields.
  [[nodiscard]] Index size() const { return size_; }
  /// Row of the first entry of a field.
  [[nodiscard]] Index first(std::size_t field) const { return fields_[field].first; }

  /// The entries of all fields, [size()].
  /// @param fields  [n_rows x n_columns] each, in the order in which they were added
  template <typename Field>
  [[nodiscard]] Vector stack(const std::vector<Field>& fields) const {
    Vector result(size_);
    for (std::size_t a = 0; a < fields_.size(); ++a) {
      const std::vector<Index>& entries = fields_[a].entries;
      result.segment(first(a), std::ssize(entries)) = fields[a].reshaped()(entries);
    }
    return result;
  }

  /// The fields, [n_rows x n_columns] each, from their entries, [size()]; zero elsewhere.
  /// @tparam Field  Matrix, or Vector where all have one column
  template <typename Field>
  [[nodiscard]] std::vector<Field> fields(const Vector& stacked) const {
    std::vector<Field> result;
    for (const auto& [n_rows, n_columns, first, entries] : fields_) {
      result.emplace_back(Field::Zero(n_rows, n_columns)).reshaped()(entries) =
          stacked.segment(first, std::ssize(entries));
    }
    return result;
  }

  /// [size()], one number a field, repeated at all of its entries.
  [[nodiscard]] Vector spread(const std::vector<double>& numbers) const {
    Vector result(size_);
    for (std::size_t a = 0; a < fields_.size(); ++a) {
      result.segment(first(a), std::ssize(fields_[a].entries)).setConstant(numbers[a]);
    }
    return result;
  }

 private:
  struct Field {
    Index n_rows, n_columns, first;
    std::vector<Index> entries;
  };
  std::vector<Field> fields_;
  Index size_ = 0;
};

}  // namespace vehd
