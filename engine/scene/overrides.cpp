#include "engine/scene/overrides.h"

#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "engine/scene/work.h"

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
  demand_at_most(scene.camera.pixel_count(), &Limits::pixels, limits, camera, errors);
  demand_at_most(scene.render.samples.value_or(1), &Limits::samples, limits,
                 render.child("samples"), errors);
  demand_at_most(work_of(scene, scene.render.samples.value_or(1)), &Limits::work, limits, render,
                 errors);
}

}  // namespace raytracer
