// The picture of a plan, whatever it says.
#pragma once

#include "engine/plan/plan.h"
#include "engine/render/tracer.h"
#include "engine/sample/pattern.h"

namespace raytracer::test {

/// One sample per pixel, in floats or bytes.
template <typename Channel = float>
Raster<Channel> image_by(const Plan& plan, const Scene& scene) {
  WorkerPool pool(2);
  const Tracer tracer = make_tracer(plan, pack_scene(scene, &pool), pool);
  Raster<Channel> image(scene.camera.width, scene.camera.height);
  for (const Tile& tile : split_into_tiles(image.width, image.height, 32))
    render_tile(tracer, sample_pattern(1), scene.render.transfer, tile, &image);
  return image;
}

}  // namespace raytracer::test
