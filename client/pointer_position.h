// Where in a JSON text the value of a JSON Pointer (RFC 6901) stands: what an editor can jump to.
#pragma once

#include <string_view>

namespace raytracer::client {

/// Both counted from 1; the column in bytes. Line 0: not found.
struct TextPosition {
  int line = 0;
  int column = 0;
};

/// The position of the value that `pointer` names in `text`, which is valid JSON; if it names a
/// key that is missing, of the object that it is missing from. Reads the text once, from its
/// beginning to the position.
TextPosition position_of(std::string_view text, std::string_view pointer);

}  // namespace raytracer::client
