#include <unistd.h>

#include <boost/test/unit_test.hpp>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "tests/app/sweep_folder.hpp"
#include "tests/support/waiting.hpp"

namespace {

std::string output_of(const std::string& command) { return run_command({"sh", "-c", command}).output; }

/// Must be requested explicitly, because root on a cluster has another Slurm there.
bool slurm_can_be_started() {
  return std::getenv("VEHD_OWN_SLURM") != nullptr && ::geteuid() == 0 &&
         run_command({"sh", "-c", "command -v slurmctld slurmd sbatch munged"}).exit_code == 0;
}

bool slurm_is_missing() {
  if (slurm_can_be_started()) return false;
  std::cout << "Not tried: cmake -DSTEP=slurm -P bie/setup.cmake\n";
  return true;
}

/// A real Slurm on this machine, for the lifetime of the object.
class OwnSlurm {
 public:
  OwnSlurm() {
    const ProgramResult started =
        run_command({"bash", VEHD_SOURCE_DIR "/tests/hard/faults/slurm/start.sh", directory_ / ""});
    BOOST_TEST_REQUIRE(started.exit_code == 0, started.errors);
    ::setenv("SLURM_CONF", (directory_ / "slurm.conf").c_str(), 1);
  }
  ~OwnSlurm() {
    for (const char* daemon : {"slurmd", "slurmctld", "munged"}) {
      const std::string number = directory_ / (std::string(daemon) + ".pid");
      if (!std::filesystem::exists(number)) continue;
      const int process = std::atoi(file_text(number).c_str());
      if (process <= 0) continue;
      ::kill(process, SIGTERM);
      comes_true([&] { return ::kill(process, 0) != 0; }, std::chrono::seconds(20));
    }
    ::unsetenv("SLURM_CONF");
  }
  OwnSlurm(const OwnSlurm&) = delete;
  OwnSlurm& operator=(const OwnSlurm&) = delete;

  /// Whether all jobs end within four minutes.
  static bool is_done() {
    return comes_true([] { return output_of("squeue -h | wc -l") == "0\n"; }, std::chrono::seconds(240));
  }

 private:
  TemporaryDirectory directory_;
};

}  // namespace

BOOST_AUTO_TEST_SUITE(slurm, *boost::unit_test::label("alone"))

BOOST_AUTO_TEST_CASE(arrays_and_tasks_of_slurm_are_workers_of_one_sweep) {
  if (slurm_is_missing()) return;
  const OwnSlurm slurm;
  const SweepWork work(quick_scene("20"));
  work.write_sweep("\"electric.conductivity_in\" = {from = 0.5, to = 2.0, count = 8}\n");
  const std::string undisturbed = work.directory / "undisturbed";
  BOOST_TEST_REQUIRE(work.run({"--jobs", "2"}, undisturbed).exit_code == 0);

  // An array of jobs; a member that is ended by a signal is queued again.
  BOOST_TEST_REQUIRE(work.run({"--emit", "slurm"}).exit_code == 0);
  std::string script = file_text(work.output + "/sweep.sbatch");
  script.replace(script.find("--array=0-0"), 11, "--array=0-1");
  script.replace(script.find("$SLURM_ARRAY_TASK_ID/1"), 22, "$SLURM_ARRAY_TASK_ID/2");
  write_text(work.output + "/sweep.sbatch", script);
  const ProgramResult submitted = run_command({"sbatch", "--parsable", work.output + "/sweep.sbatch"});
  BOOST_TEST_REQUIRE(submitted.exit_code == 0, submitted.errors);
  const std::string job = submitted.output.substr(0, submitted.output.find('\n'));
  BOOST_TEST(comes_true([&] { return !work.workers().empty(); }, std::chrono::seconds(60)));
  run_command({"scancel", "--signal=TERM", job + "_0"});
  // Slurm would wait two minutes before the next turn.
  BOOST_TEST(
      comes_true([&] { return output_of("squeue -h -o '%F_%K %r'").find(job + "_0 BeginTime") != std::string::npos; },
                 std::chrono::seconds(60)));
  run_command({"scontrol", "update", "JobId=" + job + "_0", "StartTime=now"});
  BOOST_TEST(slurm.is_done());
  BOOST_TEST((work.table() == work.table(undisturbed)));
  const std::string log = file_text(work.output + "/slurm-0.log");
  BOOST_TEST(log.find("a signal came; the same command continues from here") != std::string::npos, log);
  BOOST_TEST(log.find("8 runs: 8 completed;") != std::string::npos, log);

  // Workers as tasks of srun.
  std::filesystem::remove_all(work.output);
  std::vector<std::string> tasks = {"srun", "-N", "1", "-n", "2", "--overcommit"};
  for (const std::string& word : work.command({"--jobs", "1"})) tasks.push_back(word);
  const ProgramResult result = run_command(tasks);
  BOOST_TEST(result.exit_code == 0, result.errors);
  BOOST_TEST((work.table() == work.table(undisturbed)));
}

#ifdef VEHD_MPI_PROGRAM
// If each of its two tasks were alone, one of them would find the directory in use, and the job would fail.
BOOST_AUTO_TEST_CASE(the_script_for_one_run_connects_its_tasks) {
  if (slurm_is_missing()) return;
  const OwnSlurm slurm;
  const TemporaryDirectory directory;
  write_text(directory / "scene.toml", quick_scene("0.5"));
  const ProgramResult job =
      run_command({"env", "VEHD=" VEHD_MPI_PROGRAM, "TMPDIR=" + directory / "scratch", "sbatch", "--wait",
                   "--cpus-per-task=1", "--output=" + directory / "log", VEHD_SOURCE_DIR "/docs/slurm/one_run.sbatch",
                   directory / "scene.toml", directory / "out"});
  BOOST_TEST(job.exit_code == 0, job.errors << file_text(directory / "log"));
  BOOST_TEST(json_of(directory / "out/summary.json").at("completed").get<bool>());
}
#endif

BOOST_AUTO_TEST_SUITE_END()
