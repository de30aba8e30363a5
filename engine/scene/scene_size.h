// How large a scene is: in objects, which are limited, and in memory, which whoever keeps it pays.
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/scene/scene.h"

namespace raytracer {

/// What Limits::objects counts: each sphere of a set, each triangle, and one for all else.
std::int64_t count_objects(const Scene& scene);

/// The bytes that the scene's values take, on the heap and as members.
std::size_t memory_bytes(const Scene& scene);

}  // namespace raytracer
