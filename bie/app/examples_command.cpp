#include <fmt/format.h>

#include <memory>

#include "bie/app/commands.hpp"
#include "bie/app/scene_choice.hpp"
#include "bie/scene/shipped_scenes.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"
#include "bie/support/text_table.hpp"

namespace vehd {
namespace {

namespace fs = std::filesystem;

struct ExamplesOptions {
  std::vector<std::string> names;
  bool all = false;
  std::string directory = ".";
  CommonOptions common;

  [[nodiscard]] bool wants(const ShippedScene& scene) const {
    return all || std::find(names.begin(), names.end(), scene.name) != names.end();
  }
};

std::vector<std::string> names_of_scenes() {
  std::vector<std::string> names;
  for (const ShippedScene& scene : shipped_scenes()) names.emplace_back(scene.name);
  return names;
}

void list(const ExamplesOptions& options) {
  TextTable rows;
  nlohmann::json result = nlohmann::json::array();
  for (const ShippedScene& scene : shipped_scenes()) {
    rows.push_back({std::string(scene.name), title_of(scene)});
    result.push_back({{"name", scene.name}, {"title", title_of(scene)}});
  }
  fmt::print("{}", aligned(rows, ""));
  write_json(options.common, {{"examples", result}});
}

/// Refuses to overwrite a file that differs from the example.
void require_free(const fs::path& file, const ShippedScene& scene) {
  if (!fs::exists(file) || text_of_file(file) == scene.text) return;
  throw InputError(
      fmt::format("{}: exists already and differs from the example; accepted: another folder (-o)", file.string()));
}

void write(const ExamplesOptions& options) {
  const fs::path directory = options.directory;
  make_directory(directory);
  const auto file_of = [&](const ShippedScene& scene) {
    return (directory / fmt::format("{}.toml", scene.name)).lexically_normal();
  };
  for (const ShippedScene& scene : shipped_scenes()) {
    if (options.wants(scene)) require_free(file_of(scene), scene);
  }
  nlohmann::json result = nlohmann::json::array();
  for (const ShippedScene& scene : shipped_scenes()) {
    if (!options.wants(scene)) continue;
    replace_file(file_of(scene), std::string(scene.text));
    fmt::print("{}\n", file_of(scene).string());
    result.push_back(file_of(scene).string());
  }
  write_json(options.common, {{"files", result}});
}

}  // namespace

void add_examples_command(CLI::App& program, ExitCode& exit_code) {
  CLI::App* command = program.add_subcommand("examples", "List the scenes that come with vehd, or write some of them");
  const auto options = std::make_shared<ExamplesOptions>();
  command->add_option("NAME", options->names, "Scenes to write, as NAME.toml; none: list all")
      ->check(one_of(names_of_scenes()));
  command->add_flag("--all", options->all, "Write every scene");
  command->add_option("-o,--output", options->directory, "Folder for the scenes; the current one if not given")
      ->type_name("DIR");
  add_common_options(*command, options->common);
  command->callback([options, &exit_code] {
    if (options->all || !options->names.empty()) {
      write(*options);
    } else {
      list(*options);
    }
    exit_code = ExitCode::done;
  });
}

}  // namespace vehd
