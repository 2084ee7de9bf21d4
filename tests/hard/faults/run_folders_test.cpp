#include <boost/test/unit_test.hpp>
#include <functional>
#include <map>
#include <sstream>

#include "bie/comparison/frozen_state.hpp"
#include "bie/pictures/history_panels.hpp"
#include "bie/pictures/plots.hpp"
#include "bie/pictures/report/report.hpp"
#include "bie/runs/run_files.hpp"
#include "bie/runs/session.hpp"
#include "bie/scene/effective_scene.hpp"
#include "bie/scene/reader.hpp"
#include "bie/support/checksum.hpp"
#include "bie/support/errors.hpp"
#include "tests/hard/faults/run_damages.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scenes.hpp"

// Folders of runs, damaged at many places: each reader finds what the run wrote, or refuses with the name of the
// folder, or notes what is not known. All readers run in this process, so a crash fails the test.

namespace {

/// Number of damages; `test_faults -- 200 1000` is the long form.
int wanted_places() {
  const auto& suite = boost::unit_test::framework::master_test_suite();
  return suite.argc > 2 ? std::stoi(suite.argv[2]) : 60;
}

/// Checksum of all that a reader has found, to be compared bit for bit.
class Findings {
 public:
  void add(const std::string& text) {
    checksum_.add(std::to_string(text.size()));
    checksum_.add(text);
  }
  void add(const vehd::Matrix& values) {
    checksum_.add(static_cast<std::int64_t>(values.rows()));
    checksum_.add(std::span(values.data(), static_cast<std::size_t>(values.size())));
  }
  void add(double value) { checksum_.add(std::span(&value, 1)); }
  void add(const vehd::HistoryTable& table) {
    for (const std::string& name : table.names()) {
      add(table.header(name));
      checksum_.add(std::span(table.column(name)));
    }
  }
  vehd::ReadingNotes notes;
  [[nodiscard]] std::int64_t value() const { return checksum_.value(); }

 private:
  vehd::Checksum checksum_;
};

struct RunFolder {
  vehd::RunPaths paths;
  vehd::SceneSource scene;
  std::vector<std::filesystem::path> tables{};  ///< of the intact run
};

/// Everything that the pictures of a run show.
void plot(const RunFolder& folder, Findings& found) {
  const vehd::RunReader run = vehd::read_snapshots(folder.paths.snapshots(), found.notes);
  const vehd::Scene scene = vehd::read_scene_of(run);
  found.add(vehd::effective_scene(scene));
  found.add(vehd::units_of_run(folder.paths, scene.units, found.notes).of("time").symbol);
  for (const vehd::SnapshotChoice& choice : vehd::shapes_to_plot({folder.paths, {}, {}}, run)) {
    const vehd::RunSnapshot snapshot = run.snapshot(choice.snapshot);
    const vehd::ShapeField field = vehd::default_field(snapshot);
    const vehd::ShapeCoefficients shape = vehd::read_shape(snapshot, field);
    found.add(shape.time);
    for (const vehd::VesicleCoefficients& vesicle : shape.vesicles) {
      found.add(vesicle.position);
      found.add(vesicle.field);
    }
  }
  const vehd::HistoryTable history = vehd::read_table(folder.paths.history(), found.notes);
  std::optional<vehd::HistoryTable> errors;
  if (scene.numerics.error_bars) errors = vehd::read_table(folder.paths.history_error(), found.notes);
  for (const vehd::HistoryPanel& panel : vehd::panels_of(scene, history, errors ? &*errors : nullptr)) {
    for (const vehd::HistoryQuantity& quantity : panel.axes) {
      for (const vehd::HistoryCurve& curve : quantity.curves) {
        found.add(curve.label);
        found.add(vehd::Vector(vehd::Vector::Map(curve.values.data(), std::ssize(curve.values))));
      }
    }
  }
}

void report(const RunFolder& folder, Findings& found) {
  found.notes = vehd::write_report({folder.paths, folder.paths.report()}).notes;
  found.add(file_text(folder.paths.report()));
}

/// Reads the tables as read_history of the Python module does.
void read_history(const RunFolder& folder, Findings& found) {
  for (const std::filesystem::path& table : folder.tables) found.add(vehd::read_table(table, found.notes));
}

/// Everything that vehd check reads of a run.
void check(const RunFolder& folder, Findings& found) {
  for (const std::optional<std::string>& time : {std::optional<std::string>(), std::optional<std::string>("0.5")}) {
    const vehd::FrozenState frozen = vehd::read_frozen_state({folder.paths.snapshots(), {}}, time);
    found.notes.insert(found.notes.end(), frozen.notes.begin(), frozen.notes.end());
    found.add(frozen.state.time);
    for (std::size_t a = 0; a < frozen.state.vesicles.size(); ++a) {
      const vehd::VesicleFields& fields = frozen.fields.vesicles[a];
      found.add(frozen.state.vesicles[a].position);
      found.add(frozen.state.vesicles[a].transmembrane_potential);
      for (const vehd::Matrix* field : {&fields.velocity, &fields.force_bending, &fields.force_tension,
                                        &fields.force_electric, &fields.force_contact}) {
        found.add(*field);
      }
      found.add(fields.tension);
      found.add(fields.charge);
    }
  }
}

/// Continues the run to its end, or reads the summary of one that is complete.
void resume(const RunFolder& folder, Findings& found) {
  const vehd::RunSession session(vehd::read_scene(folder.scene), folder.scene, folder.paths.directory, true);
  if (session.is_complete()) {
    found.add(session.last_summary().dump());
  } else {
    vehd::Interruption interruption;
    nlohmann::json summary =
        session.summarise(vehd::simulate(session.task({}, vehd::longest_lag_of_files), interruption));
    for (const char* key : {"seconds", "seconds_per_step", "seconds_of_parts", "peak_memory_bytes", "checksum"})
      summary.erase(key);
    found.add(summary.dump());
  }
  found.add(vehd::HistoryTable(folder.paths.history()));
  const vehd::RunReader run(folder.paths.snapshots());
  found.add(static_cast<double>(run.checksum(run.times().size())));
  for (std::size_t i = 0; i < run.times().size(); ++i) found.add(run.snapshot(i).coefficients("x"));
}

const std::map<std::string, void (*)(const RunFolder&, Findings&)> readers = {
    {"plot", plot}, {"report", report}, {"read_history", read_history}, {"check", check}, {"resume", resume}};

/// "refused: reason", or the checksum of all that was found.
std::string outcome(void (*reader)(const RunFolder&, Findings&), const RunFolder& folder, vehd::ReadingNotes& notes) {
  try {
    Findings found;
    reader(folder, found);
    notes = found.notes;
    return std::to_string(found.value());
  } catch (const vehd::InputError& error) {
    return std::string("refused: ") + error.what();
  }
}

/// A run to be damaged again and again.
class Specimen {
 public:
  /// @param steps  after which the run ends; 0: complete run
  Specimen(const std::string& scene, int steps) {
    write_text(directory_ / "scene.toml", scene);
    const vehd::RunSession session(vehd::read_scene(folder_.scene), folder_.scene, folder_.paths.directory, false);
    vehd::Interruption interruption;
    if (steps == 0) {
      (void)session.summarise(vehd::simulate(session.task({}, vehd::longest_lag_of_files), interruption));
    } else {
      vehd::RecordedRun run(session.task({}));
      run.start();
      for (int step = 0; step < steps; ++step) run.step();
    }
    std::filesystem::copy(folder_.paths.directory, directory_ / "intact", recursive);
    for (const auto& file : {folder_.paths.history(), folder_.paths.vesicles(), folder_.paths.history_error()}) {
      if (std::filesystem::exists(file)) folder_.tables.push_back(file);
    }
    for (const auto& [name, reader] : readers) {
      restore();
      vehd::ReadingNotes notes;
      intact_[name] = outcome(reader, folder_, notes);
      BOOST_TEST(notes.empty());
    }
  }

  [[nodiscard]] const std::string& found_intact(const std::string& reader) const { return intact_.at(reader); }

  void damage(std::mt19937& random) {
    restore();
    const RunDamage done = damage_run(folder_.paths.directory, random);
    std::filesystem::copy(folder_.paths.directory, directory_ / "damaged", recursive);
    for (const auto& [name, reader] : readers) {
      BOOST_TEST_CONTEXT(name << " of a run whose " << done.file.string() << " is damaged: " << done.what) {
        vehd::ReadingNotes notes;
        const std::string found = outcome(reader, folder_, notes);
        const bool is_refused = found.starts_with("refused: ");
        // The message is one line that names the file which is damaged, or one whose content depends on it.
        BOOST_TEST((!is_refused || found.find(folder_.paths.directory.string()) != std::string::npos), found);
        BOOST_TEST((!is_refused || found.find('\n') == std::string::npos), found);
        BOOST_TEST((is_refused || found == intact_[name] || !notes.empty()), "is believed");
        n_refused_ += is_refused ? 1 : 0;
      }
      // Files written by a reader, such as a continued run or a report, are no damage.
      std::filesystem::remove_all(folder_.paths.directory);
      std::filesystem::copy(directory_ / "damaged", folder_.paths.directory, recursive);
    }
    std::filesystem::remove_all(directory_ / "damaged");
  }

  [[nodiscard]] int n_refused() const { return n_refused_; }

 private:
  static constexpr auto recursive = std::filesystem::copy_options::recursive;

  void restore() const {
    std::filesystem::remove_all(folder_.paths.directory);
    std::filesystem::copy(directory_ / "intact", folder_.paths.directory, recursive);
  }

  TemporaryDirectory directory_;
  RunFolder folder_{{directory_ / "out"}, {directory_ / "scene.toml", {}}};
  std::map<std::string, std::string> intact_;
  int n_refused_ = 0;
};

std::string with_error_bars(std::string scene) { return scene.insert(scene.find("end_time"), "error_bars = true\n"); }

std::string two_vesicles() {
  std::string scene = quick_scene("0.5");
  scene.erase(0, scene.find("[membrane]"));
  for (const char* vesicle : {"[0.0, 0.0, -2.0]", "[0.0, 0.0, 2.0]"}) {
    scene +=
        "[[vesicle]]\n[vesicle.shape]\nkind = \"ellipsoid\"\naxes = [1.0, 1.0, 1.5]\ncentre = " + std::string(vesicle) +
        "\n";
  }
  return scene;
}

void damage_everywhere(Specimen& specimen, int places, unsigned seed) {
  std::mt19937 random(seed);
  for (int place = 0; place < places; ++place) specimen.damage(random);
  // The test is meaningless unless enough damage is noticed.
  BOOST_TEST(specimen.n_refused() > places);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(run_folders, *boost::unit_test::label("slow"))

BOOST_AUTO_TEST_CASE(a_complete_run_that_is_damaged_is_not_believed) {
  Specimen specimen(with_error_bars(quick_scene("1.0")), 0);
  for (const char* reader : {"plot", "report", "read_history", "check", "resume"}) {
    BOOST_TEST(!specimen.found_intact(reader).starts_with("refused"), specimen.found_intact(reader));
  }
  damage_everywhere(specimen, wanted_places() / 3, 20240609);
}

BOOST_AUTO_TEST_CASE(half_a_run_that_is_damaged_is_not_believed) {
  Specimen specimen(quick_scene("1.5"), 3);
  for (const char* reader : {"plot", "report", "read_history", "check", "resume"}) {
    BOOST_TEST(!specimen.found_intact(reader).starts_with("refused"), specimen.found_intact(reader));
  }
  damage_everywhere(specimen, wanted_places() / 3, 20240610);
}

BOOST_AUTO_TEST_CASE(a_run_of_several_vesicles_that_is_damaged_is_not_believed) {
  Specimen specimen(two_vesicles(), 0);
  for (const char* reader : {"plot", "read_history", "check", "resume"}) {
    BOOST_TEST(!specimen.found_intact(reader).starts_with("refused"), specimen.found_intact(reader));
  }
  damage_everywhere(specimen, wanted_places() - 2 * (wanted_places() / 3), 20240611);
}

BOOST_AUTO_TEST_SUITE_END()
