#include "engine/scene/schema.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <type_traits>

#include "engine/scene/scene.h"

namespace raytracer {
namespace {

using Json = nlohmann::ordered_json;

Json reference(std::string_view name) { return {{"$ref", "#/$defs/" + std::string(name)}}; }

Json list_of(Json items) { return {{"type", "array"}, {"items", std::move(items)}}; }

Json triple_of(Json items) {
  Json list = list_of(std::move(items));
  list["minItems"] = list["maxItems"] = 3;
  return list;
}

/// The schema of a value, by the rules of engine/fields/field_rules.h.
struct SchemaOf {
  Json operator()(const NumberRule& rule) const {
    Json number{{"type", "number"}};
    if (std::isfinite(rule.range.least))
      number[rule.range.least_excluded ? "exclusiveMinimum" : "minimum"] = rule.range.least;
    if (std::isfinite(rule.range.most))
      number[rule.range.most_excluded ? "exclusiveMaximum" : "maximum"] = rule.range.most;
    return number;
  }
  Json operator()(const NotBothZeroRule&) const { return (*this)(NumberRule{not_negative}); }
  Json operator()(const IntegerRule& rule) const {
    return {{"type", "integer"}, {"minimum", rule.least}, {"maximum", rule.most}};
  }
  Json operator()(const CountRule& rule) const {
    return {{"type", "integer"}, {"minimum", rule.least}};
  }
  Json operator()(const FlagRule&) const { return {{"type", "boolean"}}; }
  Json operator()(const FieldOfViewRule&) const {
    return {{"type", "number"}, {"not", {{"const", 0}}}};
  }
  Json operator()(const PointRule&) const { return reference("point"); }
  Json operator()(const OtherPointRule&) const { return reference("point"); }
  Json operator()(const DirectionRule&) const { return reference("direction"); }
  Json operator()(const ColorRule&) const { return reference("color"); }
  Json operator()(const BackgroundRule&) const {
    return {{"oneOf", {reference("color"), {{"const", "transparent"}}}}};
  }
  template <std::size_t count>
  Json operator()(const ChoiceRule<count>& rule) const {
    return {{"enum", rule.words}};
  }
  Json operator()(const PointsRule&) const { return list_of(reference("point")); }
  Json operator()(const OtherPointPerItemRule&) const { return list_of(reference("point")); }
  Json operator()(const DirectionPerItemRule&) const { return list_of(reference("direction")); }
  Json operator()(const NumberPerItemRule& rule) const {
    const Json one = (*this)(NumberRule{rule.range});
    return {{"oneOf", {one, list_of(one)}}};
  }
  Json operator()(const NotBothZeroPerItemRule& rule) const {
    return (*this)(NumberPerItemRule{not_negative, rule.items});
  }
  Json operator()(const ColorPerItemRule&) const { return list_of(reference("color")); }
  Json operator()(const TriplesRule&) const {
    return list_of(triple_of({{"type", "integer"}, {"minimum", 0}}));
  }
};

/// What a document may leave out; null where nothing stands for it.
template <typename Value, typename Rule>
Json default_json(const Value& value, const Rule& rule) {
  if constexpr (requires { rule.words; })
    return rule.words[static_cast<std::size_t>(value)];
  else if constexpr (std::is_same_v<Value, Vec3>)
    return {value.x, value.y, value.z};
  else if constexpr (std::is_same_v<Value, std::optional<Vec3>>)
    return default_json(*value, rule);
  else if constexpr (std::is_floating_point_v<Value>)
    return std::isfinite(value) ? Json(value) : Json();
  else if constexpr (std::is_arithmetic_v<Value>)
    return value;
  else
    return nullptr;
}

/// Adds the fields of a table to an object's schema; `owner` has their defaults.
template <typename Owner, typename... Field>
void add_fields(const std::tuple<Field...>& table, const Owner& owner, Json& object) {
  for_each_field(table, [&](const auto& field) {
    Json schema = SchemaOf()(field.rule);
    if (!field.description.empty()) schema["description"] = field.description;
    if (field.is_required) {
      object["required"].push_back(field.key);
    } else {
      Json value = default_json(owner.*field.member, field.rule);
      if (!value.is_null()) schema["default"] = std::move(value);
    }
    object["properties"][std::string(field.key)] = std::move(schema);
  });
}

Json object_schema() {
  return {{"type", "object"},
          {"required", Json::array()},
          {"additionalProperties", false},
          {"properties", Json::object()}};
}

template <typename Structure>
Json structure_schema() {
  Json object = object_schema();
  add_fields(Structure::fields, Structure(), object);
  return object;
}

/// One of the structures, told apart by "type".
template <typename... Document, typename AddCommon>
Json typed_schema(Types<Document...>, const AddCommon& add_common) {
  Json choices = Json::array();
  const auto add = [&]<typename Type>(std::type_identity<Type>) {
    Json object = object_schema();
    object["description"] = Type::description;
    object["properties"]["type"] = {{"const", Type::type}};
    add_fields(Type::fields, Type(), object);
    add_common(object);
    choices.push_back(std::move(object));
  };
  (add(std::type_identity<Document>{}), ...);
  return {{"type", "object"}, {"required", {"type"}}, {"oneOf", choices}};
}

Json render_schema() {
  Json render = structure_schema<RenderSettings>();
  render["allOf"] = {{{"not", {{"required", {"samples", "target_rmse"}}}}},
                     {{"not", {{"required", {"samples", "budget_ms"}}}}}};
  return render;
}

Json definitions() {
  const Json unit = SchemaOf()(NumberRule{unit_interval});
  Json defs;
  defs["point"] = triple_of({{"type", "number"}});
  defs["direction"] = {{"description", "Not the zero vector; any other length will do."},
                       {"allOf", {reference("point"), {{"not", {{"const", {0, 0, 0}}}}}}}};
  defs["color"] = {
      {"description", "Linear red, green and blue, or \"#rrggbb\" (each byte / 255)."},
      {"oneOf", {triple_of(unit), {{"type", "string"}, {"pattern", "^#[0-9a-fA-F]{6}$"}}}}};
  defs["camera"] = structure_schema<Camera>();
  defs["light"] =
      typed_schema(LightKinds{}, [](Json& object) { add_fields(Light::fields, Light(), object); });
  defs["material"] = structure_schema<Material>();
  defs["material_of_object"] = {{"description",
                                 "A name from /materials, or a material written in place; without "
                                 "one, the default material."},
                                {"oneOf", {{{"type", "string"}}, reference("material")}}};
  defs["object"] = typed_schema(ObjectDocuments{}, [](Json& object) {
    object["properties"]["material"] = reference("material_of_object");
  });
  defs["render"] = render_schema();
  return defs;
}

}  // namespace

std::string scene_schema() {
  Json schema{
      {"$schema", "https://json-schema.org/draft/2020-12/schema"},
      {"$id", "/schema/scene.json"},
      {"title", "Scene document, version 1.1"},
      {"description",
       "What a scene says. What JSON Schema cannot say, the server checks: origin must differ from "
       "look_at; fov modulo 2 pi must lie strictly between 0 and pi; a material's name must exist; "
       "lists that go together are equally long; a cone has a radius somewhere; indices are below "
       "the number of what they name. "
       "The server's limits come on top: see /version."}};
  Json root = object_schema();
  root["required"] = {"camera"};
  Json& properties = root["properties"];
  for (const char* const key : {"$schema", "name", "description"})
    properties[key] = {{"type", "string"}};
  properties["camera"] = reference("camera");
  add_fields(Scene::fields, Scene(), root);
  const auto list = [&](const char* key, const char* of) {
    properties[key] = list_of(reference(of));
    properties[key]["default"] = Json::array();
  };
  list("lights", "light");
  properties["materials"] = {{"type", "object"},
                             {"additionalProperties", reference("material")},
                             {"default", Json::object()}};
  list("objects", "object");
  properties["render"] = reference("render");
  properties["render"]["default"] = Json::object();
  schema.update(root);
  schema["$defs"] = definitions();
  return schema.dump(2) + "\n";
}

}  // namespace raytracer
