#include <sys/stat.h>
#include <unistd.h>

#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "bie/support/file_system.hpp"
#include "tests/app/finite_elements.hpp"
#include "tests/app/reference_run.hpp"

namespace {

namespace fs = std::filesystem;

const std::vector<std::string> quick_command = {"verify", "--order", "4"};

ProgramResult with_json(std::vector<std::string> arguments, const std::string& target) {
  arguments.insert(arguments.end(), {"--json", target});
  return run_vehd(arguments);
}

/// `vehd ARGUMENTS` as a shell runs it, for pipes and redirections; "$@" stands for the command.
ProgramResult in_shell(const std::string& script, const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {"sh", "-c", script, "sh"};
  const std::vector<std::string> command = vehd_command(arguments);
  words.insert(words.end(), command.begin(), command.end());
  return run_command(words);
}

bool is_result(const std::string& text) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  return json.is_object() && json.contains("error_q");
}

/// Requires that the folder holds these names and no others.
void check_holds(const fs::path& folder, const std::set<std::string>& names) {
  std::set<std::string> found;
  for (const auto& entry : fs::directory_iterator(folder)) found.insert(entry.path().filename().string());
  BOOST_TEST(found == names, boost::test_tools::per_element());
}

}  // namespace

BOOST_AUTO_TEST_SUITE(result_file, *boost::unit_test::label("slow") * boost::unit_test::label("once"))

BOOST_AUTO_TEST_CASE(pipe_gets_the_result_and_stays_a_pipe) {
  const TemporaryDirectory directory;
  const std::string pipe = directory / "pipe";
  BOOST_TEST_REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  const ProgramResult result = in_shell("cat '" + pipe + "' & \"$@\" --json '" + pipe + "' >&2 && wait", quick_command);
  BOOST_TEST(result.exit_code == 0, result.errors);
  BOOST_TEST(is_result(result.output), result.output);
  BOOST_TEST(fs::is_fifo(pipe));
  check_holds(directory / "", {"pipe"});
}

BOOST_AUTO_TEST_CASE(device_stays_a_device) {
  // A link to /dev/null, not the device itself: if that were replaced, the machine would no longer work.
  const TemporaryDirectory directory;
  fs::create_symlink("/dev/null", directory / "null");
  BOOST_TEST(with_json(quick_command, directory / "null").exit_code == 0);
  BOOST_TEST(fs::is_symlink(directory / "null"));
  fs::create_symlink("/dev/full", directory / "full");
  const ProgramResult full = with_json(quick_command, directory / "full");
  BOOST_TEST(full.exit_code == 1);
  BOOST_TEST(full.errors == directory / "full" + ": cannot be written: No space left on device\n");
  check_holds(directory / "", {"null", "full"});
}

BOOST_AUTO_TEST_CASE(file_behind_links_is_replaced_and_the_links_stay) {
  const TemporaryDirectory directory;
  fs::create_directories(directory / "near/far");
  write_text(directory / "near/far/there.json", "old");
  fs::create_symlink("far/there.json", directory / "near/relative");
  fs::create_symlink(directory / "near/relative", directory / "near/far/absolute");
  fs::create_symlink("near/far", directory / "folder");
  fs::create_symlink("../away.json", directory / "near/far/dangling");
  for (const auto& [link, file] : {std::pair{"near/relative", "near/far/there.json"},
                                   {"near/far/absolute", "near/far/there.json"},
                                   {"folder/absolute", "near/far/there.json"},
                                   {"folder/dangling", "near/away.json"}}) {
    const ProgramResult result = with_json(quick_command, directory / link);
    BOOST_TEST(result.exit_code == 0, result.errors);
    BOOST_TEST(fs::is_symlink(directory / link), link);
    BOOST_TEST(is_result(file_text(directory / file)), link);
    write_text(directory / file, "old");
  }
  check_holds(directory / "", {"near", "folder"});
  check_holds(directory / "near", {"far", "relative", "away.json"});
  check_holds(directory / "near/far", {"there.json", "absolute", "dangling"});
}

BOOST_AUTO_TEST_CASE(a_reader_sees_the_old_or_the_new_file) {
  // The link then leads to a new file: a reader that has the old one open reads it to its end.
  const TemporaryDirectory directory;
  write_text(directory / "file", "old");
  fs::create_symlink("file", directory / "link");
  std::ifstream reader(directory / "file");
  vehd::replace_file(directory / "link", "new text");
  std::string word;
  reader >> word;
  BOOST_TEST(word == "old");
  BOOST_TEST(file_text(directory / "file") == "new text");
}

BOOST_AUTO_TEST_CASE(standard_output_holds_the_result_alone) {
  for (const char* name : {"-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"}) {
    // Standard output is a file, as in RunningProgram, or a pipe.
    for (const ProgramResult& result :
         {with_json(quick_command, name), in_shell(std::string("\"$@\" --json ") + name + " | cat", quick_command)}) {
      BOOST_TEST(result.exit_code == 0, result.errors);
      BOOST_TEST(is_result(result.output), name << ": " << result.output);
      BOOST_TEST(result.errors.find("Example 1") != std::string::npos, name);
    }
  }
}

BOOST_AUTO_TEST_CASE(descriptor_of_the_shell_is_written_where_it_stands) {
  const TemporaryDirectory directory;
  const std::string log = directory / "log";
  const ProgramResult result =
      in_shell("exec 5>'" + log + "'; echo before >&5; \"$@\" --json /dev/fd/5; echo after >&5", quick_command);
  BOOST_TEST(result.exit_code == 0, result.errors);
  const std::string text = file_text(log);
  BOOST_TEST_REQUIRE(text.starts_with("before\n{"));
  BOOST_TEST_REQUIRE(text.ends_with("}\nafter\n"));
  BOOST_TEST(is_result(text.substr(7, text.size() - 7 - 6)), text);
}

BOOST_FIXTURE_TEST_CASE(every_command_can_have_standard_output_for_its_result, FinishedRun) {
  std::vector<std::vector<std::string>> commands = {
      quick_command,
      {"plan", scene},
      {"plot", output, "-o", directory / "plots"},
      {"run", scene, "-o", directory / "again", "--no-plot"},
      {"run", scene, "-o", output, "--resume"},
      {"bench", "space", "--orders", "6,8", "--repeats", "1", "--no-plot", "-o", directory / "bench"},
      {"help", "scene"},
      {"help", "groups", scene}};
  if (finite_elements_are_built()) {
    commands.push_back({"mesh", scene, "-o", directory / "mesh.msh"});
    // This degree resolves the bending force, so that every row is decided.
    commands.push_back({"check", scene, "--set", "numerics.degree=16", "--quick", "--ranks", "2", "--require", "0.1",
                        "-o", directory / "check"});
  }
  for (const auto& command : commands) {
    const ProgramResult result = with_json(command, "-");
    BOOST_TEST(result.exit_code == 0, command.front() << ": " << result.errors);
    BOOST_TEST(nlohmann::json::accept(result.output), command.front() << ": " << result.output);
    BOOST_TEST(!result.errors.empty(), command.front());
  }
}

BOOST_AUTO_TEST_CASE(place_that_cannot_be_written_is_named) {
  const TemporaryDirectory directory;
  write_text(directory / "file", "");
  fs::create_directory(directory / "folder");
  fs::create_symlink("no_folder/away.json", directory / "dangling");
  fs::create_symlink("circle", directory / "circle");
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"folder", "folder: cannot be written: Is a directory"},
      {"missing/result.json", "missing/result.json: cannot be written: No such file or directory"},
      {"file/result.json", "file/result.json: cannot be written: Not a directory"},
      {"dangling", "no_folder/away.json: cannot be written: No such file or directory"},
      {"circle", "circle: cannot be written: Too many levels of symbolic links"}};
  for (const auto& [name, problem] : cases) {
    const ProgramResult result = with_json(quick_command, directory / name);
    BOOST_TEST(result.exit_code == 1, name);
    BOOST_TEST(result.errors == directory / problem + "\n");
  }
  check_holds(directory / "", {"file", "folder", "dangling", "circle"});
  if (::geteuid() == 0) return;
  fs::permissions(directory / "folder", fs::perms::owner_read | fs::perms::owner_exec);
  const ProgramResult closed = with_json(quick_command, directory / "folder/result.json");
  BOOST_TEST(closed.exit_code == 1);
  BOOST_TEST(closed.errors == directory / "folder/result.json" + ": cannot be written: Permission denied\n");
}

BOOST_FIXTURE_TEST_CASE(files_of_a_run_that_lie_elsewhere_stay_there, FinishedRun) {
  // As a user moves files to a larger disk in the middle of a run.
  fs::create_directory(directory / "large_disk");
  for (const char* name : {"run.h5", "run.xdmf", "summary.json", "scene.toml", "checkpoint.h5", "history.csv"}) {
    fs::rename(output + "/" + name, directory / (std::string("large_disk/") + name));
    fs::create_symlink("../large_disk/" + std::string(name), output + "/" + name);
  }
  const std::size_t size = snapshot_data(output + "/run.h5").size();
  write_text(scene, quick_scene("4.0"));
  const ProgramResult result = run_vehd({"run", scene, "-o", output, "--resume", "--no-plot"});
  BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
  for (const auto& entry : fs::directory_iterator(directory / "large_disk")) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(".")) continue;
    BOOST_TEST(fs::is_symlink(output + "/" + name), name);
  }
  BOOST_TEST(snapshot_data(directory / "large_disk/run.h5").size() > size);
}

BOOST_AUTO_TEST_SUITE_END()
