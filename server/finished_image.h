// A picture as it goes over the wire, and what an answer says about it: everything that is left of
// a rendering once it is encoded.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "engine/engine.h"
#include "server/job.h"

namespace raytracer {

/// What making a picture took, in milliseconds; parsing is each request's own.
struct Stages {
  double queue_ms = 0;
  double plan_ms = 0;
  double build_ms = 0;
  double trace_ms = 0;
  double encode_ms = 0;
};

/// A picture as it is answered.
struct FinishedImage {
  std::string bytes;
  std::vector<std::pair<std::string, std::string>> fields;  ///< Render-Samples and so on
  Stages stages;

  /// What it takes in memory.
  std::size_t memory() const { return sizeof *this + bytes.capacity(); }
};

/// Encodes the rendering, which waited in the queue for `queue_ms`, on the pool's threads.
template <typename Channel>
FinishedImage finish_image(const BasicRendering<Channel>& rendering, double queue_ms,
                           ImageFormat format, WorkerPool& pool, const Sharing& sharing = {});

}  // namespace raytracer
