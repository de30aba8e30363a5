// What stands behind the header of a PLY: for each element so many numbers, as text or as bytes.
#pragma once

#include <cstdint>
#include <string_view>

#include "client/formats/meshes/line_words.h"
#include "client/formats/meshes/ply_header.h"
#include "client/formats/reading.h"

namespace raytracer::client {

/// Adds the errors, with their lines, to the reading, and what is left out. The words stand behind
/// the header. Each element has a line of its own.
void check_ply_text(const PlyHeader& header, LineWords& words, Reading& reading);

/// Of up to eight bytes, without a sign; `body` says in which order they are.
std::uint64_t ply_integer(std::string_view bytes, PlyBody body);

/// Adds what is left out to the reading. Throws InputError if the bytes end too early.
void check_ply_bytes(const PlyHeader& header, std::string_view bytes, Reading& reading);

}  // namespace raytracer::client
