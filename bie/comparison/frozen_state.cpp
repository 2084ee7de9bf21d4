#include "bie/comparison/frozen_state.hpp"

#include <fmt/format.h>

#include <cmath>

#include "bie/comparison/stored_copies.hpp"
#include "bie/files/run_reader.hpp"
#include "bie/geometry/surface.hpp"
#include "bie/physics/effects/undulations.hpp"
#include "bie/runs/given_times.hpp"
#include "bie/runs/run_files.hpp"
#include "bie/scene/given_time.hpp"
#include "bie/scene/model_of.hpp"
#include "bie/scene/problem.hpp"
#include "bie/scene/reader.hpp"
#include "bie/scene/shapes/initial_shape.hpp"
#include "bie/scene/shapes/placement.hpp"
#include "bie/scene/vesicles.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/evolution.hpp"
#include "bie/stepping/state/state.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

void require_few_vesicles(std::size_t n, const std::filesystem::path& file, const std::string& who) {
  if (n <= most_checked_vesicles) return;
  throw InputError(fmt::format("{}: has {} vesicles; {} accepts one or two", file.string(), n, who));
}

/// Refuses an invalid shape before a solver or a mesher uses it.
/// @param what  "scene.toml: the shape", for the message
void require_outward(const std::string& what, const Matrix& position) {
  const int order = order_of(position.rows());
  const Surface surface = make_surface(SphereTransform(order, make_grid(2 * order)), position);
  const Vector& area = surface.area_element;
  const double volume = enclosed_volume(surface);
  if (area.allFinite() && !(area.minCoeff() > 0.0)) {
    throw InputError(fmt::format("{} is not a surface: its area element vanishes somewhere", what));
  }
  if (!area.allFinite() || !std::isfinite(volume)) {
    throw InputError(fmt::format("{} is too large: its area or its volume is not finite", what));
  }
  if (volume > 0.0) return;
  throw InputError(fmt::format(
      "{} encloses the volume {:.6g}; accepted: a positive one, with x_θ × x_φ pointing outwards", what, volume));
}

bool is_scene(const std::filesystem::path& file) { return file.extension() == ".toml"; }

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& problem) {
  throw InputError(fmt::format("{}: {}", file.string(), problem));
}

/// The finite-element side supports one vesicle beside a wall, which must act on the flow and the field of the scene.
void require_known_wall(const Scene& scene, const std::filesystem::path& file, const std::string& who) {
  if (!scene.wall) return;
  if (n_vesicles(scene) > 1) refuse(file, "has two vesicles and a wall; " + who + " accepts one vesicle beside a wall");
  const Model model = model_of(scene);
  if (model.mobile && model.wall->flow == WallFlow::none) {
    refuse(file,
           "has a wall without effect on the flow; " + who + " accepts \"flow\" no-slip or stress-free in [wall]");
  }
  if (model.electric && model.wall->field == WallField::none) {
    refuse(file,
           "has a wall without effect on the field; " + who + " accepts \"field\" insulating or electrode in [wall]");
  }
}

/// The finite-element side solves for one instant, with a uniform bending modulus and spontaneous curvature, and with a
/// uniform capacitance if V_m follows from charges.
void require_known_effects(const Scene& scene, const std::filesystem::path& file) {
  if (has_averaged_field(scene)) {
    refuse(file, "has an averaged ac field; vehd check accepts fields that are followed in time, without \"average\"");
  }
  for (const Scene& one : each_alone(scene)) {
    if (one.membrane.varying_bending || one.membrane.varying_curvature) {
      refuse(file,
             "has a spatially varying bending modulus or spontaneous curvature; vehd check accepts [membrane] without "
             "\"varying_bending\" and \"varying_curvature\"");
    }
    if (one.membrane.varying_capacitance && has_relaxing_charge(one)) {
      refuse(file,
             "has a spatially varying capacitance, with displacement currents; vehd check accepts one "
             "of them");
    }
  }
}

void require_start(const std::filesystem::path& file, const std::optional<std::string>& time) {
  // For a time that is not 0 the unit does not matter.
  UnitsScene any;
  any.time = 1.0;
  if (!time || number_of_time(*time, any, OutputUnit{}) == 0.0) return;
  throw InputError(fmt::format("{}: a scene has no state at time {}; run it and give its run.h5, or leave --time out",
                               file.string(), *time));
}

std::size_t choice_of(const RunReader& run, const std::filesystem::path& file, const std::optional<std::string>& time,
                      ReadingNotes& notes) {
  if (!time) return choose_snapshot(run, file, std::nullopt).snapshot;
  const GivenTimes times(run, file);
  const SnapshotChoice choice = choose_snapshot(run, file, times.number_of(*time), times.shown());
  if (!choice.note.empty()) notes.push_back(choice.note);
  return choice.snapshot;
}

void require_same_vesicles(const RunReader& run, const Scene& scene) {
  const std::size_t n = run.n_vesicles();
  if (n == n_vesicles(scene)) return;
  throw InputError(fmt::format("{}: has {} vesicle{} in its snapshots, and its scene has {}", run.name(), n,
                               n == 1 ? "" : "s", n_vesicles(scene)));
}

/// A scene, or a snapshot of a run with its scene.
struct FrozenSource {
  std::filesystem::path file;
  std::optional<RunReader> run{};  ///< absent for the start of a scene, as is the snapshot
  std::size_t number = 0;          ///< number of the snapshot
  std::optional<RunSnapshot> snapshot{};
  ReadingNotes notes{};
  std::string time_text = "0";  ///< of the snapshot, in the unit in which times of the run are given
  Scene scene{};

  /// @param who  command that accepts one or two vesicles
  FrozenSource(const SceneSource& source, const std::optional<std::string>& time, const std::string& who)
      : file(source.file) {
    if (is_scene(file)) {
      require_start(file, time);
      scene = read_scene(source);
      require_few_vesicles(n_vesicles(scene), file, who);
    } else {
      run.emplace(read_snapshots(file, notes));
      require_few_vesicles(run->n_vesicles(), file, who);
      number = choice_of(*run, file, time, notes);
      snapshot.emplace(run->snapshot(number));
      time_text = shown_time(snapshot->time(), GivenTimes(*run, file).shown());
      scene = parse_scene(run->scene(), file.string() + " (scene)", file.parent_path());
      require_same_vesicles(*run, scene);
    }
    require_known_wall(scene, file, who);
  }
  FrozenSource(const FrozenSource&) = delete;
  FrozenSource& operator=(const FrozenSource&) = delete;

  /// @throws InputError if the shape of a vesicle is invalid
  void require_outward_shape(std::size_t vesicle, const Matrix& position) const {
    if (run) {
      const std::string of_one = run->n_vesicles() < 2 ? "" : fmt::format(" of vesicle {:02}", vesicle);
      require_outward(fmt::format("{}: x{} at time {}", run->name(), of_one, time_text), position);
    } else {
      const std::vector<std::string> names = vesicle_names(scene);
      const std::string of_one = names.size() < 2 ? "" : fmt::format(" of \"{}\"", names[vesicle]);
      require_outward(fmt::format("{}: the shape{}", file.string(), of_one), position);
    }
  }
};

void start_scene(const FrozenSource& origin, FrozenState& frozen) {
  const Problem problem = problem_of(origin.scene);
  for (std::size_t a = 0; a < problem.start.size(); ++a) {
    frozen.model.vesicles[a].undulations = problem.model.vesicles[a].undulations;
    origin.require_outward_shape(a, problem.start[a].position);
  }
  Instruments instruments;
  Evolution evolution(setup_of(problem), problem.start, instruments);
  evolution.evaluate_start();
  frozen.fields = in_laboratory(problem.frame, evolution.evaluation().fields);
  frozen.state = in_laboratory(problem.frame, evolution.state());
}

/// Reads one vesicle of a snapshot: every field that a run of this scene writes, so that none can be missing.
class VesicleOfSnapshot {
 public:
  VesicleOfSnapshot(const FrozenSource& origin, std::size_t vesicle)
      : source_(origin), snapshot_(*origin.snapshot), vesicle_(vesicle) {}

  /// @param scene  of this vesicle alone
  void read(const Scene& scene, FrozenState& frozen) const {
    const MembraneScene& membrane = scene.membrane;
    const Model& model = frozen.model;
    VesicleModel& of_model = frozen.model.vesicles[vesicle_];
    VesicleState& state = frozen.state.vesicles.emplace_back();
    VesicleFields& fields = frozen.fields.vesicles.emplace_back();
    const bool electric = model.electric.has_value(), tense = model.mobile && of_model.inextensible;
    state.position = coefficients("x", 3);
    source_.require_outward_shape(vesicle_, state.position);
    state.area_strain = Vector::Zero(state.position.rows());
    if (of_model.inextensible) state.tension = Vector::Zero(state.position.rows());
    fields.velocity = coefficients("velocity", 3, model.mobile);
    fields.force_bending = coefficients("force_bending", 3, model.mobile && of_model.bending);
    fields.force_tension = coefficients("force_tension", 3, tense);
    fields.tension = coefficients("tension", 1, tense);
    fields.force_contact = coefficients("force_contact", 3, model.contact.has_value());
    fields.force_electric = coefficients("force_electric", 3, electric);
    fields.charge = coefficients("q", 1, electric);
    if (electric) read_potential(relaxes_charge(model), of_model.charging.capacitance, state, fields);
    state.material.capacitance = coefficients("capacitance", 1, electric && membrane.varying_capacitance);
    state.material.pump_current = coefficients("pump_current", 1, electric && membrane.pump);
    // The stored conductance is the sum of those of the pores and of the membrane.
    if (membrane.varying_conductance) of_model.reaction.reset();
    state.material.conductance = coefficients("conductance", 1, electric && membrane.varying_conductance);
    state.poration = coefficients("poration", 1, of_model.reaction != nullptr);
    fields.conductance = coefficients("conductance", 1, of_model.reaction != nullptr);
    // In the file they are continued by zeros to its own degree, at which nothing was solved.
    const int degree = snapshot_.degree(vesicle_);
    state = resized(std::move(state), degree);
    fields = resized(std::move(fields), degree);
    std::optional<Undulations>& undulations = of_model.undulations;
    // As in the run: otherwise the stored tension would not be judged.
    if (undulations) undulations = with_rest_area(*undulations, size_of(initial_position(scene)).area);
  }

 private:
  void read_potential(bool relaxes, double capacitance, VesicleState& state, VesicleFields& fields) const {
    const Vector potential = coefficients("Vm", 1);
    if (!relaxes) {
      state.transmembrane_potential = potential;
      return;
    }
    fields.potential = potential;
    fields.free_charge_in = coefficients("free_charge_in", 1);
    fields.free_charge_out = coefficients("free_charge_out", 1);
    state.transmembrane_potential = fields.free_charge_in / capacitance;
    state.free_charge = (fields.free_charge_in + fields.free_charge_out) / capacitance;
  }

  /// @param is_written  whether a run of this scene writes the field; if not, the result is empty
  [[nodiscard]] Matrix coefficients(const std::string& name, Index components, bool is_written = true) const {
    return is_written ? snapshot_.coefficients(name, components, vesicle_) : Matrix();
  }

  const FrozenSource& source_;
  const RunSnapshot& snapshot_;
  std::size_t vesicle_;
};

void take_snapshot(const FrozenSource& origin, FrozenState& frozen) {
  frozen.state.time = origin.snapshot->time();
  const std::vector<Scene> alone = each_alone(origin.scene);
  for (std::size_t a = 0; a < alone.size(); ++a) VesicleOfSnapshot(origin, a).read(alone[a], frozen);
  require_copies(*origin.run, origin.number);
}

}  // namespace

FrozenState read_frozen_state(const SceneSource& source, const std::optional<std::string>& time) {
  if (!is_scene(source.file) && !source.settings.empty()) {
    throw InputError(
        fmt::format("--set {}: {} is a run, which has the values that it was made with; accepted: with a "
                    "scene (.toml)",
                    source.settings.front(), source.file.string()));
  }
  const FrozenSource origin(source, time, "vehd check");
  const Scene& scene = origin.scene;
  require_known_effects(scene, origin.file);
  FrozenState frozen;
  frozen.source = origin.file.string();
  frozen.model = model_of(scene);
  frozen.notes = origin.notes;
  frozen.time_text = origin.time_text;
  frozen.names = vesicle_names(scene);
  frozen.settings = settings_of(scene);
  origin.run ? take_snapshot(origin, frozen) : start_scene(origin, frozen);
  // In the laboratory frame, which the finite elements use.
  if (scene.numerics.symmetry != SymmetryUse::off) frozen.symmetry = find_symmetry(frozen.model, frozen.state);
  return frozen;
}

FrozenShape read_frozen_shape(const std::filesystem::path& file, const std::optional<std::string>& time) {
  const FrozenSource origin({file, {}}, time, "vehd mesh");
  FrozenShape shape;
  shape.source = file.string();
  shape.wall = model_of(origin.scene).wall;
  shape.notes = origin.notes;
  const std::vector<Scene> alone = each_alone(origin.scene);
  for (std::size_t a = 0; a < alone.size(); ++a) {
    if (origin.snapshot) {
      shape.positions.push_back(resize_order(origin.snapshot->coefficients("x", 3, a), origin.snapshot->degree(a)));
    } else {
      shape.positions.push_back(initial_position(alone[a]));
    }
    origin.require_outward_shape(a, shape.positions.back());
  }
  return shape;
}

}  // namespace vehd
