// Whether a glTF is whole: of what is no JSON assimp says only that it has no reader for it.
#pragma once

#include <string_view>

#include "client/formats/reading.h"

namespace raytracer::client {

/// Adds what is wrong with the nesting of the JSON to the reading, with its line; the rest of it is
/// not looked at. Throws InputError if the text is no JSON object at all.
void check_gltf(std::string_view text, Reading& reading);

/// Of a binary glTF: throws InputError if it is none, or ends too early.
void check_glb(std::string_view bytes);

/// The text of a binary glTF, which its first chunk has (glTF 2.0, section 4.4); empty if it has
/// none.
std::string_view text_of_glb(std::string_view bytes);

}  // namespace raytracer::client
