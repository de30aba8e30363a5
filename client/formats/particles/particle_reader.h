// What the readers of particles have in common.
#pragma once

#include <optional>

#include "client/formats/particles/particles.h"

namespace raytracer::client {

class ParticleReader {
 public:
  ParticleReader() = default;
  virtual ~ParticleReader() = default;
  ParticleReader(const ParticleReader&) = delete;
  ParticleReader& operator=(const ParticleReader&) = delete;

  /// The particles of the next frame that has some: at least one; nothing if none has. Throws
  /// LineError, or InputError for what has no line.
  virtual std::optional<Particles> next_frame() = 0;
  virtual bool has_more() const = 0;
};

}  // namespace raytracer::client
