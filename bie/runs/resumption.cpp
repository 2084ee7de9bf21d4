#include "bie/runs/resumption.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bie/files/run_reader.hpp"
#include "bie/runs/scene_changes.hpp"
#include "bie/scene/key_lookup.hpp"
#include "bie/scene/model_of.hpp"
#include "bie/scene/output_units.hpp"
#include "bie/scene/problem.hpp"
#include "bie/scene/reader.hpp"
#include "bie/scene/schema.hpp"
#include "bie/sphere/degrees.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/evolution.hpp"
#include "bie/stepping/space/resolution.hpp"
#include "bie/stepping/state/state.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

Scene stored_scene(const Checkpoint& checkpoint, const RunPaths& paths) {
  return parse_scene(checkpoint.scene, paths.checkpoint().string() + " (scene)", paths.directory);
}

bool may_change(const std::string& key) { return key.starts_with("numerics.") || key.starts_with("output."); }

/// Compares a scene with that of the run which it continues.
struct Comparison {
  const Scene& scene;
  const SceneSource& source;
  const Scene& stored;
  const RunPaths& run;

  [[noreturn]] void refuse(const std::string& key, const std::string& why) const {
    throw InputError(fmt::format("{}: \"{}\" is {}, but the run in {} has {}; {}", key_place(source, key), key,
                                 shown(value_of(scene, key)), run.directory.string(), shown(value_of(stored, key)),
                                 why));
  }

  void require_end_after(double time) const {
    if (scene.numerics.end_time >= time) return;
    const OutputUnit unit = OutputUnits(scene).of("time");
    throw InputError(
        fmt::format("{}: \"numerics.end_time\" is {}, but the run in {} has already reached {}; accepted: "
                    "that or later",
                    key_place(source, "numerics.end_time"), unit.text_of(scene.numerics.end_time),
                    run.directory.string(), unit.text_of(time)));
  }
};

/// Whether a key describes the flow or the field that acts on the vesicles.
bool is_of_driving(const std::string& key) {
  return key.starts_with("flow.") || key.starts_with("electric.waveform.") || key == "electric.field" ||
         key == "electric.field_magnitude";
}

/// Degree at which a vesicle continues.
int order_of_state(const Scene& scene, const VesicleState& vesicle) {
  const NumericsScene& numerics = scene.numerics;
  if (!numerics.tolerance) return numerics.order;
  const int lowest = std::max(order_of(vesicle.position.rows()), lowest_adaptive_order);
  return Resolution(model_of(scene), vesicle)
      .order_for(thresholds::truncation_share * *numerics.tolerance, std::min(lowest, numerics.order), numerics.order);
}

State adapted(State state, const Scene& before, const Scene& scene) {
  for (VesicleState& vesicle : state.vesicles) {
    const int order = order_of_state(scene, vesicle);
    vesicle = resized(std::move(vesicle), order);
    if (before.numerics.symmetry != scene.numerics.symmetry) vesicle.recycled = {};
  }
  // 0: with a tolerance the first step size is determined at the start.
  state.dt_next = scene.numerics.tolerance ? 0.0 : *scene.numerics.dt;
  return without_past(std::move(state));
}

}  // namespace

void require_same_physics(const Scene& scene, const SceneSource& source, const Checkpoint& checkpoint,
                          const RunPaths& paths) {
  const Scene stored = stored_scene(checkpoint, paths);
  const Comparison comparison{scene, source, stored, paths};
  const auto refuse = [&](const std::string& key, const std::string& why) { comparison.refuse(key, why); };
  for (const std::string& key : differing_keys(stored, scene)) {
    if (!may_change(key)) {
      refuse(key, "--resume accepts changes of [numerics] and [output] alone: keep the value or choose another -o");
    }
    const bool has_bars = stored.numerics.error_bars || scene.numerics.error_bars;
    if (has_bars && checkpoint.state.step > 0 && key.starts_with("numerics.") && key != "numerics.end_time") {
      refuse(key, "error_bars compare two runs from the start: keep the value or choose another -o");
    }
    if (key == "output.units") refuse(key, "history.csv keeps the units of its first session: keep the value");
    if (key == "numerics.symmetry" && stored.numerics.symmetry == SymmetryUse::off) {
      refuse(key, "a state that was computed without symmetry need not have any: keep \"off\" or choose another -o");
    }
  }
  comparison.require_end_after(checkpoint.state.time);
}

Checkpoint continued_from(const RunPaths& run, const Scene& scene, const SceneSource& source) {
  const std::string directory = run.directory.string();
  if (!std::filesystem::exists(run.checkpoint())) {
    throw InputError(fmt::format("{}: holds no run that can be continued: it has no checkpoint.h5", directory));
  }
  const Checkpoint before = read_checkpoint(run.checkpoint());
  if (before.state.step == 0) throw InputError(fmt::format("{}: the run has taken no step yet", directory));
  const Scene stored = stored_scene(before, run);
  const Comparison comparison{scene, source, stored, run};
  for (const std::string& key : differing_keys(stored, scene)) {
    if (!may_change(key) && !is_of_driving(key)) {
      comparison.refuse(key,
                        "--from accepts changes of [flow], of field and waveform in [electric], of [numerics] and of "
                        "[output]: keep the value, or start from the shape with kind = \"file\"");
    }
  }
  if (has_averaged_field(stored) != has_averaged_field(scene)) {
    comparison.refuse("electric.waveform.average", "V_m of an averaged field is not part of the state: keep the value");
  }
  if (scene.numerics.error_bars) {
    throw InputError(
        fmt::format("{}: \"numerics.error_bars\" is true; accepted with --from: false, as error_bars "
                    "compare two runs from the start",
                    key_place(source, "numerics.error_bars")));
  }
  comparison.require_end_after(before.state.time);
  const auto frame_under = [&](const Scene& of, const std::optional<Origin>& origin) {
    return problem_of(of, static_cast<int>(before.start_order), origin ? &origin->state : nullptr).frame;
  };
  State state = without_past(before.state);
  for (VesicleState& vesicle : state.vesicles) vesicle.recycled = {};
  Checkpoint start;
  start.start_order = before.start_order;
  start.changes = changes_between(stored, scene, state.time, state.step);
  start.origin = Origin{std::filesystem::absolute(run.directory).lexically_normal().string(),
                        in_laboratory(frame_under(stored, before.origin), std::move(state))};
  start.state = adapted(in_frame(frame_under(scene, start.origin), start.origin->state), stored, scene);
  return start;
}

SceneSource in_scales_of(SceneSource source, const RunPaths& run) {
  if (!std::filesystem::exists(run.checkpoint()) || !is_given(source, "units")) return source;
  const Scene stored = stored_scene(read_checkpoint(run.checkpoint()), run);
  for (const char* key : {"units.length", "units.time", "units.viscosity", "units.potential"}) {
    const std::string scale = key_text(stored, key);
    if (!scale.empty() && !is_given(source, key)) source.settings.push_back(fmt::format("{}={}", key, scale));
  }
  return source;
}

Checkpoint continued(Checkpoint checkpoint, const Scene& scene, const RunPaths& paths) {
  const Scene before = stored_scene(checkpoint, paths);
  const std::vector<SceneChange> changes = changes_between(before, scene, checkpoint.state.time, checkpoint.state.step);
  // Without a row the start has not been evaluated yet, which may raise its degrees.
  if (changes.empty() && checkpoint.n_rows > 0) return checkpoint;
  checkpoint.changes.insert(checkpoint.changes.end(), changes.begin(), changes.end());
  if (checkpoint.state.step > 0) {
    checkpoint.state = adapted(std::move(checkpoint.state), before, scene);
    return checkpoint;
  }
  Checkpoint restarted;
  restarted.changes = std::move(checkpoint.changes);
  restarted.totals = std::move(checkpoint.totals);
  return restarted;
}

int order_of_files(const Scene& scene, const Checkpoint& checkpoint, const RunPaths& paths) {
  if (checkpoint.n_snapshots == 0) return scene.numerics.order;
  return std::max(scene.numerics.order, RunReader(paths.snapshots()).order());
}

std::string advice_after_failure(const NumericsScene& numerics) {
  const std::string degree = fmt::format("degree (now {})", numerics.order);
  if (numerics.tolerance) {
    return fmt::format("change tolerance (now {:g}) or {} in [numerics]", *numerics.tolerance, degree);
  }
  return fmt::format("change dt (now {:g}), {} or time_order (now {}), or give a tolerance, in [numerics]",
                     *numerics.dt, degree, numerics.time_order);
}

}  // namespace vehd
