#include "bie/scene/key_table.hpp"
#include "bie/sphere/degrees.hpp"
#include "bie/stepping/time/time_rule.hpp"

/// All tables and keys of a scene. A new key is a member in scene.hpp and a row here.
namespace vehd {
namespace {

constexpr Range positive{0.0, Range{}.upper, true};
constexpr Range not_negative{0.0, Range{}.upper, false};
constexpr Range degrees{0.0, 180.0, true};
constexpr bool required = true;

void add_units(auto& scene) {
  auto units = scene.optional("units", &Scene::units, "units of plain numbers; absent: values are dimensionless");
  const auto scale = [&](std::string_view name, std::optional<double> UnitsScene::*member, const RowText& text) {
    units.key(name, member, positive, text).type = ValueType::quantity;
  };
  scale("length", &UnitsScene::length, {"L", "length", "reference length; absent: √(area/4π) of an area in SI units"});
  scale(
      "time", &UnitsScene::time,
      {"T", "time",
       "reference time; absent: the shortest that values in SI units give: duration of a pulse, period or 1/frequency "
       "(not of an averaged field), 1/rate (of a Poiseuille flow R/v_c), LC_m(1/σ_i + 1/(2σ_e)), μ/(εE²), μL³/κ_B"});
  scale("viscosity", &UnitsScene::viscosity,
        {"M", "viscosity", "reference viscosity; absent: that of the fluid in SI units"});
  scale("potential", &UnitsScene::potential,
        {"Φ", "potential", "reference potential; absent: √(ML/(T C_m)) of a capacitance in SI units"});
  scale("temperature", &UnitsScene::temperature,
        {"", "temperature", "of energies in kBT, such as \"298 K\"; no scale"});
}

void add_shape(auto& scene) {
  auto shape = scene.always("shape", &Scene::shape, "initial shape", required);
  shape.word(
      "kind", &ShapeScene::kind, {"ellipsoid", "prolate", "oblate", "biconcave", "stomatocyte", "radial", "file"},
      "prolate, oblate, biconcave and stomatocyte have the axis z and without area or scale the area 4π; with [units] "
      "one of them is required",
      required);
  shape.of("ellipsoid").key("axes", &ShapeScene::axes, size_range, {"", "length", "semi-axes along x, y, z", required});
  const auto reduced_volume = [&](std::string_view kind, Range range, std::string_view text) {
    shape.of(kind).key("reduced_volume", &ShapeScene::reduced_volume, range, {"v", "1", text});
  };
  constexpr std::string_view definition = "6√π V/A^{3/2}, required, this or excess_area";
  reduced_volume("prolate", {0.2, 1.0}, definition);
  reduced_volume("oblate", {0.1, 1.0}, definition);
  reduced_volume("biconcave", {0.5, 0.75}, "6√π V/A^{3/2}; absent: 0.65");
  reduced_volume("stomatocyte", {0.1, 0.65}, "6√π V/A^{3/2}, required, this or excess_area; open towards −z");
  shape.of("ellipsoid", "radial", "file")
      .key("reduced_volume", &ShapeScene::reduced_volume, {0.1, 1.0},
           {"v", "1",
            "6√π V/A^{3/2}, reached by moving all points towards the sphere of this area or away from it; absent: as "
            "it is"});
  shape.key("excess_area", &ShapeScene::excess_area, not_negative,
            {"Δ", "1", "A/a_V² − 4π, a_V the radius of the sphere of this volume: v = (1 + Δ/4π)^{-3/2}"});
  auto radial = shape.of("radial");
  radial.key("base", &ShapeScene::base, {"", "length", "constant part of the radius; may be left out with area"})
      .default_has_effect = [](const Scene& s) { return !s.shape.area; };
  radial.key("amplitude", &ShapeScene::amplitude,
             {"", "length", "radius = base + amplitude exp(exponent s); absent: base + s"});
  radial.key("exponent", &ShapeScene::exponent, {"", "1", "factor of s in the exponential"});
  radial.key("modes", &ShapeScene::modes,
             {"", "1", "s = sum of a Re Y_n^m of Eq. (17), entries {n, m, a}; m < 0 takes Im Y_n^|m|", required});
  auto file = shape.of("file");
  file.key("path", &ShapeScene::path,
           {"", "", "run.h5 that holds the shape, relative to the scene file; any degree and units", required});
  file.key("time", &ShapeScene::time, not_negative,
           {"t", "time", "time of the snapshot in that run; absent: the last one"});
  file.key("checksum", &ShapeScene::checksum, {0.0, 4294967295.0},
           {"", "1", "of the snapshot, written by vehd: a file that has changed is refused; absent: any"});
  shape.key("area", &ShapeScene::area, positive, {"A", "area", "the shape is scaled to this area; not with scale"});
  shape.key("scale", &ShapeScene::scale, size_range, {"", "1", "the shape is scaled by this factor; not with area"});
  shape.key("rotation", &ShapeScene::rotation,
            {"", "1", "axis and angle in degrees about the shape's origin, right-handed, after scaling"});
  shape.key("centre", &ShapeScene::centre, {"", "length", "where the shape's origin is placed, after rotation"});
}

/// Adds the keys of a waveform. @return the table of the alternating kinds, to which the caller may add keys
auto add_waveform(auto waveform) {
  waveform.word(
      "kind", &WaveformScene::kind, {"dc", "ac", "burst", "pulse", "pulse_train", "table"},
      "dc: constant; ac: cos(2πft + phase); burst: the same during [start, start + duration), else 0; pulse: 1 "
      "during [start, start + duration), else 0; pulse_train: a pulse in every period; table: linear between "
      "its entries",
      required);
  auto ac = waveform.of("ac", "burst"), pulse = waveform.of("burst", "pulse", "pulse_train"),
       table = waveform.of("table");
  ac.key("frequency", &WaveformScene::frequency, positive,
         {"f", "1/time", "at least four steps a period are taken, unless it is averaged", required});
  ac.key("phase", &WaveformScene::phase, {"", "1", "in radians; −π/2 makes a sine"});
  pulse.key("start", &WaveformScene::start, {"", "time", "of the first pulse, or of the burst"});
  pulse.key("duration", &WaveformScene::duration, positive, {"", "time", "of a pulse, or of the burst", required});
  waveform.of("pulse_train")
      .key("period", &WaveformScene::period, positive,
           {"", "time", "from pulse to pulse; longer than a pulse", required});
  table.key("path", &WaveformScene::path,
            {"", "", "text file of lines \"time factor\", relative to the scene file; absent: times and values"});
  table.key("times", &WaveformScene::times, {"", "time", "ascending, two equal ones make a jump"});
  table.key("values", &WaveformScene::values, {"", "1", "factor at each of the times; constant beyond the ends"});
  return ac;
}

/// Adds the keys of a table for a spatially varying property.
auto add_varying_property(auto table) {
  table.word("kind", &VaryingProperty::kind, {"harmonics", "cap", "file"},
             "the value in [membrane] times a factor; harmonics: base + s at the initial (θ, φ) of the material "
             "point; cap: one "
             "factor within a round cap, another outside; file: harmonics of a text file",
             required);
  auto harmonics = table.of("harmonics", "file"), cap = table.of("cap");
  harmonics.key("base", &VaryingProperty::base, {"", "1", "constant part of the factor"});
  harmonics.key("modes", &VaryingProperty::modes,
                {"", "1", "s = sum of a Re Y_n^m of Eq. (17), entries {n, m, a}; m < 0 takes Im Y_n^|m|; absent: 0"});
  table.of("file").key("path", &VaryingProperty::path,
                       {"", "", "text file of lines \"n m a\", relative to the scene file; absent: modes"});
  cap.key("axis", &VaryingProperty::axis, {"", "1", "through the middle of the cap"});
  cap.key("angle_deg", &VaryingProperty::angle_deg, degrees,
          {"α", "1", "from the axis to the edge, in degrees", required});
  cap.key("width_deg", &VaryingProperty::width_deg, degrees,
          {"w", "1", "of the edge, in degrees: the share of the cap is ½ erfc((cos α − cos γ)/(w sin α))"});
  cap.key("inside", &VaryingProperty::inside, {"", "1", "factor within the cap", required});
  cap.key("outside", &VaryingProperty::outside, {"", "1", "factor outside"});
  return table;
}

void add_membrane(auto& scene) {
  auto membrane = scene.always("membrane", &Scene::membrane, "mechanical and electric properties of the membrane");
  membrane.key("bending_modulus", &MembraneScene::bending_modulus, not_negative,
               {"κ_B", "energy", "E = κ_B ∫H² dA, twice the Helfrich modulus κ_c; absent or 0: no bending"});
  membrane.key("spontaneous_curvature", &MembraneScene::spontaneous_curvature,
               {"c", "1/length",
                "E = κ_B ∫(H − c)² dA; H = −1 on the unit sphere. The usual C₀ of (κ_c/2)∫(C₁ + C₂ − C₀)² dA, positive "
                "where the membrane prefers to bulge outwards, is −2c"});
  membrane.key("inextensible", &MembraneScene::inextensible,
               {"", "", "local area is conserved by a tension, Eq. (1e)"});
  membrane.key("undulations", &MembraneScene::undulations,
               {"", "",
                "the area A follows the mean tension σ: A/A_0 = 1 + k_BT/(8πκ_c) ln(1 + 0.1 σA_0/κ_c) + σ/K_A, κ_c = "
                "κ_B/2; false: it is constant"});
  membrane.key("temperature", &MembraneScene::temperature, positive,
               {"k_BT", "thermal energy", "such as \"298 K\"; used with undulations; absent: they store no area"});
  membrane.key("stretching_modulus", &MembraneScene::stretching_modulus, positive,
               {"K_A", "force/length", "used with undulations; absent: the lipids do not stretch"});
  membrane.key("reference_tension", &MembraneScene::reference_tension,
               {"σ", "force/length", "mean tension of the initial shape with undulations; absent: 0"});
  membrane.key("rest_area", &MembraneScene::rest_area, positive,
               {"A_0", "area", "area at zero tension with undulations; not with reference_tension"});
  membrane
      .key("capacitance", &MembraneScene::capacitance, positive,
           {"C_m", "capacitance/area", "used with [electric] only"})
      .default_has_effect = [](const Scene& s) { return s.electric.has_value(); };
  membrane.key("conductance", &MembraneScene::conductance, not_negative,
               {"G_m", "conductance/area", "used with [electric] only"});
  membrane.key("mobile", &MembraneScene::mobile, {"", "", "false: the shape is frozen and only the membrane charges"});
  add_varying_property(membrane.optional("membrane.varying_capacitance", &MembraneScene::varying_capacitance,
                                         "spatially varying C_m; absent: uniform"));
  add_varying_property(membrane.optional("membrane.varying_conductance", &MembraneScene::varying_conductance,
                                         "spatially varying G_m; absent: uniform"));
  add_varying_property(membrane.optional("membrane.varying_bending", &MembraneScene::varying_bending,
                                         "spatially varying κ_B; absent: uniform"));
  add_varying_property(membrane.optional("membrane.varying_curvature", &MembraneScene::varying_curvature,
                                         "spatially varying spontaneous curvature c; absent: uniform"));
  auto pump = add_varying_property(membrane.optional(
      "membrane.pump", &MembraneScene::pump, "current that the membrane pumps, spatially varying; absent: none"));
  pump.of("harmonics", "cap", "file")
      .key("current", &PumpScene::current,
           {"J_p", "current/area", "outwards, where the factor is 1: C_m dV_m/dt + G_m V_m + J_p = −σ_i ∂φ_i/∂n",
            required});
  add_waveform(
      pump.optional("membrane.pump.waveform", &PumpScene::waveform, "factor of the pump current in time; absent: 1"));
}

void add_fluid(auto& scene) {
  auto fluid = scene.always("fluid", &Scene::fluid, "the fluids inside and outside");
  fluid.key("viscosity", &FluidScene::viscosity, positive, {"μ", "viscosity", "of the fluid outside"});
  fluid.key("viscosity_ratio", &FluidScene::viscosity_ratio, not_negative,
            {"μ_i/μ_e", "1", "inside over outside; 1: no double layer is evaluated"});
  fluid.key("density_difference", &FluidScene::density_difference,
            {"ρ_i − ρ_e", "density", "inside minus outside; goes with [gravity]"});
}

void add_gravity_and_contact(auto& scene) {
  auto gravity = scene.optional("gravity", &Scene::gravity, "weight of the inner fluid; absent: none");
  gravity.key("acceleration", &GravityScene::acceleration, {"g", "acceleration", "of free fall", required});
  auto contact = scene.optional("contact", &Scene::contact, "potential between different vesicles; absent: none");
  contact.key("energy", &ContactScene::energy,
              {"W", "force/length",
               "two flat membranes at distance d have W exp(−d²/range²) per area; positive repels, negative attracts",
               required});
  contact.key("range", &ContactScene::range, positive, {"", "length", "of the potential", required});
}

void add_wall(auto& scene) {
  auto wall = scene.optional("wall", &Scene::wall, "plane beside the vesicles; absent: the fluid is unbounded");
  wall.key("point", &WallScene::point, {"", "length", "any point of the plane"});
  wall.key("normal", &WallScene::normal,
           {"n", "1", "of any length; the vesicles are on the side that it points to", required});
  wall.word(
      "flow", &WallScene::flow, {"none", "no-slip", "stress-free"},
      "none: no effect on the flow; no-slip: the fluid sticks to it; stress-free: a free surface that stays flat");
  wall.word("field", &WallScene::field, {"none", "insulating", "electrode"},
            "none: no effect on the field; insulating: no current crosses it; electrode: its potential is constant");
}

void add_flow(auto& scene) {
  auto flow = scene.optional("flow", &Scene::flow, "background flow; absent: quiescent");
  flow.word("kind", &FlowScene::kind, {"shear", "planar_extension", "axisymmetric_extension", "gradient", "poiseuille"},
            "shear: rate (z, 0, 0); planar_extension: rate (x, 0, −z); axisymmetric_extension: rate (−x/2, −y/2, z); "
            "gradient: any; poiseuille: centre_velocity (1 − (y² + z²)/radius²) along x",
            required);
  flow.of("shear", "planar_extension", "axisymmetric_extension")
      .key("rate", &FlowScene::rate, {"γ̇", "1/time", "velocity gradient", required});
  flow.of("gradient").key("gradient", &FlowScene::gradient, {"∇v", "1/time", "rows dv_i/dx_j of trace zero", required});
  auto poiseuille = flow.of("poiseuille");
  poiseuille.key("centre_velocity", &FlowScene::centre_velocity, {"v_c", "velocity", "on the axis", required});
  poiseuille.key("radius", &FlowScene::radius, positive, {"R", "length", "where the profile vanishes", required});
  poiseuille.word("section", &FlowScene::section, {"tube", "slit"},
                  "tube: 1 − (y² + z²)/radius²; slit: 1 − z²/radius², a flow between planes");
  add_waveform(flow.optional("flow.waveform", &FlowScene::waveform, "factor of the flow in time; absent: 1"));
}

void add_electric(auto& scene) {
  auto electric = scene.optional("electric", &Scene::electric, "applied field; absent: nothing electric is assembled");
  electric.key("field", &ElectricScene::field, {"E_∞", "field", "applied uniform field", required});
  electric.key("field_magnitude", &ElectricScene::field_magnitude, not_negative,
               {"|E_∞|", "field", "field gives the direction alone; absent: its magnitude as well"});
  electric.key("conductivity_in", &ElectricScene::conductivity_in, not_negative,
               {"σ_i", "conductivity", "of the fluid inside", required});
  electric.key("conductivity_out", &ElectricScene::conductivity_out, not_negative,
               {"σ_e", "conductivity", "of the fluid outside", required});
  electric.key("permittivity", &ElectricScene::permittivity, positive, {"ε", "permittivity", "of the fluid outside"});
  electric.key("permittivity_ratio", &ElectricScene::permittivity_ratio, positive,
               {"ε_i/ε_e", "1", "inside over outside"});
  electric.word(
      "initial_Vm", &ElectricScene::initial_potential, {"zero", "steady", "file"},
      "transmembrane potential at time 0: zero; steady: of a fully charged membrane; file: of the file of [shape], "
      "the default if that has one");
  electric.key(
      "displacement_current", &ElectricScene::displacement_current,
      {"", "",
       "of both fluids, which matters above the frequency σ/(2πε) and in pulses below ε/σ; needs permittivity"});
  auto ac = add_waveform(
      electric.optional("electric.waveform", &ElectricScene::waveform, "factor of the field in time; absent: 1"));
  ac.key("average", &WaveformScene::average,
         {"", "",
          "the shape follows the mean force of a period, and V_m is known by amplitude and phase; see "
          "docs/experiments/ac_field.md"});
}

void add_poration(auto& scene) {
  using Poration = PorationScene;
  auto poration =
      scene.optional("poration", &Scene::poration, "electroporation of the membrane beyond a threshold; absent: none");
  poration.word(
      "model", &Poration::model, {"criterion", "porosity", "pores"},
      "criterion: when and where a threshold is passed first, which changes nothing; porosity: G_m + G_1 X with dX/dt "
      "= max((β − X)/τ_ep, (β − X)/τ_res), β = ½[1 + tanh k(|V_m|/V_r − 1)]; pores: G_m + N g_p with dN/dt = α "
      "exp((V_m/V_ep)²)[1 − (N/N_0) exp(−q(V_m/V_ep)²)], g_p = 2πr²σ_p/(πr + 2h); see docs/experiments/poration.md",
      required);
  auto criterion = poration.of("criterion"), porosity = poration.of("porosity"), pores = poration.of("pores");
  criterion.key("threshold_Vm", &Poration::threshold_potential, positive,
                {"V_c", "potential", "of |V_m|; this, lysis_tension or both"});
  criterion.key(
      "lysis_tension", &Poration::lysis_tension, positive,
      {"λ_c", "force/length", "of λ + C_m V_m²/2, on a sphere only with undulations; this, threshold_Vm or both"});
  porosity.key("threshold_Vm", &Poration::threshold_potential, positive,
               {"V_r", "potential", "where β is a half", required});
  porosity.key("porated_conductance", &Poration::porated_conductance, not_negative,
               {"G_1", "conductance/area", "beyond G_m where X is 1", required});
  porosity.key("steepness", &Poration::steepness, positive, {"k", "1", "of β"});
  porosity.key("poration_time", &Poration::poration_time, positive, {"τ_ep", "time", "in which X rises", required});
  porosity.key("resealing_time", &Poration::resealing_time, positive,
               {"τ_res", "time", "in which X falls, longer than poration_time", required});
  pores.key("creation_rate", &Poration::creation_rate, positive,
            {"α", "1/(area time)", "of pores without V_m", required});
  pores.key("creation_Vm", &Poration::threshold_potential, positive,
            {"V_ep", "potential", "creation rises by the factor e where V_m reaches it", required});
  pores.key("rest_density", &Poration::rest_density, positive, {"N_0", "1/area", "of pores without V_m", required});
  pores.key("exponent", &Poration::exponent, positive, {"q", "1", "of the density in equilibrium"});
  pores.key("pore_radius", &Poration::pore_radius, positive, {"r", "length", "of all pores", required});
  pores.key("membrane_thickness", &Poration::membrane_thickness, positive,
            {"h", "length", "of the membrane", required});
  pores.key("pore_conductivity", &Poration::pore_conductivity, positive,
            {"σ_p", "conductivity", "within pores; absent: (σ_e − σ_i)/ln(σ_e/σ_i)"});
}

void add_numerics(auto& scene) {
  auto numerics = scene.always("numerics", &Scene::numerics, "resolution in space and time", required);
  numerics.key(
      "tolerance", &NumericsScene::tolerance, {tightest_tolerance, 0.1},
      {"", "1",
       "target for the relative error of the columns of history.csv except pore_density_max: degree, steps and "
       "solvers follow; absent: they are fixed"});
  numerics
      .key("degree", &NumericsScene::order, {lowest_order, highest_order},
           {"p", "1",
            "of the spherical harmonics; also called order; with a tolerance the highest and that of the files, by "
            "default 8 (1 − log₁₀ tolerance) up to 64"})
      .other_name = "order";
  numerics.key("dt", &NumericsScene::dt, positive, {"Δt", "time", "largest time step; required without a tolerance"});
  numerics.key("time_order", &NumericsScene::time_order, {1, highest_time_order},
               {"", "1",
                "order of a step in Δt: 1 the paper's scheme; 2 … 5 its deferred correction at 2, 5, 10, 13 times the "
                "work; with a tolerance at least 2, by default 5"});
  numerics.key("end_time", &NumericsScene::end_time, not_negative,
               {"", "time", "0 solves and writes the initial state alone", required});
  numerics.word("until", &NumericsScene::until, {"end_time", "rest"},
                "rest: the run ends earlier, once no waveform changes any more and shape, V_m, pores and positions "
                "relative to a wall or other vesicles would change by less than the tolerance (1e-3 without one) up "
                "to end_time at their present rates");
  numerics.word(
      "symmetry", &NumericsScene::symmetry, {"auto", "off", "axisymmetric"},
      "auto: the symmetry that is found; off: none; axisymmetric: refuse a scene without an axis of symmetry");
  numerics.key(
      "error_bars", &NumericsScene::error_bars,
      {"", "", "history_error.csv: the estimated error of every number of history.csv; adds 6 to 63 % to the time"});
}

void add_output(auto& scene) {
  auto output = scene.always("output", &Scene::output, "snapshots and units of the results");
  output.key("every", &OutputScene::every, positive,
             {"", "time", "time between snapshots; absent: the start, the end, and those of times and window"});
  output.key("times", &OutputScene::times, not_negative, {"", "time", "further times of snapshots, ascending"});
  output.key("window", &OutputScene::windows, not_negative,
             {"", "time",
              "[[output.window]]: further snapshots at from, from + every, … up to to; any number of windows, which "
              "may overlap"});
  output.word("units", &OutputScene::units, {"auto", "si", "dimensionless"},
              "of history.csv, summary.json, pictures and progress: auto takes SI units where the scene has [units]; "
              "see docs/run_files.md");
}

void add_suspension(auto& scene) {
  auto suspension =
      scene.optional("suspension", &Scene::suspension, "copies of the vesicle at random places; absent: none");
  suspension.word("kind", &SuspensionScene::kind, {"box", "ball"}, "the region; every vesicle is within it as a whole",
                  required);
  suspension.of("box").key("size", &SuspensionScene::size, positive, {"", "length", "along x, y, z", required});
  suspension.of("ball").key("radius", &SuspensionScene::radius, positive, {"", "length", "of the ball", required});
  suspension.key("centre", &SuspensionScene::centre, {"", "length", "of the region"});
  suspension.key("count", &SuspensionScene::count, {1.0, 1e9}, {"", "1", "number of vesicles; or volume_fraction"});
  suspension.key("volume_fraction", &SuspensionScene::volume_fraction, {0.0, 1.0, true},
                 {"", "1", "of the vesicles in the region; or count"});
  suspension.key("seed", &SuspensionScene::seed, {0.0, 1e9}, {"", "1", "of the random places and orientations"});
  suspension.word("orientation", &SuspensionScene::orientation, {"random", "aligned"},
                  "random: random rotations, which replace rotation in [shape]; aligned: all alike");
  suspension.key("gap", &SuspensionScene::gap, not_negative,
                 {"", "1", "least distance of two vesicles over the radius √(area/4π)"});
}

SchemaRows make_rows() {
  SchemaRows rows;
  const auto whole = [](auto& scene) -> auto& { return scene; };
  KeyTable scene(rows, {"", "", true, [](const Scene&) { return true; }, [](Scene&) {}}, whole);
  add_units(scene);
  add_shape(scene);
  add_membrane(scene);
  add_fluid(scene);
  add_gravity_and_contact(scene);
  add_wall(scene);
  add_flow(scene);
  add_electric(scene);
  add_poration(scene);
  add_numerics(scene);
  add_output(scene);
  add_suspension(scene);
  return rows;
}

const SchemaRows& all_rows() {
  static const SchemaRows rows = make_rows();
  return rows;
}

}  // namespace

const std::vector<TableDescription>& scene_tables() { return all_rows().tables; }

const std::vector<KeyDescription>& scene_keys() { return all_rows().keys; }

}  // namespace vehd
