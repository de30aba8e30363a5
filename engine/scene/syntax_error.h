// What is wrong with text that is not JSON, and where, in nlohmann's words: simdjson does not say.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/scene/result.h"

namespace raytracer {

/// Of the value at `pointer`; empty if it is not known.
Error nested_too_deep(std::string pointer);

/// The error of a text that is not JSON; nothing if it is. Numbers that no double holds are taken
/// for errors. Throws the error of one that is nested too deep.
std::optional<Error> find_syntax_error(std::string_view text);

}  // namespace raytracer
