// The camera and the lights of a glTF. Read from the file itself: assimp's versions differ in what
// a field of view is, and keep one of several nodes that have the same light.
#pragma once

#include <string_view>

#include "client/formats/reading.h"

namespace raytracer::client {

/// Adds the lights (KHR_lights_punctual) to the reading's scene, and the first camera with a
/// perspective, where the scene's nodes stand (glTF 2.0, sections 3.5 and 3.10); tells what is left
/// out or shown otherwise. Intensities are those of the file, in lux, and for lamps in the lumens
/// that they would have if they shone to all sides. Of a glTF 1.0 nothing is read.
void read_gltf_stage(std::string_view text, Reading& reading);

}  // namespace raytracer::client
