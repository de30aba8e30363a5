#include "engine/scene/read_scene.h"

#include <array>
#include <string_view>
#include <utility>

#include "engine/scene/camera.h"
#include "engine/scene/document.h"
#include "engine/scene/fields.h"
#include "engine/scene/materials.h"
#include "engine/scene/read_objects.h"
#include "engine/scene/read_typed.h"
#include "engine/scene/scene_size.h"

namespace raytracer {
namespace {

template <typename Structure>
Structure read_structure(const Field& field) {
  const ObjectReader object(field, keys_of(Structure::fields, std::array<std::string_view, 0>{}));
  Structure structure;
  read_fields(object, Structure::fields, structure);
  return structure;
}

std::vector<Light> read_lights(const Field& field) {
  using Source = decltype(Light::source);
  static constexpr auto also = keys_of(Light::fields, std::array<std::string_view, 0>{});
  std::vector<Light> lights;
  if (!expect_array(field)) return lights;
  read_elements(field, [&](const Field& element) {
    const std::optional<Source> source = read_typed<Source>(element, LightKinds{}, also);
    if (element.value.kind() != JsonKind::object) return;
    Light light;
    read_fields(ObjectReader(element), Light::fields, light);
    if (!source) return;
    light.source = *source;
    lights.push_back(light);
  });
  return lights;
}

RenderSettings read_render(const Field& field) {
  const auto render = read_structure<RenderSettings>(field);
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
  static constexpr std::array<std::string_view, 8> others{
      "camera", "lights", "materials", "objects", "render", "name", "description", "$schema"};
  const ObjectReader object(root, keys_of(Scene::fields, others));
  Scene scene;
  MaterialReader materials;
  const auto read_part = [](auto read) {
    return [read](const Field& f) { return std::optional(read(f)); };
  };
  object.required("camera", scene.camera, read_part(read_structure<Camera>));
  read_fields(object, Scene::fields, scene);
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
