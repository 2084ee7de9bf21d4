#include "bie/stepping/state/exchange.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "bie/physics/interaction.hpp"
#include "bie/stepping/state/invariance.hpp"

namespace vehd {

namespace {

bool are_alike(const VesicleModel& a, const VesicleModel& b) {
  return a.viscosity_ratio == b.viscosity_ratio && a.inextensible == b.inextensible && a.bending == b.bending &&
         a.undulations == b.undulations && a.inside == b.inside && a.charging == b.charging &&
         a.criterion == b.criterion && a.reaction == b.reaction && a.by_place == b.by_place && a.pump == b.pump &&
         std::ranges::equal(a.effects, b.effects,
                            [](const auto& one, const auto& other) { return one->is_same_as(*other); });
}

/// Where a map takes each vesicle; nothing if any is taken to where none is like it.
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

/// Is there a vesicle that all maps but the identity move, and none that only some do?
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

/// The most equal turns about z, at least three.
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

}  // namespace

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

}  // namespace vehd
