#include "engine/sample/missable_spheres.h"

#include <cmath>
#include <numbers>
#include <variant>

#include "engine/accel/projection.h"
#include "engine/math/block.h"
#include "engine/pack/view.h"

namespace raytracer {
namespace {

/// The part of pixel (x, y) in an image of so many columns of blocks.
std::size_t part_at(int x, int y, int columns) {
  const int block = y / block_side * columns + x / block_side;
  const int in_block = y % block_side / part_side * parts_across + x % block_side / part_side;
  return parts_in_block * static_cast<std::size_t>(block) + static_cast<std::size_t>(in_block);
}

}  // namespace

MissableSpheres::MissableSpheres(const Scene& scene, const Frame& frame) {
  const Camera& camera = scene.camera;
  const int columns = (camera.width + block_side - 1) / block_side;
  const int rows = (camera.height + block_side - 1) / block_side;
  parts_.resize(parts_in_block * static_cast<std::size_t>(columns) *
                static_cast<std::size_t>(rows));
  const Projection projection(make_view(camera));
  const auto add = [&](const Vec3& scene_center, double scene_radius) {
    const Vec3 center = frame.frame_from_scene(scene_center);
    const double radius = frame.frame_from_scene(scene_radius);
    if (dot(center, center) <= radius * radius) return;
    const PixelRectangle seen = projection.of_sphere(center, radius);
    const double width = seen.x_end - seen.x_begin;
    const double height = seen.y_end - seen.y_begin;
    const double x = seen.x_begin + width / 2;
    const double y = seen.y_begin + height / 2;
    if (!(width > 0 && height > 0 && width * height < 1)) return;
    if (!(x >= 0 && x < camera.width && y >= 0 && y < camera.height)) return;
    const double area = std::numbers::pi / 4 * width * height;
    Areas& areas = parts_[part_at(static_cast<int>(x), static_cast<int>(y), columns)];
    areas.sum += area;
    areas.sum_of_squares += area * area;
  };
  for (const Object& object : scene.objects) {
    if (const auto* sphere = std::get_if<Sphere>(&object.shape)) {
      add(sphere->center, sphere->radius);
    } else if (const auto* spheres = std::get_if<Spheres>(&object.shape)) {
      for (std::size_t i = 0; i < spheres->centers.size(); ++i)
        add(spheres->centers[i], spheres->radius(i));
    }
  }
}

double MissableSpheres::error2(std::size_t part, int samples) const {
  constexpr double contrast2 = 0.5;  // of a channel, in a picture that knows black and white
  constexpr double channels = 3;
  const Areas& areas = parts_[part];
  if (areas.sum == 0) return 0;
  return channels * contrast2 * areas.sum_of_squares * std::exp(-samples * areas.sum / 2);
}

}  // namespace raytracer
