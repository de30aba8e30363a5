// How much curved mirrors magnify errors.
#pragma once

#include "engine/pack/packed_scene.h"
#include "engine/scene/features.h"

namespace raytracer {

/// How much reflections magnify errors, of a scene that reaches to `farthest` from the eye.
///
/// A first reflection shows anything up to the farthest. What follows happens between mirrors: on
/// its way through the space that holds N of radius r, of width R, a ray has a mean free path of
/// l = R^3 / (N pi r^2), meets another after d = min(l, R) with the probability d / l, and each
/// time its error grows by 2 d / r.
double magnification(const PackedScene& packed, const Features& features, double farthest);

}  // namespace raytracer
