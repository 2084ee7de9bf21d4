#include <boost/test/unit_test.hpp>
#include <regex>
#include <sstream>

#include "tests/app/program.hpp"

namespace {

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

std::string help_of(std::vector<std::string> command) {
  command.emplace_back("--help");
  const ProgramResult result = run_vehd(command);
  BOOST_TEST(result.exit_code == 0);
  return result.output;
}

/// Commands without subcommands, as words: {"bench", "time"}.
std::vector<std::vector<std::string>> commands_below(const std::vector<std::string>& owner) {
  const std::string help = help_of(owner);
  const std::size_t start = help.find("\nSubcommands:\n");
  if (start == std::string::npos) return {owner};
  std::vector<std::vector<std::string>> commands;
  std::istringstream lines(help.substr(start + 14));
  for (std::string line; std::getline(lines, line) && line.starts_with("  ");) {
    if (line.starts_with("   ")) continue;
    std::vector<std::string> command = owner;
    command.push_back(words_of(line).front());
    for (auto& found : commands_below(command)) commands.push_back(std::move(found));
  }
  return commands;
}

/// Words that completion offers after a line.
std::vector<std::string> offered(const std::string& line) {
  const std::string script = "source <('" VEHD_PROGRAM "' completion bash); COMP_WORDS=(" + line +
                             "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _vehd; printf '%s\\n' \"${COMPREPLY[@]}\"";
  return words_of(run_command({"bash", "-c", script}).output);
}

bool has(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

BOOST_AUTO_TEST_SUITE(commands, *boost::unit_test::label("once"))

BOOST_AUTO_TEST_CASE(every_command_writes_json) {
  const auto commands = commands_below({});
  BOOST_TEST(commands.size() > 15u);
  for (const auto& command : commands) {
    BOOST_TEST(help_of(command).find("--json FILE") != std::string::npos, command.back());
  }
}

BOOST_AUTO_TEST_CASE(help_of_a_command_equals_the_text_that_it_prints_itself) {
  for (auto command : commands_below({})) {
    if (command.front() == "help") continue;
    std::vector<std::string> topic = {"help"};
    topic.insert(topic.end(), command.begin(), command.end());
    BOOST_TEST(run_vehd(topic).output == help_of(command), command.back());
  }
  BOOST_TEST(run_vehd({"help", "bench"}).output == help_of({"bench"}));
  BOOST_TEST(run_vehd({"help", "rum"}).exit_code == 1);
}

BOOST_AUTO_TEST_CASE(json_goes_to_standard_output_alone) {
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"examples"}, {"help"}, {"help", "run"}, {"help", "scene"}, {"completion", "bash"}}) {
    std::vector<std::string> arguments = command;
    arguments.insert(arguments.end(), {"--json", "-"});
    const ProgramResult result = run_vehd(arguments);
    BOOST_TEST(result.exit_code == 0, result.errors);
    BOOST_TEST(nlohmann::json::accept(result.output), command.back() << ": " << result.output);
  }
}

BOOST_AUTO_TEST_CASE(completion_offers_commands_options_and_choices) {
  BOOST_TEST((offered("vehd exa") == std::vector<std::string>{"examples"}));
  BOOST_TEST((offered("vehd run --thr") == std::vector<std::string>{"--threads"}));
  BOOST_TEST((offered("vehd plan --se") == std::vector<std::string>{"--set"}));
  BOOST_TEST(has(offered("vehd examples fig"), "figure2"));
  BOOST_TEST((offered("vehd bench ti") == std::vector<std::string>{"time"}));
  BOOST_TEST(has(offered("vehd bench time --d"), "--dt"));
  BOOST_TEST(has(offered("vehd help bench spa"), "space"));
  // Scenes are files; the shell completes file names if nothing is offered.
  BOOST_TEST(offered("vehd run docs/sc").empty());
  BOOST_TEST(offered("vehd bench time docs/sc").empty());
}

BOOST_AUTO_TEST_SUITE_END()
