#include <fmt/format.h>

#include <memory>

#include "bie/app/commands.hpp"
#include "bie/scene/dimensionless_groups.hpp"
#include "bie/scene/reader.hpp"
#include "bie/scene/schema_text.hpp"
#include "bie/scene/vesicles.hpp"
#include "bie/support/text_table.hpp"

namespace vehd {
namespace {

struct HelpOptions {
  bool markdown = false;
  std::string scene_file;
  CommonOptions common;
};

nlohmann::json keys_as_json() {
  nlohmann::json keys = nlohmann::json::array();
  for (const KeyReference& key : key_references()) {
    keys.push_back({{"table", key.table},
                    {"key", key.name},
                    {"kinds", key.kinds},
                    {"symbol", key.symbol},
                    {"type", key.type},
                    {"unit", key.unit},
                    {"range", key.range},
                    {"default", key.default_value},
                    {"meaning", key.meaning}});
  }
  return {{"keys", keys}};
}

void print_groups(const HelpOptions& options) {
  const Scene scene = read_scene(options.scene_file);
  require_one_vesicle(scene, options.scene_file, "vehd help groups");
  TextTable rows;
  nlohmann::json result = nlohmann::json::array();
  for (const DimensionlessGroup& group : dimensionless_groups(scene)) {
    const std::string si = si_text(scene, group);
    rows.push_back({std::string(group.symbol), fmt::format("{:.5g}", group.value), si.empty() ? "" : "= " + si,
                    std::string(group.name), std::string(group.meaning)});
    result.push_back(
        {{"name", std::string(group.name)}, {"symbol", std::string(group.symbol)}, {"value", group.value}, {"si", si}});
  }
  fmt::print("{}", aligned(rows, ""));
  write_json(options.common, {{"groups", result}});
}

void add_scene_topic(CLI::App& help, ExitCode& exit_code) {
  CLI::App* command = help.add_subcommand("scene", "Every table and key of a scene file");
  const auto options = std::make_shared<HelpOptions>();
  command->add_flag("--markdown", options->markdown, "As the page docs/scene_keys.md");
  add_common_options(*command, options->common);
  command->callback([options, &exit_code] {
    fmt::print("{}", options->markdown ? scene_help_markdown() : scene_help());
    write_json(options->common, keys_as_json());
    exit_code = ExitCode::done;
  });
}

void add_groups_topic(CLI::App& help, ExitCode& exit_code) {
  CLI::App* command = help.add_subcommand("groups", "The dimensionless groups of a scene");
  const auto options = std::make_shared<HelpOptions>();
  command->add_option("SCENE", options->scene_file, "Scene file (TOML)")->required();
  add_common_options(*command, options->common);
  command->callback([options, &exit_code] {
    print_groups(*options);
    exit_code = ExitCode::done;
  });
}

/// `help NAME ...` for every command below `owner`: what the command prints with --help.
/// @param call  command line of the owner
void add_command_topics(CLI::App& help, const CLI::App& owner, const std::string& call, ExitCode& exit_code) {
  for (const CLI::App* command : owner.get_subcommands([](const CLI::App*) { return true; })) {
    // A group of options is a command without a name.
    if (command == &help || command->get_name().empty()) continue;
    CLI::App* topic = help.add_subcommand(command->get_name(), command->get_description());
    topic->group("Help on a command");
    topic->require_subcommand(0, 1);
    const auto options = std::make_shared<HelpOptions>();
    add_common_options(*topic, options->common);
    topic->callback([topic, command, call, options, &exit_code] {
      if (!topic->get_subcommands().empty()) return;
      const std::string text = command->help(call);
      fmt::print("{}", text);
      write_json(options->common, {{"command", command->get_name()}, {"help", text}});
      exit_code = ExitCode::done;
    });
    add_command_topics(*topic, *command, call + " " + command->get_name(), exit_code);
  }
}

}  // namespace

void add_help_command(CLI::App& program, ExitCode& exit_code) {
  CLI::App* command =
      program.add_subcommand("help", "Explain the keys of a scene file, a scene's dimensionless groups, or a command");
  command->require_subcommand(0, 1);
  add_scene_topic(*command, exit_code);
  add_groups_topic(*command, exit_code);
  add_command_topics(*command, program, "vehd", exit_code);
  const auto options = std::make_shared<HelpOptions>();
  add_common_options(*command, options->common);
  command->callback([command, options, &exit_code] {
    if (command->get_subcommands().empty()) {
      const std::string text = command->help("vehd");
      fmt::print("{}", text);
      write_json(options->common, {{"command", command->get_name()}, {"help", text}});
    }
    exit_code = ExitCode::done;
  });
}

}  // namespace vehd
