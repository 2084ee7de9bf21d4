#include <limits>

#include "bie/scene/key_table.hpp"

namespace vehd {

namespace {

/// Keys of a table that says how a property differs from place to place.
template <typename Part>
void add_place_keys(KeyTable& table, std::string_view name, Part part) {
  constexpr Range any{};
  constexpr Range degrees{0.0, 180.0, true};
  table.begin(name);
  table
      .add_word("kind", {"harmonics", "cap", "file"},
                "the property is its value in [membrane] times base + s(θ, φ), where the material point was on the "
                "parameter sphere of [shape]; times a factor within a round cap and another outside; as harmonics, of "
                "a text file",
                part, &PlaceScene::kind)
      .required = true;
  table.begin(name, {"harmonics", "file"});
  table.add("base", any, {"", "1", "constant part of the factor"}, part, &PlaceScene::base);
  table.add("modes", any,
            {"", "1", "s = sum of a Re Y_n^m of Eq. (17), entries {n, m, a}; m < 0 takes Im Y_n^|m|; absent: 0"}, part,
            &PlaceScene::modes);
  table.begin(name, {"file"});
  table.add("path", any, {"", "", "text file of lines \"n m a\", relative to the scene file; absent: modes"}, part,
            &PlaceScene::path);
  table.begin(name, {"cap"});
  table.add("axis", any, {"", "1", "through the middle of the cap"}, part, &PlaceScene::axis);
  table.add("angle_deg", degrees, {"α", "1", "from the axis to the edge, in degrees"}, part, &PlaceScene::angle_deg)
      .required = true;
  table.add("width_deg", degrees,
            {"w", "1", "of the edge, in degrees: the share of the cap is ½ erfc((cos α − cos γ)/(w sin α))"}, part,
            &PlaceScene::width_deg);
  table.add("inside", any, {"", "1", "factor within the cap"}, part, &PlaceScene::inside).required = true;
  table.add("outside", any, {"", "1", "factor outside"}, part, &PlaceScene::outside);
}

template <typename Member>
auto of_membrane(std::optional<Member> MembraneScene::*member) {
  return [member](auto& scene) -> auto& { return *(scene.membrane.*member); };
}

template <typename Member>
TableDescription place_table(std::string_view name, std::string_view description,
                             std::optional<Member> MembraneScene::*member) {
  return {name, description, false, [member](const Scene& scene) { return (scene.membrane.*member).has_value(); },
          [member](Scene& scene) { (scene.membrane.*member).emplace(); }};
}

}  // namespace

std::vector<TableDescription> place_tables() {
  return {
      place_table("membrane.capacitance_by_place", "C_m from place to place; absent: uniform",
                  &MembraneScene::capacitance_by_place),
      place_table("membrane.conductance_by_place", "G_m from place to place; absent: uniform",
                  &MembraneScene::conductance_by_place),
      place_table("membrane.bending_by_place", "κ_B from place to place; absent: uniform",
                  &MembraneScene::bending_by_place),
      place_table("membrane.curvature_by_place", "spontaneous curvature c from place to place; absent: uniform",
                  &MembraneScene::curvature_by_place),
      place_table("membrane.pump", "current that the membrane pumps from place to place; absent: none",
                  &MembraneScene::pump),
      {"membrane.pump.waveform", "factor of the pump current in time; absent: 1", false,
       [](const Scene& scene) { return scene.membrane.pump && scene.membrane.pump->waveform; },
       [](Scene& scene) {
         if (!scene.membrane.pump) scene.membrane.pump.emplace();
         scene.membrane.pump->waveform.emplace();
       }},
  };
}

void add_place_keys(KeyTable& table) {
  add_place_keys(table, "membrane.capacitance_by_place", of_membrane(&MembraneScene::capacitance_by_place));
  add_place_keys(table, "membrane.conductance_by_place", of_membrane(&MembraneScene::conductance_by_place));
  add_place_keys(table, "membrane.bending_by_place", of_membrane(&MembraneScene::bending_by_place));
  add_place_keys(table, "membrane.curvature_by_place", of_membrane(&MembraneScene::curvature_by_place));
  const auto pump = of_membrane(&MembraneScene::pump);
  add_place_keys(table, "membrane.pump", pump);
  table.begin("membrane.pump", {"harmonics", "cap", "file"});
  table
      .add("current", Range{},
           {"J_p", "current/area", "outwards, where the factor is 1: C_m dV_m/dt + G_m V_m + J_p = −σ_i ∂φ_i/∂n"}, pump,
           &PumpScene::current)
      .required = true;
}

}  // namespace vehd
