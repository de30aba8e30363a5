// The formats that the client reads besides scene documents: an ending and a reader each. To add
// one: its reader, and a row for each ending.
#pragma once

#include <array>
#include <string_view>

#include "client/formats/nff/read_nff.h"
#include "client/formats/reading.h"

namespace raytracer::client {

struct Format {
  std::string_view ending;
  Reading (*read)(std::string_view text);
};

inline constexpr std::array formats{Format{".nff", read_nff}};

/// By the ending of a path, small letters or capitals; null if it is no format's.
const Format* format_of(std::string_view path);

}  // namespace raytracer::client
