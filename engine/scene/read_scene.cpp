#include "engine/scene/read_scene.h"

#include <array>
#include <string_view>
#include <utility>

#include "engine/scene/document.h"
#include "engine/scene/fields.h"
#include "engine/scene/materials.h"
#include "engine/scene/scene_size.h"
#include "engine/scene/work.h"

namespace raytracer {
namespace {

std::optional<std::vector<Light>> read_lights(const Field& field) {
  using Source = decltype(Light::source);
  const auto array = read_array(field);
  if (!array) return {};
  std::vector<Light> lights;
  read_elements(field, *array, [&](const Field& element) {
    Light light;
    const auto read_others = [&](const ObjectReader& object) {
      read_fields(object, Light::fields, light);
    };
    static constexpr auto others = keys_of(Light::fields);
    if (auto source = read_typed<Source>(element, LightKinds{}, others, read_others)) {
      light.source = *source;
      lights.push_back(light);
    }
  });
  return lights;
}

std::optional<std::vector<Object>> read_objects(const Field& field, MaterialReader& materials) {
  static constexpr std::array<std::string_view, 1> others{"material"};
  const auto array = read_array(field);
  if (!array) return {};
  std::vector<Object> objects;
  objects.reserve(array->size());
  read_elements(field, *array, [&](const Field& element) {
    MaterialIndex material = 0;
    const auto read_others = [&](const ObjectReader& object) {
      const auto read_use = [&](const Field& use) { return materials.read_use(use); };
      if (!object.optional("material", material, read_use)) material = materials.use_default();
    };
    if (auto shape = read_typed<Shape>(element, ObjectDocuments{}, others, read_others))
      objects.push_back({std::move(*shape), material});
  });
  return objects;
}

std::optional<RenderSettings> read_render(const Field& field) {
  const auto render = read_structure<RenderSettings>(field);
  const auto has = [&](std::string_view key) { return !field.value.at_key(key).error(); };
  for (const std::string_view contract : {"target_rmse", "budget_ms"}) {
    if (!has("samples") || !has(contract)) continue;
    field.errors.add(ErrorKind::invalid, field.path.child(contract),
                     fmt::format("\"{}\" does not go with \"samples\": leave one out", contract));
  }
  return render;
}

/// The whole document but for what depends on several of its parts.
Scene read_document(const Field& root) {
  Scene scene;
  const auto object = read_object(root);
  if (!object) return scene;
  object->refuse_keys_but(keys_of(Scene::fields, "camera", "lights", "materials", "objects",
                                  "render", "name", "description", "$schema"));
  object->required("camera", scene.camera, read_structure<Camera>);
  read_fields(*object, Scene::fields, scene);
  object->optional("lights", scene.lights, read_lights);
  MaterialReader materials;
  object->optional("materials", materials,
                   [](const Field& field) { return std::optional(MaterialReader(field)); });
  object->optional("objects", scene.objects,
                   [&](const Field& field) { return read_objects(field, materials); });
  object->optional("render", scene.render, read_render);
  for (const std::string_view key : {"name", "description", "$schema"}) {
    std::string_view text;  // for people
    object->optional(key, text, read_string);
  }
  scene.materials = std::move(materials).take();
  return scene;
}

}  // namespace

Result<ViewedScene> read_viewed_scene(const DocumentText& text, const Limits& limits,
                                      const Overrides& overrides) {
  Result<Document> parsed = parse_document(text);
  if (!parsed.ok()) return parsed.errors();
  Document document = std::move(parsed).value();
  ErrorList& errors = document.errors;
  const Path root;
  const Scene scene = read_document({document.root(), root, errors});
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

Result<Scene> read_scene(const DocumentText& text, const Limits& limits,
                         const Overrides& overrides) {
  Result<ViewedScene> read = read_viewed_scene(text, limits, overrides);
  if (!read.ok()) return read.errors();
  return read.value().view;
}

}  // namespace raytracer
