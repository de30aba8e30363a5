// GET /openapi.json against the server: every route has its entry, every entry its route, and what
// is answered is what is written there.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>
#include <vector>

#include "server/embedded.h"
#include "server/query.h"
#include "server/routes.h"
#include "tests/process/patience.h"
#include "tests/service/documents.h"
#include "tests/service/service.h"

namespace raytracer::test {
namespace {

using Json = nlohmann::json;
using Names = std::set<std::string>;

class OpenApi : public Service {
 protected:
  OpenApi() : document_(json_of(get("/openapi.json"))) {}

  /// Follows a $ref within the document.
  const Json& resolved(const Json& json) const {
    if (!json.contains("$ref")) return json;
    return document_.at(Json::json_pointer(json.at("$ref").get<std::string>().substr(1)));
  }

  const Json& operation(const std::string& method, const std::string& path) const {
    return document_.at("paths").at(path).at(method);
  }

  Names query_parameters(const std::string& method, const std::string& path) const {
    Names names;
    for (const Json& entry : operation(method, path).at("parameters")) {
      const Json& parameter = resolved(entry);
      if (parameter.at("in") == "query") names.insert(parameter.at("name"));
    }
    return names;
  }

  /// "GET /jobs/{id}" for each entry.
  Names documented() const {
    Names names;
    for (const auto& [path, item] : document_.at("paths").items())
      for (const auto& [method, entry] : item.items())
        if (method != "parameters") names.insert(upper_case(method) + " " + path);
    return names;
  }

  /// Holds an answer against what is written about it: status, type, header fields, schema.
  void expect_documented(const Answer& answer, const std::string& method,
                         const std::string& path) const {
    const std::string where = fmt::format("{} {} {}", method, path, answer.status);
    const Json& responses = operation(method, path).at("responses");
    const std::string status = std::to_string(answer.status);
    ASSERT_TRUE(responses.contains(status)) << where << ": " << answer.body.substr(0, 300);
    const Json& response = resolved(responses.at(status));
    for (const auto& [name, header] : response.at("headers").items())
      EXPECT_TRUE(answer.has_header(name) || !resolved(header).value("required", true))
          << where << " lacks " << name;
    if (!response.contains("content")) {
      EXPECT_EQ(answer.body, "") << where;
      return;
    }
    std::string type = answer.get_header_value("Content-Type");
    type = type.substr(0, type.find(';'));
    ASSERT_TRUE(response.at("content").contains(type)) << where << " is " << type;
    const Json schema = response.at("content").at(type).value("schema", Json());
    if (type.ends_with("json") && schema.dump().find("#/components/") != std::string::npos)
      expect_valid(answer, schema, where);
  }

  const Json document_;

 private:
  static std::string upper_case(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(c));
    return text;
  }

  /// The schema's references are into the document, so that they stand in one beside it.
  void expect_valid(const Answer& answer, const Json& schema, const std::string& where) const {
    Json whole = schema;
    whole["components"] = document_.at("components");
    valijson::Schema parsed;
    valijson::SchemaParser parser;
    parser.populateSchema(valijson::adapters::NlohmannJsonAdapter(whole), parsed);
    const Json body = json_of(answer);
    valijson::Validator validator;
    EXPECT_TRUE(validator.validate(parsed, valijson::adapters::NlohmannJsonAdapter(body), nullptr))
        << where << ": " << answer.body;
  }
};

TEST_F(OpenApi, is_3_1) {
  EXPECT_EQ(document_.at("openapi"), "3.1.0");
  EXPECT_EQ(get("/openapi.json").get_header_value("Content-Type"), json_type);
}

/// They are the page's own business.
bool is_module_of_the_page(const Route& route) {
  return std::any_of(embedded_files().begin(), embedded_files().end(), [&](const auto& file) {
    return file.path == std::string(page_folder) + route.pattern;
  });
}

TEST_F(OpenApi, has_every_route_and_no_other) {
  Config config;
  config.quiet = true;
  Services services(config);
  Names routes;
  const RouteTable table = make_routes(services);
  for (const Route& route : table.routes())
    if (!is_module_of_the_page(route)) routes.insert(route.method + " " + route.pattern);
  EXPECT_EQ(documented(), routes);
}

TEST_F(OpenApi, methods_of_each_path_are_those_that_the_server_allows) {
  for (const auto& [path, item] : document_.at("paths").items()) {
    Names written;
    for (const auto& [method, entry] : item.items()) {
      if (method == "get") written.insert({"GET", "HEAD"});
      if (method == "post") written.insert("POST");
      if (method == "delete") written.insert("DELETE");
    }
    std::string target = path;
    if (const std::size_t hole = target.find('{'); hole != std::string::npos)
      target.replace(hole, target.find('}') + 1 - hole, "x");
    const Answer answer = request("PUT", target);
    EXPECT_EQ(answer.status, 405) << path;
    Names allowed;
    std::istringstream list(answer.get_header_value("Allow"));
    for (std::string method; std::getline(list >> std::ws, method, ',');) allowed.insert(method);
    EXPECT_EQ(allowed, written) << path;
  }
}

TEST_F(OpenApi, has_every_parameter_and_no_other) {
  const std::vector<std::string_view> names = query_names();
  Names known(names.begin(), names.end());
  EXPECT_EQ(query_parameters("get", "/render"), known);
  EXPECT_EQ(query_parameters("post", "/render"), known);
  EXPECT_EQ(query_parameters("post", "/plan"), known);
  known.insert("task");
  EXPECT_EQ(query_parameters("post", "/jobs"), known);
}

TEST_F(OpenApi, names_the_captured_parts_of_paths) {
  for (const auto& [path, item] : document_.at("paths").items()) {
    const std::size_t hole = path.find('{');
    if (hole == std::string::npos) continue;
    const Json& parameter = resolved(item.at("parameters").at(0));
    EXPECT_EQ(parameter.at("in"), "path");
    EXPECT_EQ("{" + parameter.value("name", "") + "}",
              path.substr(hole, path.find('}') + 1 - hole));
  }
}

TEST_F(OpenApi, references_lead_somewhere) {
  int count = 0;
  const Json flat = document_.flatten();
  for (const auto& [pointer, value] : flat.items()) {
    if (!pointer.ends_with("/$ref")) continue;
    ASSERT_TRUE(value.get<std::string>().starts_with('#'))
        << pointer << " leads out of the document: " << value;
    const Json::json_pointer target(value.get<std::string>().substr(1));
    EXPECT_TRUE(document_.contains(target)) << pointer << ": " << value;
    ++count;
  }
  EXPECT_GT(count, 100);
}

TEST_F(OpenApi, scene_is_that_of_the_schema) {
  const Json& scene = document_.at("components").at("schemas").at("scene");
  const Json schema = json_of(get("/schema/scene.json"));
  for (const auto& [name, definition] : schema.at("$defs").items())
    EXPECT_TRUE(scene.at("$defs").contains(name)) << name;
  EXPECT_EQ(scene.at("required"), schema.at("required"));
}

/// Calls visit(media type, pointer) for each in "content" of what is below.
template <typename Visit>
void for_each_media_type(const Json& json, const std::string& pointer, const Visit& visit) {
  if (!json.is_structured()) return;
  for (const auto& [key, part] : json.items()) {
    const std::string below = pointer + "/" + key;
    if (key == "content" && part.is_object())
      for (const auto& [type, media_type] : part.items()) visit(media_type, below + " " + type);
    for_each_media_type(part, below, visit);
  }
}

TEST_F(OpenApi, media_types_have_only_what_the_standard_gives_them) {
  const Names known{"schema", "example", "examples", "encoding"};
  int count = 0;
  const auto check = [&](const Json& media_type, const std::string& where) {
    for (const auto& [key, value] : media_type.items())
      EXPECT_TRUE(known.contains(key)) << where << ": " << key;
    ++count;
  };
  for (const char* const part : {"paths", "components"})
    for_each_media_type(document_.at(part), part, check);
  EXPECT_GT(count, 20);
}

TEST_F(OpenApi, every_refusal_is_a_problem) {
  for (const auto& [path, item] : document_.at("paths").items())
    for (const auto& [method, entry] : item.items()) {
      if (method == "parameters") continue;
      for (const auto& [status, response] : entry.at("responses").items()) {
        const bool says_state = path == "/readyz" && status == "503";
        if ((status[0] != '4' && status[0] != '5' && status != "default") || says_state) continue;
        EXPECT_TRUE(resolved(response).at("content").contains("application/problem+json"))
            << method << " " << path << " " << status;
      }
    }
}

TEST_F(OpenApi, answers_are_as_written) {
  const Headers accept{{"Accept", std::string(pfm_type)}};
  const Answer image = post("/render", small_scene);
  expect_documented(image, "post", "/render");
  expect_documented(post("/render", small_scene, accept), "post", "/render");
  expect_documented(
      post("/render", small_scene, {{"If-None-Match", image.get_header_value("ETag")}}), "post",
      "/render");
  expect_documented(get("/render?scene=demo&width=20&height=10"), "get", "/render");
  expect_documented(post("/plan", small_scene), "post", "/plan");
  for (const char* const path : {"/scenes", "/healthz", "/readyz", "/metrics", "/version",
                                 "/schema/scene.json", "/openapi.json", "/"})
    expect_documented(get(path), "get", path);
  expect_documented(get("/", {{"If-None-Match", get("/").get_header_value("ETag")}}), "get", "/");
  expect_documented(get("/scenes/demo"), "get", "/scenes/{name}");

  const Answer kept = post("/scenes", small_scene);
  expect_documented(kept, "post", "/scenes");
  expect_documented(get(kept.get_header_value("Location")), "get", "/scenes/{name}");

  const Answer accepted = post("/jobs", small_scene);
  expect_documented(accepted, "post", "/jobs");
  const std::string job = accepted.get_header_value("Location");
  expect_documented(get(job), "get", "/jobs/{id}");
  expect_documented(get(job + "/events"), "get", "/jobs/{id}/events");
  expect_documented(get(job + "/image"), "get", "/jobs/{id}/image");
  expect_documented(request("DELETE", job), "delete", "/jobs/{id}");
}

TEST_F(OpenApi, refusals_are_as_written) {
  expect_documented(post("/render", "{"), "post", "/render");
  expect_documented(post("/render", "{}"), "post", "/render");
  expect_documented(post("/render?width=100000", small_scene), "post", "/render");
  expect_documented(post("/render", small_scene, {{"Accept", "text/html"}}), "post", "/render");
  expect_documented(post("/render", "x", {{"Content-Type", "text/plain"}}), "post", "/render");
  expect_documented(get("/render?scene=dmeo"), "get", "/render");
  expect_documented(get("/scenes/dmeo"), "get", "/scenes/{name}");
  expect_documented(post("/scenes", "{}"), "post", "/scenes");
  expect_documented(get("/jobs/1"), "get", "/jobs/{id}");
  const ServerProcess closed({"--token", "word"});
  expect_documented(test::get(closed, "/version"), "get", "/version");
  const ServerProcess full({"--threads", "1", "--max-queue", "0"});
  for (int i = 0; i < 4; ++i) test::post(full, "/jobs", endless_scene());
  expect_documented(test::post(full, "/render", small_scene), "post", "/render");
  expect_documented(test::get(full, "/readyz"), "get", "/readyz");
}

}  // namespace
}  // namespace raytracer::test
