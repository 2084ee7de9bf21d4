#include "tests/fuzz/targets.hpp"

#include <sstream>
#include <stdexcept>

#include "bie/comparison/stored_copies.hpp"
#include "bie/estimate/cost.hpp"
#include "bie/files/run_reader.hpp"
#include "bie/runs/checkpoint.hpp"
#include "bie/runs/history.hpp"
#include "bie/scene/effective_scene.hpp"
#include "bie/scene/read/reading_steps.hpp"
#include "bie/scene/reader.hpp"
#include "bie/scene/schema.hpp"
#include "bie/support/errors.hpp"
#include "tests/fuzz/hdf5_edits.hpp"
#include "tests/fuzz/written_numbers.hpp"
#include "tests/support/files.hpp"

namespace fuzz {
namespace {

/// Runs one reader; the only exception allowed is InputError, with a message of one line.
template <typename Reader>
void refuse_or_read(Reader reader) {
  try {
    reader();
  } catch (const vehd::InputError& error) {
    const std::string message = error.what();
    if (message.empty() || message.find('\n') != std::string::npos) {
      throw std::logic_error("not one line: " + message);
    }
  }
}

void read_snapshot(const vehd::RunSnapshot& snapshot) {
  for (const vehd::SnapshotField& field : vehd::snapshot_fields()) {
    if (!snapshot.has_field(field.name)) continue;
    refuse_or_read([&] {
      const vehd::Matrix values = snapshot.coefficients(field.name);
      if (!values.allFinite()) throw std::logic_error("accepted values that are not finite");
    });
    refuse_or_read([&] { (void)snapshot.coefficients(field.name, 3); });
  }
}

/// Everything that plot, mesh, check and a shape file read.
void read_run(vehd::Hdf5Reader file) {
  const vehd::RunReader run(std::move(file));
  refuse_or_read([&] { (void)vehd::parse_scene(run.scene(), "run.h5 (scene)", "."); });
  refuse_or_read([&] { (void)vehd::units_of(run); });
  for (std::size_t snapshot = 0; snapshot < std::min<std::size_t>(run.times().size(), 3); ++snapshot) {
    (void)run.at(run.times()[snapshot]);
    refuse_or_read([&] { read_snapshot(run.snapshot(snapshot)); });
    refuse_or_read([&] { vehd::require_copies(run, snapshot); });
  }
}

/// Plans as `vehd plan` does, in a tenth of its time.
void plan(const vehd::Scene& scene) {
  vehd::RunPlan plan = vehd::plan_of(scene);
  vehd::predict_cost(scene, plan, {.seconds = 0.9});
  if (plan.n_jumps < 0 || plan.n_steps < 0) throw std::logic_error("planned a negative number of steps");
}

}  // namespace

void scene(std::string_view bytes) {
  refuse_or_read([&] {
    const vehd::Scene scene = vehd::parse_scene(std::string(bytes), "scene.toml", "/nonexistent");
    require_written_numbers(std::string(bytes), scene);
    const std::string text = vehd::effective_scene(scene);
    require_written_numbers(text, scene);
    try {
      const vehd::Scene again = vehd::parse_scene(text, "effective.toml", "/nonexistent");
      const auto differing = vehd::differing_keys(scene, again);
      if (!differing.empty()) throw std::logic_error("the effective scene differs in " + differing.front());
    } catch (const vehd::InputError& error) {
      throw std::logic_error(std::string("the effective scene is refused: ") + error.what());
    }
    plan(scene);
  });
}

void tables(std::string_view bytes) {
  refuse_or_read([&] {
    vehd::WaveformScene waveform;
    std::istringstream stream{std::string(bytes)};
    vehd::read_waveform_rows(waveform, stream, "waveform.txt");
    if (waveform.times.size() != waveform.values.size()) throw std::logic_error("times and values differ in number");
  });
  refuse_or_read([&] {
    std::istringstream stream{std::string(bytes)};
    const vehd::HistoryTable history(stream, "history.csv");
    (void)history.column("time");
  });
}

void files(std::string_view bytes) {
  static const TemporaryDirectory directory;
  const std::string path = directory / "file.h5";
  write_text(path, std::string(bytes));
  refuse_or_read([&] { read_run(vehd::Hdf5Reader(std::filesystem::path(path))); });
  refuse_or_read([&] { (void)vehd::read_checkpoint(path); });
}

void edits(std::string_view bytes) {
  const EditedFile file = edited_file(bytes);
  if (file.is_checkpoint) {
    refuse_or_read([&] { (void)vehd::checkpoint_of(file.image, "checkpoint.h5"); });
  } else {
    refuse_or_read([&] { read_run(vehd::Hdf5Reader(file.image, "run.h5")); });
  }
}

}  // namespace fuzz
