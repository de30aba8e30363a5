// What the server says about itself: scenes, health, version, schema, page.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/process/patience.h"
#include "tests/process/temporary_folder.h"
#include "tests/service/documents.h"
#include "tests/service/service.h"

namespace raytracer::test {
namespace {

namespace fs = std::filesystem;

class Information : public Service {};

TEST_F(Information, health_and_readiness_are_ok) {
  for (const char* const path : {"/healthz", "/readyz"}) {
    const Answer answer = get(path);
    EXPECT_EQ(answer.status, 200);
    EXPECT_EQ(answer.get_header_value("Content-Type"), json_type);
    EXPECT_EQ(answer.body, R"({"status":"ok"})");
  }
}

TEST_F(Information, scenes_are_listed_with_a_line_about_each) {
  const Answer answer = get("/scenes");
  ASSERT_EQ(answer.status, 200);
  const nlohmann::json list = json_of(answer);
  std::set<std::string> listed;
  for (const nlohmann::json& scene : list.at("scenes")) {
    listed.insert(scene.at("name"));
    const std::string description = scene.at("description");
    EXPECT_FALSE(description.empty());
    EXPECT_EQ(description.find('\n'), std::string::npos);
  }
  std::set<std::string> shipped;
  for (const auto& entry : fs::directory_iterator(RAYTRACER_SOURCE_DIR "/server/scenes"))
    shipped.insert(entry.path().stem().string());
  EXPECT_EQ(listed, shipped);
}

TEST_F(Information, scene_is_given_as_it_was_written) {
  const Answer answer = get("/scenes/demo");
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(answer.get_header_value("Content-Type"), json_type);
  EXPECT_EQ(answer.body, read_file(RAYTRACER_SOURCE_DIR "/server/scenes/demo.json"));
}

TEST_F(Information, every_listed_scene_is_valid_and_can_be_drawn) {
  const nlohmann::json list = json_of(get("/scenes"));
  EXPECT_FALSE(list.at("scenes").empty());
  for (const nlohmann::json& scene : list.at("scenes")) {
    const std::string name = scene.at("name");
    const Answer answer = get("/render?width=32&height=24&samples=1&scene=" + name);
    EXPECT_EQ(answer.status, 200) << name << ": " << answer.body;
  }
}

TEST_F(Information, version_says_build_instruction_set_threads_and_limits) {
  const ServerProcess limited({"--threads", "3", "--max-pixels", "12345", "--max-queue", "7"});
  const nlohmann::json version = json_of(test::get(limited, "/version"));
  EXPECT_TRUE(version.at("version").is_string());
  EXPECT_FALSE(version.at("build_id").get<std::string>().empty());
  EXPECT_FALSE(version.at("instruction_set").get<std::string>().empty());
  EXPECT_EQ(version.at("threads"), 3);
  std::map<std::string, std::int64_t> values;
  for (const nlohmann::json& limit : version.at("limits")) {
    values[limit.at("flag")] = limit.at("value");
  }
  EXPECT_EQ(values["--max-pixels"], 12345);
  EXPECT_EQ(values["--max-queue"], 7);
  for (const char* const flag :
       {"--max-body", "--max-objects", "--max-lights", "--max-samples", "--max-work"})
    EXPECT_TRUE(values.contains(flag)) << flag;
}

TEST_F(Information, schema_is_json_schema_2020_12) {
  const Answer answer = get("/schema/scene.json");
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(answer.get_header_value("Content-Type"), "application/schema+json");
  EXPECT_EQ(json_of(answer).at("$schema"), "https://json-schema.org/draft/2020-12/schema");
}

TEST_F(Information, page_and_all_that_it_refers_to_is_served) {
  const Answer page = get("/");
  EXPECT_EQ(page.status, 200);
  EXPECT_EQ(page.get_header_value("Content-Type"), "text/html; charset=utf-8");
  EXPECT_EQ(get("/index.html").body, page.body);
  static const std::regex reference(R"re((?:href|src)="([^"#:]+)")re");
  int count = 0;
  for (std::sregex_iterator match(page.body.begin(), page.body.end(), reference), end; match != end;
       ++match, ++count) {
    const std::string path = fmt::format("/{}", match->str(1));
    EXPECT_EQ(get(path).status, 200) << path;
  }
  EXPECT_GT(count, 0);
}

TEST_F(Information, files_of_the_page_have_their_types) {
  const std::vector<std::pair<std::string, std::string>> types{
      {".js", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".svg", "image/svg+xml"}};
  const fs::path web = RAYTRACER_SOURCE_DIR "/web";
  for (const auto& entry : fs::recursive_directory_iterator(web)) {
    if (!entry.is_regular_file() || entry.path().extension() == ".md") continue;
    const std::string path = fmt::format("/{}", fs::relative(entry.path(), web).generic_string());
    const Answer answer = get(path);
    EXPECT_EQ(answer.status, 200) << path;
    EXPECT_EQ(answer.body, read_file(entry.path())) << path;
    EXPECT_EQ(answer.get_header_value("X-Content-Type-Options"), "nosniff");
    for (const auto& [ending, type] : types) {
      if (!path.ends_with(ending)) continue;
      EXPECT_EQ(answer.get_header_value("Content-Type"), type) << path;
    }
  }
}

TEST_F(Information, files_of_the_page_are_sent_once) {
  std::set<std::string> tags;
  for (const char* const path : {"/", "/main.js", "/style.css"}) {
    const Answer first = get(path);
    const std::string tag = first.get_header_value("ETag");
    tags.insert(tag);
    EXPECT_EQ(first.get_header_value("Cache-Control"), "no-cache");
    const Answer again = get(path, {{"If-None-Match", tag}});
    EXPECT_EQ(again.status, 304) << path;
    EXPECT_EQ(again.body, "");
    for (const char* const field : {"ETag", "Cache-Control", "Vary"})
      EXPECT_EQ(again.get_header_value(field), first.get_header_value(field)) << field;
    EXPECT_EQ(get(path, {{"If-None-Match", "\"other\""}}).body, first.body);
  }
  EXPECT_EQ(tags.size(), 3U);
}

TEST_F(Information, head_is_get_without_a_body) {
  for (const char* const path : {"/", "/healthz", "/scenes", "/version"}) {
    const Answer head = request("HEAD", path);
    EXPECT_EQ(head.status, 200) << path;
    EXPECT_EQ(head.body, "");
    EXPECT_EQ(head.get_header_value("Content-Type"), get(path).get_header_value("Content-Type"));
  }
}

}  // namespace
}  // namespace raytracer::test
