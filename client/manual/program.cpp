#include "client/manual/program.h"

#include <CLI/CLI.hpp>
#include <sstream>

namespace raytracer::manual {
namespace {

/// CLI11 writes a value as "P:{auto,single,double}" where only some are allowed.
void read_value(const std::string& type_name, ProgramOption& option) {
  const std::size_t colon = type_name.find(":{");
  option.value = type_name.substr(0, colon);
  if (colon == type_name.npos) return;
  std::istringstream choices(type_name.substr(colon + 2, type_name.rfind('}') - colon - 2));
  for (std::string choice; std::getline(choices, choice, ',');) option.choices.push_back(choice);
}

ProgramOption read_option(const CLI::Option& row) {
  ProgramOption option;
  for (const std::string& name : row.get_lnames()) option.names.push_back("--" + name);
  for (const std::string& name : row.get_snames()) option.names.push_back("-" + name);
  option.help = row.get_description();
  if (row.get_items_expected_max() > 0) read_value(row.get_type_name(), option);
  return option;
}

std::vector<ProgramOption> read_options(const CLI::App& table) {
  std::vector<ProgramOption> options;
  for (const CLI::Option* row : table.get_options())
    if (!row->get_positional()) options.push_back(read_option(*row));
  return options;
}

ProgramCommand read_command(const CLI::App& table) {
  ProgramCommand command{table.get_name(), table.get_description(), {}, {}, read_options(table)};
  for (const CLI::Option* row : table.get_options()) {
    if (!row->get_positional()) continue;
    command.operand = row->get_name(true);
    command.operand_help = row->get_description();
  }
  return command;
}

}  // namespace

Program read_program(const std::string& name, const CLI::App& table) {
  Program program{name, table.get_description(), table.get_footer(), read_options(table), {}};
  for (const CLI::App* command : table.get_subcommands({}))
    program.commands.push_back(read_command(*command));
  return program;
}

bool takes_file(const ProgramOption& option) {
  return option.value == "IMAGE" || option.value == "CURVE";
}

}  // namespace raytracer::manual
