#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <functional>
#include <random>

#include "bie/files/hdf5_writer.hpp"
#include "bie/files/run_reader.hpp"
#include "bie/files/sealed_file.hpp"
#include "bie/runs/checkpoint.hpp"
#include "bie/support/errors.hpp"
#include "tests/hard/faults/faulty_run.hpp"

namespace {

/// A run that was stopped before its end, to be damaged and resumed.
struct StoppedRun : FaultyRun {
  std::string checkpoint = output + "/checkpoint.h5";
  std::string history = output + "/history.csv";
  std::string snapshots = output + "/run.h5";

  StoppedRun() {
    const std::int64_t operations = count_work().operations;
    BOOST_TEST_REQUIRE(run_command(command_with("kill " + std::to_string(operations / 2))).exit_code == -1);
    BOOST_TEST_REQUIRE(check_files() > 1);
  }

  /// Resuming must fail with this line and change nothing.
  void check_refused(const std::string& message) const {
    const std::string checkpoint_before = file_text(checkpoint), history_before = file_text(history),
                      snapshots_before = file_text(snapshots);
    const ProgramResult result = run_command(command);
    BOOST_TEST(result.exit_code == 1);
    BOOST_TEST(result.errors == message + "\n");
    BOOST_TEST((file_text(checkpoint) == checkpoint_before));
    BOOST_TEST((file_text(history) == history_before));
    BOOST_TEST((file_text(snapshots) == snapshots_before));
  }

  /// Damages a file, calls `check`, and restores the file.
  static void damage(const std::string& path, const std::function<void(std::string&)>& change,
                     const std::function<void()>& check) {
    const std::string original = file_text(path);
    std::string altered = original;
    change(altered);
    write_text(path, altered);
    check();
    write_text(path, original);
  }
};

std::function<void(std::string&)> flip(std::size_t place, int bit) {
  return [=](std::string& text) { text[place] = static_cast<char>(text[place] ^ (1 << bit)); };
}

/// Position of these numbers in the file.
std::size_t place_of(const vehd::Vector& values, const std::string& file) {
  const std::size_t place = file.find(std::string(reinterpret_cast<const char*>(values.data()), 16));
  BOOST_TEST_REQUIRE(place != std::string::npos);
  return place;
}

void set_version(const std::string& path, std::int64_t version) {
  const vehd::Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
  const vehd::Hdf5Handle attribute(H5Aopen(file.id(), "schema_version", H5P_DEFAULT), H5Aclose);
  BOOST_TEST_REQUIRE(H5Awrite(attribute.id(), H5T_NATIVE_INT64, &version) >= 0);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(damage, *boost::unit_test::label("slow"))

BOOST_FIXTURE_TEST_CASE(every_bit_and_every_length_of_a_checkpoint_counts, StoppedRun) {
  const std::string original = file_text(checkpoint);
  const std::string path = directory / "damaged.h5";
  const auto check_refused = [&](const std::string& text) {
    write_text(path, text);
    BOOST_CHECK_THROW(vehd::read_checkpoint(path), vehd::InputError);
  };
  for (std::size_t size = 0; size < original.size(); size += 13) check_refused(original.substr(0, size));
  for (std::size_t place = 0; place < original.size(); place += 7) {
    std::string altered = original;
    flip(place, static_cast<int>(place / 7 % 8))(altered);
    check_refused(altered);
  }
  check_refused(original + "\n");
  check_refused(original.substr(1));
}

BOOST_FIXTURE_TEST_CASE(damaged_checkpoint_is_not_resumed, StoppedRun) {
  const std::string unsealed =
      checkpoint + ": has no seal at its end: it is truncated, damaged or of another schema version";
  for (const std::size_t size : {std::size_t{0}, std::size_t{10}, file_text(checkpoint).size() - 1}) {
    damage(
        checkpoint, [&](std::string& text) { text.resize(size); }, [&] { check_refused(unsealed); });
  }
  std::mt19937 random(3);
  for (int trial = 0; trial < 4; ++trial) {
    damage(checkpoint, flip(random() % (file_text(checkpoint).size() - 64), trial),
           [&] { check_refused(checkpoint + ": is damaged: its bytes do not match their checksum"); });
  }
  finish();
}

BOOST_FIXTURE_TEST_CASE(other_schema_versions_are_not_resumed, StoppedRun) {
  write_text(directory / "image.h5", vehd::read_sealed_file(checkpoint));
  set_version(directory / "image.h5", 2);
  damage(
      checkpoint, [&](std::string& text) { text = vehd::sealed(file_text(directory / "image.h5")); },
      [&] { check_refused(checkpoint + ": has schema version 2; accepted: 15, 16"); });
  const std::string original = file_text(snapshots);
  set_version(snapshots, 7);
  const std::string message = snapshots + ": has schema version 7; accepted: 1";
  check_refused(message);
  BOOST_TEST(run_vehd({"plot", output}).errors == message + "\n");
  write_text(directory / "next.toml",
             "[shape]\nkind = \"file\"\npath = \"out/run.h5\"\n[numerics]\norder = 6\ndt = 1\nend_time = 0\n");
  BOOST_TEST(run_vehd({"run", directory / "next.toml", "-o", directory / "next"}).errors == message + "\n");
  write_text(snapshots, original);
  finish();
}

BOOST_FIXTURE_TEST_CASE(altered_number_of_a_snapshot_is_neither_resumed_nor_shown, StoppedRun) {
  // This dataset is too short to be deflated, so its numbers can be found in the file.
  const std::string dataset = "/snapshots/000001/coefficients/tension";
  const vehd::Vector tension = vehd::Hdf5Reader(snapshots).vector(dataset);
  const std::string message = snapshots + ": damaged or altered: " + dataset + " does not match its checksum";
  damage(snapshots, flip(place_of(tension, file_text(snapshots)) + 3, 2), [&] {
    check_refused(message);
    const ProgramResult plot = run_vehd({"plot", output, "--times", "0.5"});
    BOOST_TEST(plot.exit_code == 1);
    BOOST_TEST(plot.errors == message + "\n");
  });
  finish();
}

BOOST_FIXTURE_TEST_CASE(any_flipped_bit_of_a_run_file_is_refused_or_harmless, StoppedRun) {
  const std::string original = file_text(snapshots);
  const vehd::RunReader intact(snapshots);
  const vehd::Matrix expected = intact.snapshot(1).coefficients("x");
  const std::string path = directory / "damaged.h5";
  std::mt19937 random(5);
  int refused = 0;
  for (int trial = 0; trial < 400; ++trial) {
    std::string altered = original;
    flip(random() % original.size(), trial % 8)(altered);
    write_text(path, altered);
    try {
      const vehd::RunReader run(path);
      const vehd::Matrix actual = run.snapshot(1).coefficients("x");
      // The flipped bit belonged to padding, to a description or to another snapshot.
      BOOST_TEST_REQUIRE((actual.array() == expected.array()).all());
    } catch (const vehd::InputError&) {
      ++refused;
    }
  }
  BOOST_TEST(refused > 20);
}

BOOST_FIXTURE_TEST_CASE(truncated_run_file_is_not_resumed, StoppedRun) {
  const std::string original = file_text(snapshots);
  for (std::size_t size = 0; size < original.size(); size += original.size() / 6) {
    damage(
        snapshots, [&](std::string& text) { text.resize(size); },
        [&] {
          const ProgramResult result = run_command(command);
          BOOST_TEST(result.exit_code == 1);
          BOOST_TEST(result.errors.starts_with(snapshots + ": not a readable HDF5 file"), result.errors);
        });
  }
  finish();
}

BOOST_FIXTURE_TEST_CASE(altered_history_is_not_resumed, StoppedRun) {
  const std::int64_t bytes = vehd::read_checkpoint(checkpoint).history_bytes;
  const std::string counted = file_text(history).substr(0, static_cast<std::size_t>(bytes));
  const auto last_line = std::ranges::count(counted, '\n');
  damage(history, flip(static_cast<std::size_t>(bytes) - 5, 0), [&] {
    check_refused(history + ":" + std::to_string(last_line) +
                  ": does not match its checksum: it was altered, or lines before it were altered or removed");
  });
  damage(
      history, [&](std::string& text) { text.resize(static_cast<std::size_t>(bytes) - 1); },
      [&] {
        check_refused(history + ": rows are missing at its end: it has " + std::to_string(last_line - 2) + " rows in " +
                      std::to_string(bytes - 1) + " bytes, and checkpoint.h5 counts " + std::to_string(bytes) +
                      " bytes");
      });
  finish();
}

BOOST_FIXTURE_TEST_CASE(snapshots_of_another_run_are_not_resumed, StoppedRun) {
  std::string other = quick_scene();
  other.replace(other.find("0.0, 0.0, 0.5"), 13, "0.0, 0.0, 0.4");
  write_text(directory / "other.toml", other);
  BOOST_TEST_REQUIRE(run_vehd({"run", directory / "other.toml", "-o", directory / "other", "--no-plot"}).exit_code ==
                     0);
  const std::string foreign = file_text(directory / "other/run.h5");
  damage(
      snapshots, [&](std::string& text) { text = foreign; },
      [&] { check_refused(snapshots + ": holds other snapshots than those that checkpoint.h5 counts"); });
  finish();
}

BOOST_AUTO_TEST_SUITE_END()
