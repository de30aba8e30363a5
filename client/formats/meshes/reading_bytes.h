// A reading of meshes as bytes that go from one process to another of the same program.
#pragma once

#include <string>
#include <string_view>

#include "client/formats/reading.h"

namespace raytracer::client {

/// Of the camera, the lights, objects that are meshes or spheres, the materials, the omissions and
/// the errors; nothing else.
std::string bytes_of(const Reading& reading);

/// Throws InputError if they are not whole.
Reading reading_of(std::string_view bytes);

}  // namespace raytracer::client
