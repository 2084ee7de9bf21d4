#include "bie/stepping/state/invariance.hpp"

#include <algorithm>

#include "bie/stepping/state/composition.hpp"
#include "bie/stepping/state/field_table.hpp"

namespace vehd {

namespace {

constexpr double kRounding = 1e-12;

template <typename Difference, typename Field>
bool is_small(const Eigen::MatrixBase<Difference>& difference, const Eigen::MatrixBase<Field>& field) {
  return difference.cwiseAbs().maxCoeff() <= kRounding * field.cwiseAbs().maxCoeff();
}

}  // namespace

int potential_sign(const Model& model, const Reflection& g) {
  const auto effects = explicit_effects(model);
  const auto is_invariant = [&](const auto& effect) { return effect->is_invariant_under(g); };
  if (!std::all_of(effects.begin(), effects.end(), is_invariant)) return 0;
  if (!model.electric) return 1;
  const Vector3& field = model.electric->field;
  const Vector3 image(g.x * field.x(), g.y * field.y(), g.z * field.z());
  if (is_small(image - field, field)) return 1;
  return is_small(image + field, field) ? -1 : 0;
}

bool is_invariant_under_rotations(const Model& model) {
  const auto effects = explicit_effects(model);
  return (!model.electric || model.electric->field.head<2>().isZero(0.0)) &&
         std::all_of(effects.begin(), effects.end(),
                     [](const auto& effect) { return effect->is_invariant_under_rotations(); });
}

bool are_same(const SurfaceFields& image, const SurfaceFields& fields) {
  bool result = true;
  const auto compare = [&](const FieldRow& row, const auto& a, const auto& b) {
    if (!result || row.role == FieldRole::guess || (a.size() == 0 && b.size() == 0)) return;
    result = a.rows() == b.rows();
    if (!result) return;
    // A place counts by the size of the shape, and what has no unit by 1.
    double size = row.dimension == "1" ? 1.0 : b.cwiseAbs().maxCoeff();
    if (row.kind == FieldKind::vector) size = b.bottomRows(b.rows() - 1).cwiseAbs().maxCoeff();
    result = (a - b).cwiseAbs().maxCoeff() <= kRounding * size;
  };
  for_each_field(compare, image, fields);
  return result;
}

}  // namespace vehd
