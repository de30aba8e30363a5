// The picture of a plan, whatever it says.
#pragma once

#include "engine/plan/plan.h"
#include "engine/render/tracer.h"
#include "engine/sample/pattern.h"

namespace raytracer::test {

/// In floats, or bytes of three channels.
template <typename Channel = float>
Raster<Channel> image_by(const Plan& plan, const Scene& scene, int samples = 1,
                         int tile_side = 32) {
  WorkerPool pool(2);
  const Tracer tracer = make_tracer(plan, pack_scene(scene, &pool), pool);
  Raster<Channel> image(scene.camera.width, scene.camera.height, channel_count(scene));
  for (const Tile& tile : split_into_tiles(image.width, image.height, tile_side))
    render_tile(tracer, sample_pattern(samples), tile, {scene.render.transfer, &image});
  return image;
}

}  // namespace raytracer::test
