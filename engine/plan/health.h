// Where a scene strains the arithmetic or the sampling, in words that a person can act on.
#pragma once

#include <string>
#include <vector>

#include "engine/plan/plan.h"
#include "engine/scene/scene.h"

namespace raytracer {

/// A sentence for each strain: what, how much, and what helps. Empty for most scenes.
/// `plan` is the scene's.
std::vector<std::string> find_strains(const Scene& scene, const Plan& plan);

}  // namespace raytracer
