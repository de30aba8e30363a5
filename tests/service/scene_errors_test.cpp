// What is wrong with a posted document: everything at once, each with its place.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "tests/service/documents.h"
#include "tests/service/service.h"

namespace raytracer::test {
namespace {

class SceneErrors : public Service {};

TEST_F(SceneErrors, typo_radius_and_material_are_reported_together) {
  const Answer answer = post("/render", R"({
    "camera": {"origin": [0, 0, -5], "look_at": [0, 0, 0], "fov": 1, "width": 70, "height": 50},
    "backgruond": [0, 0, 0],
    "materials": {"red": {"color": [1, 0, 0]}},
    "objects": [{"type": "sphere", "center": [0, 0, 0], "radius": 1, "material": "red"},
                {"type": "sphere", "center": [0, 0, 0], "radius": -1},
                {"type": "sphere", "center": [0, 0, 0], "radius": 1, "material": "rad"}]
  })");
  expect_problem(answer, 422, "3 errors");
  const nlohmann::json errors = json_of(answer).at("errors");
  ASSERT_EQ(errors.size(), 3U) << errors_of(answer);
  const std::string lines = errors_of(answer);
  EXPECT_NE(lines.find("/backgruond unknown key \"backgruond\"; did you mean \"background\"?"),
            std::string::npos)
      << lines;
  EXPECT_NE(lines.find("/objects/1/radius "), std::string::npos) << lines;
  EXPECT_NE(lines.find("/objects/2/material "), std::string::npos) << lines;
  EXPECT_NE(lines.find("\"red\"?"), std::string::npos) << lines;
}

TEST_F(SceneErrors, wrong_keys_are_told_from_wrong_values) {
  const Answer answer = post("/render", R"({"ambient": 1, "ambient": 1, "shadow": "off",
    "objects": 7, "camera": {"origin": [0, 0, -5], "look_at": [0, 0, 0], "fov": 1, "width": 70,
    "height": 50}})");
  const nlohmann::json errors = json_of(answer).at("errors");
  std::map<std::string, std::string> about;
  for (const nlohmann::json& error : errors)
    about[error.at("pointer")] = error.value("about", "value");
  EXPECT_EQ(about, (std::map<std::string, std::string>{
                       {"/ambient", "key"}, {"/shadow", "key"}, {"/objects", "value"}}));
}

TEST_F(SceneErrors, text_that_is_not_json_is_400_with_line_and_column) {
  const Answer answer = post("/render", "{\n  \"camera\": {\n    \"fov\" 1\n  }\n}");
  expect_problem(answer, 400, "line 3, column 11: ");
  const nlohmann::json error = json_of(answer).at("errors").at(0);
  EXPECT_EQ(error.value("line", 0), 3);
  EXPECT_EQ(error.value("column", 0), 11);
  EXPECT_EQ(error.value("detail", ""),
            "not JSON: line 3, column 11: " + error.value("reason", "?"));
  EXPECT_EQ(errors_of(answer).find("/camera"), std::string::npos);
}

TEST_F(SceneErrors, empty_and_cut_off_bodies_are_400) {
  expect_problem(post("/render", " "), 400, "line 1");
  expect_problem(post("/render", small_scene.substr(0, 60)), 400, "line");
  expect_problem(post("/render", ""), 400, "line 1");
}

TEST_F(SceneErrors, two_documents_in_one_body_are_400) {
  expect_problem(post("/render", small_scene + small_scene), 400, "line 7, column 2");
}

TEST_F(SceneErrors, other_json_values_are_422) {
  for (const char* const text : {"null", "true", "7", "\"scene\"", "[]"})
    expect_problem(post("/render", text), 422, "object");
}

TEST_F(SceneErrors, nesting_bomb_is_refused) {
  for (const std::size_t depth : {1000U, 200'000U}) {
    const Answer answer = post("/render", std::string(depth, '[') + std::string(depth, ']'));
    EXPECT_EQ(answer.status, 422) << answer.body.substr(0, 300);
    EXPECT_EQ(post("/render", std::string(depth, '[')).status, 422);
  }
  EXPECT_EQ(get("/healthz").status, 200);
}

TEST_F(SceneErrors, numbers_beyond_doubles_are_422_with_their_place) {
  std::string huge = small_scene;
  huge.replace(huge.find("\"radius\": 1"), 11, "\"radius\": 1e400");
  const Answer answer = post("/render", huge);
  expect_problem(answer, 422, "1e400");
  EXPECT_EQ(errors_of(answer).rfind("/objects/0/radius ", 0), 0U) << errors_of(answer);
}

TEST_F(SceneErrors, duplicate_key_is_422) {
  const Answer answer = post("/render", "{\"ambient\": 1, \"ambient\": 1," + small_scene.substr(1));
  expect_problem(answer, 422, "twice");
  EXPECT_EQ(errors_of(answer).rfind("/ambient ", 0), 0U) << errors_of(answer);
}

TEST_F(SceneErrors, wrong_scene_beyond_a_limit_is_422) {
  std::string both = small_scene;
  both.replace(both.find("\"radius\": 1"), 11, "\"radius\": 0");
  const Answer answer = post("/render?width=5000&height=5000", both);
  expect_problem(answer, 422, "2 errors");
  EXPECT_NE(errors_of(answer).find("--max-pixels"), std::string::npos) << errors_of(answer);
}

TEST_F(SceneErrors, thousands_of_errors_are_one_answer) {
  std::string document = small_scene.substr(0, small_scene.rfind("{\"type\""));
  for (int i = 0; i < 5000; ++i) document += "{\"type\": \"sphere\"},";
  document.back() = ']';
  const Answer answer = post("/render", document + "}");
  expect_problem(answer, 422, "many errors");
  EXPECT_LT(answer.body.size(), 2'000'000U);
  EXPECT_NE(errors_of(answer).find("/objects/0/center "), std::string::npos);
}

TEST_F(SceneErrors, valid_scene_is_rendered_after_all_of_them) {
  EXPECT_EQ(post("/render", small_scene).status, 200);
}

}  // namespace
}  // namespace raytracer::test
