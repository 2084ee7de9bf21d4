#include "bie/stepping/state/unknowns.hpp"

namespace vehd {

namespace {

/// The scalars among them that are there, one after the other.
template <typename Fields, typename Visit>
void for_each_unknown_scalar(Fields& fields, const Visit& visit) {
  for (auto* scalar : {&fields.transmembrane_potential, &fields.free_charge, &fields.poration}) {
    if (scalar->size() > 0) visit(*scalar);
  }
}

}  // namespace

Matrix unknowns(const SurfaceFields& fields) {
  return columns_of(fields, [](const auto& of, const auto& visit) { for_each_unknown_scalar(of, visit); });
}

void add_unknowns(const Eigen::Ref<const Matrix>& columns, double weight, SurfaceFields& fields) {
  fields.position += weight * columns.leftCols(3);
  Index column = 3;
  for_each_unknown_scalar(fields, [&](Vector& scalar) { scalar += weight * columns.col(column++); });
}

}  // namespace vehd
