#include <unistd.h>

#include <boost/test/unit_test.hpp>

#include "bie/files/hdf5_reader.hpp"
#include "tests/app/reference_run.hpp"

namespace {

/// Wrong input must give exit code 1, exactly one line on standard error, and nothing on standard output.
void check_refused(const std::vector<std::string>& arguments, const std::string& message) {
  const ProgramResult result = run_vehd(arguments);
  BOOST_TEST(result.exit_code == 1);
  BOOST_TEST(result.errors == message + "\n");
  BOOST_TEST(result.output.empty());
}

struct SceneCase {
  TemporaryDirectory directory;
  std::string file = directory / "scene.toml";
  std::string output = directory / "out";

  void check(const std::string& text, const std::string& message) {
    write_text(file, text);
    check_refused({"run", file, "-o", output}, file + message);
    BOOST_TEST(!std::filesystem::exists(output));
  }
};

}  // namespace

BOOST_AUTO_TEST_SUITE(bad_input, *boost::unit_test::label("once"))

BOOST_FIXTURE_TEST_CASE(unknown_key, SceneCase) {
  check(quick_scene() + "[fluid]\nviscocity = 1.0\n",
        ":18: unknown key \"viscocity\" in [fluid]; did you mean \"viscosity\"?");
}

BOOST_FIXTURE_TEST_CASE(wrong_type, SceneCase) {
  check(quick_scene() + "[fluid]\nviscosity = \"high\"\n",
        ":18: \"viscosity\" in [fluid] is the text 'high'; accepted: a number > 0");
}

BOOST_FIXTURE_TEST_CASE(negative_viscosity, SceneCase) {
  check(quick_scene() + "[fluid]\nviscosity = -2.5\n", ":18: \"viscosity\" in [fluid] is -2.5; accepted: a number > 0");
}

BOOST_FIXTURE_TEST_CASE(not_a_number, SceneCase) {
  check(quick_scene() + "[fluid]\nviscosity = nan\n",
        ":18: \"viscosity\" in [fluid] is nan, not a finite number; accepted: a number > 0");
}

BOOST_FIXTURE_TEST_CASE(order_out_of_range, SceneCase) {
  check("[shape]\nkind = \"ellipsoid\"\naxes = [1, 1, 1]\n[numerics]\ndt = 1\nend_time = 1\norder = 1000000000\n",
        ":7: \"order\" in [numerics] is 1000000000; accepted: an integer, 4 ... 64");
}

BOOST_AUTO_TEST_CASE(missing_scene_file) {
  const TemporaryDirectory directory;
  check_refused({"run", directory / "absent.toml", "-o", directory / "out"},
                directory / "absent.toml" + ": no such file");
  BOOST_TEST(!std::filesystem::exists(directory / "out"));
}

BOOST_AUTO_TEST_CASE(wrong_usage) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{}, {"run"}, {"run", "a.toml", "b.toml"}, {"fly"}, {"plot", "--times", "x", "."}}) {
    const ProgramResult result = run_vehd(arguments);
    BOOST_TEST(result.exit_code == 1);
    BOOST_TEST(result.errors.find("--help") != std::string::npos, result.errors);
    BOOST_TEST(std::count(result.errors.begin(), result.errors.end(), '\n') == 1, result.errors);
  }
}

BOOST_AUTO_TEST_CASE(a_mistyped_command_names_the_nearest) {
  check_refused({"paln", "scene.toml"}, "vehd: unknown command \"paln\"; did you mean \"plan\"?; see vehd --help");
}

BOOST_AUTO_TEST_CASE(help_and_version_succeed) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"--help"}, {"--version"}, {"run", "--help"}, {"plot", "--help"}}) {
    const ProgramResult result = run_vehd(arguments);
    BOOST_TEST(result.exit_code == 0);
    BOOST_TEST(result.output.find("vehd") != std::string::npos);
    BOOST_TEST(result.errors.empty());
  }
  const std::string version = run_vehd({"--version"}).output;
  for (const char* library : {"compiler", "eigen", "fftw", "hdf5"}) {
    BOOST_TEST(version.find("\n" + std::string(library) + " ") != std::string::npos, version);
  }
}

BOOST_AUTO_TEST_CASE(unwritable_directory) {
  const TemporaryDirectory directory;
  write_text(directory / "scene.toml", quick_scene());
  write_text(directory / "file", "");
  // A file with the name of the output folder stops every user; permissions would not stop root.
  check_refused({"run", directory / "scene.toml", "-o", directory / "file"},
                directory / "file" + ": cannot be used as output directory: Not a directory");
  check_refused({"run", directory / "scene.toml", "-o", directory / "file/out"},
                directory / "file/out" + ": cannot be used as output directory: Not a directory");
  if (geteuid() == 0) return;
  std::filesystem::create_directory(directory / "closed");
  std::filesystem::permissions(directory / "closed",
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  check_refused({"run", directory / "scene.toml", "-o", directory / "closed"},
                directory / "closed" + ": cannot be written: Permission denied");
}

BOOST_FIXTURE_TEST_CASE(directory_that_holds_a_run, FinishedRun) {
  const std::string history = file_text(output + "/history.csv");
  const std::string snapshots = file_text(output + "/run.h5");
  check_refused({"run", scene, "-o", output},
                output + ": already holds a run (checkpoint.h5); continue it with --resume or choose another -o");
  BOOST_TEST((file_text(output + "/history.csv") == history));
  BOOST_TEST((file_text(output + "/run.h5") == snapshots));
}

BOOST_FIXTURE_TEST_CASE(nan_is_in_no_range, SceneCase) {
  write_text(file, quick_scene());
  check_refused({"run", file, "-o", output, "--checkpoint-every", "nan"},
                "vehd run: --checkpoint-every: is nan; accepted: a number from 0 to 86400; see vehd run --help");
  check_refused({"check", file, "--require", "nan"},
                "vehd check: --require: is nan; accepted: a number from 1e-09 to 1; see vehd check --help");
  check_refused({"bench", "time", file, "--at", "1", "--tolerance", "1e-3,nan"},
                "vehd bench: --tolerance: is nan; accepted: a number from 1e-09 to 0.1; see vehd bench --help");
  BOOST_TEST(!std::filesystem::exists(output));
}

BOOST_FIXTURE_TEST_CASE(no_output_replaces_an_input, FinishedRun) {
  const std::string text = file_text(scene);
  check_refused({"plan", scene, "--json", scene},
                "vehd plan: --json: " + scene +
                    " is also given as SCENE; writing the result would overwrite it; see vehd plan --help");
  for (const std::string name : {"/run.h5", "/scene.toml"}) {
    const std::string before = file_text(output + name);
    check_refused({"report", output, "-o", output + name},
                  "-o " + output + name + ": is a file of the run; accepted: another");
    BOOST_TEST((file_text(output + name) == before));
  }
  BOOST_TEST(file_text(scene) == text);
}

BOOST_AUTO_TEST_CASE(a_full_standard_output_is_reported) {
  for (const std::string command : {"help", "help scene"}) {
    const ProgramResult result = run_command({"sh", "-c", "exec " VEHD_PROGRAM " " + command + " > /dev/full"});
    BOOST_TEST(result.exit_code == 1, command);
    BOOST_TEST(result.errors == "standard output: cannot be written\n", command);
  }
}

BOOST_FIXTURE_TEST_CASE(empty_values_are_not_taken_for_none, SceneCase) {
  write_text(file, quick_scene());
  const auto check_empty = [](const std::vector<std::string>& arguments, const std::string& name) {
    const std::string command = "vehd " + arguments.front();
    check_refused(arguments, command + ": " + name + ": is empty; accepted: a value; see " + command + " --help");
  };
  check_empty({"run", file, "--from", ""}, "--from");
  check_empty({"run", file, "-o", ""}, "--output");
  check_empty({"run", ""}, "SCENE");
  check_empty({"plan", file, "--json", ""}, "--json");
  check_empty({"plot", ""}, "DIR");
  check_empty({"report", ""}, "DIR");
  check_empty({"bench", "time", file, "--dt", "1", "--at", "1", "-o", ""}, "--output");
}

BOOST_FIXTURE_TEST_CASE(directories_of_sweeps_and_fits_are_not_for_runs, SceneCase) {
  write_text(file, quick_scene());
  for (const std::string sign : {"sweep.json", "fit.json", "runs"}) {
    const TemporaryDirectory folder;
    std::filesystem::create_directory(folder / "runs");
    if (sign != "runs") write_text(folder / sign, "");
    for (const char* place : {"", "runs", "runs/"}) {
      if (sign == "runs" && *place != '\0') continue;
      check_refused({"run", file, "-o", folder / place},
                    folder / place + ": belongs to a sweep or a fit (" + sign + "); choose another -o");
    }
  }
}

BOOST_FIXTURE_TEST_CASE(foreign_history_is_not_overwritten, SceneCase) {
  write_text(file, quick_scene());
  std::filesystem::create_directory(output);
  write_text(output + "/history.csv", "mine");
  check_refused({"run", file, "-o", output}, output +
                                                 ": already holds a run (history.csv); continue it with "
                                                 "--resume or choose another -o");
  check_refused(
      {"run", file, "-o", output, "--resume"},
      output + ": holds a run (history.csv) without checkpoint.h5, which cannot be resumed; choose another -o");
  BOOST_TEST(file_text(output + "/history.csv") == "mine");
}

BOOST_FIXTURE_TEST_CASE(resume_with_another_scene_names_the_key, FinishedRun) {
  std::string other = quick_scene("0.5");
  other.replace(other.find("bending_modulus = 0.1"), 21, "bending_modulus = 0.2");
  write_text(scene, other);
  check_refused({"run", scene, "-o", output, "--resume"},
                scene + ":5: \"membrane.bending_modulus\" is 0.2, but the run in " + output +
                    " has 0.1; --resume accepts changes of [numerics] and [output] alone: keep the value or choose "
                    "another -o");
}

BOOST_FIXTURE_TEST_CASE(resume_with_an_earlier_end, FinishedRun) {
  write_text(scene, quick_scene("0.25"));
  check_refused({"run", scene, "-o", output, "--resume"},
                scene + ":14: \"numerics.end_time\" is 0.25, but the run in " + output +
                    " has already reached 0.5; accepted: that or later");
}

BOOST_FIXTURE_TEST_CASE(truncated_checkpoint, FinishedRun) {
  write_text(scene, quick_scene("1.0"));
  const std::string checkpoint = output + "/checkpoint.h5";
  const std::string history = file_text(output + "/history.csv");
  for (const std::uintmax_t size : {std::filesystem::file_size(checkpoint) / 2, std::uintmax_t{0}}) {
    std::filesystem::resize_file(checkpoint, size);
    const ProgramResult result = run_vehd({"run", scene, "-o", output, "--resume"});
    BOOST_TEST(result.exit_code == 1);
    BOOST_TEST(result.errors.find(checkpoint + ": has no seal at its end: it is truncated") == 0, result.errors);
    BOOST_TEST((file_text(output + "/history.csv") == history));
  }
}

BOOST_FIXTURE_TEST_CASE(altered_checkpoint, FinishedRun) {
  write_text(scene, quick_scene("1.0"));
  const std::string checkpoint = output + "/checkpoint.h5";
  const std::string original = file_text(checkpoint);
  // One bit of one coefficient of the position.
  const vehd::Matrix position = vehd::Hdf5Reader(checkpoint).matrix("/state/position");
  std::string altered = original;
  const std::size_t place = altered.find(std::string(reinterpret_cast<const char*>(&position(2, 2)), sizeof(double)));
  BOOST_TEST_REQUIRE(place != std::string::npos);
  altered[place] = static_cast<char>(altered[place] ^ 1);
  write_text(checkpoint, altered);
  const ProgramResult result = run_vehd({"run", scene, "-o", output, "--resume"});
  BOOST_TEST(result.exit_code == 1);
  BOOST_TEST(result.errors == checkpoint + ": is damaged: its bytes do not match their checksum\n");
}

BOOST_FIXTURE_TEST_CASE(truncated_run_file, FinishedRun) {
  const std::string file = output + "/run.h5";
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  const ProgramResult plot = run_vehd({"plot", output});
  BOOST_TEST(plot.exit_code == 1);
  BOOST_TEST(plot.errors.find(file + ": not a readable HDF5 file: truncated") == 0, plot.errors);

  write_text(directory / "next.toml",
             "[shape]\nkind = \"file\"\npath = \"out/run.h5\"\n"
             "[numerics]\norder = 6\ndt = 1\nend_time = 0\n");
  const ProgramResult run = run_vehd({"run", directory / "next.toml", "-o", directory / "next"});
  BOOST_TEST(run.exit_code == 1);
  BOOST_TEST(run.errors.find("run.h5: not a readable HDF5 file: truncated") != std::string::npos, run.errors);

  write_text(scene, quick_scene("1.0"));
  const ProgramResult resumed = run_vehd({"run", scene, "-o", output, "--resume"});
  BOOST_TEST(resumed.exit_code == 1);
  BOOST_TEST(resumed.errors.find(file + ": not a readable HDF5 file") == 0, resumed.errors);
}

BOOST_FIXTURE_TEST_CASE(shape_file_without_that_time, FinishedRun) {
  write_text(directory / "next.toml",
             "[shape]\nkind = \"file\"\npath = \"out/run.h5\"\ntime = 0.3\n"
             "[numerics]\norder = 6\ndt = 1\nend_time = 0\n");
  check_refused({"run", directory / "next.toml", "-o", directory / "next"},
                directory / "next.toml" + ":4: \"time\" in [shape] is 0.3, at which " + output +
                    "/run.h5 has no snapshot; the nearest is at 0.5");
}

BOOST_AUTO_TEST_CASE(plot_of_no_run) {
  const TemporaryDirectory directory;
  check_refused({"plot", directory / "absent"}, directory / "absent" + ": holds no run (no run.h5)");
}

BOOST_AUTO_TEST_SUITE_END()
