#include "engine/plan/coincidence.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace raytracer {
namespace {

constexpr double nothing_near = std::numeric_limits<double>::infinity();
constexpr double widest = 1e-4;               // gaps beyond this no precision has trouble with
constexpr std::size_t most = 10'000;          // sorted and compared in about a millisecond
constexpr std::ptrdiff_t most_compared = 64;  // of each with those next to it

struct PlacedSphere {
  Vec3 center;
  double radius;
  double key;  ///< of near spheres near, and of others hardly ever
};

std::vector<PlacedSphere> placed_spheres(const Scene& scene, const Frame& frame) {
  std::vector<PlacedSphere> spheres;
  const auto add = [&](const Vec3& scene_center, double scene_radius) {
    const Vec3 center = frame.frame_from_scene(scene_center);
    const double radius = frame.frame_from_scene(scene_radius);
    constexpr Vec3 slanted{0.8192, 0.6711, 0.5497};  // of no symmetry that scenes have
    spheres.push_back({center, radius, dot(center, slanted) + 0.4503 * radius});
  };
  for (const Object& object : scene.objects) {
    if (const auto* sphere = std::get_if<Sphere>(&object.shape)) {
      add(sphere->center, sphere->radius);
    } else if (const auto* set = std::get_if<Spheres>(&object.shape)) {
      if (spheres.size() + set->centers.size() > most) return {};
      for (std::size_t i = 0; i < set->centers.size(); ++i) add(set->centers[i], set->radius(i));
    }
  }
  if (spheres.size() > most) return {};
  return spheres;
}

double least_gap_of_spheres(std::vector<PlacedSphere> spheres) {
  std::sort(spheres.begin(), spheres.end(),
            [](const PlacedSphere& a, const PlacedSphere& b) { return a.key < b.key; });
  double least = nothing_near;
  for (auto a = spheres.begin(); a != spheres.end(); ++a) {
    const double reach = length(a->center) + a->radius;
    const auto end = a + std::min(most_compared, spheres.end() - a);
    for (auto b = a + 1; b < end && b->key - a->key <= 2 * widest * reach; ++b) {
      const double gap = length(a->center - b->center) + std::abs(a->radius - b->radius);
      if (gap > 0 && gap < widest * reach) least = std::min(least, gap / reach);
    }
  }
  return least;
}

double least_gap_of_planes(const Scene& scene, const Frame& frame) {
  struct PlacedPlane {
    Vec3 normal;
    double height;
  };
  constexpr std::size_t most_planes = 100;
  std::vector<PlacedPlane> planes;
  double least = nothing_near;
  for (const Object& object : scene.objects) {
    const auto* plane = std::get_if<Plane>(&object.shape);
    if (plane == nullptr || planes.size() == most_planes) continue;
    const Vec3 normal = unit(plane->normal);
    const double height = dot(normal, frame.frame_from_scene(plane->point));
    for (const PlacedPlane& other : planes) {
      const double sign = dot(normal, other.normal) < 0 ? -1 : 1;
      const double gap = std::abs(height - sign * other.height);
      const double tilt = length(normal - sign * other.normal);
      if (gap + tilt > 0 && gap < widest * std::abs(height) && tilt < widest)
        least = std::min(least, gap / std::abs(height) + tilt);
    }
    planes.push_back({normal, height});
  }
  return least;
}

}  // namespace

double least_gap(const Scene& scene, const Frame& frame) {
  return std::min(least_gap_of_spheres(placed_spheres(scene, frame)),
                  least_gap_of_planes(scene, frame));
}

}  // namespace raytracer
