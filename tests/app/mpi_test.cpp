#ifdef VEHD_MPI_PROGRAM

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "bie/runs/checkpoint.hpp"
#include "tests/app/reference_run.hpp"

BOOST_AUTO_TEST_SUITE(mpi)

namespace {

/// Vesicles that move only because of bending, so that they never meet.
std::string two_vesicles(const std::string& end_time) {
  return "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 0.9, 1.2]\n[membrane]\nbending_modulus = 0.1\n"
         "[output]\nevery = 0.1\n[numerics]\norder = 4\ndt = 0.1\nend_time = " +
         end_time +
         "\n[[vesicle]]\nname = \"left\"\nshape.centre = [-1.6, 0.0, 0.3]\n"
         "[[vesicle]]\nname = \"right\"\nshape.centre = [1.4, 0.2, 0.0]\n";
}

/// Settings for containers, where only root exists and slots are often fewer than ranks.
struct AnyContainer {
  TemporaryDirectory session_folder;

  AnyContainer() {
    // Processes of version 4 share a folder otherwise, which one that ends may remove just when another has made it.
    ::setenv("OMPI_MCA_orte_tmpdir_base", (session_folder / "").c_str(), 1);
    ::setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    ::setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    ::setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", 1);
    ::setenv("PRTE_MCA_rmaps_default_mapping_policy", ":oversubscribe", 1);
    // mpirun kills its processes at once when it is terminated.
    ::setenv("OMPI_MCA_odls_base_sigkill_timeout", "0", 1);
    ::setenv("PRTE_MCA_odls_base_sigkill_timeout", "0", 1);
    ::setenv("OMPI_MCA_orte_execute_quiet", "1", 1);
    // All ranks are on this machine: Open MPI 5 complains about TCP where there is no network.
    ::setenv("OMPI_MCA_btl", "^tcp", 1);
    // Waiting ranks leave the processors to other tests.
    ::setenv("OMPI_MCA_mpi_yield_when_idle", "1", 1);
  }
};

/// Ranks are not bound to processors because other tests run at the same time.
std::vector<std::string> on_ranks(const std::string& n, const std::vector<std::string>& arguments) {
  std::vector<std::string> command = {"mpirun", "--bind-to", "none", "-n", n, VEHD_MPI_PROGRAM};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return command;
}

struct RunOnRanks : RunPair {
  explicit RunOnRanks(const std::string& end_time) : RunPair(two_vesicles(end_time)) {}

  [[nodiscard]] std::vector<std::string> on(const std::string& n) const {
    return on_ranks(n, {"run", scene, "-o", output, "--resume", "--no-plot", "--quiet"});
  }
  /// Processes of this run.
  [[nodiscard]] std::vector<pid_t> processes() const {
    std::vector<pid_t> all;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
      std::error_code gone;
      if (std::filesystem::read_symlink(entry.path() / "exe", gone) != std::filesystem::path(VEHD_MPI_PROGRAM))
        continue;
      std::ifstream arguments(entry.path() / "cmdline");
      const std::string words(std::istreambuf_iterator<char>(arguments), {});
      if (words.find(scene) != std::string::npos) all.push_back(std::stoi(entry.path().filename()));
    }
    return all;
  }
  /// Continues the interrupted run with one process to a nearby end, and compares it with the reference.
  void finish_soon() {
    const double reached = vehd::read_checkpoint(output + "/checkpoint.h5").state.time;
    write_text(scene, two_vesicles(std::to_string(reached + 0.15)));
    run_reference();
    finish();
  }
};

}  // namespace

BOOST_FIXTURE_TEST_CASE(ranks_have_the_bits_and_the_words_of_one, AnyContainer) {
  const RunOnRanks run("0.3");
  run.run_reference();
  const ProgramResult begun =
      run_command(on_ranks("2", {"run", run.scene, "-o", run.output, "--no-plot", "--set", "numerics.end_time=0.2"}));
  BOOST_TEST(begun.exit_code == 0, begun.errors);
  BOOST_TEST(begun.output.starts_with("completed at time 0.2: 2 steps"), begun.output);
  BOOST_TEST(begun.output.find("completed", 1) == std::string::npos, begun.output);
  const ProgramResult resumed = run_command(run.on("3"));
  BOOST_TEST(resumed.exit_code == 0, resumed.errors);
  check_same_run(run.output, run.reference);
  // Sum over ranks and sessions; the second session begins with the shape at which the first has ended.
  const auto evaluations = [](const std::string& folder) {
    return json_of(folder + "/summary.json").at("kernel_evaluations").begin()->get<std::int64_t>();
  };
  BOOST_TEST(evaluations(run.output) * 4 == evaluations(run.reference) * 5);
}

// The command is run with little to compute.
BOOST_FIXTURE_TEST_CASE(the_command_of_the_page_works, AnyContainer) {
  const std::string page = file_text(VEHD_SOURCE_DIR "/docs/several_vesicles.md");
  const std::size_t first = page.find("\nmpirun ") + 1;
  std::string command = page.substr(first, page.find('\n', first) - first);
  command.replace(command.find("build/vehd"), 10, VEHD_MPI_PROGRAM);
  const TemporaryDirectory directory;
  command.replace(command.find(" -o "), 4, " -o " + (directory / ""));
  command += " --no-plot --set numerics.degree=6 --set numerics.end_time=0.01";
  const ProgramResult result = run_command({"sh", "-c", "cd " VEHD_SOURCE_DIR " && " + command});
  BOOST_TEST(result.exit_code == 0, result.errors);
}

BOOST_FIXTURE_TEST_CASE(wrong_input_is_said_once, AnyContainer) {
  const RunOnRanks run("0.1");
  write_text(run.scene, two_vesicles("-1"));
  const ProgramResult result = run_command(run.on("2"));
  BOOST_TEST(result.exit_code == 1);
  // The mpirun of Open MPI 5 adds a page of its own about the exit code, between lines of dashes.
  const std::string before_page = result.errors.substr(0, result.errors.find("-----"));
  BOOST_TEST(std::ranges::count(before_page, '\n') == 1, result.errors);
  BOOST_TEST(before_page.starts_with(run.scene), result.errors);
  BOOST_TEST(result.errors.find(run.scene, 1) == std::string::npos, result.errors);
}

BOOST_AUTO_TEST_CASE(several_tasks_of_slurm_without_mpi_are_refused) {
  const RunOnRanks run("0.1");
  const auto among = [&run](const std::string& tasks) {
    return run_command({"env", "SLURM_STEP_NUM_TASKS=" + tasks, VEHD_MPI_PROGRAM, "run", run.scene, "-o", run.output,
                        "--no-plot", "--quiet"});
  };
  const ProgramResult refused = among("2");
  BOOST_TEST(refused.exit_code == 1);
  BOOST_TEST(refused.errors.starts_with("srun has started 2 tasks without MPI"), refused.errors);
  BOOST_TEST(refused.errors.find("srun --mpi=pmix") != std::string::npos, refused.errors);
  const ProgramResult one = among("1");
  BOOST_TEST(one.exit_code == 0, one.errors);
}

BOOST_FIXTURE_TEST_CASE(a_signal_leaves_a_resumable_run, AnyContainer) {
  RunOnRanks run("10000.0");
  RunningProgram program(run.on("2"));
  run.wait_for_rows(program);
  // A signal that mpirun forwards.
  program.send(SIGUSR1);
  const ProgramResult result = program.wait();
  BOOST_TEST(result.exit_code == 3, result.errors);
  BOOST_TEST(json_of(run.output + "/summary.json").at("verdict").get<std::string>().starts_with("stopped: a signal"));
  run.finish_soon();
}

BOOST_FIXTURE_TEST_CASE(a_killed_rank_ends_all_and_leaves_a_resumable_run, AnyContainer) {
  RunOnRanks run("10000.0");
  RunningProgram program(run.on("2"));
  run.wait_for_rows(program);
  const std::vector<pid_t> processes = run.processes();
  BOOST_TEST_REQUIRE(processes.size() == 2U);
  ::kill(processes.back(), SIGKILL);
  BOOST_TEST(program.wait().exit_code != 0);
  BOOST_TEST(run.processes().empty());
  run.finish_soon();
}

BOOST_AUTO_TEST_SUITE_END()

#endif
