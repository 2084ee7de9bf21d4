#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "bie/app/commands.hpp"

namespace vehd {
namespace {

/// A word that can be completed on a command line, and its description.
struct Word {
  std::string text;
  std::string meaning;
};

/// A command and the words that may follow it, from the tables of its help.
struct Completion {
  std::string command;  ///< full name, "bench time"; empty: the program
  std::vector<Word> options;
  std::vector<Word> words;
};

std::vector<Word> options_of(const CLI::App& command) {
  std::vector<Word> words;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) words.push_back({"--" + name, option->get_description()});
    for (const std::string& name : option->get_snames()) words.push_back({"-" + name, option->get_description()});
  }
  // Some options stand in groups, which are commands without a name.
  for (const CLI::App* group : command.get_subcommands([](const CLI::App*) { return true; })) {
    if (!group->get_name().empty()) continue;
    for (Word& word : options_of(*group)) words.push_back(std::move(word));
  }
  return words;
}

std::vector<Word> commands_of(const CLI::App& command) {
  std::vector<Word> words;
  for (const CLI::App* subcommand : command.get_subcommands([](const CLI::App*) { return true; })) {
    if (subcommand->get_name().empty()) continue;
    words.push_back({subcommand->get_name(), subcommand->get_description()});
  }
  return words;
}

/// Names that a command accepts, as one_of() lists them: "TEXT:{a,b}".
std::vector<Word> choices_of(const CLI::App& command) {
  std::vector<Word> words;
  for (const CLI::Option* option : command.get_options()) {
    const std::string type = option->get_type_name();
    const std::size_t start = type.find('{');
    if (!option->get_positional() || start == std::string::npos) continue;
    std::istringstream names(type.substr(start + 1, type.find('}') - start - 1));
    for (std::string name; std::getline(names, name, ',');) words.push_back({name, option->get_description()});
  }
  return words;
}

void add_completions(const CLI::App& command, const std::string& call, std::vector<Completion>& result) {
  std::vector<Word> words = commands_of(command);
  for (Word& choice : choices_of(command)) words.push_back(std::move(choice));
  result.push_back({call, options_of(command), std::move(words)});
  for (const CLI::App* subcommand : command.get_subcommands([](const CLI::App*) { return true; })) {
    if (subcommand->get_name().empty()) continue;
    add_completions(*subcommand, (call.empty() ? "" : call + " ") + subcommand->get_name(), result);
  }
}

std::vector<Completion> completions(const CLI::App& program) {
  std::vector<Completion> result;
  add_completions(program, "", result);
  return result;
}

std::string joined(const std::vector<Word>& words) {
  std::vector<std::string> texts;
  for (const Word& word : words) texts.push_back(word.text);
  return fmt::format("{}", fmt::join(texts, " "));
}

std::string bash_script(const CLI::App& program) {
  std::string cases;
  for (const Completion& completion : completions(program)) {
    cases += fmt::format("    \"{}\") options=\"{}\"; words=\"{}\" ;;\n", completion.command,
                         joined(completion.options), joined(completion.words));
  }
  return fmt::format(R"(# Completion of vehd for bash.
_vehd() {{
  local current="${{COMP_WORDS[COMP_CWORD]}}" options words count
  # The longest command that the line begins with.
  for count in 3 2 1 0; do
    (( count < COMP_CWORD )) && _vehd_after "${{COMP_WORDS[*]:1:count}}" && break
  done
  if [[ "$current" == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$current"))
  else
    COMPREPLY=($(compgen -W "$words" -- "$current"))
  fi
}}
_vehd_after() {{
  case "$1" in
{}    *) return 1 ;;
  esac
}}
# Files where no word fits.
complete -o default -F _vehd vehd
)",
                     cases);
}

/// A word with its description as an element of a zsh array: "word:meaning" in single quotes.
std::string zsh_entry(const Word& word) {
  std::string meaning = word.meaning.substr(0, word.meaning.find('\n'));
  std::string quoted;
  for (const char letter : meaning) {
    if (letter == '\'') {
      quoted += "'\\''";
    } else {
      quoted += letter;
    }
  }
  return fmt::format("'{}:{}'", word.text, quoted);
}

std::string zsh_entries(const std::vector<Word>& words) {
  std::vector<std::string> entries;
  entries.reserve(words.size());
  for (const Word& word : words) entries.push_back(zsh_entry(word));
  return fmt::format("({})", fmt::join(entries, " "));
}

std::string zsh_script(const CLI::App& program) {
  std::string cases;
  for (const Completion& completion : completions(program)) {
    cases += fmt::format("    \"{}\") options={}; choices={} ;;\n", completion.command, zsh_entries(completion.options),
                         zsh_entries(completion.words));
  }
  return fmt::format(R"(#compdef vehd
# Completion of vehd for zsh.
_vehd() {{
  local -a options choices
  local count
  # The longest command that the line begins with.
  for count in 3 2 1 0; do
    (( count < CURRENT - 1 )) && _vehd_after "${{(j: :)words[2,count + 1]}}" && break
  done
  if [[ "$PREFIX" == -* ]]; then
    _describe -o option options
  else
    (( ${{#choices}} )) && _describe word choices
    (( CURRENT > 2 )) && _files
  fi
}}
_vehd_after() {{
  case "$1" in
{}    *) return 1 ;;
  esac
}}
_vehd "$@"
)",
                     cases);
}

}  // namespace

void add_completion_command(CLI::App& program, ExitCode& exit_code) {
  CLI::App* command = program.add_subcommand("completion", "Print a script that completes commands and options");
  command->require_subcommand(1);
  const auto add = [&](const char* shell, const char* use, std::string (*script)(const CLI::App&)) {
    CLI::App* topic = command->add_subcommand(shell, use);
    const auto common = std::make_shared<CommonOptions>();
    add_common_options(*topic, *common);
    topic->callback([&program, &exit_code, script, common, shell = topic->get_name()] {
      const std::string text = script(program);
      fmt::print("{}", text);
      write_json(*common, {{"shell", shell}, {"script", text}});
      exit_code = ExitCode::done;
    });
  };
  add("bash", "For bash: source <(vehd completion bash)", bash_script);
  add("zsh", "For zsh: as a file _vehd in a folder of $fpath", zsh_script);
}

}  // namespace vehd
