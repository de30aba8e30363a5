// /jobs: renders that are asked for now and fetched later.
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "tests/process/patience.h"
#include "tests/service/documents.h"
#include "tests/service/service.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

class Jobs : public Service {
 protected:
  /// The job's path, "/jobs/ID".
  static std::string start(const std::string& document, const std::string& query = "") {
    const Answer answer = post("/jobs" + query, document);
    EXPECT_EQ(answer.status, 202) << answer.body;
    return answer.get_header_value("Location");
  }
  static std::string status_of(const std::string& job) {
    return json_of(get(job)).value("status", "");
  }
  static bool becomes(const std::string& job, const std::string& status) {
    return eventually([&] { return status_of(job) == status; });
  }
};

TEST_F(Jobs, accepted_job_says_where_it_is) {
  const Answer answer = post("/jobs", small_scene);
  ASSERT_EQ(answer.status, 202) << answer.body;
  EXPECT_EQ(answer.get_header_value("Content-Type"), json_type);
  const nlohmann::json job = json_of(answer);
  EXPECT_EQ(answer.get_header_value("Location"), "/jobs/" + job.at("id").get<std::string>());
  EXPECT_EQ(job.at("task"), "render");
}

TEST_F(Jobs, done_job_has_all_its_fields) {
  const std::string path = start(small_scene, "?samples=3");
  ASSERT_TRUE(becomes(path, "done"));
  const nlohmann::json job = json_of(get(path));
  EXPECT_EQ("/jobs/" + job.at("id").get<std::string>(), path);
  EXPECT_EQ(job.at("task"), "render");
  EXPECT_EQ(job.at("progress"), 1);
  EXPECT_EQ(job.at("samples"), 3);
  EXPECT_TRUE(job.contains("error"));
  EXPECT_GT(job.at("elapsed_ms").get<double>(), 0);
}

TEST_F(Jobs, image_is_that_of_render) {
  const std::string path = start(small_scene, "?width=20");
  ASSERT_TRUE(becomes(path, "done"));
  for (const std::string_view type : {png_type, ppm_type, pfm_type}) {
    const Headers accept{{"Accept", std::string(type)}};
    const Answer image = get(path + "/image", accept);
    const Answer rendered = post("/render?width=20", small_scene, accept);
    EXPECT_EQ(image.status, 200);
    EXPECT_EQ(image.body, rendered.body) << type;
    EXPECT_EQ(image.get_header_value("Content-Type"), type);
    EXPECT_EQ(image.get_header_value("ETag"), rendered.get_header_value("ETag"));
    EXPECT_EQ(image.get_header_value("Render-Stop"), "samples");
    EXPECT_TRUE(image.has_header("Server-Timing"));
  }
  const std::string tag = get(path + "/image").get_header_value("ETag");
  EXPECT_EQ(get(path + "/image", {{"If-None-Match", tag}}).status, 304);
  expect_problem(get(path + "/image", {{"Accept", "text/html"}}), 406, "image/png");
}

TEST_F(Jobs, image_of_a_running_job_is_what_there_is_of_it) {
  const std::string path = start(endless_scene());
  ASSERT_TRUE(becomes(path, "running"));
  ASSERT_TRUE(eventually([&] { return json_of(get(path)).at("progress") > 0; }));
  const auto begin = std::chrono::steady_clock::now();
  const Answer image = get(path + "/image", {{"Accept", std::string(ppm_type)}});
  EXPECT_LT(std::chrono::steady_clock::now() - begin, patience(5s));
  ASSERT_EQ(image.status, 200) << image.body;
  EXPECT_EQ(image.body.substr(0, 2), "P6");
  EXPECT_FALSE(image.has_header("ETag"));
  EXPECT_EQ(image.get_header_value("Cache-Control"), "no-store");
  const auto black =
      static_cast<std::size_t>(std::count(image.body.begin() + 16, image.body.end(), '\0'));
  EXPECT_GT(black, image.body.size() / 4) << "it is done already";
  EXPECT_LT(black, image.body.size() - 100) << "nothing is seen of it";
  EXPECT_EQ(request("DELETE", path).status, 204);
}

TEST_F(Jobs, image_under_a_contract_is_the_last_whole_one) {
  const std::string path = start(endless_scene(), "?budget_ms=3000");
  ASSERT_TRUE(becomes(path, "running"));
  ASSERT_TRUE(eventually([&] { return get(path + "/image").status == 200; }));
  EXPECT_EQ(json_of(get(path)).at("status"), "running");
  EXPECT_EQ(request("DELETE", path).status, 204);
}

TEST_F(Jobs, progress_grows) {
  const std::string path = start(square_scene(600, 100));
  double last = 0;
  EXPECT_TRUE(eventually([&] {
    const double progress = json_of(get(path)).at("progress");
    EXPECT_GE(progress, last);
    EXPECT_LE(progress, 1);
    last = progress;
    return progress > 0.02;
  }));
  request("DELETE", path);
}

TEST_F(Jobs, deleted_job_stops_and_makes_room) {
  const ServerProcess full({"--threads", "1", "--max-queue", "0"});
  std::vector<std::string> paths;
  paths.reserve(4);
  for (int i = 0; i < 4; ++i)
    paths.push_back(test::post(full, "/jobs", endless_scene()).get_header_value("Location"));
  EXPECT_EQ(test::get(full, "/readyz").status, 503);
  EXPECT_EQ(test::post(full, "/jobs", small_scene).status, 429);
  for (const std::string& path : paths) {
    EXPECT_EQ(test::request(full, "DELETE", path).status, 204);
    EXPECT_EQ(test::get(full, path).status, 404);
  }
  EXPECT_TRUE(eventually([&] { return test::get(full, "/readyz").status == 200; }, 5s));
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(test::post(full, "/render", small_scene).status, 200);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, patience(5s));
}

TEST_F(Jobs, queued_job_can_be_deleted) {
  const ServerProcess busy({"--threads", "1", "--max-queue", "1"});
  for (int i = 0; i < 4; ++i) test::post(busy, "/jobs", endless_scene());
  const std::string queued = test::post(busy, "/jobs", small_scene).get_header_value("Location");
  EXPECT_EQ(json_of(test::get(busy, queued)).value("status", ""), "queued");
  EXPECT_EQ(test::post(busy, "/jobs", small_scene).status, 429);
  EXPECT_EQ(test::request(busy, "DELETE", queued).status, 204);
  EXPECT_EQ(test::post(busy, "/jobs", small_scene).status, 202);
}

TEST_F(Jobs, image_of_a_queued_job_is_black) {
  const ServerProcess busy({"--threads", "1"});
  const std::string query = "/jobs?width=200&height=150";
  // Memory that held a picture, and that of other requests, must not be seen in it.
  const std::string done = test::post(busy, query, small_scene).get_header_value("Location");
  ASSERT_TRUE(eventually([&] { return json_of(test::get(busy, done)).at("status") == "done"; }));
  EXPECT_EQ(test::request(busy, "DELETE", done).status, 204);
  for (int i = 0; i < 4; ++i) test::post(busy, "/jobs", endless_scene());
  const std::string queued = test::post(busy, query, small_scene).get_header_value("Location");
  for (int i = 0; i < 10; ++i) {
    const Answer image = test::get(busy, queued + "/image", {{"Accept", std::string(pfm_type)}});
    ASSERT_EQ(image.status, 200) << image.body;
    EXPECT_TRUE(image.body ==
                "PF\n200 150\n-1.0\n" + std::string(std::size_t{200} * 150 * 12, '\0'));
    EXPECT_FALSE(image.has_header("ETag"));
  }
}

TEST_F(Jobs, image_can_be_asked_for_at_any_moment) {
  for (int i = 0; i < 100; ++i) {
    const std::string path = start(small_scene, fmt::format("?width=20&max_depth={}", i % 50));
    EXPECT_EQ(get(path + "/image").status, 200);
  }
}

TEST_F(Jobs, unknown_job_is_404) {
  for (const char* const path : {"/jobs/1", "/jobs/1/image", "/jobs/%00"})
    expect_problem(get(path), 404, "job");
  expect_problem(request("DELETE", "/jobs/1"), 404, "job");
  const std::string path = start(small_scene);
  EXPECT_EQ(request("DELETE", path).status, 204);
  EXPECT_EQ(request("DELETE", path).status, 404);
}

TEST_F(Jobs, wrong_scene_is_refused_at_once) {
  const Answer answer = post("/jobs", "{}");
  expect_problem(answer, 422, "camera");
  EXPECT_FALSE(answer.has_header("Location"));
  expect_problem(post("/jobs?task=nonsense", small_scene), 400, "\"task\"");
}

TEST_F(Jobs, named_scene_can_be_a_job) {
  const Answer answer = request("POST", "/jobs?scene=first-sphere&width=32&height=24&samples=1");
  ASSERT_EQ(answer.status, 202) << answer.body;
  EXPECT_TRUE(becomes(answer.get_header_value("Location"), "done"));
}

}  // namespace
}  // namespace raytracer::test
