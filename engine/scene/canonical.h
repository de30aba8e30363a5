// One text for all documents that mean the same picture: the basis of entity tags.
#pragma once

#include <string>

#include "engine/scene/scene.h"

namespace raytracer {

/// Bytes that are equal for two scenes exactly if every value that can change a pixel is equal:
/// white space, key order, names, spelled-out defaults and notations of one number do not count.
std::string canonical_bytes(const Scene& scene);

}  // namespace raytracer
