// Jobs and kept scenes belong to the cluster: any front answers for them.
#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <string>
#include <thread>

#include "tests/cluster/cluster_test.h"
#include "tests/cluster/stored.h"
#include "tests/service/documents.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

class ClusterJobs : public ClusterTest {};

TEST_F(ClusterJobs, another_front_answers_for_a_job) {
  const ServerProcess& one = start_front();
  const ServerProcess& other = start_front();
  start_worker();
  ASSERT_TRUE(has_workers(other, 1));
  const std::string query = "?scene=demo&samples=4&width=200&height=150";
  const std::string job = post_job(one, query);
  const Answer events = get(other, job + "/events");
  EXPECT_EQ(events.get_header_value("Content-Type"), "text/event-stream");
  EXPECT_NE(events.body.find("event: done\n"), std::string::npos) << events.body;
  ASSERT_TRUE(ends_done(other, job));
  const nlohmann::json json = json_of(get(other, job));
  EXPECT_EQ("/jobs/" + json.at("id").get<std::string>(), job);
  EXPECT_EQ(json.at("task"), "render");
  EXPECT_EQ(json.at("progress"), 1);
  EXPECT_EQ(json.at("samples"), 4);
  EXPECT_GT(json.at("error").get<double>(), 0);
  EXPECT_GT(json.at("elapsed_ms").get<double>(), 0);
  EXPECT_FALSE(json.contains("detail"));

  const std::string expected = alone("/render" + query);
  EXPECT_TRUE(get(other, job + "/image").body == expected);
  const ServerProcess& later = start_front();
  ASSERT_TRUE(eventually([&] { return get(later, job).status == 200; }));
  EXPECT_TRUE(get(later, job + "/image").body == expected);
  EXPECT_NE(get(later, job + "/events").body.find("event: done\n"), std::string::npos);
  EXPECT_EQ(request(later, "DELETE", job).status, 204);
  for (const ServerProcess* const front : {&one, &other, &later})
    expect_problem(get(*front, job), 404, "job");
}

TEST_F(ClusterJobs, no_front_says_less_than_another_did) {
  const ServerProcess& one = start_front();
  const ServerProcess& other = start_front();
  start_worker();
  ASSERT_TRUE(has_workers(other, 1));
  for (int i = 0; i < 10; ++i) {
    const std::string job = post_job(one, "", as_another_picture(square_scene(64, 1), i));
    ASSERT_TRUE(eventually([&] {
      EXPECT_NE(status_of(other, job), "failed");
      return status_of(one, job) == "done";
    }));
    EXPECT_TRUE(get(other, job + "/image").has_header("ETag")) << "it is a preview";
    EXPECT_EQ(status_of(other, job), "done");
  }
}

/// Milliseconds of a stage.
double stage(const Answer& answer, const std::string& name) {
  const std::string timing = answer.get_header_value("Server-Timing");
  const std::size_t at = timing.find(name + ";dur=");
  return at == std::string::npos ? -1 : std::stod(timing.substr(at + name.size() + 5));
}

TEST_F(ClusterJobs, answer_says_how_long_each_stage_took) {
  const ServerProcess& front = start_front();
  start_worker();
  ASSERT_TRUE(has_workers(front, 1));
  const std::string query = "?scene=square-500&samples=16&width=320&height=180";
  const std::string job = post_job(front, query);
  ASSERT_TRUE(ends_done(front, job));
  for (const Answer& answer : {get(front, job + "/image"), get(front, "/render" + query)}) {
    ASSERT_EQ(answer.status, 200) << answer.body;
    EXPECT_TRUE(answer.has_header("Render-Tasks"));
    for (const char* const name : {"plan", "build", "trace"})
      EXPECT_GT(stage(answer, name), 0) << answer.get_header_value("Server-Timing");
  }
}

TEST_F(ClusterJobs, count_in_the_metrics_as_those_of_one_server_do) {
  const ServerProcess& front = start_front();
  start_worker();
  ASSERT_TRUE(has_workers(front, 1));
  const std::string first = post_job(front, "?budget_ms=50", small_scene);
  ASSERT_TRUE(ends_done(front, first));
  EXPECT_EQ(metric_of(front, "raytracer_queue_duration_seconds_count"), 1);
  EXPECT_GT(Stored(nats().url()).store.job(first.substr(6))->queue_ms, 0);
  EXPECT_EQ(request(front, "DELETE", first).status, 204);
  EXPECT_EQ(metric_of(front, "raytracer_renders_cancelled_total"), 0) << "it was done";
  const std::string endless = post_job(front, "", endless_scene());
  EXPECT_EQ(request(front, "DELETE", endless).status, 204);
  EXPECT_EQ(metric_of(front, "raytracer_renders_cancelled_total"), 1);
}

TEST_F(ClusterJobs, floats_are_to_be_had_announced_or_not) {
  const ServerProcess& front = start_front();
  const ServerProcess& worker = start_worker();
  ASSERT_TRUE(has_workers(front, 1));
  const auto task_total = [&] { return metric_of(worker, "raytracer_cluster_tasks_total"); };
  const std::string query = "?scene=glints&samples=4&width=150&height=101";
  const Headers floats{{"Accept", std::string(pfm_type)}};
  Stored stored(nats().url());
  for (const bool is_announced : {false, true}) {
    const Answer accepted = post(front, "/jobs" + query, "", is_announced ? floats : Headers{});
    ASSERT_EQ(accepted.status, 202) << accepted.body;
    const std::string job = accepted.get_header_value("Location");
    ASSERT_TRUE(ends_done(front, job));
    EXPECT_EQ(stored.store.job(job.substr(6))->is_8_bit, !is_announced);
    const double tasks = task_total();
    EXPECT_TRUE(get(front, job + "/image").body == alone("/render" + query));
    EXPECT_TRUE(get(front, job + "/image", floats).body == alone("/render" + query, "", pfm_type));
    EXPECT_EQ(task_total() == tasks, is_announced) << "it was rendered again";
    EXPECT_EQ(request(front, "DELETE", job).status, 204);
  }
}

TEST_F(ClusterJobs, curve_is_measured_by_a_worker) {
  const ServerProcess& one = start_front();
  const ServerProcess& other = start_front();
  start_worker();
  ASSERT_TRUE(has_workers(other, 1));
  const std::string job = post_job(one, "?task=tradeoff", small_scene);
  ASSERT_TRUE(ends_done(other, job));
  const Answer curve = get(other, job + "/result");
  ASSERT_EQ(curve.status, 200) << curve.body;
  EXPECT_FALSE(json_of(curve).at("points").empty());
  expect_problem(get(other, job + "/image"), 404, "/result");
  expect_problem(get(one, "/jobs/1"), 404, "job");
}

TEST_F(ClusterJobs, events_of_one_whose_record_is_damaged_end_and_the_server_lives) {
  const ServerProcess& front = start_front();
  ASSERT_TRUE(eventually([&] { return get(front, "/cluster").status == 200; }));
  const std::string job = post_job(front, "", small_scene);
  ASSERT_NE(job, "");
  Stored stored(nats().url());
  std::thread damage([&] {
    std::this_thread::sleep_for(1s);
    stored.connection.put("raytracer.job.record." + job.substr(6), "{}");
  });
  EXPECT_FALSE(front.client().Get(job + "/events")) << "its end was that of the job";
  damage.join();
  expect_problem(get(front, job), 500, "");
  EXPECT_EQ(get(front, "/healthz").status, 200);
}

TEST_F(ClusterJobs, scene_that_one_front_keeps_is_known_to_all) {
  const ServerProcess& one = start_front();
  const ServerProcess& other = start_front();
  const ServerProcess& worker = start_worker();
  ASSERT_TRUE(has_workers(one, 1));
  const Answer kept = post(one, "/scenes", small_scene);
  ASSERT_EQ(kept.status, 201) << kept.body;
  const std::string id = kept.get_header_value("Location").substr(8);
  const Answer image = get(other, "/render?scene=" + id + "&samples=2");
  ASSERT_EQ(image.status, 200) << image.body;
  EXPECT_EQ(image.get_header_value("Render-Tasks"), "1");
  EXPECT_TRUE(image.body == alone("/render?samples=2", small_scene));
  const std::string job = post_job(other, "?scene=" + id);
  EXPECT_TRUE(ends_done(one, job));
  EXPECT_GT(metric_of(worker, "raytracer_cluster_scene_bytes_total"), 0);
  expect_problem(get(other, "/render?scene=0123456789abcdef"), 404, "scene");
}

TEST_F(ClusterJobs, deleted_one_stops_workers_at_once_and_leaves_nothing) {
  const ServerProcess& one = start_front();
  const ServerProcess& other = start_front();
  start_worker();
  start_worker();
  ASSERT_TRUE(has_workers(one, 2));
  const std::string job = post_job(one, "", endless_scene());
  ASSERT_TRUE(is_half_way(other, job)) << get(other, job).body << one.log();
  EXPECT_EQ(get(other, job + "/image").status, 200);
  std::string events;
  std::promise<void> first;
  std::thread listener([&] {
    one.client().Get(job + "/events", [&](const char* data, std::size_t size) {
      if (events.empty()) first.set_value();
      events.append(data, size);
      return true;
    });
  });
  first.get_future().wait();
  EXPECT_EQ(request(other, "DELETE", job).status, 204);
  const auto deleted = std::chrono::steady_clock::now();
  for (const ServerProcess* const front : {&one, &other})
    expect_problem(get(*front, job), 404, "job");
  // The workers are free: another job does not wait for what is left of the first.
  EXPECT_TRUE(ends_done(one, post_job(one, "", small_scene)));
  EXPECT_LT(std::chrono::steady_clock::now() - deleted, patience(5s));
  listener.join();
  EXPECT_NE(events.find("event: cancelled\n"), std::string::npos) << events;
  Stored stored(nats().url());
  EXPECT_TRUE(eventually([&] {
    const auto all = stored.of_jobs();
    return std::none_of(all.begin(), all.end(), [&](const std::string& subject) {
      return subject.find(job.substr(6)) != std::string::npos;
    });
  })) << testing::PrintToString(stored.of_jobs());
}

TEST_F(ClusterJobs, job_of_one_scene_need_not_wait_for_a_long_one_of_another) {
  const ServerProcess& front = start_front();
  start_worker();
  ASSERT_TRUE(has_workers(front, 1));
  const std::string endless = post_job(front, "", endless_scene());
  ASSERT_TRUE(is_half_way(front, endless));
  const std::string brief = post_job(front, "", small_scene);
  EXPECT_TRUE(ends_done(front, brief, 10s));
  EXPECT_EQ(request(front, "DELETE", endless).status, 204);
}

}  // namespace
}  // namespace raytracer::test
