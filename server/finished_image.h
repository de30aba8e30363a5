// A picture as it goes over the wire, and what an answer says about it: everything that is left of
// a rendering once it is encoded.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "engine/engine.h"

namespace raytracer {

/// What making a picture took, in milliseconds; parsing is each request's own.
struct Stages {
  double queue_ms = 0;
  double plan_ms = 0;
  double build_ms = 0;
  double trace_ms = 0;
  double encode_ms = 0;
};

struct FinishedImage {
  std::string bytes;
  // The header fields Render-Samples and so on.
  std::string samples;
  std::string_view precision;
  std::string_view stop;
  std::optional<std::string> error;
  Stages stages;

  /// What it takes in memory.
  std::size_t memory() const;
};

/// Encodes the rendering, which waited in the queue for `queue_ms`, on the pool's threads.
template <typename Channel>
FinishedImage finish_image(const BasicRendering<Channel>& rendering, double queue_ms,
                           ImageFormat format, WorkerPool& pool);

}  // namespace raytracer
