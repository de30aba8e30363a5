// Entity tags: strong, of what the picture is, not of how it was asked for.
#include <gtest/gtest.h>

#include <regex>
#include <string>

#include "tests/process/patience.h"
#include "tests/service/documents.h"
#include "tests/service/service.h"

namespace raytracer::test {
namespace {

class Caching : public Service {
 protected:
  static std::string tag_of(const std::string& document, const std::string& query = "",
                            const Headers& headers = {}) {
    const Answer answer = post("/render" + query, document, headers);
    EXPECT_EQ(answer.status, 200) << answer.body;
    return answer.get_header_value("ETag");
  }
};

/// small_scene with other white space, key order, notations, names, and its defaults spelled out.
const std::string same_picture =
    R"({"objects":[{"radius":1.0,"material":{"ka":1,"kd":0.70,"ks":3e-1,
  "shininess":50,"reflectivity":0,"color":[0.9,0.1,0.1]},"center":[0,0,0],"type":"sphere"}],
  "lights":[{"direction":[-1,-1,2.0],"type":"distant","color":"#ffffff","intensity":1}],
  "background":[0.1,0.2,0.8],"ambient":0.2,"shadows":"black","name":"another","materials":{},
  "camera":{"height":8,"width":12,"fov":0.9,"look_at":[0,0,0],"origin":[0,0,-5],"up":[0,1,0]},
  "render":{"samples":1,"max_depth":5,"precision":"auto","transfer":"linear"}})";

TEST_F(Caching, tag_is_strong) {
  static const std::regex strong(R"("[\x21\x23-\x7e]+")");
  EXPECT_TRUE(std::regex_match(tag_of(small_scene), strong)) << tag_of(small_scene);
}

TEST_F(Caching, tag_is_one_for_all_notations_of_a_picture) {
  EXPECT_EQ(tag_of(same_picture), tag_of(small_scene));
  EXPECT_EQ(post("/render", same_picture, without_cache).body,
            post("/render", small_scene, without_cache).body);
}

TEST_F(Caching, tag_outlives_the_server) {
  const ServerProcess another({"--threads", "1"});
  EXPECT_EQ(test::post(another, "/render", small_scene).get_header_value("ETag"),
            tag_of(small_scene));
}

TEST_F(Caching, tag_differs_where_the_picture_may) {
  const std::string tag = tag_of(small_scene);
  EXPECT_NE(tag_of(small_scene, "?width=13"), tag);
  EXPECT_NE(tag_of(small_scene, "?samples=2"), tag);
  EXPECT_NE(tag_of(small_scene, "?transfer=srgb"), tag);
  EXPECT_NE(tag_of(small_scene, "", {{"Accept", std::string(ppm_type)}}), tag);
  std::string other = small_scene;
  other.replace(other.find("\"radius\": 1"), 11, "\"radius\": 1.0000000000000002");
  EXPECT_NE(tag_of(other), tag);
}

TEST_F(Caching, override_equals_the_same_value_in_the_document) {
  std::string larger = small_scene;
  larger.replace(larger.find("\"width\": 12"), 11, "\"width\": 24");
  EXPECT_EQ(tag_of(small_scene, "?width=24"), tag_of(larger));
}

TEST_F(Caching, known_picture_is_not_sent_again) {
  const std::string tag = tag_of(small_scene);
  for (const std::string& known : {tag, "\"other\", " + tag, std::string("*"), "W/" + tag}) {
    const Answer answer = post("/render", small_scene, {{"If-None-Match", known}});
    EXPECT_EQ(answer.status, 304) << known;
    EXPECT_EQ(answer.body, "");
    EXPECT_EQ(answer.get_header_value("ETag"), tag);
    EXPECT_FALSE(answer.has_header("Server-Timing")) << "a 304 renders nothing";
  }
}

TEST_F(Caching, known_picture_is_not_rendered_again) {
  // Rendering this would take minutes.
  const auto answer = post("/render", endless_scene(), {{"If-None-Match", "*"}});
  EXPECT_EQ(answer.status, 304);
}

TEST_F(Caching, picture_without_a_tag_is_any_but_no_named_one) {
  const auto status_for = [](const char* known) {
    return post("/render?budget_ms=5", small_scene, {{"If-None-Match", known}}).status;
  };
  EXPECT_EQ(status_for("*"), 304);
  EXPECT_EQ(status_for("\"other\""), 200);
}

TEST_F(Caching, picture_under_a_time_budget_has_the_tag_of_its_bytes) {
  static const std::regex strong(R"("[\x21\x23-\x7e]+")");
  const Answer answer = post("/render?budget_ms=5", small_scene);
  ASSERT_EQ(answer.status, 200) << answer.body;
  const std::string tag = answer.get_header_value("ETag");
  EXPECT_TRUE(std::regex_match(tag, strong)) << tag;
  EXPECT_EQ(answer.get_header_value("Cache-Control"), "no-store") << "the next one is another";
  EXPECT_NE(tag_of(small_scene, "?budget_ms=5&width=13"), tag);
}

TEST_F(Caching, picture_of_a_job_under_a_time_budget_is_not_sent_again) {
  const std::string path =
      post("/jobs?budget_ms=5", small_scene).get_header_value("Location") + "/image";
  std::string tag;
  ASSERT_TRUE(eventually([&] { return !(tag = get(path).get_header_value("ETag")).empty(); }));
  EXPECT_EQ(get(path).get_header_value("ETag"), tag) << "it has the same bytes";
  const Answer known = get(path, {{"If-None-Match", tag}});
  EXPECT_EQ(known.status, 304);
  EXPECT_EQ(known.body, "");
  EXPECT_EQ(known.get_header_value("ETag"), tag);
  EXPECT_EQ(get(path, {{"If-None-Match", tag}, {"Cache-Control", "no-cache"}}).status, 200);
  EXPECT_EQ(get(path, {{"If-None-Match", "\"other\""}}).status, 200);
}

TEST_F(Caching, other_picture_is_sent) {
  const Answer answer = post("/render", small_scene, {{"If-None-Match", "\"other\""}});
  EXPECT_EQ(answer.status, 200);
  EXPECT_FALSE(answer.body.empty());
}

TEST_F(Caching, insisting_client_gets_it_anew) {
  const Answer answer =
      post("/render", small_scene,
           {{"If-None-Match", tag_of(small_scene)}, {"Cache-Control", "no-cache"}});
  EXPECT_EQ(answer.status, 200);
  EXPECT_TRUE(answer.has_header("Server-Timing"));
}

TEST_F(Caching, answers_vary_by_accept_and_are_asked_for_again) {
  const Answer answer = post("/render", small_scene);
  EXPECT_EQ(answer.get_header_value("Vary"), "Accept");
  EXPECT_EQ(answer.get_header_value("Cache-Control"), "no-cache");
}

}  // namespace
}  // namespace raytracer::test
