#include "engine/sample/missable_spheres.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "engine/accel/projection.h"
#include "engine/image/pixel_spreads.h"
#include "engine/plan/view.h"

namespace raytracer {

MissableSpheres::MissableSpheres(const Scene& scene, const Frame& frame) {
  const Camera& camera = scene.camera;
  const auto stride = static_cast<std::size_t>(PixelSpreads::whole_parts(camera.width));
  pixels_.resize(stride * static_cast<std::size_t>(PixelSpreads::whole_parts(camera.height)));
  const Projection projection(make_view(camera));
  const auto add = [&](const Vec3& scene_center, double scene_radius) {
    const Vec3 center = frame.frame_from_scene(scene_center);
    const double radius = frame.frame_from_scene(scene_radius);
    if (dot(center, center) <= radius * radius) return;
    const PixelRectangle seen = projection.of_sphere(center, radius);
    const double width = seen.x_end - seen.x_begin;
    const double height = seen.y_end - seen.y_begin;
    if (!(width > 0 && height > 0 && width * height < 1)) return;
    const auto within = [](double place, int count) {
      return static_cast<int>(std::clamp(place, 0.0, static_cast<double>(count)));
    };
    const int x_end = within(std::ceil(seen.x_end), camera.width);
    const int y_end = within(std::ceil(seen.y_end), camera.height);
    for (int y = within(seen.y_begin, camera.height); y < y_end; ++y)
      for (int x = within(seen.x_begin, camera.width); x < x_end; ++x) {
        const double across = std::min(seen.x_end, x + 1.0) - std::max<double>(seen.x_begin, x);
        const double down = std::min(seen.y_end, y + 1.0) - std::max<double>(seen.y_begin, y);
        const auto area = static_cast<float>(std::numbers::pi / 4 * across * down);
        Areas& areas = pixels_[static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x)];
        areas.sum += area;
        areas.sum_of_squares += area * area;
      }
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

double MissableSpheres::error2(std::size_t pixel, int samples) const {
  constexpr double contrast2 = 0.5;  // of a channel, in a picture that knows black and white
  constexpr double channels = 3;
  const Areas& areas = pixels_[pixel];
  if (areas.sum == 0) return 0;
  return channels * contrast2 * static_cast<double>(areas.sum_of_squares) *
         std::exp(-samples * static_cast<double>(areas.sum) / 2);
}

}  // namespace raytracer
