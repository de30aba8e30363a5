// Images integrated along lines, and what they should be.
#pragma once

#include <cmath>
#include <cstddef>

#include "engine/engine.h"
#include "engine/plan/plan.h"
#include "engine/render/tracer.h"
#include "tests/support/scenes.h"

namespace raytracer::test {

inline Scene with_target(json text, const char* precision) {
  text["render"] = {{"target_rmse", 0.01}, {"precision", precision}};
  return scene_of(text);
}

struct Integrated {
  Image image;
  PixelSpreads spreads;
  int left = 0;
  BeyondRange beyond;

  Integrated(const Plan& plan, const Scene& scene, std::size_t lines, double negligible_error = 0)
      : image(scene.camera.width, scene.camera.height), spreads(image.width, image.height) {
    WorkerPool pool(1);
    const Tracer tracer = make_tracer(plan, scene, pool);
    for (const Tile& tile : split_into_tiles(image.width, image.height, block_side)) {
      const IntegratedBlock block = integrate_block(tracer, {lines, negligible_error},
                                                    scene.render.transfer, tile, image, spreads);
      left += block.left;
      beyond += block.beyond;
    }
  }
};

inline double told_error(const Integrated& integrated) {
  double told2 = 0;
  for (const float error2 : integrated.spreads.error2) told2 += static_cast<double>(error2);
  return std::sqrt(told2 / static_cast<double>(integrated.image.values.size()));
}

inline Image reference_of(json text) {
  text["render"] = {{"samples", 2048}, {"precision", "double"}};
  return image_of(text);
}

}  // namespace raytracer::test
