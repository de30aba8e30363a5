// How a measurement was run, for its report.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>

namespace raytracer::measure {

/// The program and its arguments, without `left_out` and their values: those only say where files
/// go, or have a place of their own in the report.
inline std::string command_text(std::string program, int argc, char** argv,
                                std::initializer_list<std::string_view> left_out) {
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (std::find(left_out.begin(), left_out.end(), argument) != left_out.end())
      ++i;
    else
      program += ' ' + argument;
  }
  return program;
}

}  // namespace raytracer::measure
