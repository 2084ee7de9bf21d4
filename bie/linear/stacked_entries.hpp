#pragma once

#include <numeric>
#include <utility>
#include <vector>

#include "bie/support/types.hpp"

namespace vehd {

/// Stacks the unknowns of a solver in one vector: those coefficients of the fields of several bodies that can be
/// nonzero. A field has one or more columns: real and imaginary part of a complex scalar, or components of a vector.
class StackedEntries {
 public:
  /// Adds a field, [n_rows x n_columns].
  /// @param entries  positions in the column-major field of the entries that can be nonzero, ascending
  void add(Index n_rows, Index n_columns, std::vector<Index> entries) {
    const Index first = size_;
    size_ += std::ssize(entries);
    fields_.push_back({n_rows, n_columns, first, std::move(entries)});
  }
  /// Adds a field whose entries can all be nonzero.
  void add(Index n_rows, Index n_columns) {
    std::vector<Index> all(static_cast<std::size_t>(n_rows * n_columns));
    std::iota(all.begin(), all.end(), Index{0});
    add(n_rows, n_columns, std::move(all));
  }

  /// Number of entries of all fields.
  [[nodiscard]] Index size() const { return size_; }
  /// Position in the stacked vector of the first entry of a field.
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
  /// @tparam Field  Matrix, or Vector if all have one column
  template <typename Field>
  [[nodiscard]] std::vector<Field> fields(const Vector& stacked) const {
    std::vector<Field> result;
    for (const auto& [n_rows, n_columns, first, entries] : fields_) {
      result.emplace_back(Field::Zero(n_rows, n_columns)).reshaped()(entries) =
          stacked.segment(first, std::ssize(entries));
    }
    return result;
  }

  /// Vector that holds the number of each field at all entries of the field, [size()].
  /// @param numbers  [n_fields]
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
