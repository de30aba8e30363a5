#include "client/manual/man_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <regex>

namespace raytracer::manual {
namespace {

/// Text that roff shows as it is: a dash stays a dash, and no line becomes a request.
std::string escaped(const std::string& text) {
  std::string roff;
  for (const char c : text) {
    const bool begins_line = roff.empty() || roff.back() == '\n';
    if (begins_line && (c == '.' || c == '\'')) roff += "\\&";
    if (c == '-')
      roff += "\\-";
    else if (c == '\\')
      roff += "\\e";
    else
      roff += c;
  }
  return roff;
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

std::string first_sentence(const std::string& text) { return text.substr(0, text.find('.')); }

void append_options(std::string& page, const std::vector<ProgramOption>& options) {
  for (const ProgramOption& option : options) {
    page += ".TP\n";
    const char* separator = "";
    for (const std::string& name : option.names) {
      page += fmt::format("{}\\fB{}\\fR", separator, escaped(name));
      separator = ", ";
    }
    if (!option.value.empty()) page += fmt::format(" \\fI{}\\fR", escaped(option.value));
    page += fmt::format("\n{}\n", escaped(option.help));
  }
}

void append_commands(std::string& page, const std::vector<ProgramCommand>& commands) {
  if (commands.empty()) return;
  page += ".SH COMMANDS\n";
  for (const ProgramCommand& command : commands) {
    page +=
        fmt::format(".SS \"{} [OPTIONS]{}\"\n{}.\n", command.name,
                    command.operand.empty() ? "" : " " + command.operand, escaped(command.purpose));
    if (!command.operand.empty())
      page += fmt::format(".TP\n\\fI{}\\fR\n{}\n", command.operand, escaped(command.operand_help));
    append_options(page, command.options);
  }
}

/// The variables are those that the options' help names.
void append_environment(std::string& page, const std::vector<ProgramOption>& options) {
  static const std::regex variable("RAYTRACER_[A-Z_]+");
  page += ".SH ENVIRONMENT\nA flag stands over its variable.\n";
  for (const ProgramOption& option : options) {
    std::smatch match;
    if (std::regex_search(option.help, match, variable))
      page += fmt::format(".TP\n\\fB{}\\fR\nAs \\fB{}\\fR.\n", match.str(),
                          escaped(option.names.front()));
  }
}

}  // namespace

std::string man_page(const Program& program, const std::string& version,
                     const std::vector<std::string>& others) {
  const std::string name = escaped(program.name);
  std::string page = fmt::format(
      ".TH {0} 1 \"\" \"raytracer {1}\" \"User Commands\"\n"
      ".SH NAME\n{2} \\- {3}\n"
      ".SH SYNOPSIS\n\\fB{2}\\fR [\\fIOPTIONS\\fR]",
      upper(program.name), version, name, escaped(first_sentence(program.purpose)));
  if (!program.commands.empty()) page += " \\fICOMMAND\\fR [\\fIARGUMENTS\\fR]";
  page += "\n.SH OPTIONS\n";
  append_options(page, program.options);
  append_commands(page, program.commands);
  append_environment(page, program.options);
  if (!program.remarks.empty()) page += fmt::format(".SH NOTES\n{}\n", escaped(program.remarks));
  page += ".SH SEE ALSO\n";
  const char* separator = "";
  for (const std::string& other : others) {
    page += fmt::format("{}.BR {} (1)", separator, escaped(other));
    separator = " ,\n";
  }
  return page + "\n";
}

}  // namespace raytracer::manual
