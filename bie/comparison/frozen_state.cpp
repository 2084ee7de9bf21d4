#include "bie/comparison/frozen_state.hpp"

#include <fmt/format.h>

#include "bie/files/run_reader.hpp"
#include "bie/files/snapshot_choice.hpp"
#include "bie/runs/given_times.hpp"
#include "bie/scene/given_time.hpp"
#include "bie/scene/initial_shape.hpp"
#include "bie/scene/model_of.hpp"
#include "bie/scene/problem.hpp"
#include "bie/scene/reader.hpp"
#include "bie/scene/vesicles.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/evolution.hpp"
#include "bie/stepping/state/resized.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

void require_few_vesicles(std::size_t n, const std::filesystem::path& file, const std::string& who) {
  if (n <= most_checked_vesicles) return;
  throw InputError(fmt::format("{}: has {} vesicles; {} accepts one or two", file.string(), n, who));
}

bool is_scene(const std::filesystem::path& file) { return file.extension() == ".toml"; }

/// Finite elements solve for one instant.
void require_instant(const Scene& scene, const std::filesystem::path& file) {
  if (!has_averaged_field(scene)) return;
  throw InputError(fmt::format(
      "{}: has an averaged ac field; vehd check accepts fields that are followed in time, without \"average\"",
      file.string()));
}

/// They know a membrane that bends alike everywhere, and one capacitance where V_m follows from charges.
void require_known_places(const Scene& scene, const std::filesystem::path& file) {
  const auto refuse = [&](const std::string& problem) {
    throw InputError(fmt::format("{}: {}", file.string(), problem));
  };
  for (const Scene& one : each_alone(scene)) {
    if (one.membrane.bending_by_place || one.membrane.curvature_by_place) {
      refuse(
          "has a membrane that bends differently from place to place; vehd check accepts [membrane] without "
          "\"bending_by_place\" and \"curvature_by_place\"");
    }
    if (one.membrane.capacitance_by_place && has_relaxing_charge(one)) {
      refuse(
          "has a capacitance that differs from place to place, with displacement currents; vehd check accepts one of "
          "them");
    }
  }
}

void require_start(const std::filesystem::path& file, const std::optional<std::string>& time) {
  // Of a time that is not 0 the unit does not matter.
  UnitsScene any;
  any.time = 1.0;
  if (!time || number_of_time(*time, any, OutputUnit{}) == 0.0) return;
  throw InputError(fmt::format("{}: a scene has no state at time {}; run it and give its run.h5, or leave --time out",
                               file.string(), *time));
}

SnapshotChoice choice_of(const RunReader& run, const std::filesystem::path& file,
                         const std::optional<std::string>& time) {
  if (!time) return choose_snapshot(run, file, std::nullopt);
  const GivenTimes times(run, file);
  return choose_snapshot(run, file, times.number_of(*time), times.shown());
}

/// In the laboratory, where the finite elements are as well.
Symmetry symmetry_of(const Scene& scene, const FrozenState& frozen) {
  return scene.numerics.symmetry == SymmetryUse::off ? Symmetry{} : find_symmetry(frozen.model, frozen.state);
}

FrozenState start_of_scene(const SceneSource& source) {
  const Scene scene = read_scene(source);
  require_few_vesicles(n_vesicles(scene), source.file, "vehd check");
  require_instant(scene, source.file);
  require_known_places(scene, source.file);
  FrozenState frozen;
  frozen.source = source.file.string();
  frozen.model = model_of(scene);
  const Problem problem = problem_of(scene);
  Instruments instruments;
  Evolution evolution(setup_of(problem), problem.start, instruments);
  evolution.evaluate_start();
  frozen.fields = in_laboratory(problem.frame, evolution.evaluation().fields);
  frozen.state = in_laboratory(problem.frame, evolution.state());
  frozen.symmetry = symmetry_of(scene, frozen);
  frozen.settings = settings_of(scene);
  frozen.names = vesicle_names(scene);
  return frozen;
}

/// What differs from place to place, and the state of poration.
/// @param read  coefficients of a field of the snapshot, empty where it has none
template <typename Read>
void take_membrane(const MembraneScene& scene, const Read& read, VesicleModel& of_model, VesicleState& vesicle,
                   VesicleFields& fields) {
  vesicle.material.capacitance = read("capacitance", 1);
  vesicle.material.pump_current = read("pump_current", 1);
  // The file has the sum of what porates and what conducts there anyway.
  if (scene.conductance_by_place) of_model.reaction.reset();
  if (of_model.reaction) {
    vesicle.poration = read("poration", 1);
    fields.conductance = read("conductance", 1);
  } else {
    vesicle.material.conductance = read("conductance", 1);
  }
}

/// One vesicle of a snapshot.
void read_vesicle(const RunReader& run, std::size_t snapshot, std::size_t number, const MembraneScene& scene,
                  FrozenState& frozen) {
  const auto read = [&](const std::string& name, Index components) {
    return run.has_field(snapshot, name) ? run.coefficients(snapshot, name, components, number) : Matrix();
  };
  VesicleState& vesicle = frozen.state.vesicles.emplace_back();
  vesicle.position = run.coefficients(snapshot, "x", 3, number);
  vesicle.area_strain = Vector::Zero(vesicle.position.rows());
  VesicleModel& of_model = frozen.model.vesicles[number];
  if (of_model.inextensible) vesicle.tension = Vector::Zero(vesicle.position.rows());
  VesicleFields& fields = frozen.fields.vesicles.emplace_back();
  fields.velocity = read("velocity", 3);
  fields.force_bending = read("force_bending", 3);
  fields.force_tension = read("force_tension", 3);
  fields.force_electric = read("force_electric", 3);
  fields.force_contact = read("force_contact", 3);
  fields.tension = read("tension", 1);
  fields.charge = read("q", 1);
  if (relaxes_charge(frozen.model)) {
    fields.potential = run.coefficients(snapshot, "Vm", 1, number);
    fields.free_charge_in = run.coefficients(snapshot, "free_charge_in", 1, number);
    fields.free_charge_out = run.coefficients(snapshot, "free_charge_out", 1, number);
    const double capacitance = of_model.charging.capacitance;
    vesicle.transmembrane_potential = fields.free_charge_in / capacitance;
    vesicle.free_charge = (fields.free_charge_in + fields.free_charge_out) / capacitance;
  } else if (frozen.model.electric) {
    vesicle.transmembrane_potential = run.coefficients(snapshot, "Vm", 1, number);
  }
  take_membrane(scene, read, of_model, vesicle, fields);
  // The file continues them by zeros to its own degree, at which nothing was solved.
  const int degree = run.degree(snapshot, number);
  vesicle = resized(std::move(vesicle), degree);
  fields = resized(std::move(fields), degree);
}

FrozenState snapshot_of_run(const std::filesystem::path& file, const std::optional<std::string>& time) {
  const RunReader run(file);
  require_few_vesicles(run.n_vesicles(), file, "vehd check");
  const SnapshotChoice choice = choice_of(run, file, time);
  const std::size_t snapshot = choice.snapshot;
  run.require_sealed(snapshot);
  const Scene scene = parse_scene(run.scene(), file.string() + " (scene)", file.parent_path());
  require_instant(scene, file);
  require_known_places(scene, file);
  FrozenState frozen;
  frozen.source = file.string();
  frozen.note = choice.note;
  frozen.model = model_of(scene);
  frozen.names = vesicle_names(scene);
  frozen.state.time = run.times()[snapshot];
  const std::vector<Scene> alone = each_alone(scene);
  for (std::size_t a = 0; a < run.n_vesicles(); ++a) read_vesicle(run, snapshot, a, alone[a].membrane, frozen);
  frozen.symmetry = symmetry_of(scene, frozen);
  frozen.settings = settings_of(scene);
  return frozen;
}

}  // namespace

FrozenState read_frozen_state(const SceneSource& source, const std::optional<std::string>& time) {
  if (is_scene(source.file)) {
    require_start(source.file, time);
    return start_of_scene(source);
  }
  if (source.settings.empty()) return snapshot_of_run(source.file, time);
  throw InputError(
      fmt::format("--set {}: {} is a run, which has the values that it was made with; accepted: with a "
                  "scene (.toml)",
                  source.settings.front(), source.file.string()));
}

FrozenShape read_frozen_shape(const std::filesystem::path& file, const std::optional<std::string>& time) {
  if (is_scene(file)) {
    require_start(file, time);
    const Scene scene = read_scene(file);
    require_few_vesicles(n_vesicles(scene), file, "vehd mesh");
    FrozenShape shape;
    for (const Scene& one : each_alone(scene)) shape.positions.push_back(initial_position(one));
    return shape;
  }
  const RunReader run(file);
  require_few_vesicles(run.n_vesicles(), file, "vehd mesh");
  const SnapshotChoice choice = choice_of(run, file, time);
  FrozenShape shape;
  shape.note = choice.note;
  for (std::size_t a = 0; a < run.n_vesicles(); ++a) {
    const Matrix position = run.coefficients(choice.snapshot, "x", 3, a);
    shape.positions.push_back(resize_order(position, run.degree(choice.snapshot, a)));
  }
  return shape;
}

}  // namespace vehd
