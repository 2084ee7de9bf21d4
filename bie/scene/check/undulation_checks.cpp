#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "bie/physics/effects/undulations.hpp"
#include "bie/scene/output_units.hpp"
#include "bie/scene/read/reading_steps.hpp"
#include "bie/scene/shapes/initial_shape.hpp"
#include "bie/scene/shapes/placement.hpp"

namespace vehd {

void check_undulations(const Scene& scene, const TomlFile& file, const std::vector<Scene>& all) {
  const MembraneScene& m = scene.membrane;
  const auto refuse_if = [&](bool is_wrong, std::string_view key, std::string_view problem) {
    if (is_wrong) file.refuse_key("membrane", key, "\"{}\" in [membrane] {}", key, problem);
  };
  const std::array<std::pair<std::string_view, bool>, 4> keys = {
      {{"temperature", m.temperature.has_value()},
       {"stretching_modulus", m.stretching_modulus.has_value()},
       {"reference_tension", m.reference_tension.has_value()},
       {"rest_area", m.rest_area.has_value()}}};
  const bool nobody_undulates = std::ranges::none_of(all, [](const Scene& one) { return one.membrane.undulations; });
  for (const auto& [key, is_given] : keys) {
    refuse_if(is_given && nobody_undulates, key, "has no effect without \"undulations\"");
  }
  if (!m.undulations) return;
  constexpr std::string_view key = "undulations";
  refuse_if(!m.inextensible || !m.mobile, key,
            "has no effect without a tension; accepted: \"inextensible\" and \"mobile\" true");
  refuse_if(!(m.bending_modulus.value_or(0.0) > 0.0), key, "needs \"bending_modulus\", which sets how much they store");
  refuse_if(m.varying_bending.has_value(), key,
            "needs a uniform bending modulus; accepted: no [membrane.varying_bending]");
  refuse_if(!m.temperature && !m.stretching_modulus, key, "needs \"temperature\", \"stretching_modulus\" or both");
  refuse_if(m.rest_area && m.reference_tension, "rest_area",
            "sets the area at rest, and so does \"reference_tension\"; accepted: one of them");
  if (!m.temperature || !m.reference_tension) return;
  const double area = size_of(initial_position(scene)).area;
  Undulations found{*m.temperature, 0.5 * *m.bending_modulus, m.stretching_modulus, area, *m.reference_tension};
  const double buckling = AreaLaw(found).least_tension();
  found.rest_area = 0.0;
  refuse_if(
      !(with_rest_area(found, area).rest_area > 0.0), "reference_tension",
      fmt::format("is {}, but a membrane of this area buckles at {}; accepted: more",
                  file.typed("membrane.reference_tension"), quantity_text(scene.units, buckling, "force/length")));
}

}  // namespace vehd
