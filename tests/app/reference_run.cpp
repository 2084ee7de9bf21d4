#include "tests/app/reference_run.hpp"

#include <boost/test/unit_test.hpp>
#include <chrono>
#include <cmath>
#include <thread>

#include "bie/files/run_reader.hpp"
#include "bie/runs/checkpoint.hpp"

std::vector<std::pair<std::string, vehd::Vector>> snapshot_data(const std::string& path) {
  const vehd::Hdf5Reader file(path);
  std::vector<std::pair<std::string, vehd::Vector>> data;
  for (const std::string& name : file.members("/snapshots")) {
    const std::string group = "/snapshots/" + name;
    data.emplace_back(group, vehd::Vector::Constant(1, file.number_attribute(group, "time")));
    for (const std::string& vesicle : vehd::vesicle_groups(file, group)) {
      for (const vehd::SnapshotField& field : vehd::snapshot_fields()) {
        for (const std::string_view part : vehd::snapshot_parts) {
          const std::string dataset = vesicle + "/" + std::string(part) + field.name;
          if (file.has(dataset)) data.emplace_back(dataset, file.vector(dataset));
        }
      }
    }
  }
  return data;
}

void check_same_run(const std::string& actual, const std::string& expected) {
  BOOST_TEST((file_text(actual + "/history.csv") == file_text(expected + "/history.csv")));
  const bool of_several = std::filesystem::exists(expected + "/vesicles.csv");
  BOOST_TEST(std::filesystem::exists(actual + "/vesicles.csv") == of_several);
  if (of_several) BOOST_TEST((file_text(actual + "/vesicles.csv") == file_text(expected + "/vesicles.csv")));
  const auto data = snapshot_data(actual + "/run.h5"), reference = snapshot_data(expected + "/run.h5");
  BOOST_TEST_REQUIRE(data.size() == reference.size());
  for (std::size_t i = 0; i < data.size(); ++i) {
    BOOST_TEST_REQUIRE(data[i].first == reference[i].first);
    BOOST_TEST((data[i].second.array() == reference[i].second.array()).all(), data[i].first);
  }
  BOOST_TEST((file_text(actual + "/run.xdmf") == file_text(expected + "/run.xdmf")));
}

FinishedRun::FinishedRun(const std::string& text) {
  write_text(scene, text);
  const ProgramResult result = run_vehd({"run", scene, "-o", output, "--no-plot"});
  BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
}

void RunPair::run_reference() const {
  const ProgramResult result = run_vehd({"run", scene, "-o", reference, "--no-plot"});
  BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
}

void RunPair::run_until(const std::string& end_time) const {
  const ProgramResult result =
      run_vehd({"run", scene, "-o", output, "--no-plot", "--set", "numerics.end_time=" + end_time});
  BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
}

ReferenceRun::ReferenceRun(const std::string& text) : RunPair(text) {
  const auto start = std::chrono::steady_clock::now();
  run_reference();
  seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void EndlessRun::finish_soon() const {
  const double reached = vehd::read_checkpoint(output + "/checkpoint.h5").state.time;
  write_text(scene, quick_scene(std::to_string(std::ceil(reached) + 1.0)));
  run_reference();
  finish();
}

void RunPair::finish() const {
  const ProgramResult result = run_command(command);
  BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
  BOOST_TEST(!std::filesystem::exists(output + "/.run.h5.spare"));
  check_same_run(output, reference);
}

void RunPair::wait_for_rows(RunningProgram& program) const {
  while (!program.ended() && file_text(output + "/history.csv").size() < 1000) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}
