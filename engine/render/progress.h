// How far a render is, and the request that it end.
#pragma once

#include <atomic>

#include "engine/render/preview.h"

namespace raytracer {

/// Shared between the one who waits for a render and the threads that make it.
/// `stop` may be set from any thread at any time; it is looked at before each tile.
struct RenderProgress {
  std::atomic<bool> stop{false};
  std::atomic<double> fraction{0};  ///< 0 to 1, never falls
  Preview preview;                  ///< what there is to see of it
};

}  // namespace raytracer
