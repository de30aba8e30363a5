// What a glTF says that a reader must know beyond glTF itself.
#pragma once

#include <string_view>

namespace raytracer::client {

/// Throws InputError if the file requires extensions without which its geometry means something
/// else (glTF 2.0, section 3.12): quantized or compressed. What is not JSON is passed over.
void require_known_extensions(std::string_view text);

}  // namespace raytracer::client
