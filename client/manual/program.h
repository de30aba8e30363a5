// A program's command line as data: what --help prints, read from the same table.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace raytracer::manual {

struct ProgramOption {
  std::vector<std::string> names;    ///< with their dashes, the long one first
  std::string value;                 ///< what stands for it, as "N"; empty: it takes none
  std::vector<std::string> choices;  ///< the only values, where they are few
  std::string help;
};

struct ProgramCommand {
  std::string name;
  std::string purpose;
  std::string operand;       ///< as "SCENE"; empty: it takes none
  std::string operand_help;  ///< empty as well then
  std::vector<ProgramOption> options;
};

struct Program {
  std::string name;
  std::string purpose;
  std::string remarks;  ///< lines below everything else; may be empty
  std::vector<ProgramOption> options;
  std::vector<ProgramCommand> commands;
};

Program read_program(const std::string& name, const CLI::App& table);

/// Whether the option's value is a file's name.
bool takes_file(const ProgramOption& option);

}  // namespace raytracer::manual
