#include "engine/plan/plan.h"

namespace raytracer {
namespace {

/// How many primitives have a place in a structure.
std::size_t count_bounded(const Scene& scene) {
  std::size_t count = 0;
  for (const Object& object : scene.objects) {
    if (std::holds_alternative<Sphere>(object.shape))
      ++count;
    else if (const auto* spheres = std::get_if<Spheres>(&object.shape))
      count += spheres->centers.size();
    else if (const auto* mesh = std::get_if<Mesh>(&object.shape))
      count += mesh->triangles.size();
  }
  return count;
}

}  // namespace

Plan make_plan(const Scene& scene) {
  constexpr std::size_t few = 12;  // PLACEHOLDER_MEASURE
  return {make_frame(scene),
          count_bounded(scene) > few ? Plan::Structure::bvh : Plan::Structure::none};
}

}  // namespace raytracer
