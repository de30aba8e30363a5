// What a shell offers when Tab is pressed: commands, options, an option's values, files, and where
// a scene may stand, the names of the shipped ones too. The scripts ask no server and read no file.
#pragma once

#include <string>
#include <vector>

#include "client/manual/program.h"

namespace raytracer::manual {

/// For bash from 3.2 on. `scenes` are the names to offer where the operand is SCENE.
std::string bash_completion(const Program& program, const std::vector<std::string>& scenes);

/// For zsh, as an autoloaded function _PROGRAM.
std::string zsh_completion(const Program& program, const std::vector<std::string>& scenes);

}  // namespace raytracer::manual
