#include "engine/scene/read_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "engine/scene/camera_rules.h"
#include "engine/scene/document.h"
#include "engine/scene/fields.h"
#include "engine/scene/materials.h"
#include "engine/scene/read_objects.h"
#include "engine/scene/read_typed.h"
#include "engine/scene/scene_size.h"

namespace raytracer {
namespace {

std::optional<double> read_fov(const Field& field) {
  const std::optional<double> fov = read_number(field);
  if (!fov || is_field_of_view(*fov)) return fov;
  field.refuse(fmt::format("{} is out of range: {}", *fov, fov_rule));
  return {};
}

/// A count of pixels or samples: whatever fits an int; the limits are judged later.
std::optional<std::int64_t> read_count(const Field& field) {
  const auto count = read_integer(field, 1, 1LL << 53);
  if (!count) return {};
  return std::min<std::int64_t>(*count, std::numeric_limits<int>::max());
}

std::optional<int> read_max_depth(const Field& field) {
  // Any integer is valid; deeper than an int counts, no ray is ever followed.
  constexpr auto most = std::numeric_limits<int>::max();
  const std::optional<double> depth = read_number(field, not_negative);
  if (!depth) return {};
  if (*depth == std::floor(*depth)) return static_cast<int>(std::min<double>(*depth, most));
  field.refuse(fmt::format("{} must be an integer", *depth));
  return {};
}

Camera read_camera(const Field& field) {
  const ObjectReader object(field, {"origin", "look_at", "up", "fov", "width", "height"});
  Camera camera;
  std::optional<Vec3> origin;
  object.required("origin", origin, read_point);
  object.required("look_at", camera.look_at, [&](const Field& f) -> std::optional<Vec3> {
    const std::optional<Vec3> look_at = read_point(f);
    if (!look_at || look_at != origin) return look_at;
    f.refuse(std::string(look_at_rule));
    return {};
  });
  camera.origin = origin.value_or(Vec3{});
  object.optional("up", camera.up, read_direction);
  object.required("fov", camera.fov, read_fov);
  object.required("width", camera.width, read_count);
  object.required("height", camera.height, read_count);
  return camera;
}

using LightSource = decltype(Light::source);

/// The keys that every light has.
void read_emission(const ObjectReader& object, Light& light) {
  object.optional("color", light.color, read_color);
  object.optional("intensity", light.intensity,
                  [](const Field& f) { return read_number(f, not_negative); });
}

Light read_distant_light(const Field& field) {
  const ObjectReader object(field, {"type", "direction", "color", "intensity"});
  Light light;
  DistantLight source;
  object.required("direction", source.direction, read_direction);
  read_emission(object, light);
  light.source = source;
  return light;
}

Light read_point_light(const Field& field) {
  const ObjectReader object(field, {"type", "position", "color", "intensity"});
  Light light;
  PointLight source;
  object.required("position", source.position, read_point);
  read_emission(object, light);
  light.source = source;
  return light;
}

/// For the errors in what lights of all types have; which other keys it may have is not known.
void read_light_of_no_type(const Field& field) {
  Light light;
  read_emission(ObjectReader(field), light);
}

std::vector<Light> read_lights(const Field& field) {
  static constexpr TypedReaders<Light, 2> readers{
      {{"distant", read_distant_light}, {"point", read_point_light}}};
  std::vector<Light> lights;
  if (!expect_array(field)) return lights;
  read_elements(field, [&](const Field& element) {
    if (auto light = read_typed(element, readers))
      lights.push_back(*light);
    else
      read_light_of_no_type(element);
  });
  return lights;
}

RenderSettings read_render(const Field& field) {
  static constexpr std::array<std::string_view, 3> precision_words{"auto", "single", "double"};
  static constexpr std::array<std::string_view, 2> transfer_words{"linear", "srgb"};
  const ObjectReader object(
      field, {"samples", "target_rmse", "budget_ms", "precision", "max_depth", "transfer"});
  const auto read_bound = [](const Field& f) { return read_number(f, positive); };
  RenderSettings render;
  object.optional("samples", render.samples, read_count);
  object.optional("target_rmse", render.target_rmse, read_bound);
  object.optional("budget_ms", render.budget_ms, read_bound);
  object.optional("precision", render.precision,
                  [](const Field& f) { return read_choice(f, precision_words); });
  object.optional("max_depth", render.max_depth, read_max_depth);
  object.optional("transfer", render.transfer,
                  [](const Field& f) { return read_choice(f, transfer_words); });
  const auto has = [&](std::string_view key) {
    return field.value.kind() == JsonKind::object && field.value.member(key);
  };
  for (const std::string_view contract : {"target_rmse", "budget_ms"}) {
    if (!has("samples") || !has(contract)) continue;
    field.errors.add(ErrorKind::invalid, field.path.child(contract),
                     fmt::format("\"{}\" does not go with \"samples\": leave one out", contract));
  }
  return render;
}

/// The whole document but for what depends on several of its parts.
Scene read_document(const Field& root) {
  static constexpr std::array<std::string_view, 3> shadows_words{"black", "ambient", "off"};
  const ObjectReader object(
      root, {"camera", "background", "ambient", "shadows", "lights", "materials", "objects",
             "render", "name", "description", "$schema"});
  Scene scene;
  MaterialReader materials;
  const auto read_part = [](auto read) {
    return [read](const Field& f) { return std::optional(read(f)); };
  };
  object.required("camera", scene.camera, read_part(read_camera));
  object.optional("background", scene.background, read_color);
  object.optional("ambient", scene.ambient,
                  [](const Field& f) { return read_number(f, not_negative); });
  object.optional("shadows", scene.shadows,
                  [](const Field& f) { return read_choice(f, shadows_words); });
  object.optional("lights", scene.lights, read_part(read_lights));
  bool has_materials = false;
  object.optional("materials", has_materials, read_part([&](const Field& f) {
                    materials.read_named(f);
                    return true;
                  }));
  object.optional("objects", scene.objects,
                  read_part([&](const Field& f) { return read_objects(f, materials); }));
  object.optional("render", scene.render, read_part(read_render));
  for (const std::string_view key : {"name", "description", "$schema"}) {
    std::string_view text;  // for people
    object.optional(key, text, read_string);
  }
  scene.materials = std::move(materials).take();
  return scene;
}

}  // namespace

Result<ViewedScene> read_viewed_scene(std::string_view text, const Limits& limits,
                                      const Overrides& overrides) {
  Result<Document> parsed = parse_document(text);
  if (!parsed.ok()) return parsed.errors();
  Document document = std::move(parsed).value();

  ErrorList errors = std::move(document.errors);
  const Path root;
  const Scene scene = read_document({JsonValue(document), root, errors});
  const bool document_is_valid = errors.empty();

  const Scene view = with_overrides(scene, overrides);
  if (document_is_valid) check_view_rules(view, errors);
  check_view_limits(view, limits, errors);
  demand_at_most(static_cast<double>(count_objects(scene)), &Limits::objects, limits,
                 root.child("objects"), errors);
  demand_at_most(static_cast<double>(scene.lights.size()), &Limits::lights, limits,
                 root.child("lights"), errors);
  if (!errors.empty()) return std::move(errors).take();
  return ViewedScene{scene, view};
}

Result<Scene> read_scene(std::string_view text, const Limits& limits, const Overrides& overrides) {
  Result<ViewedScene> read = read_viewed_scene(text, limits, overrides);
  if (!read.ok()) return read.errors();
  return read.value().view;
}

}  // namespace raytracer
