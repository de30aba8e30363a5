#include "tests/measure/extremes/peers.h"

#include <algorithm>
#include <stdexcept>

#include "tests/measure/peers/embree_peer.h"
#include "tests/measure/peers/povray_peer.h"

namespace raytracer::extremes {

struct Peers::Programs {
  explicit Programs(WorkerPool& pool) : embree(pool), povray(pool.thread_count()) {}

  bench::EmbreePeer embree;
  bench::PovrayPeer povray;
};

Peers::Peers(WorkerPool& pool) : pool_(pool), programs_(std::make_unique<Programs>(pool)) {}

Peers::~Peers() = default;

namespace {

/// What its levels stand for, each at most half a level off.
Image as_floats(const ByteImage& levels) {
  Image image(levels.width, levels.height);
  std::transform(levels.values.begin(), levels.values.end(), image.values.begin(),
                 [](unsigned char level) { return static_cast<float>(level) / 255; });
  return image;
}

/// Without what is found only at an edge: peers are compared as this project is.
std::string wrong_pixels(const ByteImage& levels, const ExactImage& exact, const Scene& scene) {
  const Comparison comparison = compare(as_floats(levels), exact, scene);
  return std::to_string(comparison.off) +
         (comparison.at_edge > 0 ? " (+" + std::to_string(comparison.at_edge) + ")" : "");
}

}  // namespace

std::string Peers::povray(const Scene& scene, const ExactImage& exact) {
  try {
    programs_->povray.set_scene(scene);
    const ByteImage image = programs_->povray.run().image;
    if (scene.ambient == 0) return wrong_pixels(image, exact, scene);
    // It draws without ambient light.
    Scene without_ambient = scene;
    without_ambient.ambient = 0;
    return wrong_pixels(image, exact_image(without_ambient, pool_), without_ambient);
  } catch (const std::runtime_error&) {
    return "-";
  }
}

std::string Peers::embree(const Scene& scene, const ExactImage& exact) {
  try {
    return wrong_pixels(programs_->embree.run(scene).image, exact, scene);
  } catch (const std::runtime_error&) {
    return "-";
  }
}

}  // namespace raytracer::extremes
