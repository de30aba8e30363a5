// The scene as kernels see it: arrays of plain values in frame coordinates.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/math/ray.h"
#include "engine/math/vec.h"
#include "engine/memory/page_allocator.h"
#include "engine/pack/numbering.h"
#include "engine/parallel/worker_pool.h"
#include "engine/plan/frame.h"
#include "engine/plan/view.h"
#include "engine/scene/scene.h"

namespace raytracer {

struct PackedSphere {
  Vec3 center;
  double radius;
  PrimitiveId id;
};

/// A square of touching spheres; the two spanning axes and the one across them as indices.
struct PackedSquare {
  Vec3 center;
  double radius;
  std::int64_t side;  ///< spheres along a side: 2n
  std::uint32_t object;
  int first_axis;
  int second_axis;
  int across;
};

struct PackedPlane {
  Vec3 point;
  Vec3 normal;  ///< unit
  PrimitiveId id;
};

struct PackedTriangle {
  std::array<Vec3, 3> vertices;
  Vec3 normal;  ///< unit
  PrimitiveId id;
};

struct PackedLight {
  bool is_distant;
  Vec3 place;    ///< distant: unit vector towards the light; point: its position
  Rgb emission;  ///< distant: i; point: i at distance 1 in frame coordinates
};

/// Everything that a ray may need, and nothing of how the document said it.
struct PackedScene {
  View view;
  // Without what the frame does not carry, and triangles of no area.
  LargeArray<PackedSphere> spheres;  ///< of all objects of type sphere and spheres
  std::vector<PackedSquare> squares;
  std::vector<PackedPlane> planes;
  LargeArray<PackedTriangle> triangles;
  Numbering numbers;
  std::vector<MaterialIndex> material_of_object;
  std::vector<Material> materials;
  std::vector<PackedLight> lights;  ///< that can change a colour
  Rgb background;
  double ambient = 0;
  Shadows shadows = Shadows::black;
  int max_depth = 0;
};

/// On the pool's threads where there is much to do.
PackedScene pack_scene(const Scene& scene, const Frame& frame, WorkerPool& pool);

}  // namespace raytracer
