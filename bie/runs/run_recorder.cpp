#include "bie/runs/run_recorder.hpp"

#include <fmt/format.h>

#include "bie/files/run_file.hpp"
#include "bie/runs/snapshot_copy.hpp"
#include "bie/runs/vesicle_rows.hpp"
#include "bie/scene/reader.hpp"
#include "bie/scene/units.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/space/resolution.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {
namespace {

bool is_late(const std::optional<std::chrono::steady_clock::time_point>& written, std::chrono::milliseconds lag) {
  return !written || std::chrono::steady_clock::now() - *written >= lag;
}

bool has_several(const Checkpoint& checkpoint) { return checkpoint.state.vesicles.size() > 1; }

/// The scene with its origin and its changes as comments at the top.
std::string scene_text(const Checkpoint& start) {
  const std::string scene = with_changes(start.scene, start.changes);
  if (!start.origin) return scene;
  const State& state = start.origin->state;
  return fmt::format("# from {} at time {:g} (step {})\n{}", start.origin->run, state.time, state.step, scene);
}

/// Starts the files of a session. Existing ones are intact, see require_intact. The checkpoint comes first, so that a
/// kill at any point leaves a run that can be resumed.
Checkpoint written(const RunPaths& paths, Checkpoint start, HistoryKind kind) {
  if (start.n_snapshots > 0) {
    // Different if a killed session had already written the same snapshots at another degree.
    start.snapshots_checksum = RunReader(paths.snapshots()).checksum(static_cast<std::size_t>(start.n_snapshots));
  }
  if (start.history_bytes > 0) require_columns(paths.history(), kind);
  if (start.vesicles_bytes > 0) require_columns(paths.vesicles(), of_each_like(kind));
  if (start.companion && start.companion->bytes > 0) require_columns(paths.history_error(), kind);
  write_checkpoint(paths.checkpoint(), start);
  replace_file(paths.scene(), scene_text(start));
  return start;
}

/// Snapshots of the last session, converted to the degree of this one.
SnapshotStore::Kept kept_snapshots(const RunPaths& paths, const SphereTransform& output, const Checkpoint& start,
                                   const SiUnits& si_units) {
  SnapshotStore::Kept kept{start.n_snapshots, start.snapshots_checksum, {}};
  if (start.n_snapshots == 0) return kept;
  const auto present = std::make_shared<const RunReader>(paths.snapshots());
  if (present->order() == output.order()) return kept;
  kept.convert = [present, &output, &si_units](Hdf5Writer& file, std::size_t number) {
    return copy_snapshot(file, *present, number, output, si_units);
  };
  return kept;
}

SnapshotStore::WriteHeader header_writer(const SphereTransform& output, const Checkpoint& start,
                                         const SiUnits& si_units) {
  return [&output, header = RunHeader{scene_text(start), static_cast<int>(start.threads), si_units}](Hdf5Writer& file) {
    write_run_header(file, output, header);
  };
}

/// Lists the fields of the snapshots. @param has  whether the snapshots have this dataset
template <typename Predicate>
void name_fields(XdmfSeries& series, const Predicate& has) {
  for (const auto& [name, is_vector] : snapshot_fields()) {
    // x is already the geometry of the surface.
    if (name != "x" && has("surface/" + name)) (is_vector ? series.vectors : series.scalars).push_back(name);
  }
}

/// Corners of a square of the wall below the vesicles, which extends some radii beyond them.
/// @param x  coefficients of each vesicle
Matrix square_of(const Wall& wall, const std::vector<Matrix>& x, double radius) {
  constexpr double radii_beyond = 5.0;
  Matrix middles(std::ssize(x), 3);
  for (Index a = 0; a < middles.rows(); ++a) {
    middles.row(a) = mean_vector(x[static_cast<std::size_t>(a)]).transpose();
  }
  const Eigen::RowVector3d middle = middles.colwise().mean();
  const double half = radii_beyond * radius + (middles.rowwise() - middle).rowwise().norm().maxCoeff();
  const Vector3 foot = middle.transpose() - wall.height(middle.transpose()) * wall.normal;
  const Vector3 along = half * wall.normal.unitOrthogonal(), across = wall.normal.cross(along);
  Matrix corners(4, 3);
  corners << (foot + along + across).transpose(), (foot - along + across).transpose(),
      (foot - along - across).transpose(), (foot + along - across).transpose();
  return corners;
}

std::vector<Matrix> positions_of(const State& state) {
  std::vector<Matrix> x;
  for (const VesicleState& vesicle : state.vesicles) x.push_back(vesicle.position);
  return x;
}

}  // namespace

RunRecorder::RunRecorder(const RunPaths& paths, const NumericalSettings& settings, const Frame& frame,
                         const Checkpoint& start, const OutputUnits& units, HistoryKind kind, std::optional<Wall> wall,
                         std::chrono::milliseconds checkpoint_lag)
    : paths_(paths),
      si_units_(si_units_of(parse_units(start.scene, "scene"))),
      output_(settings.order, make_grid(settings.order)),
      lab_frame_(frame, settings),
      last_(written(paths, start, kind)),
      snapshots_(paths.snapshots(), header_writer(output_, start, si_units_),
                 kept_snapshots(paths, output_, last_, si_units_)),
      history_(paths.history(), start.history_bytes, start.history_checksum, units, kind),
      wall_(std::move(wall)),
      checkpoint_lag_(checkpoint_lag) {
  if (has_several(start)) {
    vesicles_.emplace(paths.vesicles(), start.vesicles_bytes, start.vesicles_checksum, units, of_each_like(kind));
  }
  if (start.companion) {
    errors_.emplace(paths.history_error(), start.companion->bytes, start.companion->checksum, units, kind);
  }
  xdmf_.n_vesicles = start.state.vesicles.size();
  const SphereGrid& grid = output_.grid();
  xdmf_.n_points = grid.n_points() + 2;
  xdmf_.n_triangles = Index{2} * grid.n_theta * grid.n_phi;
  if (start.n_snapshots == 0) return;
  const RunReader run(paths.snapshots());
  for (std::size_t number = 0; number < static_cast<std::size_t>(start.n_snapshots); ++number) {
    std::vector<Matrix> x;
    for (std::size_t a = 0; wall_ && a < run.n_vesicles(); ++a) {
      x.push_back(run.snapshot(number).coefficients("x", 3, a));
    }
    list_in_xdmf(run.times()[number], x);
  }
  const std::string first = vesicle_groups(run.file(), "/snapshots/" + snapshot_name(0)).front();
  name_fields(xdmf_, [&](const std::string& name) { return run.file().has(first + "/" + name); });
}

void RunRecorder::record(const State& state, const std::vector<RecordedSide>& sides, const RunTotals& totals) {
  for (const RecordedSide& side : sides) {
    const HistoryRow shown = row_in_laboratory(lab_frame_, output_.order(), side);
    history_.append(vesicles_ ? row_of_all(shown) : shown);
    if (vesicles_) {
      for (const HistoryRow& own : rows_of_each(shown)) vesicles_->append(own);
    }
    ++last_.n_rows;
    if (side.row.step.at_snapshot) waiting_.push_back({side.state, side.fields});
  }
  last_.state = state;
  last_.history_bytes = history_.bytes();
  last_.history_checksum = history_.checksum();
  if (vesicles_) {
    last_.vesicles_bytes = vesicles_->bytes();
    last_.vesicles_checksum = vesicles_->checksum();
  }
  if (is_late(snapshots_written_, longest_lag_of_files)) write_snapshots();
  // Writing it after every short step takes a tenth of a run, and a quarter of the time that error bars add.
  if (is_late(saved_, checkpoint_lag_)) save(totals);
}

void RunRecorder::record_errors(const std::vector<Vector>& rows, CompanionState companion) {
  for (const Vector& row : rows) errors_->append(row);
  companion.bytes = errors_->bytes();
  companion.checksum = errors_->checksum();
  last_.companion = std::move(companion);
}

void RunRecorder::keep_last_state(const Fields& fields) {
  write_snapshots();
  if (xdmf_.times.empty() || xdmf_.times.back() >= last_.state.time) return;
  waiting_.push_back({last_.state, fields});
  write_snapshots();
}

/// Writes the waiting snapshots.
void RunRecorder::write_snapshots() {
  if (waiting_.empty()) return;
  snapshots_.add(waiting_.size(), [&](Hdf5Writer& file, const std::string& name, std::size_t i) {
    const std::int64_t checksum = write_snapshot(file, name, output_, lab_frame_.state(waiting_[i].state),
                                                 lab_frame_.fields(waiting_[i].fields), si_units_);
    const std::string first = "/snapshots/" + name + (vesicles_ ? "/vesicles/" + vesicle_group(0) : "");
    const auto has = [&](const std::string& field) { return file.has(first + "/" + field); };
    if (xdmf_.scalars.empty() && xdmf_.vectors.empty()) name_fields(xdmf_, has);
    return checksum;
  });
  for (const Snapshot& written : waiting_) {
    list_in_xdmf(written.state.time, positions_of(lab_frame_.state(written.state)));
  }
  waiting_.clear();
  snapshots_written_ = std::chrono::steady_clock::now();
  // Its length grows with the run, and checkpoints can write snapshots after every step.
  if (is_late(xdmf_written_, longest_lag_of_files)) write_xdmf();
}

void RunRecorder::end_session(const RunTotals& totals) {
  save(totals);
  if (!xdmf_.times.empty()) write_xdmf();
}

void RunRecorder::save(const RunTotals& totals) {
  write_snapshots();
  last_.n_snapshots = snapshots_.size();
  last_.snapshots_checksum = snapshots_.checksum();
  last_.totals = totals;
  write_checkpoint(paths_.checkpoint(), last_);
  saved_ = std::chrono::steady_clock::now();
}

void RunRecorder::list_in_xdmf(double time, const std::vector<Matrix>& x) {
  xdmf_.times.push_back(time);
  if (!wall_) return;
  double radius = 0.0;
  for (const VesicleState& vesicle : last_.state.vesicles) radius = std::max(radius, vesicle.radius());
  xdmf_.walls.push_back(square_of(*wall_, x, radius));
}

void RunRecorder::write_xdmf() {
  replace_file(paths_.xdmf(), xdmf_text(xdmf_));
  xdmf_written_ = std::chrono::steady_clock::now();
}

}  // namespace vehd
