// /jobs?task=tradeoff: the measured curve of what accuracy costs, as a job.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "tests/process/patience.h"
#include "tests/service/documents.h"
#include "tests/service/service.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

class Tradeoff : public Service {
 protected:
  static std::string start(const std::string& document, const std::string& query = "") {
    const Answer answer = post("/jobs?task=tradeoff" + query, document);
    EXPECT_EQ(answer.status, 202) << answer.body;
    return answer.get_header_value("Location");
  }
  static bool becomes(const std::string& job, const std::string& status) {
    return eventually([&] { return json_of(get(job)).value("status", "") == status; }, 30s);
  }
  static nlohmann::json curve_of(const std::string& job) {
    EXPECT_TRUE(becomes(job, "done")) << get(job).body;
    const Answer answer = get(job + "/result");
    EXPECT_EQ(answer.status, 200) << answer.body;
    EXPECT_EQ(answer.get_header_value("Content-Type"), json_type);
    return json_of(answer);
  }
};

TEST_F(Tradeoff, accepted_job_says_its_task_and_counts_up_to_1) {
  const std::string path = start(small_scene);
  EXPECT_EQ(json_of(get(path)).at("task"), "tradeoff");
  double last = 0;
  EXPECT_TRUE(eventually([&] {
    const nlohmann::json job = json_of(get(path));
    EXPECT_GE(job.at("progress").get<double>(), last);
    last = job.at("progress");
    return job.at("status") == "done";
  }));
  EXPECT_EQ(last, 1);
}

TEST_F(Tradeoff, curve_has_all_its_fields) {
  const nlohmann::json curve = curve_of(start(small_scene));
  const nlohmann::json& reference = curve.at("reference");
  EXPECT_EQ(reference.at("samples"), reference.at("settings").at("samples"));
  EXPECT_EQ(reference.at("settings").at("precision"), "double");
  EXPECT_GT(reference.at("estimated_error"), 0);
  int best = 0;
  int of_another_picture = 0;
  for (const nlohmann::json& point : curve.at("points")) {
    const nlohmann::json& settings = point.at("settings");
    EXPECT_NE(settings.contains("samples"), settings.contains("target_rmse")) << point;
    EXPECT_EQ(point.at("changes_picture"),
              settings.contains("shadows") || settings.contains("max_depth"));
    EXPECT_GT(point.at("trace_ms"), 0);
    EXPECT_GT(point.at("rmse"), 0);
    EXPECT_GE(point.at("max_error"), point.at("rmse"));
    EXPECT_GE(point.at("off_share"), 0);
    EXPECT_LE(point.at("off_share"), 1);
    best += point.at("pareto").get<bool>() ? 1 : 0;
    of_another_picture += point.at("changes_picture").get<bool>() ? 1 : 0;
  }
  EXPECT_GE(best, 2);
  EXPECT_GE(of_another_picture, 1);
  const nlohmann::json& contract = curve.at("contract");
  EXPECT_GE(contract.size(), 3U);
  for (const nlohmann::json& kept : contract) {
    EXPECT_LE(kept.at("rmse"), kept.at("target_rmse"));
    EXPECT_LE(kept.at("estimated_error"), kept.at("target_rmse"));
    EXPECT_GT(kept.at("trace_ms"), 0);
  }
}

TEST_F(Tradeoff, query_says_which_picture) {
  const nlohmann::json curve = curve_of(start(small_scene, "&width=7&height=5&transfer=srgb"));
  EXPECT_EQ(curve.at("width"), 7);
  EXPECT_EQ(curve.at("height"), 5);
}

TEST_F(Tradeoff, what_it_varies_may_be_said_and_counts_for_nothing) {
  const auto settings_of = [](const nlohmann::json& curve) {
    nlohmann::json settings = nlohmann::json::array();
    for (const nlohmann::json& point : curve.at("points")) settings.push_back(point.at("settings"));
    return settings;
  };
  const nlohmann::json plain = settings_of(curve_of(start(small_scene)));
  for (const std::string query :
       {"&samples=4", "&target_rmse=0.1&budget_ms=10", "&precision=double", "&samples=100000"}) {
    const nlohmann::json settings = settings_of(curve_of(start(small_scene, query)));
    const auto has_precision = [&](const char* precision) {
      return settings.dump().find(fmt::format(R"("precision":"{}")", precision)) !=
             std::string::npos;
    };
    EXPECT_EQ(settings.at(0), plain.at(0)) << query;
    for (const char* const precision : {"single", "double"})
      EXPECT_TRUE(has_precision(precision)) << query;
    EXPECT_NE(settings.dump().find("target_rmse"), std::string::npos) << query;
  }
}

TEST_F(Tradeoff, what_it_varies_is_held_to_the_rules_all_the_same) {
  for (const auto& [query, status] : {std::pair{"samples=x", 400},
                                      {"precision=triple", 400},
                                      {"samples=1&budget_ms=9", 400},
                                      {"samples=0", 422},
                                      {"target_rmse=0", 422},
                                      {"budget_ms=-1", 422}})
    expect_problem(post(std::string("/jobs?task=tradeoff&") + query, small_scene), status, "");
}

TEST_F(Tradeoff, task_is_one_of_two_and_of_jobs_alone) {
  expect_problem(post("/render?task=tradeoff", small_scene), 400, "\"task\"");
  expect_problem(post("/jobs?task=curve", small_scene), 400, "render or tradeoff");
  expect_problem(post("/jobs?task=render&task=tradeoff", small_scene), 400,
                 "\"task\" is given more than once");
  expect_problem(post("/jobs?task=render&task=render", small_scene), 400,
                 "\"task\" is given more than once");
}

TEST_F(Tradeoff, result_of_a_running_job_is_409_and_it_can_be_cancelled) {
  const std::string path = start(endless_scene());
  ASSERT_TRUE(becomes(path, "running"));
  const Answer early = get(path + "/result");
  expect_problem(early, 409, "running");
  EXPECT_TRUE(early.has_header("Retry-After"));
  EXPECT_EQ(request("DELETE", path).status, 204);
  expect_problem(get(path + "/result"), 404, "job");
}

TEST_F(Tradeoff, deleted_one_makes_room) {
  const ServerProcess full({"--threads", "1", "--max-queue", "0"});
  std::vector<std::string> paths;
  paths.reserve(4);
  for (int i = 0; i < 4; ++i)
    paths.push_back(
        test::post(full, "/jobs?task=tradeoff", endless_scene()).get_header_value("Location"));
  EXPECT_EQ(test::post(full, "/jobs?task=tradeoff", small_scene).status, 429);
  for (const std::string& path : paths) test::request(full, "DELETE", path);
  EXPECT_TRUE(eventually([&] { return test::get(full, "/readyz").status == 200; }, 5s));
}

TEST_F(Tradeoff, each_task_has_a_product_of_its_own) {
  const std::string curve = start(small_scene);
  expect_problem(get(curve + "/image"), 404, "/result");
  const std::string image = post("/jobs", small_scene).get_header_value("Location");
  expect_problem(get(image + "/result"), 404, "/image");
  expect_problem(get("/jobs/1/result"), 404, "job");
}

TEST_F(Tradeoff, work_is_limited) {
  // 128 samples of each of 12 x 8 pixels.
  const ServerProcess enough({"--max-work", "12288"});
  EXPECT_EQ(test::post(enough, "/jobs?task=tradeoff", small_scene).status, 202);
  const ServerProcess too_little({"--max-work", "12287"});
  expect_problem(test::post(too_little, "/jobs?task=tradeoff", small_scene), 413, "--max-work");
  const ServerProcess some_samples({"--max-samples", "60"});
  EXPECT_EQ(test::post(some_samples, "/jobs?task=tradeoff", small_scene).status, 202);
  const ServerProcess few_samples({"--max-samples", "59"});
  expect_problem(test::post(few_samples, "/jobs?task=tradeoff", small_scene), 413, "--max-samples");
}

TEST_F(Tradeoff, wrong_scene_is_refused_at_once) {
  expect_problem(post("/jobs?task=tradeoff", "{}"), 422, "camera");
}

}  // namespace
}  // namespace raytracer::test
