// Particles as spheres and cylinders with colours.
#pragma once

#include <optional>
#include <utility>

#include "client/formats/import_options.h"
#include "client/formats/particles/particles.h"

namespace raytracer::client {

/// What the frames of a film have in common: what the first one had.
struct DrawingScale {
  std::optional<double> radius;                  ///< of particles that have none
  std::optional<std::pair<float, float>> range;  ///< of the numbers on a colour map
  bool is_exceeded = false;                      ///< some later number is beyond it
};

/// Adds objects and materials to the scene. Throws InputError if the style is not possible.
void draw_particles(Particles particles, const ImportOptions& options, DrawingScale& scale,
                    model::Scene& scene);

}  // namespace raytracer::client
