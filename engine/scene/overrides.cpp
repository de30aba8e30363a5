#include "engine/scene/overrides.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "engine/scene/camera.h"

namespace raytracer {
namespace {

template <typename T>
void override_with(T& value, const std::optional<T>& over) {
  if (over) value = *over;
}

template <typename T>
void override_with(std::optional<T>& value, const std::optional<T>& over) {
  if (over) value = over;
}

bool reflects(const Scene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const Material& material) { return material.reflectivity > 0; });
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
  const Path camera_path = root.child("camera");
  const Path render_path = root.child("render");
  const auto demand = [&](bool holds, const Path& parent, std::string_view key,
                          std::string_view rule) {
    if (!holds) errors.add(ErrorKind::invalid, parent.child(key), std::string(rule));
  };
  const Camera& camera = scene.camera;
  demand(camera.width >= 1, camera_path, "width", "must be at least 1");
  demand(camera.height >= 1, camera_path, "height", "must be at least 1");
  const auto is_finite = [](const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  };
  constexpr std::string_view finite_rule = "must be three finite numbers";
  demand(is_finite(camera.origin), camera_path, "origin", finite_rule);
  demand(is_finite(camera.look_at), camera_path, "look_at", finite_rule);
  demand(is_finite(camera.up), camera_path, "up", finite_rule);
  demand(camera.origin != camera.look_at, camera_path, "look_at", look_at_rule);
  demand(camera.up != Vec3{}, camera_path, "up", "the zero vector has no direction");
  demand(is_field_of_view(camera.fov), camera_path, "fov", fov_rule);
  const RenderSettings& render = scene.render;
  demand(render.samples.value_or(1) >= 1, render_path, "samples", "must be at least 1");
  demand(render.target_rmse.value_or(1) > 0, render_path, "target_rmse", "must be above 0");
  demand(render.budget_ms.value_or(1) > 0, render_path, "budget_ms", "must be above 0");
  demand(render.max_depth >= 0, render_path, "max_depth", "must be at least 0");
}

void check_view_limits(const Scene& scene, const Limits& limits, ErrorList& errors) {
  const Path root;
  const Path camera = root.child("camera");
  const Path render = root.child("render");
  demand_at_most(static_cast<double>(scene.camera.width) * scene.camera.height, &Limits::pixels,
                 limits, camera, errors);
  demand_at_most(scene.render.samples.value_or(1), &Limits::samples, limits,
                 render.child("samples"), errors);
  demand_at_most(count_rays(scene, scene.render.samples.value_or(1)), &Limits::work, limits, render,
                 errors);
}

double count_rays(const Scene& scene, int samples) {
  const double bounces = reflects(scene) ? 1.0 + scene.render.max_depth : 1.0;
  return static_cast<double>(scene.camera.width) * scene.camera.height * samples * bounces;
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
