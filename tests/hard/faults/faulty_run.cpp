#include "tests/hard/faults/faulty_run.hpp"

#include <boost/test/unit_test.hpp>
#include <map>
#include <sstream>
#include <utility>

#include "bie/files/run_reader.hpp"
#include "bie/runs/checkpoint.hpp"

namespace {

/// One thread is quick and gives the same bits everywhere; with the policy set the program does not restart itself.
struct OneThread {
  OneThread() {
    ::setenv("OMP_NUM_THREADS", "1", 1);
    ::setenv("OMP_WAIT_POLICY", "passive", 1);
  }
};

}  // namespace

BOOST_TEST_GLOBAL_FIXTURE(OneThread);

std::vector<std::string> with_fault(const std::string& fault, const std::vector<std::string>& command) {
  // Sanitizers require to be loaded first, but it suffices that they are loaded.
  std::vector<std::string> result = {"env", "ASAN_OPTIONS=verify_asan_link_order=0:detect_leaks=0",
                                     "LD_PRELOAD=" VEHD_FAULT_SHIM, "VEHD_FAULT=" + fault};
  result.insert(result.end(), command.begin(), command.end());
  return result;
}

std::vector<std::string> FaultyRun::command_with(const std::string& fault) const { return with_fault(fault, command); }

FaultyRun::Work FaultyRun::count_work() const {
  const ProgramResult result = run_command(command_with("count " + directory / "work"));
  BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
  std::filesystem::remove_all(output);
  Work work;
  std::istringstream(file_text(directory / "work")) >> work.operations >> work.bytes;
  BOOST_TEST_REQUIRE(work.operations > 0);
  return work;
}

std::int64_t FaultyRun::check_files() const {
  std::int64_t accepted = 0;
  if (std::filesystem::exists(output + "/checkpoint.h5")) {
    accepted = vehd::read_checkpoint(output + "/checkpoint.h5").n_snapshots;
  }
  if (std::filesystem::exists(output + "/history.csv")) {
    BOOST_TEST(file_text(reference + "/history.csv").starts_with(file_text(output + "/history.csv")));
  }
  const std::string snapshots = output + "/run.h5";
  if (!std::filesystem::exists(snapshots)) {
    BOOST_TEST(accepted == 0);
    return accepted;
  }
  const std::size_t count = vehd::Hdf5Reader(std::filesystem::path(snapshots)).members("/snapshots").size();
  BOOST_TEST(std::cmp_greater_equal(count, accepted));
  if (count == 0) return accepted;
  const vehd::RunReader run(snapshots);
  for (std::size_t number = 0; number < count; ++number) (void)run.snapshot(number);
  const auto expected = snapshot_data(reference + "/run.h5");
  const auto actual = snapshot_data(snapshots);
  BOOST_TEST_REQUIRE(actual.size() <= expected.size());
  for (std::size_t i = 0; i < actual.size(); ++i) {
    BOOST_TEST_REQUIRE(actual[i].first == expected[i].first);
    BOOST_TEST((actual[i].second.array() == expected[i].second.array()).all(), actual[i].first);
  }
  return accepted;
}

std::string adaptive_scene() {
  std::string text = quick_scene("6.0");
  const std::string fixed = "order = 6\ndt = 0.25";
  return text.replace(text.find(fixed), fixed.size(), "tolerance = 1e-3");
}
