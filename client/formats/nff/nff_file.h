// An NFF file as a scene file of one frame.
#pragma once

#include <memory>

#include "client/formats/scene_file.h"

namespace raytracer::client {

/// Haines' Neutral File Format.
std::unique_ptr<SceneFile> open_nff(FileInput input, const ImportOptions& options);

}  // namespace raytracer::client
