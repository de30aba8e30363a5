// Whether single precision suffices for a scene, by the error that it would make.
#pragma once

#include "engine/plan/choice.h"
#include "engine/plan/scene_statistics.h"
#include "engine/scene/features.h"
#include "engine/scene/scene.h"

namespace raytracer {

/// What rounding may do to a picture, at most: the bound that the choice of precision rests on.
struct ArithmeticError {
  double displacement_px = 0;  ///< of edges, of shadows and of what mirrors show
  double levels = 0;           ///< of a shaded surface, in levels of 255
};

/// "single", "double" or "mixed", of what is chosen.
const char* name_of(Precision precision);

/// What single displaces edges by that are as far as what is rounded, in pixels.
double direction_error_in_single(const SceneStatistics& statistics);

/// Of the kernels in `precision`, which is not automatic.
ArithmeticError predict_arithmetic_error(Precision precision, const Features& features,
                                         const SceneStatistics& statistics);

/// In mixed precision what rays from the eye meet nearer than this is traced in double: single
/// would displace the shadows there. In frame coordinates.
double nearest_in_single(const SceneStatistics& statistics);

/// How far from a point light its shadows are as little displaced in single as is tolerated.
double lamp_reach_in_single(const LampDistances& lamp, const Features& features,
                            const SceneStatistics& statistics);

/// Whether curved mirrors or lenses may magnify what single displaces beyond what is tolerated:
/// then double carries the paths of rays from one to the next.
bool are_paths_magnified(const SceneStatistics& statistics);

/// Single where its errors stay below a small part of a pixel and half a level of shading, else
/// double; the first bound that single would break is the reason. `requested` other than automatic
/// is granted, unless single cannot hold the scene's sizes or number its primitives.
Choice<Precision> choose_precision(Precision requested, const Features& features,
                                   const SceneStatistics& statistics);

}  // namespace raytracer
