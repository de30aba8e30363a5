// The service described for programs: OpenAPI 3.1.
//
// openapi.json says what is particular to each route, openapi.components.json what several share,
// openapi.schemas.json what bodies and answers look like;
// what is the same for all is added here, so that it is said once: the request's id, the refusals
// that any request may meet, that refusals are problem+json, and the schema of scenes.
#include <nlohmann/json.hpp>
#include <string>

#include "engine/engine.h"
#include "server/answer.h"
#include "server/embedded.h"
#include "server/handlers.h"

namespace raytracer {
namespace {

using Json = nlohmann::ordered_json;

Json component(const std::string& path) { return {{"$ref", "#/components/" + path}}; }

void add_request_id(Json& response) {
  if (!response.contains("$ref"))
    response["headers"]["X-Request-Id"] = component("headers/request_id");
}

/// Every component that is named after a status, and "problem", is a refusal.
void complete_components(Json& responses) {
  for (auto& [name, response] : responses.items()) {
    add_request_id(response);
    const bool is_problem = name == "problem" || name.starts_with('4') || name.starts_with('5');
    if (is_problem)
      response["content"]["application/problem+json"]["schema"] = component("schemas/problem");
  }
}

void complete_operation(Json& operation) {
  Json& responses = operation["responses"];
  for (auto& [status, response] : responses.items()) add_request_id(response);
  if (!operation.contains("security")) responses["401"] = component("responses/401");
  responses["default"] = component("responses/problem");
}

/// Has the references within a schema, which begin at its root, begin at that of a document that
/// has the schema at `place`.
void move_references(Json& schema, const std::string& place) {
  if (schema.is_object() && schema.contains("$ref")) {
    const std::string within = schema["$ref"].get<std::string>().substr(1);
    schema["$ref"] = place + within;
  }
  if (!schema.is_structured()) return;
  for (Json& part : schema) move_references(part, place);
}

/// That of a scene document, as a part of this document: whoever reads it fetches nothing else.
Json scene_component() {
  Json schema = Json::parse(scene_schema());
  schema.erase("$schema");
  schema.erase("$id");  // or references would begin at the schema again
  move_references(schema, "#/components/schemas/scene");
  return schema;
}

/// The whole document.
Json openapi_document() {
  Json document = Json::parse(embedded_file("openapi.json").bytes);
  Json& components = document["components"];
  components = Json::parse(embedded_file("openapi.components.json").bytes);
  complete_components(components["responses"]);
  components["schemas"] = Json::parse(embedded_file("openapi.schemas.json").bytes);
  components["schemas"]["scene"] = scene_component();
  Json& paths = document["paths"];
  for (auto& [path, item] : paths.items())
    for (auto& [method, operation] : item.items())
      if (method != "parameters") complete_operation(operation);
  return document;
}

}  // namespace

void get_openapi(Services&, Call& call) {
  static const std::string text = openapi_document().dump(2) + "\n";
  answer_bytes(call.response, text, "application/json");
}

}  // namespace raytracer
