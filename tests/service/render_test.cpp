// POST /render and GET /render: the picture and what its header fields say.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <regex>
#include <string>

#include "tests/golden/picture.h"
#include "tests/service/documents.h"
#include "tests/service/service.h"

namespace raytracer::test {
namespace {

class Render : public Service {};

/// Server-Timing as metric -> milliseconds.
std::map<std::string, double> stages_of(const Answer& answer) {
  static const std::regex metric(R"(([\w-]+);dur=(\d+(?:\.\d+)?)(?:, |$))");
  const std::string field = answer.get_header_value("Server-Timing");
  std::map<std::string, double> stages;
  std::size_t length = 0;
  for (std::sregex_iterator match(field.begin(), field.end(), metric), end; match != end; ++match) {
    stages[match->str(1)] = std::stod(match->str(2));
    length += static_cast<std::size_t>(match->length());
  }
  EXPECT_EQ(length, field.size()) << "not a list of metric;dur=NUMBER: " << field;
  return stages;
}

TEST_F(Render, posted_scene_becomes_its_picture) {
  const Answer answer = post("/render", small_scene);
  ASSERT_EQ(answer.status, 200) << answer.body;
  EXPECT_EQ(answer.get_header_value("Content-Type"), png_type);
  const Picture picture = decode_png(answer.body);
  ASSERT_EQ(picture.width, 12);
  ASSERT_EQ(picture.height, 8);
  // The corner is background, the middle a red sphere.
  EXPECT_EQ(picture.rgb[0], 26);   // floor(255 * 0.1 + 1/2)
  EXPECT_EQ(picture.rgb[1], 51);   // floor(255 * 0.2 + 1/2)
  EXPECT_EQ(picture.rgb[2], 204);  // floor(255 * 0.8 + 1/2)
  constexpr std::size_t middle = 3UL * (4 * 12 + 6);
  EXPECT_GT(picture.rgb[middle], 2 * picture.rgb[middle + 2]);
}

TEST_F(Render, shipped_scene_is_rendered_by_name) {
  const Answer by_name = get("/render?scene=first-sphere");
  ASSERT_EQ(by_name.status, 200) << by_name.body;
  const Answer by_document = post("/render", get("/scenes/first-sphere").body, without_cache);
  EXPECT_EQ(by_name.body, by_document.body);
  EXPECT_EQ(by_name.get_header_value("ETag"), by_document.get_header_value("ETag"));
}

TEST_F(Render, posted_query_names_a_shipped_scene_without_a_body) {
  const Answer answer = request("POST", "/render?scene=first-sphere&width=20&height=10&samples=1");
  ASSERT_EQ(answer.status, 200) << answer.body;
  EXPECT_EQ(decode_png(answer.body).width, 20);
}

TEST_F(Render, answer_carries_every_stage_in_milliseconds) {
  const auto begin = std::chrono::steady_clock::now();
  const auto stages = stages_of(post("/render", square_scene(100, 4)));
  const std::chrono::duration<double, std::milli> passed = std::chrono::steady_clock::now() - begin;
  double sum = 0;
  for (const char* const stage : {"queue", "parse", "plan", "build", "trace", "encode"}) {
    ASSERT_TRUE(stages.contains(stage)) << stage;
    sum += stages.at(stage);
  }
  EXPECT_GT(stages.at("trace"), 0);
  EXPECT_GT(stages.at("parse"), 0);
  EXPECT_LE(sum, passed.count()) << "the stages take longer than the request that they are part of";
}

TEST_F(Render, answer_says_samples_precision_and_what_ended_it) {
  const Answer answer = post("/render?samples=3", small_scene);
  EXPECT_EQ(std::stod(answer.get_header_value("Render-Samples")), 3);
  EXPECT_EQ(answer.get_header_value("Render-Stop"), "samples");
  static const std::regex precision("single|double");
  EXPECT_TRUE(std::regex_match(answer.get_header_value("Render-Precision"), precision));
}

TEST_F(Render, answer_says_how_many_places_of_soft_lights_it_sampled) {
  EXPECT_FALSE(post("/render", small_scene).has_header("Render-Light-Samples"));
  nlohmann::json scene = nlohmann::json::parse(small_scene);
  scene["lights"] = {{{"type", "sky"}}};
  for (const char* const bound : {"samples=1", "samples=7", "samples=64", "target_rmse=0.02"}) {
    const Answer answer = post(std::string("/render?") + bound, scene.dump());
    EXPECT_GE(std::stoi(answer.get_header_value("Render-Light-Samples")), 64) << bound;
  }
  const auto plan = nlohmann::json::parse(post("/plan", scene.dump()).body);
  EXPECT_GE(plan["light_samples"]["choice"], 64);
}

TEST_F(Render, wanted_double_precision_is_used) {
  const Answer answer = post("/render?precision=double", small_scene);
  EXPECT_EQ(answer.get_header_value("Render-Precision"), "double");
}

TEST_F(Render, error_is_told_for_every_number_of_samples) {
  for (const char* query : {"", "?samples=1", "?samples=3", "?samples=4", "?samples=16"}) {
    const Answer answer = post(std::string("/render") + query, small_scene);
    ASSERT_TRUE(answer.has_header("Render-Error")) << query;
    const double error = std::stod(answer.get_header_value("Render-Error"));
    EXPECT_GT(error, 0) << query;
    EXPECT_LT(error, 0.5) << query;
  }
}

TEST_F(Render, accuracy_contract_ends_by_its_target) {
  const Answer answer = post("/render?target_rmse=0.2", small_scene);
  ASSERT_EQ(answer.status, 200) << answer.body;
  EXPECT_EQ(answer.get_header_value("Render-Stop"), "target");
  ASSERT_TRUE(answer.has_header("Render-Error"));
  const double error = std::stod(answer.get_header_value("Render-Error"));
  EXPECT_LE(error, 0.2);
  EXPECT_GT(error, 0);
}

TEST_F(Render, time_contract_ends_by_its_budget_and_is_not_stored) {
  const Answer answer = post("/render?budget_ms=20", square_scene(300, 1));
  ASSERT_EQ(answer.status, 200) << answer.body;
  EXPECT_EQ(answer.get_header_value("Render-Stop"), "budget");
  // How far it came differs from run to run, so that the tag names these bytes alone.
  EXPECT_TRUE(answer.has_header("ETag"));
  EXPECT_EQ(answer.get_header_value("Cache-Control"), "no-store");
}

TEST_F(Render, shortest_time_contract_is_a_coarse_picture_with_its_error) {
  const Answer answer = post("/render?budget_ms=0.000001", square_scene(300, 1));
  ASSERT_EQ(answer.status, 200) << answer.body;
  EXPECT_EQ(answer.get_header_value("Render-Stop"), "budget");
  const double samples = std::stod(answer.get_header_value("Render-Samples"));
  EXPECT_GE(samples, 1.0 / 1024);  // a subtile in each square of 128 x 128
  EXPECT_LT(samples, 1);
  ASSERT_TRUE(answer.has_header("Render-Error"));
  EXPECT_GT(std::stod(answer.get_header_value("Render-Error")), 0.01);
}

TEST_F(Render, same_document_gives_the_same_bytes_whatever_the_threads) {
  const std::string reference = post("/render", square_scene(90, 3)).body;
  EXPECT_EQ(post("/render", square_scene(90, 3), without_cache).body, reference);
  for (const char* const threads : {"1", "3", "7"}) {
    const ServerProcess other({"--threads", threads});
    EXPECT_EQ(test::post(other, "/render", square_scene(90, 3)).body, reference) << threads;
  }
}

TEST_F(Render, head_has_the_fields_of_get_and_no_body) {
  const Answer head = request("HEAD", "/render?scene=first-sphere");
  EXPECT_EQ(head.status, 200);
  EXPECT_EQ(head.body, "");
  EXPECT_EQ(head.get_header_value("Content-Type"), png_type);
  EXPECT_EQ(head.get_header_value("ETag"),
            get("/render?scene=first-sphere").get_header_value("ETag"));
}

TEST_F(Render, connection_serves_several_requests) {
  httplib::Client client = server().client();
  client.set_keep_alive(true);
  for (int i = 0; i < 5; ++i) {
    const auto answer = client.Post("/render", small_scene, "application/json");
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->status, 200);
  }
}

}  // namespace
}  // namespace raytracer::test
