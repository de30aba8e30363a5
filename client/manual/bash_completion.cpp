// One function a program, written as a reader would: a case on the command, in it one on the word
// before.
#include <fmt/format.h>

#include "client/manual/completion.h"

namespace raytracer::manual {
namespace {

std::string names_of(const std::vector<ProgramOption>& options) {
  std::string names;
  for (const ProgramOption& option : options)
    for (const std::string& name : option.names) names += " " + name;
  return names;
}

/// A case on the word before: an option's value, if that is an option that takes one.
void append_values(std::string& script, const std::vector<ProgramOption>& options,
                   const std::string& indent) {
  std::vector<std::string> without_offer;
  std::string rows;
  for (const ProgramOption& option : options) {
    if (option.value.empty()) continue;
    const std::string names = fmt::format("{}", fmt::join(option.names, " | "));
    if (!option.choices.empty())
      rows += fmt::format("{}  {}) COMPREPLY=($(compgen -W \"{}\" -- \"$word\")); return ;;\n",
                          indent, names, fmt::join(option.choices, " "));
    else if (takes_file(option))
      rows += fmt::format("{}  {}) _raytracer_files; return ;;\n", indent, names);
    else
      without_offer.push_back(names);
  }
  if (!without_offer.empty())
    rows += fmt::format("{}  {}) return ;;\n", indent, fmt::join(without_offer, " | "));
  if (!rows.empty()) script += fmt::format("{0}case \"$before\" in\n{1}{0}esac\n", indent, rows);
}

}  // namespace

std::string bash_completion(const Program& program, const std::vector<std::string>& scenes) {
  std::string function = "_" + program.name;
  for (char& c : function)
    if (c == '-') c = '_';
  std::string script = fmt::format(
      "# bash completion for {}\n# shellcheck disable=SC2207  # no name has a space, and bash 3.2 "
      "has no mapfile\n\n",
      program.name);
  if (!program.commands.empty())
    script += R"(_raytracer_files() {
  local IFS=$'\n'
  compopt -o filenames 2>/dev/null  # bash 3.2 has none
  COMPREPLY=(${COMPREPLY[@]+"${COMPREPLY[@]}"} $(compgen -f -- "$word"))
}

)";
  script += function + R"(() {
  local word="${COMP_WORDS[COMP_CWORD]}" before="${COMP_WORDS[COMP_CWORD - 1]}" command="" i
  COMPREPLY=()
  # --option=value comes as three words.
  [[ $word != = ]] || word=""
  [[ $before != = ]] || before="${COMP_WORDS[COMP_CWORD - 2]}"
)";
  if (!program.commands.empty()) {
    std::vector<std::string> names;
    for (const ProgramCommand& command : program.commands) names.push_back(command.name);
    script += fmt::format(R"(  for ((i = 1; i < COMP_CWORD; i++)); do
    case "${{COMP_WORDS[i]}}" in
      {}) command="${{COMP_WORDS[i]}}"; break ;;
    esac
  done
)",
                          fmt::join(names, " | "));
  }
  append_values(script, program.options, "  ");
  script += "  case \"$command\" in\n";
  std::string command_names;
  const std::vector<ProgramOption> without_help(program.options.begin() + 1, program.options.end());
  for (const ProgramCommand& command : program.commands) {
    command_names += " " + command.name;
    script += fmt::format("    {})\n", command.name);
    append_values(script, command.options, "      ");
    script += fmt::format(
        "      if [[ $word == -* ]]; then\n"
        "        COMPREPLY=($(compgen -W \"{}\" -- \"$word\"))\n",
        (names_of(command.options) + names_of(without_help)).substr(1));
    if (!command.operand.empty())
      script += fmt::format(
          "      else\n"
          "        COMPREPLY=($(compgen -W \"{}\" -- \"$word\"))\n"
          "        _raytracer_files\n",
          fmt::join(scenes, " "));
    script += "      fi ;;\n";
  }
  script += fmt::format("    *) COMPREPLY=($(compgen -W \"{}\" -- \"$word\")) ;;\n  esac\n}}\n\n",
                        (command_names + names_of(program.options)).substr(1));
  return script + fmt::format("complete -F {} {}\n", function, program.name);
}

}  // namespace raytracer::manual
