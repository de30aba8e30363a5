// What accuracy costs on one scene: settings, each with the time and the error that it had there.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "engine/scene/scene.h"
#include "engine/tradeoff/difference.h"

namespace raytracer {

/// The least samples per pixel of what all points are compared with.
inline constexpr int least_reference_samples = 60;

/// The samples per pixel in all that the shortest curve takes.
inline constexpr int least_curve_samples = 128;

/// What stands over the scene's own settings: either `samples` or `target_rmse`, and the rest.
struct CurveSettings {
  std::optional<int> samples;  ///< per pixel
  std::optional<double> target_rmse;
  Precision precision = Precision::automatic;
  bool without_shadows = false;
  bool without_reflections = false;

  /// Whether ever more samples would end in another picture than the scene's.
  bool changes_picture() const { return without_shadows || without_reflections; }
};

/// One measured picture.
struct CurvePoint {
  CurveSettings settings;
  double trace_ms = 0;  ///< the median of its repetitions
  std::size_t repetitions = 0;
  Difference error;  ///< from the reference

  double samples_per_pixel = 0;           ///< mean
  std::optional<double> estimated_error;  ///< what the render itself said, if it did
  bool pareto = false;                    ///< see mark_pareto
};

/// What all points are compared with.
struct CurveReference {
  CurveSettings settings;
  double estimated_error = 0;  ///< rms; see reference.h
  double trace_ms = 0;
};

struct Curve {
  int width_px = 0;
  int height_px = 0;
  std::size_t thread_count = 0;
  CurveReference reference;
  std::vector<CurvePoint> points;  ///< those with a target_rmse are the contracts
};

/// Sets `pareto` where no point that keeps the picture is at least as fast and as accurate, and
/// better in one of the two. A point that changes the picture takes the mark from no other.
void mark_pareto(std::vector<CurvePoint>& points);

}  // namespace raytracer
