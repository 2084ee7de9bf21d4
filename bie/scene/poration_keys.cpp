#include <limits>

#include "bie/scene/key_table.hpp"

namespace vehd {

void add_poration_keys(KeyTable& table) {
  constexpr Range above_zero{0.0, std::numeric_limits<double>::infinity(), true};
  constexpr Range from_zero{0.0, std::numeric_limits<double>::infinity(), false};
  const auto of_poration = [](auto& scene) -> auto& { return *scene.poration; };
  table.begin("poration");
  table
      .add_word("model", {"criterion", "porosity", "pores"},
                "criterion: when and where a threshold is passed first, which changes nothing; porosity: G_m + G_1 X "
                "with dX/dt = max((β − X)/τ_ep, (β − X)/τ_res), β = ½[1 + tanh k(|V_m|/V_r − 1)]; pores: G_m + N g_p "
                "with dN/dt = α exp((V_m/V_ep)²)[1 − (N/N_0) exp(−q(V_m/V_ep)²)], g_p = 2πr²σ_p/(πr + 2h); see "
                "docs/experiments/poration.md",
                of_poration, &PorationScene::model)
      .required = true;
  table.begin("poration", {"criterion"});
  table.add("threshold_Vm", above_zero, {"V_c", "potential", "of |V_m|; this, lysis_tension or both"}, of_poration,
            &PorationScene::threshold_potential);
  table.add("lysis_tension", above_zero,
            {"λ_c", "force/length", "of λ + C_m V_m²/2, which a sphere does not determine; this, threshold_Vm or both"},
            of_poration, &PorationScene::lysis_tension);
  table.begin("poration", {"porosity"});
  table
      .add("threshold_Vm", above_zero, {"V_r", "potential", "where β is a half"}, of_poration,
           &PorationScene::threshold_potential)
      .required = true;
  table
      .add("porated_conductance", from_zero, {"G_1", "conductance/area", "beyond G_m where X is 1"}, of_poration,
           &PorationScene::porated_conductance)
      .required = true;
  table.add("steepness", above_zero, {"k", "1", "of β"}, of_poration, &PorationScene::steepness);
  table
      .add("poration_time", above_zero, {"τ_ep", "time", "in which X rises"}, of_poration,
           &PorationScene::poration_time)
      .required = true;
  table
      .add("resealing_time", above_zero, {"τ_res", "time", "in which X falls, longer than poration_time"}, of_poration,
           &PorationScene::resealing_time)
      .required = true;
  table.begin("poration", {"pores"});
  table
      .add("creation_rate", above_zero, {"α", "1/(area time)", "of pores without V_m"}, of_poration,
           &PorationScene::creation_rate)
      .required = true;
  table
      .add("creation_Vm", above_zero, {"V_ep", "potential", "creation rises by the factor e where V_m reaches it"},
           of_poration, &PorationScene::threshold_potential)
      .required = true;
  table
      .add("rest_density", above_zero, {"N_0", "1/area", "of pores without V_m"}, of_poration,
           &PorationScene::rest_density)
      .required = true;
  table.add("exponent", above_zero, {"q", "1", "of the density in equilibrium"}, of_poration, &PorationScene::exponent);
  table.add("pore_radius", above_zero, {"r", "length", "of all pores"}, of_poration, &PorationScene::pore_radius)
      .required = true;
  table
      .add("membrane_thickness", above_zero, {"h", "length", "of the membrane"}, of_poration,
           &PorationScene::membrane_thickness)
      .required = true;
  table.add("pore_conductivity", above_zero, {"σ_p", "conductivity", "within pores; absent: (σ_e − σ_i)/ln(σ_e/σ_i)"},
            of_poration, &PorationScene::pore_conductivity);
}

}  // namespace vehd
