// How much reflections magnify errors.
#pragma once

#include "engine/plan/features.h"
#include "engine/plan/frame.h"
#include "engine/scene/scene.h"

namespace raytracer {

/// As Census::magnification says, of a scene that reaches to `farthest` from the eye.
///
/// A first reflection shows anything up to the farthest. What follows happens between mirrors: on
/// its way through the space that holds N of radius r, of width R, a ray has a mean free path of
/// l = R^3 / (N pi r^2), meets another after d = min(l, R) with the probability d / l, and each
/// time its error grows by 2 d / r.
double magnification(const Scene& scene, const Frame& frame, const Features& features,
                     double farthest);

}  // namespace raytracer
