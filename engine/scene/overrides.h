// Another view of a scene: its picture's size, bounds and camera replaced, everything in it shared.
#pragma once

#include <cstdint>
#include <optional>

#include "engine/scene/error_list.h"
#include "engine/scene/limits.h"
#include "engine/scene/result.h"
#include "engine/scene/scene.h"

namespace raytracer {

/// What a request's query says over the document's own.
/// Values are taken as they are and judged with the document's.
struct Overrides {
  std::optional<int> width;
  std::optional<int> height;
  std::optional<int> samples;         ///< drops the document's contracts
  std::optional<double> target_rmse;  ///< drops the document's samples
  std::optional<double> budget_ms;    ///< drops the document's samples
  std::optional<Precision> precision;
  std::optional<Transfer> transfer;
  std::optional<int> max_depth;
  std::optional<Vec3> origin;
  std::optional<Vec3> look_at;
  std::optional<Vec3> up;
  std::optional<double> fov;
};

/// The scene that read_scene would have made of its document with these overrides and limits, in a
/// time that does not depend on how much is in it. Errors: those of a view; the objects were
/// counted when the scene was read.
Result<Scene> view_scene(const Scene& scene, const Limits& limits, const Overrides& overrides);

/// The same scene with other values, not judged yet.
Scene with_overrides(Scene scene, const Overrides& over);

/// The document's rules for all values that overrides may replace.
void check_view_rules(const Scene& scene, ErrorList& errors);

/// The limits that depend on the view: pixels, samples and work.
void check_view_limits(const Scene& scene, const Limits& limits, ErrorList& errors);

}  // namespace raytracer
