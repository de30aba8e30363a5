// The spine: a scene becomes an image.
#pragma once

#include <cstddef>
#include <optional>

#include "engine/image/image.h"
#include "engine/kernel/beyond_range.h"
#include "engine/parallel/worker_pool.h"
#include "engine/render/prepared_scene.h"
#include "engine/render/progress.h"
#include "engine/scene/limits.h"
#include "engine/scene/scene.h"

namespace raytracer {

/// Which bound ended a render.
enum class Stop { samples, target, budget, cancelled };

/// What is true of an image.
struct RenderReport {
  std::size_t pixel_count = 0;
  double samples_per_pixel = 0;  ///< mean
  int light_samples = 0;         ///< of each soft light, for each pixel; 0 if there is none
  std::optional<double> estimated_error;  ///< rms; nothing without an image
  Precision precision = Precision::double_precision;
  /// Pixels of the image; under a contract `clamped` is as the first pass has it, and `not_numbers`
  /// counts those of every pass.
  BeyondRange beyond;
  Stop stop = Stop::samples;  ///< `cancelled`: there is no image, or one not refined

  double plan_ms = 0;
  double build_ms = 0;
  double trace_ms = 0;
};

template <typename Channel>
struct BasicRendering : RenderReport {
  Raster<Channel> image;
};
using Rendering = BasicRendering<float>;
using ByteRendering = BasicRendering<unsigned char>;

/// Renders on the pool's threads and returns when done, or soon after `progress.stop` once the
/// structures are built.
/// The pixels depend on the scene alone (with a time budget: up to how far it got), not on the
/// number of threads. `limits` bounds the samples that a contract may spend.
Rendering render(const PreparedScene& scene, const Limits& limits, WorkerPool& pool,
                 RenderProgress& progress);
Rendering render(const Scene& scene, const Limits& limits, WorkerPool& pool,
                 RenderProgress& progress);

/// Alike, rounded to 8 bits, which is cheaper than floats but where needs_floats(). There is no
/// preview then.
ByteRendering render_bytes(const PreparedScene& scene, const Limits& limits, WorkerPool& pool,
                           RenderProgress& progress);
ByteRendering render_bytes(const Scene& scene, const Limits& limits, WorkerPool& pool,
                           RenderProgress& progress);

}  // namespace raytracer
