#include "bie/stepping/state/symmetry.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "bie/physics/interaction.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/state/composition.hpp"
#include "bie/stepping/state/field_table.hpp"

namespace vehd {

bool is_invariant_under_rotations(const Model& model) {
  return std::ranges::all_of(effects_on_all(model),
                             [](const MadeEffect& effect) { return effect->is_invariant_under_rotations(); });
}

namespace {

constexpr double kRounding = 1e-12;

/// Sign of V_m under the reflection g, that of g E = ± E; 0 if the field, the flow or any other effect has another
/// image.
int potential_sign(const Model& model, const Reflection& g) {
  bool is_reversed = false;
  for (const MadeEffect& effect : effects_on_all(model)) {
    const int sign = effect->potential_sign(g);
    if (sign == 0) return 0;
    is_reversed = is_reversed || sign < 0;
  }
  return is_reversed ? -1 : 1;
}

/// Are position, shape, strain, V_m and material of both membranes the same? Lengths are compared with the size of the
/// second one.
bool are_same(const SurfaceFields& image, const SurfaceFields& fields) {
  bool result = true;
  const auto compare = [&](const FieldRow& row, const auto& a, const auto& b) {
    if (!result || row.role == FieldRole::guess || (a.size() == 0 && b.size() == 0)) return;
    result = a.rows() == b.rows();
    if (!result) return;
    // Positions are compared with the size of the shape, dimensionless fields with 1.
    double size = row.dimension == "1" ? 1.0 : b.cwiseAbs().maxCoeff();
    if (row.kind == FieldKind::vector) size = b.bottomRows(b.rows() - 1).cwiseAbs().maxCoeff();
    result = (a - b).cwiseAbs().maxCoeff() <= kRounding * size;
  };
  for_each_field(compare, image, fields);
  return result;
}

bool are_alike(const VesicleModel& a, const VesicleModel& b) {
  return a.viscosity_ratio == b.viscosity_ratio && a.inextensible == b.inextensible && a.bending == b.bending &&
         a.undulations == b.undulations && a.inside == b.inside && a.charging == b.charging &&
         a.criterion == b.criterion && a.reaction == b.reaction &&
         a.has_varying_properties == b.has_varying_properties && a.pump == b.pump &&
         std::ranges::equal(a.effects, b.effects,
                            [](const auto& one, const auto& other) { return one->is_same_as(*other); });
}

/// Where a map takes each vesicle; nothing if the image of any is not a vesicle of the scene.
std::optional<Exchange::Map> exchange_under(const ImageOfFields& of_fields, const Model& model, const State& state) {
  Exchange::Map map{of_fields, {}};
  const std::size_t n = state.vesicles.size();
  for (std::size_t a = 0; a < n; ++a) {
    const SurfaceFields image = image_of<SurfaceFields>(of_fields, state.vesicles[a]);
    std::size_t b = 0;
    while (b < n && !(are_alike(model.vesicles[a], model.vesicles[b]) && are_same(image, state.vesicles[b]))) ++b;
    if (b == n) return std::nullopt;
    map.places.push_back(b);
  }
  return map;
}

/// Do all maps except the identity move the same vesicles, at least one?
bool is_free(const std::vector<Exchange::Map>& maps) {
  const auto moved_by = [](const Exchange::Map& map) {
    std::vector<bool> moved;
    for (std::size_t a = 0; a < map.places.size(); ++a) moved.push_back(map.places[a] != a);
    return moved;
  };
  if (maps.size() < 2) return false;
  const std::vector<bool> moved = moved_by(maps[1]);
  return std::ranges::count(moved, true) > 0 &&
         std::all_of(maps.begin() + 1, maps.end(), [&](const Exchange::Map& map) { return moved_by(map) == moved; });
}

Reflection product(const Reflection& a, const Reflection& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

/// Adds one reflection after the other to the group as long as it stays free.
std::vector<Exchange::Map> group_of_reflections(const Model& model, const State& state) {
  std::vector<Exchange::Map> group{*exchange_under({}, model, state)};
  for (int bits = 1; bits < 8; ++bits) {
    const Reflection g{bits & 1 ? -1 : 1, bits & 2 ? -1 : 1, bits & 4 ? -1 : 1};
    std::vector<Exchange::Map> larger = group;
    for (const Exchange::Map& known : group) {
      const Reflection both = product(g, known.of_fields.map.reflection);
      const int sign = potential_sign(model, both);
      const auto map = sign == 0 ? std::nullopt : exchange_under({{both}, sign}, model, state);
      if (map) larger.push_back(*map);
    }
    if (larger.size() == 2 * group.size() && is_free(larger)) group = std::move(larger);
  }
  return group;
}

/// The largest group of equal turns about z, of at least three; else empty.
std::vector<Exchange::Map> group_of_turns(const Model& model, const State& state) {
  if (!is_invariant_under_rotations(model)) return {};
  for (int fold = static_cast<int>(state.vesicles.size()); fold > 2; --fold) {
    std::vector<Exchange::Map> group;
    for (int turn = 0; turn < fold; ++turn) {
      const auto map = exchange_under({{{}, turn, fold}, 1}, model, state);
      if (!map) break;
      group.push_back(*map);
    }
    if (std::ssize(group) == fold && is_free(group)) return group;
  }
  return {};
}

/// Finds which vesicles of a scene are images of others, for up to most_summed_membranes vesicles: the group of
/// reflections and half turns, or of turns about z, that exchanges equal vesicles and leaves the fewest to compute. See
/// Exchange for the groups that are allowed.
Exchange find_exchange(const Model& model, const State& state) {
  const std::size_t n = state.vesicles.size();
  if (n < 2 || n > most_summed_membranes) return {};
  Exchange best;
  for (const auto group_of : {group_of_reflections, group_of_turns}) {
    std::vector<Exchange::Map> group = group_of(model, state);
    if (!is_free(group)) continue;
    Exchange found(std::move(group));
    if (found.n_originals(n) < best.n_originals(n)) best = std::move(found);
  }
  return best;
}

}  // namespace

State with_images(const Exchange& exchange, State state) {
  for (std::size_t a = 0; a < state.vesicles.size(); ++a) {
    if (!exchange.is_image(a)) continue;
    const VesicleState& original = state.vesicles[exchange.original(a)];
    VesicleState& vesicle = state.vesicles[a];
    static_cast<SurfaceFields&>(vesicle) = image_of<SurfaceFields>(exchange.image(a), original);
    vesicle.reference_area = original.reference_area;
    vesicle.reference_volume = original.reference_volume;
    vesicle.quadrature_level = original.quadrature_level;
  }
  return state;
}

std::vector<int> with_images(const Exchange& exchange, std::vector<int> orders) {
  for (std::size_t a = 0; a < orders.size(); ++a) orders[a] = orders[exchange.original(a)];
  return orders;
}

namespace {

/// Does the membrane equal its symmetric part?
bool has(const Symmetry& symmetry, const SurfaceFields& fields) {
  return are_same(symmetric_part(SymmetrySubspace(symmetry, order_of(fields.position.rows())), fields), fields);
}

bool has(const Symmetry& symmetry, const State& state) {
  return std::all_of(state.vesicles.begin(), state.vesicles.end(),
                     [&](const VesicleState& vesicle) { return has(symmetry, vesicle); });
}

/// The largest number of equal turns about z, at least three, under which the scene is invariant; 1 if there is none.
/// More than 2p + 2 would save nothing.
int find_fold(const Model& model, const State& state) {
  if (!is_invariant_under_rotations(model)) return 1;
  for (int fold = 2 * highest_order_of(state) + 2; fold > 2; --fold) {
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
