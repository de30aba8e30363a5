// Whether single precision suffices for a scene, by the error that it would make.
#pragma once

#include "engine/plan/census.h"
#include "engine/plan/choice.h"
#include "engine/plan/features.h"
#include "engine/scene/scene.h"

namespace raytracer {

/// Single where its errors stay below a small part of a pixel and half a level of shading, else
/// double.
/// `wish` other than automatic is granted.
Choice<Precision> choose_precision(Precision wish, const Features& features, const Census& census);

}  // namespace raytracer
