#include "server/openapi.h"

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "server/embedded.h"

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

Json page_file_operation(std::string_view media_type) {
  const std::string type(media_type.substr(0, media_type.find(';')));
  return {{"summary", "A file of the page"},
          {"responses",
           {{"200",
             {{"description", "The file"},
              {"headers", {{"Cache-Control", component("headers/cache_control")}}},
              {"content", {{type, Json::object()}}}}}}}};
}

void complete_operation(Json& operation) {
  Json& responses = operation["responses"];
  for (auto& [status, response] : responses.items()) add_request_id(response);
  if (!operation.contains("security")) responses["401"] = component("responses/401");
  responses["default"] = component("responses/problem");
}

}  // namespace

Json openapi_document() {
  Json document = Json::parse(embedded_file("openapi.json").bytes);
  Json& components = document["components"];
  components = Json::parse(embedded_file("openapi.components.json").bytes);
  complete_components(components["responses"]);
  Json& paths = document["paths"];
  for (auto& [path, item] : paths.items())
    for (auto& [method, operation] : item.items())
      if (method != "parameters") complete_operation(operation);

  for (const EmbeddedFile& file : embedded_files()) {
    if (!file.path.starts_with(page_folder)) continue;
    Json get = page_file_operation(media_type_of(file.path));
    complete_operation(get);
    const std::string path(file.path.substr(page_folder.size()));
    paths[path]["get"] = get;
    if (path == "/index.html") paths["/"]["get"] = get;
  }
  return document;
}

}  // namespace raytracer
