#include "bie/stepping/state/symmetry.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/state/composition.hpp"
#include "bie/stepping/state/exchange.hpp"
#include "bie/stepping/state/field_table.hpp"
#include "bie/stepping/state/invariance.hpp"

namespace vehd {

namespace {

/// Does the membrane equal its symmetric part?
bool has(const Symmetry& symmetry, const SurfaceFields& fields) {
  return are_same(symmetric_part(SymmetrySubspace(symmetry, order_of(fields.position.rows())), fields), fields);
}

bool has(const Symmetry& symmetry, const State& state) {
  return std::all_of(state.vesicles.begin(), state.vesicles.end(),
                     [&](const VesicleState& vesicle) { return has(symmetry, vesicle); });
}

int highest_degree(const State& state) {
  int highest = 0;
  for (const VesicleState& vesicle : state.vesicles) highest = std::max(highest, order_of(vesicle.position.rows()));
  return highest;
}

/// The largest number of equal turns about z, at least three, under which the scene is its own image; 1 if there is
/// none. Beyond 2p + 2 it would not save anything.
int find_fold(const Model& model, const State& state) {
  if (!is_invariant_under_rotations(model)) return 1;
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
  for_each_field(
      [&](const FieldRow& row, auto& field) {
        if (field.size() == 0) return;
        if constexpr (std::is_same_v<decltype(field), Matrix&>) {
          field = subspace.symmetric_vector(field);
        } else {
          field =
              row.kind == FieldKind::potential ? subspace.symmetric_potential(field) : subspace.symmetric_scalar(field);
        }
      },
      fields);
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
  for (int bits = 1; bits < 8; ++bits) {
    const Reflection g{bits & 1 ? -1 : 1, bits & 2 ? -1 : 1, bits & 4 ? -1 : 1};
    const int sign = potential_sign(model, g);
    const Symmetry single{false, {Reflection{}, g}, {1, sign}};
    if (sign == 0 || !has(single, state)) continue;
    result.reflections.push_back(g);
    result.potential_signs.push_back(sign);
  }
  Symmetry axis;
  axis.axisymmetric = true;
  const auto is_axisymmetric = [](const MadeEffect& effect) { return effect->is_axisymmetric(); };
  result.axisymmetric = std::ranges::all_of(effects_on_all(model), is_axisymmetric) && has(axis, state);
  if (!result.axisymmetric) result.fold = find_fold(model, state);
  result.exchange = find_exchange(model, state);
  return result;
}

namespace {

std::string name_of(const Reflection& g, const std::array<std::string, 3>& axes) {
  std::vector<std::string> reversed;
  for (int i = 0; i < 3; ++i) {
    if (g.sign(i) < 0) reversed.push_back(axes[static_cast<std::size_t>(i)]);
  }
  if (reversed.size() == 3) return "inversion";
  if (reversed.size() == 2) return "half turn about " + (g.x > 0 ? axes[0] : g.y > 0 ? axes[1] : axes[2]);
  return "mirror " + reversed[0];
}

/// "vesicles exchanged by mirror z", "vesicles exchanged by 3-fold turns about z".
std::string exchange_text(const Exchange& exchange, const std::array<std::string, 3>& axes) {
  if (exchange.fold() > 1) return fmt::format("vesicles exchanged by {}-fold turns about {}", exchange.fold(), axes[2]);
  std::vector<std::string> names;
  for (const Isometry& map : exchange.maps()) names.push_back(name_of(map.reflection, axes));
  return fmt::format("vesicles exchanged by {}", fmt::join(names, " and "));
}

}  // namespace

std::string symmetry_text(const Symmetry& symmetry, const std::array<std::string, 3>& axes) {
  std::vector<std::string> names;
  if (symmetry.axisymmetric) names.push_back("axisymmetric about " + axes[2]);
  if (symmetry.fold > 1) names.push_back(fmt::format("{}-fold about {}", symmetry.fold, axes[2]));
  for (const Reflection& g : symmetry.reflections) {
    const bool about_z = symmetry.axisymmetric && g.z > 0;
    const bool in_fold = symmetry.fold > 1 && g == Reflection{-1, -1, 1};
    if (g == Reflection{} || about_z || in_fold) continue;
    if (symmetry.axisymmetric && g != Reflection{1, 1, -1}) continue;
    names.push_back(name_of(g, axes));
  }
  if (symmetry.exchange.any()) names.push_back(exchange_text(symmetry.exchange, axes));
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace vehd
