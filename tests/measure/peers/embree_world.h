// A scene as Embree takes it.
#pragma once

#include <embree3/rtcore.h>

#include <memory>
#include <type_traits>
#include <vector>

#include "engine/engine.h"
#include "tests/measure/peers/embree_kernel.h"

namespace raytracer::peers {

struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};

/// Filled in, not yet committed.
struct EmbreeWorld {
  std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene> scene;
  std::vector<EmbreeMaterial> materials;  ///< of each geometry by its id, then of each plane
  std::vector<EmbreePlane> planes;
  std::vector<EmbreeLight> lights;
  std::vector<float> sample_x;
  std::vector<float> sample_y;
  std::vector<float> disc_x;
  std::vector<float> disc_y;
  std::vector<float> sphere_x;
  std::vector<float> sphere_y;
  std::vector<float> sphere_z;
  EmbreeFrame frame{};  ///< points into this world, which must outlive it
};

/// One geometry for all spheres of a material, one for all its cylinders and cones, one for each
/// mesh. The places of soft lights are shared by all points, at least 64 for each pixel.
/// The scene must be one that the peer can draw.
std::unique_ptr<EmbreeWorld> make_embree_world(RTCDevice device, const Scene& scene);

/// A random place in each of side x side strata of every soft light, in place of shared ones.
void set_random_places(EmbreeWorld& world, int side);

/// side x side samples in every pixel, each in the middle of its cell, instead of the scene's own.
void set_sample_grid(EmbreeWorld& world, int side);

}  // namespace raytracer::peers
