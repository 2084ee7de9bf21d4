#include "bie/stepping/state/symmetry.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/state/composition.hpp"

namespace vehd {

namespace {

constexpr double kRounding = 1e-12;

template <typename Difference, typename Field>
bool is_small(const Eigen::MatrixBase<Difference>& difference, const Eigen::MatrixBase<Field>& field) {
  return difference.cwiseAbs().maxCoeff() <= kRounding * field.cwiseAbs().maxCoeff();
}

bool is_same(const MembraneMaterial& part, const MembraneMaterial& whole) {
  std::vector<const Vector*> parts;
  for_each_property(part, [&](const Vector& property) { parts.push_back(&property); });
  bool same = true;
  std::size_t i = 0;
  for_each_property(whole, [&](const Vector& property) {
    same = same && is_small(*parts[i] - property, property);
    ++i;
  });
  return same;
}

/// Does the membrane equal its symmetric part?
bool has(const Symmetry& symmetry, const SurfaceFields& fields) {
  const SurfaceFields part = symmetric_part(SymmetrySubspace(symmetry, order_of(fields.position.rows())), fields);
  const Matrix shape = fields.position.bottomRows(fields.position.rows() - 1);
  if (!is_small(part.position - fields.position, shape)) return false;
  if ((part.area_strain - fields.area_strain).cwiseAbs().maxCoeff() > kRounding) return false;
  const Vector& potential = fields.transmembrane_potential;
  if (potential.size() > 0 && !is_small(part.transmembrane_potential - potential, potential)) return false;
  return is_same(part.material, fields.material);
}

bool has(const Symmetry& symmetry, const State& state) {
  return std::all_of(state.vesicles.begin(), state.vesicles.end(),
                     [&](const VesicleState& vesicle) { return has(symmetry, vesicle); });
}

/// Sign of g E = ± E, or 0 where neither holds.
int field_sign(const Model& model, const Reflection& g) {
  if (!model.electric) return 1;
  const Vector3& field = model.electric->field;
  const Vector3 image(g.x * field.x(), g.y * field.y(), g.z * field.z());
  if (is_small(image - field, field)) return 1;
  return is_small(image + field, field) ? -1 : 0;
}

int highest_degree(const State& state) {
  int highest = 0;
  for (const VesicleState& vesicle : state.vesicles) highest = std::max(highest, order_of(vesicle.position.rows()));
  return highest;
}

/// The largest number of equal turns about z, at least three, under which the scene is its own image; 1 if there is
/// none. Beyond 2p + 2 it would not save anything.
int find_fold(const Model& model, const State& state) {
  const auto effects = explicit_effects(model);
  const auto is_invariant_under_rotations = [](const auto& effect) { return effect->is_invariant_under_rotations(); };
  if (model.electric && !model.electric->field.head<2>().isZero(0.0)) return 1;
  if (!std::all_of(effects.begin(), effects.end(), is_invariant_under_rotations)) return 1;
  for (int fold = 2 * highest_degree(state) + 2; fold > 2; --fold) {
    Symmetry turns;
    turns.fold = fold;
    if (has(turns, state)) return fold;
  }
  return 1;
}

}  // namespace

SurfaceFields symmetric_part(const SymmetrySubspace& subspace, SurfaceFields fields) {
  if (!subspace.symmetry().any()) return fields;
  fields.position = subspace.symmetric_vector(fields.position);
  fields.area_strain = subspace.symmetric_scalar(fields.area_strain);
  if (fields.tension.size() > 0) fields.tension = subspace.symmetric_scalar(fields.tension);
  if (fields.transmembrane_potential.size() > 0) {
    fields.transmembrane_potential = subspace.symmetric_potential(fields.transmembrane_potential);
  }
  if (fields.free_charge.size() > 0) {
    fields.free_charge = subspace.symmetric_potential(fields.free_charge);
  }
  // V_m counts by its size alone.
  if (fields.poration.size() > 0) fields.poration = subspace.symmetric_scalar(fields.poration);
  // The pump drives V_m, and changes its sign with it.
  Vector pump = std::move(fields.material.pump_current);
  fields.material.pump_current = Vector();
  for_each_property(fields.material, [&](Vector& property) { property = subspace.symmetric_scalar(property); });
  if (pump.size() > 0) pump = subspace.symmetric_potential(pump);
  fields.material.pump_current = std::move(pump);
  return fields;
}

State symmetric_part(const Symmetry& symmetry, State state) {
  for (VesicleState& vesicle : state.vesicles) {
    static_cast<SurfaceFields&>(vesicle) =
        symmetric_part(SymmetrySubspace(symmetry, order_of(vesicle.position.rows())), vesicle);
  }
  return state;
}

Symmetry find_symmetry(const Model& model, const State& state) {
  Symmetry result;
  const auto effects = explicit_effects(model);
  for (int bits = 1; bits < 8; ++bits) {
    const Reflection g{bits & 1 ? -1 : 1, bits & 2 ? -1 : 1, bits & 4 ? -1 : 1};
    const int sign = field_sign(model, g);
    const Symmetry single{false, {Reflection{}, g}, {1, sign}};
    const auto is_invariant = [&](const auto& effect) { return effect->is_invariant_under(g); };
    if (sign == 0 || !std::all_of(effects.begin(), effects.end(), is_invariant) || !has(single, state)) continue;
    result.reflections.push_back(g);
    result.potential_signs.push_back(sign);
  }
  Symmetry axis;
  axis.axisymmetric = true;
  const bool field_is_axial = !model.electric || (model.electric->field.x() == 0.0 && model.electric->field.y() == 0.0);
  const auto is_axisymmetric = [](const auto& effect) { return effect->is_axisymmetric(); };
  result.axisymmetric =
      field_is_axial && std::all_of(effects.begin(), effects.end(), is_axisymmetric) && has(axis, state);
  if (!result.axisymmetric) result.fold = find_fold(model, state);
  return result;
}

std::string symmetry_text(const Symmetry& symmetry, const std::array<std::string, 3>& axes) {
  std::vector<std::string> names;
  if (symmetry.axisymmetric) names.push_back("axisymmetric about " + axes[2]);
  if (symmetry.fold > 1) names.push_back(fmt::format("{}-fold about {}", symmetry.fold, axes[2]));
  for (const Reflection& g : symmetry.reflections) {
    const bool about_z = symmetry.axisymmetric && g.z > 0;
    const bool in_fold = symmetry.fold > 1 && g == Reflection{-1, -1, 1};
    if (g == Reflection{} || about_z || in_fold) continue;
    std::vector<std::string> reversed;
    for (int i = 0; i < 3; ++i) {
      if (g.sign(i) < 0) reversed.push_back(axes[static_cast<std::size_t>(i)]);
    }
    if (symmetry.axisymmetric && reversed.size() > 1) continue;
    if (reversed.size() == 3) {
      names.emplace_back("inversion");
    } else if (reversed.size() == 2) {
      names.push_back("half turn about " + (g.x > 0 ? axes[0] : g.y > 0 ? axes[1] : axes[2]));
    } else {
      names.push_back("mirror " + reversed[0]);
    }
  }
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace vehd
