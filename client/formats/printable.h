// Words of a file or of a document in a message: nothing in them moves the terminal's cursor.
#pragma once

#include <string>
#include <string_view>

namespace raytracer::client {

/// With control characters as \u000a.
std::string printable(std::string_view text);

/// Printable, in quotation marks, cut where it is long.
std::string quoted(std::string_view word);

}  // namespace raytracer::client
