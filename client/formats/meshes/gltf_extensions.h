// What a glTF says that a reader must know beyond glTF itself.
#pragma once

#include <string_view>

#include "client/formats/reading.h"

namespace raytracer::client {

/// Throws InputError if the file requires extensions without which its geometry means something
/// else (glTF 2.0, section 3.12), such as quantized or compressed places. Others that it requires
/// and that are not known are told. What is not JSON is passed over.
void check_extensions(std::string_view text, Reading& reading);

}  // namespace raytracer::client
