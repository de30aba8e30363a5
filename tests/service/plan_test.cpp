// POST /plan: what the engine would do with a scene, and what that takes.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/service/documents.h"
#include "tests/service/service.h"

namespace raytracer::test {
namespace {

class PlanRoute : public Service {
 protected:
  static nlohmann::json plan_of(const std::string& document, const std::string& query = "") {
    const Answer answer = post("/plan" + query, document);
    EXPECT_EQ(answer.status, 200) << answer.body;
    EXPECT_EQ(answer.get_header_value("Content-Type"), json_type);
    return json_of(answer);
  }
};

TEST_F(PlanRoute, says_what_it_must) {
  const nlohmann::json plan = plan_of(small_scene);
  EXPECT_EQ(plan.at("features").at("objects").at("spheres"), 1);
  EXPECT_EQ(plan.at("features").at("lights").at("distant"), 1);
  EXPECT_EQ(plan.at("features").at("reflections"), 0);
  for (const char* const key : {"precision", "geometry", "sampling"}) {
    EXPECT_TRUE(plan.at(key).contains("choice")) << key;
    EXPECT_TRUE(plan.at(key).at("reason").is_string()) << key;
  }
  EXPECT_GT(plan.at("prediction").at("trace_ms"), 0);
  EXPECT_GE(plan.at("prediction").at("build_ms"), 0);
  EXPECT_GT(plan.at("prediction").at("error"), 0);
}

TEST_F(PlanRoute, names_the_instruction_set_that_version_names) {
  EXPECT_EQ(plan_of(small_scene).at("instruction_set").at("choice"),
            json_of(get("/version")).at("instruction_set"));
}

TEST_F(PlanRoute, query_stands_over_the_document) {
  const nlohmann::json plan =
      plan_of(small_scene, "?samples=9&precision=double&width=300&height=200");
  EXPECT_EQ(plan.at("sampling").at("choice"), 9);
  EXPECT_EQ(plan.at("prediction").at("samples"), 9);
  EXPECT_EQ(plan.at("precision").at("choice"), "double");
}

TEST_F(PlanRoute, is_of_a_shipped_scene_by_name) {
  const Answer answer = request("POST", "/plan?scene=demo&origin=0,3,-30");
  EXPECT_EQ(answer.status, 200) << answer.body;
  EXPECT_EQ(json_of(answer).at("features").at("objects").at("sphere_squares"), 1);
}

TEST_F(PlanRoute, precision_is_the_one_that_a_render_takes) {
  std::set<std::string> choices;
  for (const char* const scene : {"demo", "mesh", "mirrors", "glass"}) {
    const std::string query = std::string("?width=40&height=30&samples=1&scene=") + scene;
    const std::string choice = json_of(request("POST", "/plan" + query))["precision"]["choice"];
    choices.insert(choice);
    // What is single for the most part is called so.
    EXPECT_EQ(get("/render" + query).get_header_value("Render-Precision"),
              choice == "mixed" ? "single" : choice);
  }
  EXPECT_TRUE(choices.contains("mixed"));
}

TEST_F(PlanRoute, is_not_to_be_stored) {
  const Answer answer = post("/plan", small_scene);
  EXPECT_EQ(answer.get_header_value("Cache-Control"), "no-store");
  EXPECT_FALSE(answer.has_header("ETag"));
}

TEST_F(PlanRoute, of_an_endless_render_is_soon_there) {
  const nlohmann::json plan = plan_of(endless_scene());
  EXPECT_GT(plan.at("prediction").at("trace_ms"), 5000);
}

TEST_F(PlanRoute, wrong_scenes_and_queries_are_refused_as_by_render) {
  expect_problem(post("/plan", "{"), 400, "line 1");
  const Answer wrong = post("/plan", R"({"camera": {}, "objcets": []})");
  expect_problem(wrong, 422, "");
  EXPECT_EQ(errors_of(wrong), errors_of(post("/render", R"({"camera": {}, "objcets": []})")));
  expect_problem(post("/plan?width=0", small_scene), 422, "/camera/width");
  expect_problem(post("/plan?samples=many", small_scene), 400, "\"samples\"");
  expect_problem(post("/plan?task=render", small_scene), 400, "\"task\"");
  expect_problem(post("/plan?width=99999&height=99999", small_scene), 413, "--max-pixels");
  expect_problem(request("POST", "/plan?scene=dmo"), 404, "\"demo\"");
  expect_problem(request("POST", "/plan", {{"Content-Type", "text/plain"}}, small_scene), 415,
                 "application/json");
}

TEST_F(PlanRoute, other_methods_are_405) {
  const Answer answer = get("/plan");
  EXPECT_EQ(answer.status, 405);
  EXPECT_EQ(answer.get_header_value("Allow"), "POST");
}

}  // namespace
}  // namespace raytracer::test
