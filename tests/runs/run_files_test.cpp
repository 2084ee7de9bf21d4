#include "bie/runs/run_files.hpp"

#include <hdf5.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <sstream>
#include <utility>

#include "bie/files/sealed_file.hpp"
#include "bie/runs/run_loop.hpp"
#include "bie/scene/reader.hpp"
#include "bie/support/errors.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scenes.hpp"

namespace {

/// A run that was killed: its checkpoint counts some rows and snapshots, and more were written.
struct KilledRun {
  TemporaryDirectory directory;
  vehd::RunPaths paths{directory / "out"};
  vehd::Checkpoint checkpoint;

  KilledRun() {
    const vehd::Scene scene = vehd::parse_scene(quick_scene("2.0"), "scene.toml", directory / "");
    vehd::make_directory(paths.directory);
    vehd::RecordedRun run({scene, paths, std::nullopt});
    run.start();
    for (int step = 0; step < 4; ++step) run.step();
    const std::string counted = file_text(paths.checkpoint());
    checkpoint = vehd::read_checkpoint(paths.checkpoint());
    for (int step = 0; step < 4; ++step) run.step();
    run.end({.completed = false, .reason = "killed"});
    write_text(paths.checkpoint(), counted);
  }

  [[nodiscard]] std::string table_refusal(const std::string& text) const {
    write_text(paths.history(), text);
    vehd::ReadingNotes notes;
    return refusal([&] { (void)vehd::read_table(paths.history(), notes); });
  }

  template <typename Read>
  static std::string refusal(const Read& read) {
    try {
      read();
    } catch (const vehd::InputError& error) {
      return error.what();
    }
    return "";
  }
};

std::string first_lines(const std::string& text, std::int64_t count) {
  std::size_t end = 0;
  for (; count > 0; --count) end = text.find('\n', end) + 1;
  return text.substr(0, end);
}

void remove_object(hid_t file, const std::string& path) {
  BOOST_TEST_REQUIRE(H5Ldelete(file, path.c_str(), H5P_DEFAULT) >= 0);
}

/// Removes the seals, as in a file of an earlier vehd.
void remove_seals(const vehd::RunPaths& paths) {
  {
    const vehd::Hdf5Handle file(H5Fopen(paths.snapshots().c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    remove_object(file.id(), "/seal");
    const auto names = *vehd::hdf5_members(file.id(), "/snapshots");
    for (const std::string& name : names) remove_object(file.id(), "/snapshots/" + name + "/seal");
  }
  std::istringstream lines(file_text(paths.history()));
  std::string text;
  for (std::string line; std::getline(lines, line);) text += line.substr(0, line.rfind(',')) + "\n";
  write_text(paths.history(), text);
  write_text(paths.directory / "image.h5", vehd::read_sealed_file(paths.checkpoint()));
  {
    const vehd::Hdf5Handle file(H5Fopen((paths.directory / "image.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    const vehd::Hdf5Handle attribute(H5Aopen(file.id(), "schema_version", H5P_DEFAULT), H5Aclose);
    const std::int64_t version = 11;
    BOOST_TEST_REQUIRE(H5Awrite(attribute.id(), H5T_NATIVE_INT64, &version) >= 0);
  }
  write_text(paths.checkpoint(), vehd::sealed(file_text(paths.directory / "image.h5")));
}

}  // namespace

BOOST_AUTO_TEST_SUITE(run_files)

BOOST_FIXTURE_TEST_CASE(rows_are_compared_with_checksums_beyond_the_last_checkpoint_too, KilledRun) {
  const std::string text = file_text(paths.history());
  BOOST_TEST_REQUIRE(std::cmp_greater(text.size(), checkpoint.history_bytes + 100));
  BOOST_TEST(table_refusal(text) == "");
  // A kill may have cut off this line as well.
  BOOST_TEST(table_refusal(text.substr(0, text.size() - 10)) == "");
  BOOST_TEST(table_refusal(text.substr(0, static_cast<std::size_t>(checkpoint.history_bytes))) == "");
  std::string edited = text;
  edited[edited.size() - 60] = edited[edited.size() - 60] == '1' ? '2' : '1';
  BOOST_TEST(table_refusal(edited).find("history.csv:10: does not match its checksum") != std::string::npos);
  const std::string cut = first_lines(text, checkpoint.n_rows);
  BOOST_TEST(table_refusal(cut) == paths.history().string() + ": rows are missing at its end: it has " +
                                       std::to_string(checkpoint.n_rows - 1) + " rows in " +
                                       std::to_string(cut.size()) + " bytes, and checkpoint.h5 counts " +
                                       std::to_string(checkpoint.history_bytes) + " bytes");
}

BOOST_FIXTURE_TEST_CASE(snapshots_that_the_checkpoint_counts_must_be_there, KilledRun) {
  vehd::ReadingNotes notes;
  const auto read = [&] { (void)vehd::read_snapshots(paths.snapshots(), notes); };
  const auto remove_last = [&] {
    const vehd::Hdf5Handle file(H5Fopen(paths.snapshots().c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    remove_object(file.id(), "/snapshots/" + vehd::hdf5_members(file.id(), "/snapshots")->back());
  };
  BOOST_TEST(refusal(read) == "");
  const auto count = static_cast<std::int64_t>(vehd::RunReader(paths.snapshots()).times().size());
  for (std::int64_t more = count; more > checkpoint.n_snapshots; --more) {
    remove_last();
    BOOST_TEST(refusal(read) == "");
  }
  remove_last();
  BOOST_TEST(refusal(read) == paths.snapshots().string() + ": holds " + std::to_string(checkpoint.n_snapshots - 1) +
                                  " of the " + std::to_string(checkpoint.n_snapshots) +
                                  " snapshots that checkpoint.h5 counts");
}

BOOST_AUTO_TEST_CASE(a_run_goes_on_while_its_snapshots_are_read) {
  const TemporaryDirectory directory;
  const vehd::RunPaths paths{directory / "out"};
  const vehd::Scene scene = vehd::parse_scene(quick_scene("2.0"), "scene.toml", directory / "");
  vehd::make_directory(paths.directory);
  vehd::RecordedRun run({scene, paths, std::nullopt});
  run.start();
  const auto snapshot_now = [&] {
    run.step();
    run.snapshot();
    return vehd::RunReader(paths.snapshots());
  };
  std::vector<vehd::RunReader> readers;
  for (int step = 0; step < 5; ++step) readers.push_back(snapshot_now());
  run.end({.completed = true, .reason = {}});
  const vehd::RunReader whole(paths.snapshots());
  for (const vehd::RunReader& reader : readers) {
    const std::size_t last = reader.times().size() - 1;
    BOOST_TEST(last == static_cast<std::size_t>(&reader - readers.data()) + 1U);
    BOOST_TEST((reader.snapshot(last).coefficients("x") == whole.snapshot(last).coefficients("x")));
  }
  BOOST_TEST(whole.times().size() == 6U);
}

BOOST_FIXTURE_TEST_CASE(files_of_an_earlier_vehd_are_read_and_said_to_be_unsealed, KilledRun) {
  remove_seals(paths);
  write_text(paths.summary(), "{\"verdict\": \"trustworthy\"}");
  vehd::ReadingNotes notes;
  const vehd::RunReader run = vehd::read_snapshots(paths.snapshots(), notes);
  BOOST_TEST(run.snapshot(1).coefficients("x").rows() == 49);
  BOOST_TEST(vehd::read_table(paths.history(), notes).n_rows() == 9U);
  BOOST_TEST(vehd::read_summary(paths.summary(), notes)["verdict"] == "trustworthy");
  (void)vehd::read_snapshots(paths.snapshots(), notes);
  BOOST_TEST_REQUIRE(notes.size() == 4U);
  for (const char* name : {"checkpoint.h5", "run.h5", "history.csv", "summary.json"}) {
    const std::string note = (paths.directory / name).string() +
                             ": an earlier vehd wrote it without checksums: damage to it would not be noticed";
    BOOST_TEST(std::ranges::count(notes, note) == 1, name);
  }
}

BOOST_AUTO_TEST_CASE(an_edited_summary_is_refused_and_another_layout_is_not) {
  const TemporaryDirectory directory;
  const std::filesystem::path file = directory / "summary.json";
  vehd::ReadingNotes notes;
  BOOST_TEST(vehd::read_summary(file, notes).is_null());
  const nlohmann::json summary =
      vehd::write_summary(file, {{"completed", true}, {"seconds", 0.1}, {"verdict", "trustworthy"}});
  BOOST_TEST((vehd::read_summary(file, notes) == summary));
  nlohmann::json json = json_of(file);
  write_text(file, json.dump());
  BOOST_TEST((vehd::read_summary(file, notes) == summary));
  BOOST_TEST(notes.empty());
  json["completed"] = false;
  write_text(file, json.dump());
  BOOST_TEST(KilledRun::refusal([&] { (void)vehd::read_summary(file, notes); }) ==
             file.string() + ": was altered: it does not match its checksum");
}

BOOST_AUTO_TEST_SUITE_END()
