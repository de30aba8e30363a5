// How much a render asks for, against the limits.
#pragma once

#include <cstdint>

#include "engine/scene/error_list.h"
#include "engine/scene/limits.h"
#include "engine/scene/path.h"
#include "engine/scene/scene.h"

namespace raytracer {

/// What Limits::work bounds, with so many samples per pixel: rays from the eye and those that
/// follow them. Those that a surface splits one into count by their weights, because
/// least_ray_weight bounds how many there are. A double, because the product has no bound.
double work_of(const Scene& scene, int samples);

/// Rays from the eye and those that follow them, at most.
double count_rays(const Scene& scene, int samples);

/// An error at `path`, which names the limit's flag, if `count` exceeds it.
void demand_at_most(double count, std::int64_t Limits::*limit, const Limits& limits,
                    const Path& path, ErrorList& errors);

}  // namespace raytracer
