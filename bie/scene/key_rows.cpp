#include "bie/scene/key_rows.hpp"

#include "bie/scene/key_table.hpp"
#include "bie/sphere/degrees.hpp"
#include "bie/stepping/time/time_rule.hpp"

namespace vehd {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Range any_number{};
constexpr Range positive{0.0, infinity, true};
constexpr Range not_negative{0.0, infinity, false};

const auto units = [](auto& scene) -> auto& { return *scene.units; };
const auto shape = [](auto& scene) -> auto& { return scene.shape; };
const auto membrane = [](auto& scene) -> auto& { return scene.membrane; };
const auto pump_waveform = [](auto& scene) -> auto& { return *scene.membrane.pump->waveform; };
const auto fluid = [](auto& scene) -> auto& { return scene.fluid; };
const auto gravity = [](auto& scene) -> auto& { return *scene.gravity; };
const auto contact = [](auto& scene) -> auto& { return *scene.contact; };
const auto suspension = [](auto& scene) -> auto& { return *scene.suspension; };
const auto flow = [](auto& scene) -> auto& { return *scene.flow; };
const auto electric = [](auto& scene) -> auto& { return *scene.electric; };
const auto flow_waveform = [](auto& scene) -> auto& { return *scene.flow->waveform; };
const auto electric_waveform = [](auto& scene) -> auto& { return *scene.electric->waveform; };
const auto numerics = [](auto& scene) -> auto& { return scene.numerics; };
const auto output = [](auto& scene) -> auto& { return scene.output; };

void add_units_keys(KeyTable& table) {
  table.begin("units");
  const auto add_scale = [&](std::string_view name, KeyTable::Text text, std::optional<double> UnitsScene::*member) {
    table.add(name, positive, text, units, member).type = ValueType::quantity;
  };
  add_scale("length", {"L", "length", "reference length; absent: √(area/4π) of an area in SI units"},
            &UnitsScene::length);
  add_scale("time",
            {"T", "time",
             "reference time; absent: the shortest that values in SI units give: duration of a pulse, period or "
             "1/frequency (not of an averaged field), 1/rate (of a Poiseuille flow R/v_c), LC_m(1/σ_i + 1/(2σ_e)), "
             "μ/(εE²), μL³/κ_B"},
            &UnitsScene::time);
  add_scale("viscosity", {"M", "viscosity", "reference viscosity; absent: that of the fluid in SI units"},
            &UnitsScene::viscosity);
  add_scale("potential", {"Φ", "potential", "reference potential; absent: √(ML/(T C_m)) of a capacitance in SI units"},
            &UnitsScene::potential);
  add_scale("temperature", {"", "temperature", "of energies in kBT, such as \"298 K\"; no scale"},
            &UnitsScene::temperature);
}

void add_shape_keys(KeyTable& table) {
  table.begin("shape");
  table
      .add_word("kind", {"ellipsoid", "prolate", "oblate", "biconcave", "stomatocyte", "radial", "file"},
                "how the initial shape is given; the middle four have the axis z", shape, &ShapeScene::kind)
      .required = true;
  table.begin("shape", {"ellipsoid"});
  table.add("axes", size_range, {"", "length", "semi-axes along x, y, z"}, shape, &ShapeScene::axes).required = true;
  table.begin("shape", {"prolate"});
  table
      .add("reduced_volume", {0.2, 1.0}, {"v", "1", "6√π V/A^{3/2}; size: area 4π"}, shape, &ShapeScene::reduced_volume)
      .required = true;
  table.begin("shape", {"oblate"});
  table
      .add("reduced_volume", {0.1, 1.0}, {"v", "1", "6√π V/A^{3/2}; size: area 4π"}, shape, &ShapeScene::reduced_volume)
      .required = true;
  table.begin("shape", {"biconcave"});
  table.add("reduced_volume", {0.5, 0.75}, {"v", "1", "6√π V/A^{3/2}; size: area 4π"}, shape,
            &ShapeScene::reduced_volume);
  table.begin("shape", {"stomatocyte"});
  table
      .add("reduced_volume", {0.1, 0.65}, {"v", "1", "6√π V/A^{3/2}; size: area 4π; open towards −z"}, shape,
           &ShapeScene::reduced_volume)
      .required = true;
  table.begin("shape", {"radial"});
  table
      .add("base", any_number, {"", "length", "constant part of the radius; may be left out with area"}, shape,
           &ShapeScene::base)
      .default_has_effect = [](const Scene& scene) { return !scene.shape.area; };
  table.add("amplitude", any_number, {"", "length", "radius = base + amplitude exp(exponent s); absent: base + s"},
            shape, &ShapeScene::amplitude);
  table.add("exponent", any_number, {"", "1", "factor of s in the exponential"}, shape, &ShapeScene::exponent);
  table
      .add("modes", any_number,
           {"", "1", "s = sum of a Re Y_n^m of Eq. (17), entries {n, m, a}; m < 0 takes Im Y_n^|m|"}, shape,
           &ShapeScene::modes)
      .required = true;
  table.begin("shape", {"file"});
  table
      .add("path", any_number,
           {"", "", "run.h5 that holds the shape, relative to the scene file; any degree and units"}, shape,
           &ShapeScene::path)
      .required = true;
  table.add("time", not_negative, {"t", "time", "time of the snapshot in that run; absent: the last one"}, shape,
            &ShapeScene::time);
  table.begin("shape");
  table.add("area", positive, {"A", "area", "the shape is scaled to this area; not with scale"}, shape,
            &ShapeScene::area);
  table.add("scale", size_range, {"", "1", "the shape is scaled by this factor; not with area"}, shape,
            &ShapeScene::scale);
  table.add("rotation", any_number,
            {"", "1", "axis and angle in degrees about the shape's origin, right-handed, after scaling"}, shape,
            &ShapeScene::rotation);
  table.add("centre", any_number, {"", "length", "where the shape's origin is placed, after rotation"}, shape,
            &ShapeScene::centre);
}

void add_membrane_keys(KeyTable& table) {
  table.begin("membrane");
  table.add("bending_modulus", not_negative,
            {"κ_B", "energy", "E = κ_B ∫H² dA, twice the Helfrich modulus κ_c; absent or 0: no bending"}, membrane,
            &MembraneScene::bending_modulus);
  table.add("spontaneous_curvature", any_number,
            {"c", "1/length",
             "E = κ_B ∫(H − c)² dA; H = −1 on the unit sphere. The usual C₀ of (κ_c/2)∫(C₁ + C₂ − C₀)² dA, positive "
             "where the membrane prefers to bulge outwards, is −2c"},
            membrane, &MembraneScene::spontaneous_curvature);
  table.add("inextensible", any_number, {"", "", "local area is conserved by a tension, Eq. (1e)"}, membrane,
            &MembraneScene::inextensible);
  table
      .add("capacitance", positive, {"C_m", "capacitance/area", "used with [electric] only"}, membrane,
           &MembraneScene::capacitance)
      .default_has_effect = [](const Scene& scene) { return scene.electric.has_value(); };
  table.add("conductance", not_negative, {"G_m", "conductance/area", "used with [electric] only"}, membrane,
            &MembraneScene::conductance);
  table.add("mobile", any_number, {"", "", "false: the shape is frozen and only the membrane charges"}, membrane,
            &MembraneScene::mobile);
}

void add_fluid_keys(KeyTable& table) {
  table.begin("fluid");
  table.add("viscosity", positive, {"μ", "viscosity", "of the fluid outside"}, fluid, &FluidScene::viscosity);
  table.add("viscosity_ratio", not_negative, {"μ_i/μ_e", "1", "inside over outside; 1: no double layer is evaluated"},
            fluid, &FluidScene::viscosity_ratio);
  table.add("density_difference", any_number, {"ρ_i − ρ_e", "density", "inside minus outside; goes with [gravity]"},
            fluid, &FluidScene::density_difference);
}

void add_gravity_keys(KeyTable& table) {
  table.begin("gravity");
  table.add("acceleration", any_number, {"g", "acceleration", "of free fall"}, gravity, &GravityScene::acceleration)
      .required = true;
}

template <typename Part>
void add_waveform_keys(KeyTable& table, std::string_view name, Part part) {
  table.begin(name);
  table
      .add_word("kind", {"dc", "ac", "pulse", "pulse_train", "table"},
                "constant; cos(2πft + phase); 1 during [start, start + duration); that in every period; linear between "
                "the entries of a table",
                part, &WaveformScene::kind)
      .required = true;
  table.begin(name, {"ac"});
  table
      .add("frequency", positive, {"f", "1/time", "at least four steps a period are taken, unless it is averaged"},
           part, &WaveformScene::frequency)
      .required = true;
  table.add("phase", any_number, {"", "1", "in radians; −π/2 makes a sine"}, part, &WaveformScene::phase);
  table.begin(name, {"pulse", "pulse_train"});
  table.add("start", any_number, {"", "time", "of the first pulse"}, part, &WaveformScene::start);
  table.add("duration", positive, {"", "time", "of a pulse"}, part, &WaveformScene::duration).required = true;
  table.begin(name, {"pulse_train"});
  table.add("period", positive, {"", "time", "from pulse to pulse; longer than a pulse"}, part, &WaveformScene::period)
      .required = true;
  table.begin(name, {"table"});
  table.add("path", any_number,
            {"", "", "text file of lines \"time factor\", relative to the scene file; absent: times and values"}, part,
            &WaveformScene::path);
  table.add("times", any_number, {"", "time", "ascending, two equal ones make a jump"}, part, &WaveformScene::times);
  table.add("values", any_number, {"", "1", "factor at each of the times; constant beyond the ends"}, part,
            &WaveformScene::values);
}

void add_contact_keys(KeyTable& table) {
  table.begin("contact");
  table
      .add("energy", any_number,
           {"W", "force/length",
            "two flat membranes at distance d have W exp(−d²/range²) per area; positive repels, negative attracts"},
           contact, &ContactScene::energy)
      .required = true;
  table.add("range", positive, {"", "length", "of the potential"}, contact, &ContactScene::range).required = true;
}

void add_flow_keys(KeyTable& table) {
  table.begin("flow");
  table
      .add_word("kind", {"shear", "planar_extension", "axisymmetric_extension", "gradient", "poiseuille"},
                "rate (z, 0, 0); rate (x, 0, −z); rate (−x/2, −y/2, z); any gradient; centre_velocity (1 − (y² + "
                "z²)/radius²) along x",
                flow, &FlowScene::kind)
      .required = true;
  table.begin("flow", {"shear", "planar_extension", "axisymmetric_extension"});
  table.add("rate", any_number, {"γ̇", "1/time", "velocity gradient"}, flow, &FlowScene::rate).required = true;
  table.begin("flow", {"gradient"});
  table.add("gradient", any_number, {"∇v", "1/time", "rows dv_i/dx_j of trace zero"}, flow, &FlowScene::gradient)
      .required = true;
  table.begin("flow", {"poiseuille"});
  table.add("centre_velocity", any_number, {"v_c", "velocity", "on the axis"}, flow, &FlowScene::centre_velocity)
      .required = true;
  table
      .add("radius", positive, {"R", "length", "where the profile vanishes; there is no wall"}, flow,
           &FlowScene::radius)
      .required = true;
  add_waveform_keys(table, "flow.waveform", flow_waveform);
}

void add_electric_keys(KeyTable& table) {
  table.begin("electric");
  table.add("field", any_number, {"E_∞", "field", "applied uniform field"}, electric, &ElectricScene::field).required =
      true;
  table
      .add("conductivity_in", not_negative, {"σ_i", "conductivity", "of the fluid inside"}, electric,
           &ElectricScene::conductivity_in)
      .required = true;
  table
      .add("conductivity_out", not_negative, {"σ_e", "conductivity", "of the fluid outside"}, electric,
           &ElectricScene::conductivity_out)
      .required = true;
  table.add("permittivity", positive, {"ε", "permittivity", "of the fluid outside"}, electric,
            &ElectricScene::permittivity);
  table.add("permittivity_ratio", positive, {"ε_i/ε_e", "1", "inside over outside"}, electric,
            &ElectricScene::permittivity_ratio);
  table.add_word(
      "initial_Vm", {"zero", "steady", "file"},
      "transmembrane potential at time 0: none; that of a membrane fully charged; that of the file of [shape], "
      "which is the default with a file that has one",
      electric, &ElectricScene::initial_potential);
  table.add(
      "displacement_current", any_number,
      {"", "", "of both fluids, which matters in fields of some 100 kHz and pulses below some us; needs permittivity"},
      electric, &ElectricScene::displacement_current);
  add_waveform_keys(table, "electric.waveform", electric_waveform);
  table.begin("electric.waveform", {"ac"});
  table.add("average", any_number,
            {"", "",
             "the shape follows the mean force of a period, and V_m is known by amplitude and phase; see "
             "docs/experiments/ac_field.md"},
            electric_waveform, &WaveformScene::average);
}

void add_numerics_keys(KeyTable& table) {
  table.begin("numerics");
  table.add("tolerance", {tightest_tolerance, 0.1},
            {"", "1",
             "relative error wanted in the columns of history.csv: degree, steps and solvers follow; absent: they are "
             "fixed"},
            numerics, &NumericsScene::tolerance);
  table
      .add("degree", {lowest_order, highest_order},
           {"p", "1",
            "of the spherical harmonics; also called order; with a tolerance the highest and that of the files, by "
            "default 8 (1 − log₁₀ tolerance) up to 64"},
           numerics, &NumericsScene::order)
      .other_name = "order";
  table.add("dt", positive, {"Δt", "time", "largest time step; required without a tolerance"}, numerics,
            &NumericsScene::dt);
  table.add(
      "time_order", {1, highest_time_order},
      {"", "1",
       "order of a step in Δt: 1 the paper's scheme; 2 … 5 its deferred correction at 2, 5, 10, 13 times the work; "
       "with a tolerance at least 2, by default 5"},
      numerics, &NumericsScene::time_order);
  table
      .add("end_time", not_negative, {"", "time", "0 solves and writes the initial state alone"}, numerics,
           &NumericsScene::end_time)
      .required = true;
  table.add_word("symmetry", {"auto", "off", "axisymmetric"},
                 "use what is found; use none; refuse a scene that is not axisymmetric about any axis", numerics,
                 &NumericsScene::symmetry);
  table.add("error_bars", any_number,
            {"", "", "history_error.csv: the estimated error of every number of history.csv, for a third more time"},
            numerics, &NumericsScene::error_bars);
}

void add_output_keys(KeyTable& table) {
  table.begin("output");
  table.add("every", positive,
            {"", "time", "time between snapshots; absent: the start, the end, and what times and window ask for"},
            output, &OutputScene::every);
  table.add("times", not_negative, {"", "time", "further times of snapshots, ascending"}, output, &OutputScene::times);
  table.add("window", not_negative,
            {"", "time",
             "[[output.window]]: further snapshots at from, from + every, … up to to; any number of windows, which may "
             "overlap"},
            output, &OutputScene::windows);
  table.add_word(
      "units", {"auto", "si", "dimensionless"},
      "of history.csv, summary.json, pictures and progress: auto takes SI units where the scene has [units]; "
      "see docs/run_files.md",
      output, &OutputScene::units);
}

TableDescription always_present(std::string_view name, std::string_view description, bool required = false) {
  return {name, description, required, [](const Scene&) { return true; }, [](Scene&) {}};
}

/// The waveform of a field or flow; its owner comes with it.
template <typename Member>
TableDescription waveform_table(std::string_view name, std::string_view description,
                                std::optional<Member> Scene::*member) {
  return {name, description, false,
          [member](const Scene& scene) { return (scene.*member).has_value() && (scene.*member)->waveform.has_value(); },
          [member](Scene& scene) {
            if (!(scene.*member)) (scene.*member).emplace();
            (scene.*member)->waveform.emplace();
          }};
}

/// An effect that the scene has exactly if it has the table.
template <typename Member>
TableDescription optional_table(std::string_view name, std::string_view description,
                                std::optional<Member> Scene::*member) {
  return {name, description, false, [member](const Scene& scene) { return (scene.*member).has_value(); },
          [member](Scene& scene) { (scene.*member).emplace(); }};
}

void add_suspension_keys(KeyTable& table) {
  table.begin("suspension");
  table
      .add_word("kind", {"box", "ball"}, "the region; every vesicle is within it as a whole", suspension,
                &SuspensionScene::kind)
      .required = true;
  table.begin("suspension", {"box"});
  table.add("size", positive, {"", "length", "along x, y, z"}, suspension, &SuspensionScene::size).required = true;
  table.begin("suspension", {"ball"});
  table.add("radius", positive, {"", "length", "of the ball"}, suspension, &SuspensionScene::radius).required = true;
  table.begin("suspension");
  table.add("centre", any_number, {"", "length", "of the region"}, suspension, &SuspensionScene::centre);
  table.add("count", {1.0, 1e9}, {"", "1", "number of vesicles; or volume_fraction"}, suspension,
            &SuspensionScene::count);
  table.add("volume_fraction", {0.0, 1.0, true}, {"", "1", "of the vesicles in the region; or count"}, suspension,
            &SuspensionScene::volume_fraction);
  table.add("seed", {0.0, 1e9}, {"", "1", "of the random places and orientations"}, suspension, &SuspensionScene::seed);
  table.add_word("orientation", {"random", "aligned"}, "random takes the place of rotation in [shape]", suspension,
                 &SuspensionScene::orientation);
  table.add("gap", not_negative, {"", "1", "least distance of two vesicles over the radius √(area/4π)"}, suspension,
            &SuspensionScene::gap);
}

}  // namespace

std::vector<TableDescription> table_rows() {
  std::vector<TableDescription> rows = {
      optional_table("units", "what 1 means; absent: values are dimensionless", &Scene::units),
      always_present("shape", "initial shape", true),
      always_present("membrane", "mechanical and electric properties of the membrane"),
      always_present("fluid", "the fluids inside and outside"),
      optional_table("gravity", "weight of the inner fluid; absent: none", &Scene::gravity),
      optional_table("contact", "potential between different vesicles; absent: none", &Scene::contact),
      optional_table("flow", "background flow; absent: quiescent", &Scene::flow),
      waveform_table("flow.waveform", "factor of the flow in time; absent: 1", &Scene::flow),
      optional_table("electric", "applied field; absent: nothing electric is assembled", &Scene::electric),
      waveform_table("electric.waveform", "factor of the field in time; absent: 1", &Scene::electric),
      optional_table("poration", "what the membrane does beyond a threshold; absent: nothing", &Scene::poration),
      always_present("numerics", "resolution in space and time", true),
      always_present("output", "what is written"),
      optional_table("suspension", "copies of the vesicle at random places; absent: none", &Scene::suspension),
  };
  const auto fluid_row = std::ranges::find(rows, "fluid", &TableDescription::name);
  std::vector<TableDescription> of_places = place_tables();
  rows.insert(fluid_row, of_places.begin(), of_places.end());
  return rows;
}

std::vector<KeyDescription> key_rows() {
  KeyTable table;
  add_units_keys(table);
  add_shape_keys(table);
  add_membrane_keys(table);
  add_place_keys(table);
  add_waveform_keys(table, "membrane.pump.waveform", pump_waveform);
  add_fluid_keys(table);
  add_gravity_keys(table);
  add_contact_keys(table);
  add_flow_keys(table);
  add_electric_keys(table);
  add_poration_keys(table);
  add_numerics_keys(table);
  add_output_keys(table);
  add_suspension_keys(table);
  return table.take();
}

}  // namespace vehd
