// The same bytes for all documents that mean the same picture: the basis of entity tags.
//
// In two parts, because many views of one scene share all but a few numbers: what stands in the
// scene, and how it is looked at and drawn.
#pragma once

#include <string>

#include "engine/scene/scene.h"

namespace raytracer {

/// Together with canonical_view, bytes that are equal for two scenes exactly if every value that
/// can change a pixel is equal: white space, key order, names, spelled-out defaults and notations
/// of one number do not count. This part is all but the camera and the render settings.
std::string canonical_content(const Scene& scene);

/// The other part: the camera and the render settings.
std::string canonical_view(const Scene& scene);

}  // namespace raytracer
