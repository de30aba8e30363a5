#include "engine/scene/overrides.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "engine/math/ray.h"

namespace raytracer {
namespace {

template <typename Value, typename T>
void override_with(Value& value, const std::optional<T>& over) {
  if (over) value = *over;
}

/// The point that a structure has under a key.
template <typename Structure>
Vec3 point_of(const Structure& structure, std::string_view key) {
  Vec3 point;
  for_each_field(Structure::fields, [&](const auto& row) {
    if constexpr (std::is_same_v<decltype(structure.*row.member), const Vec3&>)
      if (row.key == key) point = structure.*row.member;
  });
  return point;
}

/// Notes what the rules of a structure's fields have to complain about.
template <typename Structure>
void check_fields(const Structure& structure, const Path& path, ErrorList& errors) {
  for_each_field(Structure::fields, [&](const auto& row) {
    const auto& value = structure.*row.member;
    std::string complaint;
    if constexpr (requires { row.rule.complaint(value); })
      complaint = row.rule.complaint(value);
    else if constexpr (requires { row.rule.complaint(*value); })
      complaint = value ? row.rule.complaint(*value) : "";
    else if constexpr (requires { row.rule.other; })
      complaint = row.rule.complaint(value, point_of(structure, row.rule.other));
    if (!complaint.empty()) errors.add(ErrorKind::invalid, path.child(row.key), complaint);
  });
}

/// The most rays that a sample may take: each may be followed by one, or by two where a surface
/// both mirrors and lets through. All of one depth have a weight together, of which each has the
/// least at least, or it is left out.
double most_rays(const Scene& scene) {
  constexpr double most_of_one = 1 / least_ray_weight;
  bool is_followed = false;
  bool branches = false;
  double weight = 0;
  for (const Material& m : scene.materials) {
    is_followed = is_followed || m.reflectivity > 0 || m.transparency > 0;
    branches = branches || (m.transparency > 0 && (m.reflectivity > 0 || m.fresnel));
    weight = std::max(weight, m.reflectivity + m.transparency);
  }
  if (!is_followed) return 1;
  if (!branches) return 1.0 + scene.render.max_depth;
  double rays = 1;
  double branched = 1;  // of one depth, were none left out
  double together = 1;
  for (int depth = 0; depth < scene.render.max_depth && std::isfinite(rays); ++depth) {
    branched *= 2;
    together *= weight;
    if (branched <= most_of_one * together) {
      rays += branched;
      continue;
    }
    const double rest = scene.render.max_depth - depth;
    const double sum = weight == 1 ? rest : (std::pow(weight, rest) - 1) / (weight - 1);
    return rays + most_of_one * together * sum;
  }
  return rays;
}

/// The rays of a sample; those that surfaces split count by their weight together, which grows
/// only where a surface gives back more than it receives.
double weighed_rays(const Scene& scene) {
  double weight = 0;
  for (const Material& m : scene.materials)
    weight = std::max(weight, m.reflectivity + m.transparency);
  if (weight == 0) return 1;
  const double rays = 1.0 + scene.render.max_depth;
  return weight <= 1 ? rays : (std::pow(weight, rays) - 1) / (weight - 1);
}

}  // namespace

Result<Scene> view_scene(const Scene& scene, const Limits& limits, const Overrides& overrides) {
  Scene view = with_overrides(scene, overrides);
  ErrorList errors;
  check_view_rules(view, errors);
  check_view_limits(view, limits, errors);
  if (!errors.empty()) return std::move(errors).take();
  return view;
}

Scene with_overrides(Scene scene, const Overrides& over) {
  override_with(scene.camera.width, over.width);
  override_with(scene.camera.height, over.height);
  override_with(scene.camera.origin, over.origin);
  override_with(scene.camera.look_at, over.look_at);
  override_with(scene.camera.up, over.up);
  override_with(scene.camera.fov, over.fov);
  RenderSettings& render = scene.render;
  override_with(render.precision, over.precision);
  override_with(render.transfer, over.transfer);
  override_with(render.max_depth, over.max_depth);
  // A query that names its own bound replaces the document's kind of bound altogether.
  if (over.samples) {
    render.samples = over.samples;
    render.target_rmse.reset();
    render.budget_ms.reset();
  } else if (over.target_rmse || over.budget_ms) {
    render.samples.reset();
    override_with(render.target_rmse, over.target_rmse);
    override_with(render.budget_ms, over.budget_ms);
  }
  return scene;
}

void check_view_rules(const Scene& scene, ErrorList& errors) {
  const Path root;
  check_fields(scene.camera, root.child("camera"), errors);
  check_fields(scene.render, root.child("render"), errors);
}

void check_view_limits(const Scene& scene, const Limits& limits, ErrorList& errors) {
  const Path root;
  const Path camera = root.child("camera");
  const Path render = root.child("render");
  demand_at_most(static_cast<double>(scene.camera.width) * scene.camera.height, &Limits::pixels,
                 limits, camera, errors);
  demand_at_most(scene.render.samples.value_or(1), &Limits::samples, limits,
                 render.child("samples"), errors);
  demand_at_most(work_of(scene, scene.render.samples.value_or(1)), &Limits::work, limits, render,
                 errors);
}

double work_of(const Scene& scene, int samples) {
  return static_cast<double>(scene.camera.width) * scene.camera.height * samples *
         weighed_rays(scene);
}

double count_rays(const Scene& scene, int samples) {
  return static_cast<double>(scene.camera.width) * scene.camera.height * samples * most_rays(scene);
}

void demand_at_most(double count, std::int64_t Limits::*limit, const Limits& limits,
                    const Path& path, ErrorList& errors) {
  const LimitRow& row = row_of(limit);
  if (count <= static_cast<double>(limits.*limit)) return;
  errors.add(ErrorKind::limit, path,
             fmt::format("asks for {} {}, but this service accepts {} ({})", count, row.meaning,
                         limits.*limit, row.flag));
}

}  // namespace raytracer
