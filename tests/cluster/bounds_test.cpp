// What a cluster holds is bounded: its queue, its store, what is left over, what travels.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <iostream>
#include <string>
#include <vector>

#include "tests/cluster/cluster_test.h"
#include "tests/cluster/stored.h"
#include "tests/service/documents.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

class ClusterBounds : public ClusterTest {};

/// One sphere, and so many that nobody sees.
std::string unseen_spheres(int count) {
  std::string scene = R"({"camera": {"origin": [0, 0, -5], "look_at": [0, 0, 0], "fov": 0.5,
    "width": 1000, "height": 700}, "lights": [{"type": "distant", "direction": [-1, -1, 2]}],
    "objects": [{"type": "sphere", "center": [0, 0, 0], "radius": 1})";
  for (int i = 0; i < count; ++i)
    scene += fmt::format(
        R"(,{{"type": "sphere", "center": [{}, 900.125, -90.25], "radius": 0.25}})", i - count / 2);
  return scene + "]}";
}

double fetched(const ServerProcess& worker) {
  return metric_of(worker, "raytracer_cluster_scene_bytes_total");
}

TEST_F(ClusterBounds, queue_is_bounded) {
  for (const char* const most : {"0", "1"}) {
    const ServerProcess& front = start_front({"--max-queue", most});
    if (worker_count(front) == 0) start_worker();
    ASSERT_TRUE(has_workers(front, 1));
    std::vector<std::string> jobs;
    // Fewer wait at the front than may be open in the cluster: the front may refuse first.
    ASSERT_TRUE(eventually([&] {
      const Answer answer = post(front, "/jobs", endless_scene());
      if (answer.status == 202) {
        jobs.push_back(answer.get_header_value("Location"));
        return jobs.size() > 20;
      }
      EXPECT_EQ(answer.status, 429) << answer.body;
      EXPECT_TRUE(answer.has_header("Retry-After"));
      return answer.body.find("cluster") != std::string::npos;
    }));
    EXPECT_LE(jobs.size(), 4U + std::stoul(most) + 4U);
    // What waits in the cluster takes long, too.
    EXPECT_TRUE(eventually([&] {
      const Answer answer = post(front, "/jobs", endless_scene());
      if (answer.status == 202) jobs.push_back(answer.get_header_value("Location"));
      return answer.status == 429 && std::stol(answer.get_header_value("Retry-After")) >= 10;
    }));
    for (const std::string& job : jobs) EXPECT_EQ(request(front, "DELETE", job).status, 204);
    EXPECT_TRUE(eventually([&] { return task_count(front) == 0; }));
    EXPECT_TRUE(ends_done(front, post_job(front, "", small_scene)));
  }
}

TEST_F(ClusterBounds, full_store_is_said_and_has_room_again_when_jobs_are_deleted) {
  const Flags least{"--max-stored", std::to_string(64 << 20)};
  const ServerProcess& front = start_front(least);
  start_worker(least);
  ASSERT_TRUE(has_workers(front, 1));
  // 13 bytes a pixel, of 32 MB: two have room, a third has not.
  const std::string query = "?scene=first-sphere&samples=1&width=1200&height=900&max_depth=";
  std::vector<std::string> jobs;
  for (int i = 0; i < 2; ++i) {
    jobs.push_back(post_job(front, query + std::to_string(i)));
    ASSERT_TRUE(ends_done(front, jobs.back()));
  }
  const Answer accepted = post(front, "/jobs" + query + "2", "");
  if (accepted.status == 202) {
    const std::string job = accepted.get_header_value("Location");
    ASSERT_TRUE(eventually([&] { return status_of(front, job) == "failed"; }))
        << get(front, job).body;
    EXPECT_NE(json_of(get(front, job)).value("detail", "").find("--max-stored"), std::string::npos)
        << get(front, job).body;
    EXPECT_EQ(request(front, "DELETE", job).status, 204);
  } else {
    expect_problem(accepted, 503, "--max-stored");
  }
  const Answer refused = get(front, "/render" + query + "3", {{"Accept", std::string(pfm_type)}});
  expect_problem(refused, 503, "--max-stored");
  EXPECT_TRUE(refused.has_header("Retry-After"));
  for (const std::string& job : jobs) EXPECT_EQ(request(front, "DELETE", job).status, 204);
  EXPECT_TRUE(ends_done(front, post_job(front, query + "4")));
}

TEST_F(ClusterBounds, scenes_that_others_post_leave_those_of_jobs_where_they_are) {
  const Flags least{"--max-stored", std::to_string(64 << 20)};  // 4 MB of it for what is posted
  const ServerProcess& front = start_front(least);
  ASSERT_TRUE(eventually([&] { return cluster_of(front).is_object(); }));
  const std::string job = post_job(front, "", small_scene);
  std::string kept;
  for (int i = 0; i < 8; ++i) {
    std::string scene = small_scene;
    scene.insert(1, fmt::format(R"("description": "{}",)", std::string(1'000'000, "abcdefgh"[i])));
    const Answer posted = post(front, "/scenes", scene);
    ASSERT_EQ(posted.status, 201) << posted.body;
    kept = posted.get_header_value("Location");
  }
  start_worker(least);
  EXPECT_TRUE(ends_done(front, job));
  const ServerProcess& other = start_front(least);
  EXPECT_TRUE(eventually([&] { return get(other, kept).status == 200; })) << "the last is there";
}

TEST_F(ClusterBounds, nothing_is_left_of_old_jobs) {
  const Flags brief{"--keep", "2"};
  const ServerProcess& front = start_front(brief);
  start_worker(brief);
  ASSERT_TRUE(has_workers(front, 1));
  const std::string job = post_job(front, "", small_scene);
  ASSERT_TRUE(ends_done(front, job));
  EXPECT_EQ(get(front, "/render?scene=demo&samples=1&width=900&height=700").status, 200);
  Stored stored(nats().url());
  EXPECT_TRUE(eventually([&] {
    return stored.of_jobs().empty() &&
           stored.connection.subjects("raytracer_scenes", ">").empty() &&
           stored.connection.subjects("raytracer_kept", ">").empty();
  })) << testing::PrintToString(stored.of_jobs());
  expect_problem(get(front, job), 404, "job");
}

TEST_F(ClusterBounds, scene_reaches_each_worker_once) {
  const ServerProcess& front = start_front();
  const ServerProcess& one = start_worker();
  const ServerProcess& other = start_worker();
  ASSERT_TRUE(has_workers(front, 2));
  const std::string scene = unseen_spheres(30'000);
  ASSERT_GT(scene.size(), std::size_t{2} << 20);
  int jobs = 0;
  ASSERT_TRUE(eventually([&] {
    const std::string query = fmt::format("?max_depth={}", jobs % 50);
    EXPECT_TRUE(ends_done(front, post_job(front, query, scene)));
    ++jobs;
    return jobs >= 3 && fetched(one) > 0 && fetched(other) > 0;
  }));
  EXPECT_EQ(fetched(one), scene.size());
  EXPECT_EQ(fetched(other), scene.size());
}

TEST_F(ClusterBounds, scene_that_is_larger_than_what_a_worker_keeps_reaches_it_once) {
  const ServerProcess& front = start_front();
  const ServerProcess& worker = start_worker({"--max-kept", "10000"});
  ASSERT_TRUE(has_workers(front, 1));
  const std::string scene = unseen_spheres(300);
  const std::string job = post_job(front, "", scene);
  ASSERT_TRUE(ends_done(front, job));
  EXPECT_GT(metric_of(worker, "raytracer_cluster_tasks_total"), 1);
  EXPECT_EQ(fetched(worker), scene.size());
}

TEST_F(ClusterBounds, scene_of_20_mb_takes_its_way_once_for_each_worker) {
  const ServerProcess& front = start_front();
  std::string scene = R"({"camera": {"origin": [0, 0, -5], "look_at": [0, 0, 0], "fov": 0.5,
    "width": 64, "height": 64}, "objects": [{"type": "sphere", "center": [0, 0, 0], "radius": 1})";
  for (int i = 0; scene.size() < 20'000'000; ++i)
    scene += fmt::format(
        R"(,{{"type": "sphere", "center": [{}, 900.125, -90.25], "radius": 0.25}})", i - 140'000);
  scene += "]}";
  ASSERT_TRUE(eventually([&] { return cluster_of(front).is_object(); }));
  const std::uint64_t before = nats().sent_bytes();
  // One after another: else who has it takes all that there is to do.
  for (int i = 0; i < 3; ++i) {
    const ServerProcess& worker = start_worker();
    const std::string job = post_job(front, fmt::format("?max_depth={}", i), scene);
    EXPECT_NE(get(front, job + "/events").body.find("event: done"), std::string::npos);
    EXPECT_EQ(metric_of(worker, "raytracer_cluster_scene_bytes_total"), scene.size());
    worker.signal(SIGSTOP);
  }
  const double sent = static_cast<double>(nats().sent_bytes() - before);
  const double size = static_cast<double>(scene.size());
  EXPECT_GE(sent, 3 * size);
  EXPECT_LE(sent, 3.1 * size);
  std::cout << fmt::format("{:.0f} bytes of scene, {:.3f} times as many sent\n", size, sent / size);
}

}  // namespace
}  // namespace raytracer::test
