// One _arguments specification for each option; zsh does the rest.
#include <fmt/format.h>

#include "client/manual/completion.h"

namespace raytracer::manual {
namespace {

/// A text within '...[text]...' of an _arguments specification.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\'')
      result += "'\\''";
    else if (c == '[' || c == ']' || c == ':' || c == '\\')
      result += fmt::format("\\{}", c);
    else
      result += c;
  }
  return result;
}

/// What completes the option's value: ":N:" and how.
std::string value_of(const ProgramOption& option) {
  if (option.value.empty()) return "";
  std::string action = " ";
  if (!option.choices.empty()) action = fmt::format("({})", fmt::join(option.choices, " "));
  if (takes_file(option)) action = "_files";
  return fmt::format(":{}:{}", option.value, action);
}

/// One specification for each option. Those with two names exclude each other.
void append_options(std::string& script, const std::vector<ProgramOption>& options,
                    const std::string& indent) {
  for (const ProgramOption& option : options) {
    const std::string rest = fmt::format("[{}]{}", escaped(option.help), value_of(option));
    const bool takes_value = !option.value.empty();
    if (option.names.size() == 1)
      script +=
          fmt::format("{}'{}{}{}' \\\n", indent, option.names[0], takes_value ? "=" : "", rest);
    else
      script += fmt::format("{}'({})'{{{}}}'{}' \\\n", indent, fmt::join(option.names, " "),
                            fmt::join(option.names, takes_value ? "=," : ","), rest);
  }
}

}  // namespace

std::string zsh_completion(const Program& program, const std::vector<std::string>& scenes) {
  const std::string function = "_" + program.name;
  if (program.commands.empty()) {
    std::string script = fmt::format("#compdef {}\n\n_arguments \\\n", program.name);
    append_options(script, program.options, "  ");
    return script.erase(script.size() - 3, 2);
  }
  std::string script = fmt::format(R"(#compdef {0}

_raytracer_scene() {{
  _alternative 'scenes:shipped scene:({1})' 'files:file:_files'
}}

{2}() {{
  local -a commands line
  local state
  commands=(
)",
                                   program.name, fmt::join(scenes, " "), function);
  for (const ProgramCommand& command : program.commands)
    script += fmt::format("    '{}:{}'\n", command.name, escaped(command.purpose));
  script += "  )\n  _arguments -C \\\n";
  append_options(script, program.options, "    ");
  script += R"(    '1:command:->command' \
    '*::argument:->argument'
  case $state in
    command) _describe command commands ;;
    argument)
      case $line[1] in
)";
  for (const ProgramCommand& command : program.commands) {
    script += fmt::format("        {})\n          _arguments \\\n", command.name);
    append_options(script, command.options, "            ");
    append_options(script, {program.options.begin() + 1, program.options.end()}, "            ");
    if (command.operand.empty())
      script.erase(script.size() - 3, 2);
    else
      script += fmt::format("            '1:{}:_raytracer_scene'\n", command.operand);
    script += "          ;;\n";
  }
  return script + fmt::format("      esac ;;\n  esac\n}}\n\n{} \"$@\"\n", function);
}

}  // namespace raytracer::manual
