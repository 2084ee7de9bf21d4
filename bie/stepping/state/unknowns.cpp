#include "bie/stepping/state/unknowns.hpp"

#include "bie/stepping/state/field_table.hpp"

namespace vehd {

namespace {

bool is_unknown(const FieldRow& row) { return row.role == FieldRole::unknown; }

}  // namespace

Matrix unknowns(const SurfaceFields& fields) { return columns_of(fields, is_unknown); }

void add_unknowns(const Eigen::Ref<const Matrix>& columns, double weight, SurfaceFields& fields) {
  for_each_block(fields, is_unknown,
                 [&](auto& field, Index first) { field += weight * columns.middleCols(first, field.cols()); });
}

}  // namespace vehd
