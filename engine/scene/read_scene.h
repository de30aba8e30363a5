// JSON text to a Scene, or all of its errors: the first step of every render.
#pragma once

#include <optional>
#include <string_view>

#include "engine/scene/limits.h"
#include "engine/scene/result.h"
#include "engine/scene/scene.h"

namespace raytracer {

/// What a request's query says over the document's own; see http.md's query parameters.
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

/// Reads a scene document, version 1.
/// Errors: one ErrorKind::syntax error for text that is not JSON (the detail says line and
/// column); otherwise every rule that the document breaks, and every limit that it exceeds with
/// `overrides` applied, each with its JSON Pointer.
Result<Scene> read_scene(std::string_view text, const Limits& limits,
                         const Overrides& overrides = {});

/// Rays from the eye and reflected ones, at most, with so many samples per pixel: what
/// Limits::work bounds. A double, because the product has no bound.
double count_rays(const Scene& scene, int samples);

}  // namespace raytracer
