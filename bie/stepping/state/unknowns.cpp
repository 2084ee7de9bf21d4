#include "bie/stepping/state/unknowns.hpp"

#include "bie/stepping/state/field_table.hpp"

namespace vehd {

Matrix unknowns(const SurfaceFields& fields) {
  return columns_of(fields, [](const FieldRow& row) { return row.role == FieldRole::unknown; });
}

void add_unknowns(const Eigen::Ref<const Matrix>& columns, double weight, SurfaceFields& fields) {
  Index column = 0;
  for_each_field(
      [&](const FieldRow& row, auto& field) {
        if (field.size() == 0 || row.role != FieldRole::unknown) return;
        field += weight * columns.middleCols(column, field.cols());
        column += field.cols();
      },
      fields);
}

}  // namespace vehd
