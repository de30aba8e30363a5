// POST /scenes: a scene that is sent and read once, and looked at often.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "tests/service/documents.h"
#include "tests/service/server_timing.h"
#include "tests/service/service.h"

namespace raytracer::test {
namespace {

class KeptScenes : public Service {
 protected:
  static std::string keep(const std::string& document) {
    const Answer answer = post("/scenes", document);
    EXPECT_EQ(answer.status, 201) << answer.body;
    return json_of(answer).value("id", "");
  }
};

/// Thousands of small spheres in one object, each document with another picture.
std::string crowd(int count, int number) {
  std::string text = fmt::format(
      R"({{"ambient": {}, "camera": {{"origin": [0, 0, -5], "look_at": [0, 0, 0], "fov": 0.5,
          "width": 12, "height": 8}},
          "objects": [{{"type": "spheres", "radius": 0.01, "centers": [[0, 0, 0])",
      number);
  for (int i = 1; i < count; ++i)
    fmt::format_to(std::back_inserter(text), ",[{},{},{}]", i % 100 * 0.05 - 2.5,
                   std::floor(i * 0.01) * 0.05 - 2.5, i % 7);
  return text + "]}]}";
}

TEST_F(KeptScenes, posted_scene_says_where_it_is_and_what_it_holds) {
  const Answer answer = post("/scenes", small_scene);
  ASSERT_EQ(answer.status, 201) << answer.body;
  EXPECT_EQ(answer.get_header_value("Content-Type"), json_type);
  const nlohmann::json kept = json_of(answer);
  const std::string id = kept.at("id");
  EXPECT_TRUE(std::regex_match(id, std::regex("[0-9a-f]{32}"))) << id;
  EXPECT_EQ(answer.get_header_value("Location"), "/scenes/" + id);
  EXPECT_EQ(kept.at("objects"), 1);
  EXPECT_EQ(kept.at("lights"), 1);
  EXPECT_EQ(kept.at("width"), 12);
  EXPECT_EQ(kept.at("height"), 8);
  EXPECT_GT(kept.at("bytes"), small_scene.size());
  EXPECT_EQ(get(kept.at("render")).status, 200);
}

TEST_F(KeptScenes, id_is_the_contents) {
  const std::string id = keep(small_scene);
  EXPECT_EQ(keep(small_scene), id);
  EXPECT_EQ(keep(" \n" + small_scene), id) << "white space means nothing";
  const std::string named = R"({"name": "a \" b", )" + small_scene.substr(1);
  const std::string other_name = R"({"name": "a \"b", )" + small_scene.substr(1);
  EXPECT_NE(keep(named), id);
  EXPECT_NE(keep(named), keep(other_name)) << "but in a string it does";
  EXPECT_NE(keep(as_another_picture(small_scene, 1)), id);
  std::string other_view = small_scene;
  other_view.replace(other_view.find("\"width\": 12"), 11, "\"width\": 13");
  EXPECT_NE(keep(other_view), id);
  const ServerProcess another;
  EXPECT_EQ(json_of(test::post(another, "/scenes", small_scene)).at("id"), id);
}

TEST_F(KeptScenes, document_is_given_as_it_was_posted) {
  const std::string path = "/scenes/" + keep(small_scene);
  EXPECT_EQ(get(path).body, small_scene);
  EXPECT_EQ(get(path).get_header_value("Content-Type"), json_type);
  const std::string with_name = R"({"name": "mine", )" + small_scene.substr(1);
  EXPECT_EQ(get("/scenes/" + keep(with_name)).body, with_name);
  EXPECT_EQ(get(path).body, small_scene) << "what others post of the same picture changes nothing";
}

TEST_F(KeptScenes, view_in_the_query_is_that_of_a_document) {
  std::string document = small_scene;
  document.replace(document.find("\"origin\": [0, 0, -5]"), 20, "\"origin\": [1, 2, -4]");
  document.replace(document.find("\"width\": 12"), 11, "\"width\": 30");
  const Answer posted = post("/render", document);
  const std::string target = "/render?scene=" + keep(small_scene) +
                             "&origin=1,2,-4&look_at=0,0,0&up=0,1,0&fov=0.9&width=30&height=8";
  for (const std::string method : {"GET", "POST"}) {
    const Answer view = request(method, target, without_cache);
    ASSERT_EQ(view.status, 200) << view.body;
    EXPECT_EQ(view.body, posted.body);
    EXPECT_EQ(view.get_header_value("ETag"), posted.get_header_value("ETag"));
  }
  EXPECT_NE(get("/render?scene=" + keep(small_scene)).body, posted.body)
      << "a view changes the kept scene";
}

TEST_F(KeptScenes, plan_and_jobs_take_it_too) {
  const std::string id = keep(small_scene);
  EXPECT_EQ(request("POST", "/plan?scene=" + id).status, 200);
  EXPECT_EQ(request("POST", "/jobs?fov=0.4&scene=" + id).status, 202);
  EXPECT_EQ(request("HEAD", "/render?scene=" + id).status, 200);
}

TEST_F(KeptScenes, unknown_id_says_to_post_it_again) {
  const std::string id(32, 'a');
  for (const std::string path : {"/render?scene=", "/scenes/"})
    expect_problem(get(path + id), 404, "POST it to /scenes again");
  for (const std::string path : {"/render?scene=", "/plan?scene=", "/jobs?scene="})
    expect_problem(request("POST", path + id), 404, "POST it to /scenes again");
}

TEST_F(KeptScenes, wrong_document_is_refused_as_everywhere) {
  expect_problem(post("/scenes", "{"), 400, "line 1");
  const Answer wrong = post("/scenes", R"({"objects": 7})");
  expect_problem(wrong, 422, "2 errors");
  EXPECT_NE(errors_of(wrong).find("/camera"), std::string::npos);
  EXPECT_FALSE(wrong.has_header("Location"));
  expect_problem(post("/scenes", square_scene(5000, 1)), 413, "--max-pixels");
  expect_problem(post("/scenes", small_scene, {{"Content-Type", "text/plain"}}), 415, "json");
  expect_problem(post("/scenes?width=3", small_scene), 400, "query");
}

TEST_F(KeptScenes, view_is_judged_as_a_document_is) {
  const std::string id = keep(small_scene);
  expect_problem(get("/render?width=5000&height=5000&scene=" + id), 413, "--max-pixels");
  expect_problem(get("/render?origin=0,0,0&scene=" + id), 422, "/camera/look_at");
  expect_problem(get("/render?fov=0&scene=" + id), 422, "/camera/fov");
}

TEST_F(KeptScenes, least_recently_used_one_goes_when_the_memory_is_full) {
  const std::size_t bytes = json_of(post("/scenes", crowd(1000, 0))).at("bytes");
  const ServerProcess two({"--max-kept", std::to_string(2 * bytes + bytes / 2)});
  std::vector<std::string> targets;
  const auto post_one = [&](int number) {
    const Answer answer = test::post(two, "/scenes", crowd(1000, number));
    ASSERT_EQ(answer.status, 201) << answer.body;
    targets.push_back(json_of(answer).at("render"));
  };
  post_one(0);
  post_one(1);
  EXPECT_EQ(test::get(two, targets[0]).status, 200);
  post_one(2);
  EXPECT_EQ(test::get(two, targets[0]).status, 200) << "it was used";
  EXPECT_EQ(test::get(two, targets[1]).status, 404) << "it was used less recently";
  EXPECT_EQ(test::get(two, targets[2]).status, 200);
  post_one(1);
  EXPECT_EQ(test::get(two, targets[1]).status, 200) << "it was posted again";
}

TEST_F(KeptScenes, scene_beyond_the_whole_memory_is_refused) {
  const ServerProcess small({"--max-kept", "5000"});
  expect_problem(test::post(small, "/scenes", crowd(1000, 0)), 413, "--max-kept");
  EXPECT_EQ(test::post(small, "/scenes", small_scene).status, 201);
  EXPECT_EQ(test::post(small, "/render", crowd(1000, 0)).status, 200);
}

TEST_F(KeptScenes, view_of_a_large_scene_does_not_read_it) {
  const std::string document = crowd(200'000, 0);
  const ServerProcess fresh;
  const double reading_ms = stage_ms(test::post(fresh, "/render", document), "parse");
  const Answer kept = test::post(fresh, "/scenes", document);
  const std::string target = json_of(kept).at("render");
  for (const char* const view : {"&width=13", "&origin=1,0,-5"}) {
    const Answer answer = test::get(fresh, target + view);
    ASSERT_EQ(answer.status, 200) << answer.body;
    EXPECT_LT(stage_ms(answer, "parse"), reading_ms / 20);
  }
}

TEST_F(KeptScenes, body_that_came_before_is_not_read_again) {
  const std::string document = crowd(200'000, 0);
  const ServerProcess fresh;
  const double reading_ms = stage_ms(test::post(fresh, "/render", document), "parse");
  double least_ms = reading_ms;  // other programs may hold up one of them
  for (const char* query : {"?width=13", "?width=14", "?width=15"})
    least_ms = std::min(
        least_ms, stage_ms(test::post(fresh, "/render" + std::string(query), document), "parse"));
  EXPECT_LT(least_ms, reading_ms / 2);
  EXPECT_EQ(test::post(fresh, "/render?width=16", document).body,
            test::post(ServerProcess(), "/render?width=16", document).body);
}

TEST_F(KeptScenes, short_bodies_are_not_remembered) {
  const ServerProcess fresh;
  const auto remembered = [&] {
    const std::string metrics = test::get(fresh, "/metrics").body;
    const std::string name = R"(raytracer_cache_entries{cache="read_scenes"} )";
    return std::stoi(metrics.substr(metrics.find(name) + name.size()));
  };
  for (int number = 0; number < 3; ++number)
    EXPECT_EQ(test::post(fresh, "/render", as_another_picture(small_scene, number)).status, 200);
  EXPECT_EQ(remembered(), 0);
  EXPECT_EQ(test::post(fresh, "/render", crowd(1'000, 0)).status, 200);
  EXPECT_EQ(remembered(), 1);
}

TEST_F(KeptScenes, limit_is_listed) {
  const ServerProcess limited({"--max-kept", "123456", "--max-cache", "7890"});
  const std::string version = json_of(test::get(limited, "/version")).at("limits").dump();
  EXPECT_NE(version.find(R"("flag":"--max-kept")"), std::string::npos) << version;
  EXPECT_NE(version.find(R"("value":123456)"), std::string::npos) << version;
  EXPECT_NE(version.find(R"("value":7890)"), std::string::npos) << version;
}

}  // namespace
}  // namespace raytracer::test
