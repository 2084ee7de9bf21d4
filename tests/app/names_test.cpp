#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <regex>
#include <string>
#include <vector>

#include "bie/scene/schema.hpp"
#include "tests/app/finite_elements.hpp"
#include "tests/app/sweep_folder.hpp"

namespace {

namespace fs = std::filesystem;

/// Names that act as commands if taken as part of a script: each would create a file "pwned" in the home directory.
std::vector<std::string> hostile_names() {
  std::vector<std::string> names = {"q\n!cd;touch pwned\n#",
                                    "a';!cd;touch pwned;'",
                                    "`cd;touch pwned`",
                                    "$(cd;touch pwned)",
                                    "\";cd;touch pwned;\"",
                                    "x'\nset print '|cd;touch pwned'\nprint 'y",
                                    "| cd;touch pwned",
                                    "< cd;touch pwned",
                                    "a&b<script>touch(1)<!--]]>{{data}}",
                                    "%06d %s %n 100%",
                                    "-o",
                                    "~",
                                    "ü \xe2\x88\xab @x {a} _b ^c \\",
                                    "not \xff\xfe UTF-8"};
  const std::vector<std::string> parts = {
      "'",  "\"", "`", "\n", "\r", "\t", "$(", ")", "${HOME}", "!",           "#",    "<", ">", "&", ";",  "|",
      "\\", "%",  "*", "?",  "~",  "{{", "}}", "=", "cd",      "touch pwned", "\x1b", "é", " ", "-", "@a", "]]>"};
  std::mt19937 random(50);
  std::uniform_int_distribution<std::size_t> part(0, parts.size() - 1), length(1, 12);
  for (int i = 0; i < 6; ++i) {
    std::string name;
    for (std::size_t left = length(random); left > 0; --left) name += parts[part(random)];
    names.push_back(name);
  }
  return names;
}

/// A separate home directory for files that a command might leave there.
struct HostileFolder {
  TemporaryDirectory directory;
  const char* const former = std::getenv("HOME");

  HostileFolder() {
    fs::create_directory(directory / "home");
    ::setenv("HOME", (directory / "home").c_str(), 1);
  }
  ~HostileFolder() { former != nullptr ? ::setenv("HOME", former, 1) : ::unsetenv("HOME"); }
  HostileFolder(const HostileFolder&) = delete;
  HostileFolder& operator=(const HostileFolder&) = delete;

  /// Runs a command in the folder and checks that it has not created a file "pwned".
  ProgramResult run(std::vector<std::string> command, const std::string& name) const {
    command.insert(command.begin(), {"env", "-C", directory / ""});
    const ProgramResult result = run_command(command);
    BOOST_TEST(!fs::exists(directory / "home/pwned"), command[4] << " with the name " << name);
    BOOST_TEST(!fs::exists(directory / "pwned"), command[4] << " with the name " << name);
    return result;
  }
  void run_well(const std::vector<std::string>& arguments, const std::string& name) const {
    const ProgramResult result = run(vehd_command(arguments), name);
    BOOST_TEST(result.exit_code == 0, arguments.front() << " with the name " << name << ": " << result.errors);
  }
};

/// @param check  Python that reads the file sys.argv[1], and fails if it is not well formed
void require_readable(const std::string& file, const std::string& check) {
  const ProgramResult result = run_command({"python3", "-c", "import sys\n" + check, file});
  BOOST_TEST(result.exit_code == 0, file << ": " << result.errors);
}

constexpr const char* xml = "import xml.etree.ElementTree as tree; tree.parse(sys.argv[1])";

}  // namespace

BOOST_AUTO_TEST_SUITE(names, *boost::unit_test::label("slow") * boost::unit_test::label("extended") *
                                 boost::unit_test::label("once"))

BOOST_AUTO_TEST_CASE(of_files_and_directories_are_data_to_every_command) {
  for (const std::string& name : hostile_names()) {
    const HostileFolder folder;
    // A name that begins with "-" is taken as an option, as in other programs.
    const std::string place = name.starts_with('-') ? "./" + name : name;
    const std::string scene = place + ".toml", run = place;
    write_text(folder.directory / scene, quick_scene("1.0"));
    folder.run_well({"run", scene, "-o", run, "--quiet", "--json", place + ".json"}, name);
    BOOST_TEST(fs::exists(folder.directory / (run + "/plots/history.png")));
    require_readable(folder.directory / (place + ".json"), "import json; json.load(open(sys.argv[1]))");
    require_readable(folder.directory / (run + "/run.xdmf"), xml);
    folder.run_well({"run", scene, "-o", run, "--quiet", "--resume", "--set", "numerics.end_time=1.5"}, name);
    folder.run_well({"plot", run, "-o", place + ".svg"}, name);
    require_readable(folder.directory / (place + ".svg"), xml);
    folder.run_well({"report", run, "-o", place + ".html"}, name);
    const std::string page = file_text(folder.directory / (place + ".html"));
    BOOST_TEST(page.find("touch(1)<!--") == std::string::npos);
    BOOST_TEST(page.find("<script>touch") == std::string::npos);
  }
}

BOOST_AUTO_TEST_CASE(of_data_fits_and_checks_are_data) {
  for (const std::string& name : hostile_names()) {
    const HostileFolder folder;
    const std::string place = name.starts_with('-') ? "./" + name : name, data = folder.directory / "data.csv";
    const std::string scene = quick_scene("0.5");
    write_text(folder.directory / "scene.toml", scene);
    folder.run_well({"synthesise", "scene.toml", "-o", place, "--quantity", "Vm_north", "--noise", "0.001", "--quiet"},
                    name);
    fs::rename(folder.directory / place, data);
    write_text(folder.directory / (place + ".toml"),
               "[[experiment]]\nscene = 'scene.toml'\ndata = 'data.csv'\nquantity = 'Vm_north'\n"
               "[free]\n'membrane.conductance' = {from = 1.0, to = 9.0}\n");
    folder.run_well({"fit", place + ".toml", "-o", place, "--jobs", "1", "--quiet"}, name);
    if (!fs::exists(finite_element_program())) continue;
    write_text(folder.directory / (place + ".toml"),
               std::regex_replace(scene, std::regex("bending_modulus = 0.1"), "mobile = false"));
    folder.run_well({"check", place + ".toml", "--quick", "--ranks", "1", "-o", place + ".check"}, name);
  }
}

BOOST_AUTO_TEST_CASE(of_a_movie_are_data_to_ffmpeg) {
  const HostileFolder folder;
  const std::string name = "%06d 'x'\n`cd;touch pwned`.mp4";
  write_text(folder.directory / "scene.toml", quick_scene("1.0"));
  folder.run_well({"run", "scene.toml", "-o", "run", "--quiet", "--no-plot"}, name);
  fs::create_directory(folder.directory / "%d temporary");
  ::setenv("TMPDIR", (folder.directory / "%d temporary").c_str(), 1);
  folder.run_well({"plot", "run", "--movie", "-o", name}, name);
  ::unsetenv("TMPDIR");
}

BOOST_AUTO_TEST_CASE(of_a_sweep_are_words_of_its_script_for_slurm) {
  for (const std::string& name : hostile_names()) {
    const HostileFolder folder;
    const std::string place = name.starts_with('-') ? "./" + name : name;
    write_text(folder.directory / "base.toml", quick_scene("0.5"));
    write_text(folder.directory / (place + ".toml"),
               "scene = \"base.toml\"\n[vary]\n\"electric.conductivity_in\" = {values = [1.0, 3.0]}\n");
    const std::vector<std::string> sweep = {"sweep", place + ".toml", "-o", place, "--quiet", "--json", "result.json"};
    folder.run_well(sweep, name);
    folder.run_well({"plot", place}, name);
    std::vector<std::string> emit = sweep;
    emit.insert(emit.end(), {"--emit", "slurm"});
    const ProgramResult emitted = folder.run(vehd_command(emit), name);
    const std::string script = folder.directory / (place + "/sweep.sbatch");
    if (emitted.exit_code == 1) {
      BOOST_TEST(emitted.errors.find("a line #SBATCH cannot hold") != std::string::npos, emitted.errors);
      BOOST_TEST(!fs::exists(script));
      continue;
    }
    BOOST_TEST(emitted.exit_code == 0, name << ": " << emitted.errors);
    // Stand-ins for srun and scontrol that print their arguments.
    fs::create_directory(folder.directory / "bin");
    write_text(folder.directory / "bin/srun", "#!/bin/sh\nprintf '%s\\0' \"$@\"\n");
    fs::permissions(folder.directory / "bin/srun", fs::perms::owner_all);
    const ProgramResult started = folder.run(
        {"env", "PATH=" + (folder.directory / "bin") + ":/usr/bin:/bin", "SLURM_ARRAY_TASK_ID=0", "bash", script},
        name);
    std::string expected;
    const auto absolute = [&](const std::string& file) {
      return fs::path(folder.directory / file).lexically_normal().string();
    };
    for (const std::string& word :
         {std::string("--cpus-per-task=1"), std::string(VEHD_PROGRAM), std::string("sweep"), absolute(place + ".toml"),
          std::string("-o"), absolute(place), std::string("--member"), std::string("0/1"), std::string("--jobs"),
          std::string("1"), std::string("--threads"), std::string("1")}) {
      expected += word + '\0';
    }
    BOOST_TEST((started.output == expected), name << ": " << started.output << started.errors);
  }
}

BOOST_AUTO_TEST_CASE(of_vesicles_and_words_of_a_scene_stand_in_all_files_as_they_are) {
  const HostileFolder folder;
  std::vector<std::string> given;
  std::string scene =
      "[membrane]\nbending_modulus = 0.1\n[numerics]\ndegree = 4\ndt = 0.1\nend_time = 0.1\n[electric]\n"
      "field = [0, 0, 0.1]\nconductivity_in = 2\nconductivity_out = 1\n[electric.waveform]\nkind = \"table\"\n"
      "path = " +
      vehd::to_toml(std::string("a\n`cd;touch pwned` 'b' & <c>.csv")) + "\n";
  write_text(folder.directory / "a\n`cd;touch pwned` 'b' & <c>.csv", "0,0\n0.05,1\n1,1\n");
  for (const std::string& name : hostile_names()) {
    const bool is_plain = std::ranges::all_of(
        name, [](unsigned char letter) { return letter >= 0x20 && letter != 0x7f && letter != '"' && letter < 0xf0; });
    if (!is_plain || name.size() > 64) continue;
    given.push_back(name);
    scene += "[[vesicle]]\nname = " + vehd::to_toml(name) +
             "\n[vesicle.shape]\nkind = \"ellipsoid\"\naxes = [1, 1, 1.2]\ncentre = [0, 0, " +
             std::to_string(10 * given.size()) + "]\n";
    if (given.size() == 6) break;
  }
  BOOST_TEST_REQUIRE(given.size() == 6u);
  write_text(folder.directory / "scene.toml", scene);
  folder.run_well({"run", "scene.toml", "-o", "run", "--quiet"}, "of the vesicles");
  folder.run_well({"plot", "run", "-o", "shapes.svg"}, "of the vesicles");
  require_readable(folder.directory / "shapes.svg", xml);
  require_readable(folder.directory / "run/run.xdmf", xml);
  BOOST_TEST((json_of(folder.directory / "run/summary.json").at("vesicles").get<std::vector<std::string>>() == given));
  // The scene that a run writes can be read again.
  folder.run_well({"plan", "run/scene.toml"}, "of the vesicles");
}

BOOST_AUTO_TEST_CASE(of_columns_and_values_in_files_are_no_commands) {
  for (const std::string& name : hostile_names()) {
    if (name.find_first_of("\n\r\xff") != std::string::npos) continue;
    const HostileFolder folder;
    write_text(folder.directory / "base.toml", quick_scene("0.5"));
    write_text(folder.directory / "some.toml",
               "scene = \"base.toml\"\n[vary]\n\"electric.conductivity_in\" = {values = [1.0, 3.0]}\n"
               "\"numerics.dt\" = {values = [0.25, 0.125]}\n");
    folder.run_well({"sweep", "some.toml", "-o", "sweep", "--quiet"}, name);
    nlohmann::json sweep = json_of(folder.directory / "sweep/sweep.json");
    sweep["keys"][0]["name"] = name;
    sweep["columns"][1] = name + " [" + name + "]";
    write_text(folder.directory / "sweep/sweep.json", sweep.dump());
    std::string table = file_text(folder.directory / "sweep/table.csv");
    for (std::size_t at = table.find("3.0,"); at != std::string::npos; at = table.find("3.0,")) {
      table.replace(at, 4, vehd::csv_line({name, ""}).substr(0, vehd::csv_line({name, ""}).size() - 1));
    }
    write_text(folder.directory / "sweep/table.csv", table);
    const ProgramResult drawn = folder.run(vehd_command({"plot", "sweep", "--format", "svg"}), name);
    BOOST_TEST((drawn.exit_code == 0 || drawn.exit_code == 1), name << ": " << drawn.errors);
    // Nothing is written beside the pictures of the sweep.
    BOOST_TEST(std::ranges::distance(fs::directory_iterator(folder.directory / "")) == 4, name);
  }
}

BOOST_AUTO_TEST_SUITE_END()
