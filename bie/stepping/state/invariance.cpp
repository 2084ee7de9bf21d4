#include "bie/stepping/state/invariance.hpp"

#include <algorithm>

#include "bie/stepping/state/composition.hpp"
#include "bie/stepping/state/field_table.hpp"

namespace vehd {

namespace {

constexpr double kRounding = 1e-12;

}  // namespace

int potential_sign(const Model& model, const Reflection& g) {
  bool is_reversed = false;
  for (const MadeEffect& effect : effects_on_all(model)) {
    const int sign = effect->potential_sign(g);
    if (sign == 0) return 0;
    is_reversed = is_reversed || sign < 0;
  }
  return is_reversed ? -1 : 1;
}

bool is_invariant_under_rotations(const Model& model) {
  return std::ranges::all_of(effects_on_all(model),
                             [](const MadeEffect& effect) { return effect->is_invariant_under_rotations(); });
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
