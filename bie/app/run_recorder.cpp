#include "bie/app/run_recorder.hpp"

#include "bie/app/file_system.hpp"
#include "bie/app/run_file.hpp"
#include "bie/scene/hdf5_reader.hpp"
#include "bie/stepping/resolution.hpp"

namespace vehd {
namespace {

/// Nothing is touched before the files of the run to continue are known to be intact. Then the checkpoint comes first:
/// whatever a kill leaves behind can be resumed.
const Checkpoint& written(const RunPaths& paths, const Checkpoint& start) {
  if (start.n_snapshots > 0) require_snapshots(paths.snapshots(), start.n_snapshots, start.snapshots_checksum);
  require_history(paths.history(), start.history_bytes, start.history_checksum);
  write_checkpoint(paths.checkpoint(), start);
  replace_file(paths.scene(), start.scene);
  return start;
}

SnapshotStore::WriteHeader header_writer(const Discretisation& discretisation, const Checkpoint& start) {
  return [&discretisation, header = RunHeader{start.scene, static_cast<int>(start.threads)}](Hdf5Writer& file) {
    write_run_header(file, discretisation, header);
  };
}

}  // namespace

RunRecorder::RunRecorder(const RunPaths& paths, const Discretisation& discretisation, const Frame& frame,
                         const Checkpoint& start)
    : paths_(paths),
      discretisation_(discretisation),
      laboratory_(frame, discretisation.settings()),
      last_(written(paths, start)),
      snapshots_(paths.snapshots(), header_writer(discretisation, start), start.n_snapshots, start.snapshots_checksum),
      history_(paths.history(), start.history_bytes, start.history_checksum) {
  const SphereGrid& grid = discretisation.transform().grid();
  xdmf_.n_points = grid.n_points() + 2;
  xdmf_.n_triangles = Index{2} * grid.n_theta * grid.n_phi;
  const Hdf5Reader file(paths.snapshots());
  for (std::int64_t number = 0; number < start.n_snapshots; ++number) {
    xdmf_.times.push_back(file.number_attribute("/snapshots/" + snapshot_name(number), "time"));
  }
}

void RunRecorder::record(HistoryRow row, const State& state, const Fields& fields, const RunTotals& totals) {
  const State full_state = resized(state, discretisation_.order());
  const Fields full_fields = resized(fields, discretisation_.order());
  row.diagnostics = laboratory_.diagnostics(row.diagnostics, full_state, full_fields);
  history_.append(row);
  if (row.step.at_snapshot) {
    snapshots_.add([&](Hdf5Writer& file, const std::string& name) {
      return write_snapshot(file, name, discretisation_, laboratory_.state(full_state),
                            laboratory_.fields(full_fields));
    });
    write_xdmf(state, fields);
  }
  last_.state = state;
  ++last_.n_rows;
  last_.history_bytes = history_.bytes();
  last_.history_checksum = history_.checksum();
  last_.n_snapshots = snapshots_.size();
  last_.snapshots_checksum = snapshots_.checksum();
  update_totals(totals);
}

void RunRecorder::update_totals(const RunTotals& totals) {
  last_.totals = totals;
  write_checkpoint(paths_.checkpoint(), last_);
}

void RunRecorder::write_xdmf(const State& state, const Fields& fields) {
  xdmf_.times.push_back(state.time);
  xdmf_.scalars.clear();
  xdmf_.vectors.clear();
  const auto add = [](std::vector<std::string>& names, const char* name, bool present) {
    if (present) names.emplace_back(name);
  };
  add(xdmf_.scalars, "Vm", state.transmembrane_potential.size() > 0);
  add(xdmf_.scalars, "q", fields.charge.size() > 0);
  add(xdmf_.scalars, "tension", fields.tension.size() > 0);
  add(xdmf_.vectors, "velocity", fields.velocity.size() > 0);
  add(xdmf_.vectors, "force_bending", fields.force_bending.size() > 0);
  add(xdmf_.vectors, "force_tension", fields.force_tension.size() > 0);
  add(xdmf_.vectors, "force_electric", fields.force_electric.size() > 0);
  replace_file(paths_.xdmf(), xdmf_text(xdmf_));
}

}  // namespace vehd
