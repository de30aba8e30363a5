// Tasks that no worker may take, that fail, or that are not what they say.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

#include "tests/cluster/cluster_test.h"
#include "tests/cluster/stored.h"
#include "tests/service/documents.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

class Tasks : public ClusterTest {
 protected:
  static std::string failure_of(const ServerProcess& front, const std::string& id) {
    EXPECT_TRUE(eventually([&] { return status_of(front, "/jobs/" + id) == "failed"; }))
        << get(front, "/jobs/" + id).body;
    return json_of(get(front, "/jobs/" + id)).value("detail", "");
  }
};

TEST_F(Tasks, those_of_another_build_are_left_to_it) {
  const ServerProcess& front = start_front();
  const ServerProcess& worker = start_worker();
  ASSERT_TRUE(has_workers(front, 1));
  Stored stored(nats().url());
  stored.queue(stored.new_job("other", "anotherbuild", small_scene, 12, 16, 1));
  const auto detail = [&] { return json_of(get(front, "/jobs/other")).value("detail", ""); };
  EXPECT_TRUE(eventually([&] { return !detail().empty(); }));
  EXPECT_NE(detail().find("anotherbuild"), std::string::npos) << detail();
  // Its own kind of work it does meanwhile.
  const std::string job = post_job(front, "", small_scene);
  ASSERT_TRUE(ends_done(front, job));
  EXPECT_EQ(status_of(front, "/jobs/other"), "running");
  EXPECT_EQ(metric_of(worker, "raytracer_cluster_tasks_total"), 1);
  EXPECT_EQ(request(front, "DELETE", "/jobs/other").status, 204);
}

TEST_F(Tasks, job_says_that_there_is_no_worker) {
  const ServerProcess& front = start_front();
  ASSERT_TRUE(eventually([&] { return cluster_of(front).is_object(); }));
  const std::string job = post_job(front, "", small_scene);
  EXPECT_TRUE(eventually([&] {
    return json_of(get(front, job)).value("detail", "").find("worker") != std::string::npos;
  }));
  const Answer refused = get(front, "/render?scene=demo");
  expect_problem(refused, 503, "workers");
  EXPECT_TRUE(refused.has_header("Retry-After"));
  start_worker();
  EXPECT_TRUE(ends_done(front, job));
}

TEST_F(Tasks, one_that_fails_three_times_on_two_workers_fails_its_job) {
  const ServerProcess& front = start_front();
  const ServerProcess& one = start_worker();
  const ServerProcess& other = start_worker();
  ASSERT_TRUE(has_workers(front, 2));
  Stored stored(nats().url());
  stored.queue(stored.new_job("poisoned", stored.renderer(), "", 12, 16, 1));
  const std::string reason = failure_of(front, "poisoned");
  EXPECT_NE(reason.find("failed 3 times"), std::string::npos) << reason;
  EXPECT_NE(reason.find("no longer stored"), std::string::npos) << reason;
  const double at_one = metric_of(one, "raytracer_cluster_task_failures_total");
  const double at_other = metric_of(other, "raytracer_cluster_task_failures_total");
  EXPECT_GE(at_one, 1);
  EXPECT_GE(at_other, 1);
  EXPECT_EQ(at_one + at_other, 3);
  expect_problem(get(front, "/jobs/poisoned/image"), 409, "failed 3 times");
  const auto elapsed_ms = [&] { return json_of(get(front, "/jobs/poisoned")).at("elapsed_ms"); };
  const nlohmann::json ended = elapsed_ms();
  std::this_thread::sleep_for(50ms);
  EXPECT_EQ(elapsed_ms(), ended) << "it goes on rising";
  EXPECT_NE(get(front, "/jobs/poisoned/events").body.find("event: failed\n"), std::string::npos);
}

TEST_F(Tasks, one_that_fails_is_given_up_by_a_worker_that_is_alone) {
  const ServerProcess& front = start_front();
  start_worker();
  ASSERT_TRUE(has_workers(front, 1));
  Stored stored(nats().url());
  // A region that the scene does not have.
  stored.queue(stored.new_job("poisoned", stored.renderer(), small_scene, 4096, 16, 65'000));
  EXPECT_NE(failure_of(front, "poisoned").find("failed 3 times"), std::string::npos);
  EXPECT_TRUE(ends_done(front, post_job(front, "", small_scene)));
}

TEST_F(Tasks, one_that_failed_at_one_worker_waits_for_another_that_is_busy) {
  const ServerProcess& front = start_front();
  const ServerProcess& one = start_worker();
  ASSERT_TRUE(has_workers(front, 1));
  Stored stored(nats().url());
  const std::vector<Member> members = stored.store.members();
  const auto named = std::find_if(members.begin(), members.end(),
                                  [](const Member& member) { return member.works; });
  ASSERT_NE(named, members.end());
  const ServerProcess& other = start_worker();
  ASSERT_TRUE(has_workers(front, 2));
  // Two tasks of eight seconds each, whatever the machine, keep the other busy, once the first does
  // not take them.
  one.signal(SIGSTOP);
  for (const char* const id : {"busy1", "busy2"}) {
    JobRecord busy = stored.new_job(id, named->renderer, endless_scene(), 350, 0, 1);
    busy.query = {{"budget_ms", "8000"}};
    stored.queue(busy);
  }
  EXPECT_TRUE(eventually([&] { return cluster_of(front).at("tasks").at("running") == 2; }));
  const std::string scene = R"({"camera": {"origin": [0, 0, -5], "look_at": [0, 0, 0], "fov": 0.9,
    "width": 16, "height": 16}, "objects": [{"type": "sphere", "center": [0, 0, 0], "radius": 1}]})";
  stored.queue(stored.new_job("picky", named->renderer, scene, 16, 16, 1));
  auto task = stored.store.tasks_of({"picky", named->renderer, "", 0, 0}).take(5s);
  ASSERT_TRUE(task);
  stored.store.add_failure("picky", 0, 0, {named->name, "as a worker says it"});
  task->hand_back(0ms);
  one.signal(SIGCONT);
  EXPECT_TRUE(ends_done(front, "/jobs/picky")) << one.log() << other.log();
  EXPECT_GT(stored.store.hand_backs("picky", 0), 5U) << "the other was not busy for long enough";
}

TEST_F(Tasks, limits_are_those_of_the_front) {
  const ServerProcess& front = start_front();
  start_worker({"--max-pixels", "16", "--max-samples", "1", "--max-work", "16"});
  ASSERT_TRUE(has_workers(front, 1));
  const std::string query = "?scene=first-sphere&samples=4&width=200&height=160";
  const std::string job = post_job(front, query);
  ASSERT_TRUE(ends_done(front, job));
  EXPECT_TRUE(get(front, job + "/image").body == alone("/render" + query));
}

TEST_F(Tasks, one_that_takes_long_is_said_to_be_in_progress_as_often_as_its_front_demands) {
  const ServerProcess& front = start_front();
  start_worker({"--task-timeout", "60"});
  ASSERT_TRUE(has_workers(front, 1));
  Stored stored(nats().url());
  JobRecord record = stored.new_job("long", stored.renderer(), endless_scene(), 350, 0, 1);
  record.query = {{"budget_ms", "2500"}};  // five times as long as may be silence
  record.task_timeout_s = 0.5;
  stored.queue(record);
  ASSERT_TRUE(ends_done(front, "/jobs/long"));
  EXPECT_EQ(stored.store.redelivered(), 0U);
}

}  // namespace
}  // namespace raytracer::test
