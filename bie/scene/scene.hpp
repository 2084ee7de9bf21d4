#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bie/physics/wall.hpp"
#include "bie/sphere/degrees.hpp"

namespace vehd {

/// Three numbers: a vector.
using Triple = std::array<double, 3>;
/// Rows of a 3 x 3 matrix.
using TripleOfTriples = std::array<Triple, 3>;
/// Axis of any length and angle in degrees, right-handed.
using AxisAngle = std::array<double, 4>;

/// One term amplitude * Re Y_n^m of Eq. (17); m < 0 takes Im Y_n^|m|.
struct HarmonicMode {
  int n = 0, m = 0;
  double a = 0.0;
  bool operator==(const HarmonicMode&) const = default;
};

/// Values of kind in [shape].
enum class ShapeKind { ellipsoid, prolate, oblate, biconcave, stomatocyte, radial, file };
/// Values of kind in [flow].
enum class FlowKind { shear, planar_extension, axisymmetric_extension, gradient, poiseuille };
/// Values of section in [flow].
enum class FlowSection { tube, slit };
/// Values of kind in a waveform.
enum class WaveformKind { dc, ac, burst, pulse, pulse_train, table };
/// Values of model in [poration].
enum class PorationModel { criterion, porosity, pores };
constexpr std::size_t n_poration_models = 3;
/// Values of initial_Vm in [electric].
enum class InitialPotential { zero, steady, file };
/// Values of symmetry in [numerics].
enum class SymmetryUse { automatic, off, axisymmetric };

/// Values of until in [numerics].
enum class RunsUntil { end_time, rest };

/// Values of units in [output].
enum class ResultUnits { automatic, si, dimensionless };

/// Reference scales of a scene, in SI base units; a scale that no value needs may be absent.
struct UnitsScene {
  std::optional<double> length, time, viscosity, potential;
  std::optional<double> temperature{};  ///< for energies in kBT; not a scale
  bool operator==(const UnitsScene&) const = default;
};

/// Initial shape; the members used depend on the kind.
struct ShapeScene {
  ShapeKind kind = ShapeKind::ellipsoid;
  Triple axes{1.0, 1.0, 1.0};
  std::optional<double> reduced_volume;  ///< always present for a prolate, oblate, biconcave or stomatocyte
  std::optional<double> excess_area{};   ///< absent once it is converted to the reduced volume
  double base = 1.0;
  std::optional<double> amplitude;  ///< absent: radius = base + s, otherwise base + amplitude exp(exponent s)
  double exponent = 1.0;
  std::vector<HarmonicMode> modes;
  std::string path;                      ///< absolute path of a run.h5
  std::optional<double> time;            ///< absent: the last snapshot, if there is no scale for its time
  std::optional<std::int64_t> checksum;  ///< of the snapshot; absent: the file has no seals
  std::optional<double> area;            ///< at most one of area and scale is present
  std::optional<double> scale;
  std::optional<AxisAngle> rotation;
  Triple centre{0.0, 0.0, 0.0};
  bool operator==(const ShapeScene&) const = default;
};

/// Factor of a field, flow or pump as a function of time; the members used depend on the kind.
struct WaveformScene {
  WaveformKind kind = WaveformKind::dc;
  double frequency = 1.0, phase = 0.0, start = 0.0, duration = 1.0, period = 1.0;
  bool average = false;             ///< of an ac field: only the mean of its force over a period acts
  std::optional<std::string> path;  ///< file of a table; absent once it is read
  std::vector<double> times, values;
  bool operator==(const WaveformScene&) const = default;
};

inline bool alternates(const WaveformScene& waveform) {
  return waveform.kind == WaveformKind::ac || waveform.kind == WaveformKind::burst;
}

/// Values of kind in the table of a spatially varying property.
enum class VariationKind { harmonics, cap, file };

/// Factor of a property of the membrane over its parameter sphere; the members used depend on the kind.
struct VaryingProperty {
  VariationKind kind = VariationKind::harmonics;
  double base = 1.0;
  std::vector<HarmonicMode> modes;
  std::optional<std::string> path;  ///< file of modes; absent once it is read
  Triple axis{0.0, 0.0, 1.0};
  double angle_deg = 30.0, width_deg = 15.0, inside = 1.0, outside = 1.0;
  bool operator==(const VaryingProperty&) const = default;
};

/// Table [membrane.pump].
struct PumpScene : VaryingProperty {
  double current = 0.0;
  std::optional<WaveformScene> waveform;  ///< absent: constant
  bool operator==(const PumpScene&) const = default;
};

/// Table [membrane], in units of the scene; see docs/scene_keys.md.
struct MembraneScene {
  std::optional<double> bending_modulus;
  double spontaneous_curvature = 0.0;
  bool inextensible = true;
  bool undulations = false;
  std::optional<double> temperature{}, stretching_modulus{}, reference_tension{}, rest_area{};  ///< of undulations
  double capacitance = 1.0;
  double conductance = 0.0;
  bool mobile = true;
  std::optional<VaryingProperty> varying_capacitance{}, varying_conductance{}, varying_bending{}, varying_curvature{};
  std::optional<PumpScene> pump{};
  bool operator==(const MembraneScene&) const = default;
};

/// Table [fluid].
struct FluidScene {
  double viscosity = 1.0, viscosity_ratio = 1.0, density_difference = 0.0;
  bool operator==(const FluidScene&) const = default;
};

/// Table [gravity].
struct GravityScene {
  Triple acceleration{0.0, 0.0, 0.0};
  bool operator==(const GravityScene&) const = default;
};

/// Table [contact]: a potential between the membranes of different vesicles.
struct ContactScene {
  double energy = 0.0, range = 1.0;
  bool operator==(const ContactScene&) const = default;
};

/// Table [wall].
struct WallScene {
  Triple point{0.0, 0.0, 0.0}, normal{0.0, 0.0, 1.0};
  WallFlow flow = WallFlow::none;
  WallField field = WallField::none;
  bool operator==(const WallScene&) const = default;
};

/// Values of kind and orientation in [suspension].
enum class SuspensionKind { box, ball };
enum class SuspensionOrientation { random, aligned };

/// Table [suspension]: copies of one vesicle in a region.
struct SuspensionScene {
  SuspensionKind kind = SuspensionKind::box;
  Triple size{1.0, 1.0, 1.0}, centre{0.0, 0.0, 0.0};
  double radius = 1.0;
  std::optional<std::int64_t> count;
  std::optional<double> volume_fraction;
  int seed = 1;
  SuspensionOrientation orientation = SuspensionOrientation::random;
  double gap = 0.1;
  bool operator==(const SuspensionScene&) const = default;
};

/// Table [flow]; the members used depend on the kind.
struct FlowScene {
  FlowKind kind = FlowKind::shear;
  double rate = 1.0;
  TripleOfTriples gradient{};
  double centre_velocity = 1.0, radius = 1.0;
  FlowSection section = FlowSection::tube;
  std::optional<WaveformScene> waveform;  ///< absent: constant
  bool operator==(const FlowScene&) const = default;
};

/// Table [electric].
struct ElectricScene {
  Triple field{0.0, 0.0, 0.0};
  std::optional<double> field_magnitude{};  ///< absent once the field is scaled to it
  Triple direction{0.0, 0.0, 0.0};          ///< of a field that is scaled to 0, as given; else zero
  double conductivity_in = 1.0, conductivity_out = 1.0, permittivity = 1.0, permittivity_ratio = 1.0;
  bool displacement_current = false;
  std::optional<WaveformScene> waveform;                        ///< absent: constant
  InitialPotential initial_potential = InitialPotential::zero;  ///< by default `file` if the shape file has V_m
  bool operator==(const ElectricScene&) const = default;
};

/// Table [poration]; the members used depend on the model.
struct PorationScene {
  PorationModel model = PorationModel::criterion;
  std::optional<double> threshold_potential, lysis_tension;
  double porated_conductance = 0.0, steepness = 10.0, poration_time = 1.0, resealing_time = 1.0;
  double creation_rate = 1.0, rest_density = 1.0, exponent = 2.46, pore_radius = 1.0, membrane_thickness = 1.0;
  std::optional<double> pore_conductivity;
  bool operator==(const PorationScene&) const = default;
};

/// Table [numerics].
struct NumericsScene {
  std::optional<double> tolerance;  ///< absent: fixed degree and steps
  int order = 16;                   ///< with a tolerance: the highest degree
  std::optional<double> dt;         ///< with a tolerance: the largest step, or none; without: always present
  int time_order = 1;
  double end_time = 0.0;
  RunsUntil until = RunsUntil::end_time;
  SymmetryUse symmetry = SymmetryUse::automatic;
  bool error_bars = false;
  bool operator==(const NumericsScene&) const = default;
};

/// Snapshots at from, from + every, ... up to `to`.
struct OutputWindow {
  double from = 0.0, to = 0.0, every = 0.0;
  bool operator==(const OutputWindow&) const = default;
};

/// Table [output]. Snapshots are taken at the start, at the end and at the times that these members give.
struct OutputScene {
  std::optional<double> every;
  std::vector<double> times;
  std::vector<OutputWindow> windows;
  ResultUnits units = ResultUnits::automatic;
  bool operator==(const OutputScene&) const = default;
};

/// One of several vesicles: the keys of its table [[vesicle]], and those it takes from the tables for all. Members that
/// belong to all vesicles, such as the field, are those of the scene.
struct VesicleScene {
  std::string name;
  ShapeScene shape;
  MembraneScene membrane;
  FluidScene fluid;
  std::optional<ElectricScene> electric;
  bool operator==(const VesicleScene&) const = default;
};

/// A validated scene file: every value is finite and within the range that the key table states.
struct Scene {
  std::optional<UnitsScene> units;  ///< absent: no value may have a unit
  ShapeScene shape;
  MembraneScene membrane;
  FluidScene fluid;
  std::optional<GravityScene> gravity;
  std::optional<ContactScene> contact;
  std::optional<WallScene> wall{};
  std::optional<FlowScene> flow;
  std::optional<ElectricScene> electric;
  std::optional<PorationScene> poration;
  NumericsScene numerics;
  OutputScene output;
  std::optional<SuspensionScene> suspension{};  ///< absent once its vesicles are placed
  /// Empty for a single vesicle. Otherwise all vesicles; the members above are then those of the first.
  std::vector<VesicleScene> vesicles{};
  bool operator==(const Scene&) const = default;
};

/// Does only the mean of the field's force over a period act?
inline bool has_averaged_field(const Scene& scene) {
  return scene.electric && scene.electric->waveform && alternates(*scene.electric->waveform) &&
         scene.electric->waveform->average;
}

/// Does free charge relax in time in addition to V_m?
inline bool has_relaxing_charge(const Scene& scene) {
  return scene.electric && scene.electric->displacement_current && !has_averaged_field(scene);
}

/// Is V_m at time 0 that of the shape file?
inline bool takes_stored_potential(const Scene& scene) {
  return scene.electric && scene.electric->initial_potential == InitialPotential::file;
}

inline bool has_varying_properties(const MembraneScene& membrane) {
  return membrane.varying_capacitance || membrane.varying_conductance || membrane.varying_bending ||
         membrane.varying_curvature;
}

/// Does any membrane have spatially varying properties or a pump?
inline bool varies_or_pumps(const Scene& scene) {
  const auto holds = [](const MembraneScene& membrane) { return has_varying_properties(membrane) || membrane.pump; };
  return holds(scene.membrane) ||
         std::ranges::any_of(scene.vesicles, [&](const VesicleScene& vesicle) { return holds(vesicle.membrane); });
}

}  // namespace vehd
