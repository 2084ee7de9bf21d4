#include <boost/test/unit_test.hpp>
#include <csignal>

#include "tests/app/sweep_folder.hpp"
#include "tests/support/waiting.hpp"

BOOST_AUTO_TEST_SUITE(sweeps, *boost::unit_test::label("once"))

namespace {

namespace fs = std::filesystem;

const std::string conductivities = "\"electric.conductivity_in\" = {values = [0.5, 1.0, 2.0]}\n";

using Cells = std::vector<std::string>;

std::string without_seconds(const std::vector<Cells>& rows) {
  std::string text;
  for (const Cells& row : rows) text += vehd::csv_line(row);
  return text;
}

}  // namespace

BOOST_FIXTURE_TEST_CASE(any_number_of_workers_makes_one_table, SweepWork) {
  write_sweep(conductivities + "\"numerics.dt\" = {values = [0.25, 0.125]}\n", "columns = [\"time\", \"extent_z\"]\n");
  BOOST_TEST_REQUIRE(run({"--jobs", "1"}).exit_code == 0);
  const auto rows = table();
  BOOST_TEST_REQUIRE(rows.size() == 7u);
  BOOST_TEST(
      rows[0] == (Cells{"electric.conductivity_in", "numerics.dt", "time", "extent_z", "verdict", "reason", "run"}),
      boost::test_tools::per_element());
  BOOST_TEST(rows[2][0] == "0.5");
  BOOST_TEST(rows[2][1] == "0.125");
  for (const char* jobs : {"2", "4"}) {
    const std::string other = directory / ("out" + std::string(jobs));
    BOOST_TEST_REQUIRE(run({"--jobs", jobs}, other).exit_code == 0);
    BOOST_TEST(without_seconds(table(other)) == without_seconds(rows));
  }
  // Each row equals the same run outside of the sweep, to the last digit.
  const ProgramResult alone =
      run_vehd({"run", directory / "base.toml", "-o", directory / "alone", "--no-plot", "--threads", "1", "--set",
                "electric.conductivity_in=2.0", "--set", "numerics.dt=0.125"});
  BOOST_TEST_REQUIRE(alone.exit_code == 0, alone.errors);
  BOOST_TEST(file_text(output + "/runs/" + rows[6].back() + "/history.csv") ==
             file_text(directory / "alone/history.csv"));
}

BOOST_FIXTURE_TEST_CASE(a_second_call_does_nothing_and_a_changed_sweep_only_its_new_runs, SweepWork) {
  write_sweep(conductivities);
  BOOST_TEST_REQUIRE(run().exit_code == 0);
  const auto rows = table();
  const std::string kept = output + "/runs/" + rows[2].back() + "/history.csv";
  const auto written = fs::last_write_time(kept);
  BOOST_TEST(run().exit_code == 0);
  BOOST_TEST(without_seconds(table()) == without_seconds(rows));
  write_sweep("\"electric.conductivity_in\" = {values = [3.0, 1.0]}\n", "columns = [\"extent_x\"]\n");
  const ProgramResult result = run({"--json", directory / "result.json"});
  BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
  BOOST_TEST(column("electric.conductivity_in") == (Cells{"3.0", "1.0"}), boost::test_tools::per_element());
  BOOST_TEST(table()[2].back() == rows[2].back());
  BOOST_TEST((fs::last_write_time(kept) == written));
  const nlohmann::json json = json_of(directory / "result.json");
  BOOST_TEST(json["completed"] == 2);
  BOOST_TEST(json["unfinished"] == 0);
}

BOOST_FIXTURE_TEST_CASE(scenes_that_are_refused_or_stop_are_rows_with_their_reasons, SweepWork) {
  // A field under which no step of this size is acceptable.
  write_sweep(
      "\"electric.field\" = {values = [[0, 0, 0.5], [0, 0, 1e5], [0, 0, 1.0]]}\n"
      "\"electric.waveform.kind\" = {values = [\"dc\", \"ac\"]}\n");
  const ProgramResult result = run({"--jobs", "2"});
  BOOST_TEST(result.exit_code == 0, result.errors);
  const Cells verdicts = column("verdict"), reasons = column("reason");
  BOOST_TEST_REQUIRE(verdicts.size() == 6u);
  for (const std::size_t i : {1u, 3u, 5u}) {
    BOOST_TEST(verdicts[i] == "refused");
    BOOST_TEST(reasons[i].find("frequency") != std::string::npos, reasons[i]);
  }
  BOOST_TEST(verdicts[2].starts_with("stopped"), verdicts[2]);
  BOOST_TEST(!reasons[2].empty());
  BOOST_TEST(reasons[4] == "");
  BOOST_TEST(result.output.find("6 runs: 2 completed, 1 stopped, 3 refused") == 0, result.output);
}

BOOST_FIXTURE_TEST_CASE(mistakes_are_said_before_anything_runs, SweepWork) {
  write_sweep("\"electric.conductivity_inn\" = {values = [1.0]}\n");
  ProgramResult result = run();
  BOOST_TEST(result.exit_code == 1);
  BOOST_TEST(result.errors ==
             file +
                 ":3: unknown key \"conductivity_inn\" of [electric] in [vary]; did you mean \"conductivity_in\"?\n");
  write_sweep(conductivities, "columns = [\"extend_x\"]\n");
  result = run();
  BOOST_TEST(result.errors.starts_with(file + ":2: \"columns\" has \"extend_x\""), result.errors);
  BOOST_TEST(!fs::exists(output));
  fs::create_directories(output);
  write_text(output + "/history.csv", "");
  write_sweep(conductivities);
  BOOST_TEST(run().errors.starts_with(output + ": already holds a run (history.csv)"));
}

BOOST_FIXTURE_TEST_CASE(a_signal_leaves_everything_to_the_next_call, SweepWork) {
  write_text(directory / "base.toml", quick_scene("20"));
  write_sweep("\"electric.conductivity_in\" = {from = 0.5, to = 2.0, count = 4}\n");
  const std::string undisturbed = directory / "undisturbed";
  BOOST_TEST_REQUIRE(run({"--jobs", "2"}, undisturbed).exit_code == 0);
  int n_stopped = 0;
  for (const int signal : {SIGINT, SIGTERM, SIGINT}) {
    RunningProgram program(command({"--jobs", "2"}));
    BOOST_TEST(comes_true([&] { return program.ended() || !workers().empty(); }, std::chrono::seconds(60)));
    program.send(signal);
    const ProgramResult result = program.wait();
    if (result.exit_code == 3) ++n_stopped;
    BOOST_TEST((result.exit_code == 3 || result.exit_code == 0), result.errors);
    BOOST_TEST(workers().empty());
    BOOST_TEST(table().size() == 5u);
  }
  BOOST_TEST(n_stopped > 0);
  BOOST_TEST(run({"--jobs", "2"}).exit_code == 0);
  BOOST_TEST(without_seconds(table()) == without_seconds(table(undisturbed)));
}

BOOST_FIXTURE_TEST_CASE(a_crash_is_a_row_and_the_other_runs_go_on, SweepWork) {
  // The first run is long enough to be still running on any machine.
  write_sweep("\"numerics.end_time\" = {values = [100000.0, 0.5, 0.6, 0.7]}\n");
  RunningProgram program(command({"--jobs", "1"}));
  BOOST_TEST(comes_true([&] { return !workers().empty(); }, std::chrono::seconds(60)));
  ::kill(workers().front(), SIGSEGV);
  BOOST_TEST(program.wait().exit_code == 0);
  const Cells verdicts = column("verdict");
  BOOST_TEST(std::ranges::count(verdicts, "crashed") == 1);
  BOOST_TEST(std::ranges::count(verdicts, "unfinished") == 0);
  BOOST_TEST(file_text(output + "/table.csv").find("signal 11") != std::string::npos);
}

BOOST_FIXTURE_TEST_CASE(a_run_whose_workers_are_killed_again_and_again_is_given_up, SweepWork) {
  write_sweep("\"numerics.end_time\" = {values = [100000.0, 0.5]}\n");
  RunningProgram program(command({"--jobs", "1"}));
  int n_kills = 0;
  std::set<pid_t> killed;
  BOOST_TEST(comes_true(
      [&] {
        for (const pid_t worker : workers()) {
          if (killed.insert(worker).second && ::kill(worker, SIGKILL) == 0) ++n_kills;
        }
        return program.ended();
      },
      std::chrono::seconds(120)));
  BOOST_TEST(program.wait().exit_code == 0);
  BOOST_TEST(n_kills >= 20);
  BOOST_TEST(column("verdict")[0] == "crashed");
  BOOST_TEST(column("reason")[0] == "21 workers were killed while computing it");
}

BOOST_FIXTURE_TEST_CASE(results_of_a_sweep_do_not_depend_on_units, SweepWork) {
  // Lengths times 3, times times 7: conductivity, capacitance and conductance scale with time and length as Eq. (9) has
  // them, energies with viscosity.
  const auto scene = [](double length, double time) {
    return fmt::format(
        "[shape]\nkind = \"ellipsoid\"\naxes = [{0}, {0}, {1}]\n[membrane]\nbending_modulus = {2}\n"
        "[flow]\nkind = \"shear\"\nrate = {3}\n[numerics]\norder = 6\ndt = {4}\nend_time = {5}\n",
        length, 1.5 * length, 0.1 * length * length * length / time, 1.0 / time, 0.25 * time, 0.5 * time);
  };
  const auto swept = [&](double length, double time) {
    write_text(directory / "base.toml", scene(length, time));
    write_sweep("\"fluid.viscosity_ratio\" = {values = [1.0, 2.0]}\n",
                "columns = [\"reduced_volume\", \"inclination_deg\", \"bending_energy_scaled\"]\n");
    const std::string place = directory / fmt::format("out{}", length);
    BOOST_TEST_REQUIRE(run({}, place).exit_code == 0);
    return table(place);
  };
  const auto rows = swept(1.0, 1.0), scaled = swept(3.0, 7.0);
  for (std::size_t row = 1; row < rows.size(); ++row) {
    for (std::size_t column = 1; column < 4; ++column) {
      BOOST_TEST(std::stod(scaled[row][column]) == std::stod(rows[row][column]), boost::test_tools::tolerance(1e-9));
    }
    BOOST_TEST(scaled[row][4] == rows[row][4]);
  }
}

BOOST_FIXTURE_TEST_CASE(a_script_for_slurm_shares_the_runs_out, SweepWork) {
  write_text(directory / "base.toml", quick_scene("5"));
  write_sweep("\"numerics.end_time\" = {values = [1.0, 2.0, 5.0]}\n\"numerics.degree\" = {values = [6, 8]}\n");
  const ProgramResult result = run({"--emit", "slurm", "--minutes", "90", "--json", directory / "result.json"});
  BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
  const std::string script = file_text(output + "/sweep.sbatch");
  for (const char* line : {"#SBATCH --array=0-0\n", "#SBATCH --time=90\n", "#SBATCH --signal=TERM@300\n"}) {
    BOOST_TEST(script.find(line) != std::string::npos, script);
  }
  BOOST_TEST(script.find("\nsrun --cpus-per-task=1 ") != std::string::npos, script);
  BOOST_TEST(script.find("scontrol requeue") != std::string::npos, script);
  BOOST_TEST(run_command({"bash", "-n", output + "/sweep.sbatch"}).exit_code == 0);
  // Memory for the worker and its parent process: more than nothing, less than that of a small machine.
  const std::size_t memory = script.find("#SBATCH --mem=");
  BOOST_TEST_REQUIRE(memory != std::string::npos, script);
  BOOST_TEST(std::stoi(script.substr(memory + 14)) > 10);
  BOOST_TEST(std::stoi(script.substr(memory + 14)) < 2000);
  BOOST_TEST(json_of(directory / "result.json").at("jobs").get<int>() == 1);
  BOOST_TEST(run({"--member", "1/2"}).exit_code == 0);
  BOOST_TEST(run({"--member", "7/7"}).errors.starts_with("--member 7/7: "));
}

BOOST_FIXTURE_TEST_CASE(a_slurm_script_has_the_options_of_the_cluster, SweepWork) {
  write_sweep(conductivities);
  write_text(directory / "modules.sh", "module load fftw");
  const std::vector<std::string> wanted = {
      "--account", "cells", "--partition", "long", "--prologue", directory / "modules.sh", "--turns", "3"};
  std::vector<std::string> emit = {"--emit", "slurm"};
  emit.insert(emit.end(), wanted.begin(), wanted.end());
  const ProgramResult result = run(emit);
  BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
  const std::string script = file_text(output + "/sweep.sbatch");
  for (const char* text : {"#SBATCH --account=\"cells\"\n", "#SBATCH --partition=\"long\"\n",
                           "\nmodule load fftw\nsrun ", "--dependency=afterany:$job"}) {
    BOOST_TEST(script.find(text) != std::string::npos, script);
  }
  BOOST_TEST(script.find("requeue") == std::string::npos, script);
  BOOST_TEST(run_command({"bash", "-n", output + "/sweep.sbatch"}).exit_code == 0);
  // Runs the line that submits all turns, with a stand-in for sbatch that prints its arguments.
  const std::size_t line = script.find("# job="), end = script.find('\n', line);
  BOOST_TEST_REQUIRE(line != std::string::npos, script);
  const ProgramResult turns =
      run_command({"bash", "-c", "sbatch() { echo \"$*\" >&2; echo 7; }; " + script.substr(line + 2, end - line - 2)});
  const std::string first = "--parsable " + output + "/sweep.sbatch\n",
                    next = "--parsable --dependency=afterany:7 " + output + "/sweep.sbatch\n";
  BOOST_TEST(turns.errors == first + next + next);
  const ProgramResult absent = run({"--emit", "slurm", "--prologue", directory / "absent.sh"});
  BOOST_TEST(absent.exit_code == 1);
  BOOST_TEST(absent.errors.find("--prologue: File does not exist: " + (directory / "absent.sh")) != std::string::npos,
             absent.errors);
  // These options require --emit.
  BOOST_TEST(run({"--account", "cells"}).exit_code == 1);
  BOOST_TEST(run({"--emit", "slurm", "--account", "a\"b"}).errors.find("a line #SBATCH cannot hold") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(the_script_for_one_run_works_in_scratch_space_and_brings_its_files_back) {
  const TemporaryDirectory directory;
  fs::create_directories(directory / "bin");
  write_text(directory / "bin/srun", "#!/bin/sh\necho \"$1\" > " + directory / "mpi\nshift 2\nexec \"$@\"\n");
  write_text(directory / "bin/scontrol", "#!/bin/sh\necho \"$*\" >> " + directory / "turns\n");
  for (const char* program : {"bin/srun", "bin/scontrol"}) {
    fs::permissions(directory / program, fs::perms::owner_all);
  }
  write_text(directory / "scene.toml", quick_scene("1.0"));
  const std::string output = directory / "out";
  const auto submit = [&](const std::string& program) {
    return run_command({"env", "PATH=" + directory / "bin:" + std::getenv("PATH"), "TMPDIR=" + directory / "scratch",
                        "SLURM_JOB_ID=7", "SLURM_CPUS_PER_TASK=1", "VEHD=" + program, "bash",
                        VEHD_SOURCE_DIR "/docs/slurm/one_run.sbatch", directory / "scene.toml", output});
  };
  BOOST_TEST_REQUIRE(submit(VEHD_PROGRAM).exit_code == 0);
  BOOST_TEST(file_text(directory / "mpi") == "--mpi=pmix\n");
  BOOST_TEST(json_of(output + "/summary.json").at("completed").get<bool>());
  BOOST_TEST(fs::is_empty(directory / "scratch"));
  BOOST_TEST(!fs::exists(directory / "turns"));
  // Continues in the existing folder; a run ended by a signal is requeued.
  const ProgramResult again = submit(VEHD_PROGRAM);
  BOOST_TEST(again.output.find("nothing to do") != std::string::npos, again.output);
  write_text(directory / "stopped", "#!/bin/sh\nexit 3\n");
  fs::permissions(directory / "stopped", fs::perms::owner_all);
  BOOST_TEST(submit(directory / "stopped").exit_code == 3);
  BOOST_TEST(file_text(directory / "turns") == "requeue 7\n");
}

BOOST_FIXTURE_TEST_CASE(pictures_show_lines_of_one_key_and_maps_of_two, SweepWork) {
  write_sweep(conductivities);
  BOOST_TEST_REQUIRE(run().exit_code == 0);
  BOOST_TEST(run_vehd({"plot", output}).exit_code == 0);
  BOOST_TEST(fs::file_size(output + "/plots/lines.png") > 1000u);
  write_sweep(conductivities + "\"numerics.dt\" = {values = [0.25, 0.125]}\n");
  BOOST_TEST_REQUIRE(run().exit_code == 0);
  const ProgramResult result =
      run_vehd({"plot", output, "--column", "aspect_ratio", "--border", "1.5", "--format", "pdf"});
  BOOST_TEST(result.exit_code == 0, result.errors);
  BOOST_TEST(result.output == output + "/plots/map_aspect_ratio.pdf\n");
  // A curve from corner to corner; the one below belongs to another sweep.
  write_text(directory / "curve.csv",
             "numerics.dt,electric.conductivity_in\n0.25,0.5\n0.125,2.0\n\n0.2,1.0\n0.2,2.0\n");
  BOOST_TEST(run_vehd({"plot", output, "--column", "aspect_ratio"}).exit_code == 0);
  const std::string map = file_text(output + "/plots/map_aspect_ratio.png");
  BOOST_TEST(run_vehd({"plot", output, "--column", "aspect_ratio", "--curve", directory / "curve.csv"}).exit_code == 0);
  BOOST_TEST((file_text(output + "/plots/map_aspect_ratio.png") != map));
  write_text(directory / "curve.csv", "numerics.dt,electric.conductivity_in\n0.25,1 kHz\n");
  BOOST_TEST(run_vehd({"plot", output, "--curve", directory / "curve.csv"})
                 .errors.find("curve.csv:2: 1 kHz of \"electric.conductivity_in\"; accepted: a number\n") !=
             std::string::npos);
  BOOST_TEST(run_vehd({"plot", output, "--column", "aspect_ration"}).errors.find("did you mean \"aspect_ratio\"?") !=
             std::string::npos);
  BOOST_TEST(run_vehd({"plot", output, "--border", "nan"}).errors == "--border: is nan; accepted: a finite number\n");
  for (const std::vector<std::string>& of_runs : std::vector<std::vector<std::string>>{
           {"--times", "0"}, {"--view", "x"}, {"--field", "tension"}, {"--section"}, {"--movie"}}) {
    std::vector<std::string> words{"plot", output};
    words.insert(words.end(), of_runs.begin(), of_runs.end());
    BOOST_TEST(run_vehd(words).errors ==
               output + ": is a sweep; --times, --view, --field, --section and --movie are for pictures of runs\n");
  }
  fs::remove(output + "/sweep.json");
  BOOST_TEST(run_vehd({"plot", output}).errors ==
             output + ": holds runs, but no table of a sweep yet (no sweep.json)\n");
}

BOOST_AUTO_TEST_SUITE_END()
