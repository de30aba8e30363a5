// Workers and fronts that are killed, hang or are told to end: no job is lost, nothing counts
// twice.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <optional>
#include <string>
#include <thread>

#include "tests/cluster/cluster_test.h"
#include "tests/cluster/stored.h"
#include "tests/service/documents.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

class Loss : public ClusterTest {
 protected:
  const Flags quick{"--task-timeout", "1"};
  const std::string scene = long_scene(60);

  /// Whether the job is done with the right picture, each task counted once.
  void expect_right_picture(const ServerProcess& front, const std::string& job,
                            std::chrono::milliseconds limit = 30s) {
    expect_picture_of(scene, front, job, limit);
  }

  void expect_picture_of(const std::string& document, const ServerProcess& front,
                         const std::string& job, std::chrono::milliseconds limit) {
    ASSERT_TRUE(ends_done(front, job, limit));
    const Answer image = get(front, job + "/image");
    EXPECT_TRUE(image.body == alone("/render", document));
    Stored stored(nats().url());
    const auto record = stored.store.job(job.substr(6));
    ASSERT_TRUE(record);
    EXPECT_GT(record->task_count, 2);
    EXPECT_EQ(stored.store.results(record->id).size(),
              static_cast<std::size_t>(record->task_count));
    EXPECT_EQ(image.get_header_value("Render-Tasks"), std::to_string(record->task_count));
  }
};

TEST_F(Loss, killed_worker_costs_its_running_tasks_only) {
  const ServerProcess& front = start_front(quick);
  const ServerProcess& lost = start_worker(quick);
  ASSERT_TRUE(has_workers(front, 1));
  const std::string job = post_job(front, "", scene);
  ASSERT_TRUE(is_half_way(front, job));
  lost.signal(SIGKILL);
  start_worker(quick);
  expect_right_picture(front, job);
  EXPECT_GT(cluster_of(front).at("redelivered"), 0);
}

TEST_F(Loss, worker_that_hangs_is_replaced_and_counts_once_when_it_wakes) {
  const ServerProcess& front = start_front(quick);
  const ServerProcess& hung = start_worker(quick);
  ASSERT_TRUE(has_workers(front, 1));
  const std::string job = post_job(front, "", scene);
  ASSERT_TRUE(is_half_way(front, job));
  hung.signal(SIGSTOP);
  start_worker(quick);
  const bool others_took = eventually([&] { return cluster_of(front).at("redelivered") > 0; });
  hung.signal(SIGCONT);
  EXPECT_TRUE(others_took);
  expect_right_picture(front, job);
}

TEST_F(Loss, another_front_answers_when_one_is_killed) {
  const ServerProcess& lost = start_front(quick);
  const ServerProcess& other = start_front(quick);
  start_worker(quick);
  ASSERT_TRUE(has_workers(lost, 1));
  const std::string job = post_job(lost, "", scene);
  ASSERT_TRUE(is_half_way(lost, job));
  lost.signal(SIGKILL);
  EXPECT_EQ(status_of(other, job), "running");
  expect_right_picture(other, job);
}

TEST_F(Loss, job_that_a_dead_front_had_not_cut_is_cut_by_another) {
  const ServerProcess& front = start_front(quick);
  start_worker(quick);
  ASSERT_TRUE(has_workers(front, 1));
  Stored stored(nats().url());
  JobRecord record = stored.new_job("uncut", stored.renderer(), scene, 350, 0, 0);
  record.samples = samples_of_long_scene(60);
  ASSERT_TRUE(stored.store.put_job(record));
  expect_right_picture(front, "/jobs/uncut");
}

TEST_F(Loss, job_whose_record_cannot_be_read_keeps_nobody_from_the_others) {
  const ServerProcess& front = start_front(quick);
  start_worker(quick);
  ASSERT_TRUE(has_workers(front, 1));
  Stored stored(nats().url());
  for (const char* const id : {"a", "m", "z", "0", "9"})
    stored.connection.put(std::string("raytracer.job.record.") + id, "{}");
  JobRecord record = stored.new_job("uncut", stored.renderer(), scene, 350, 0, 0);
  record.samples = samples_of_long_scene(60);
  ASSERT_TRUE(stored.store.put_job(record));
  expect_right_picture(front, "/jobs/uncut");
}

TEST_F(Loss, what_a_removal_left_that_was_cut_off_is_removed) {
  Stored stored(nats().url());
  stored.store.ensure_streams();
  const JobRecord record = stored.new_job("half", "no-build", scene, 350, 16, 9);
  stored.queue(record);
  stored.store.put_result("half", 3, "something");
  stored.connection.purge("raytracer_jobs", "raytracer.job.record.half");
  ASSERT_FALSE(stored.of_jobs().empty());
  start_front(quick);
  EXPECT_TRUE(eventually([&] { return stored.of_jobs().empty(); }))
      << testing::PrintToString(stored.of_jobs());
}

TEST_F(Loss, picture_for_a_client_of_a_killed_front_is_forgotten) {
  const ServerProcess& lost = start_front(quick);
  const ServerProcess& other = start_front(quick);
  start_worker(quick);
  ASSERT_TRUE(has_workers(lost, 1));
  std::thread client([&] {
    httplib::Client connection = lost.client();
    EXPECT_FALSE(connection.Post("/render", endless_scene(), "application/json"));
  });
  EXPECT_TRUE(eventually([&] { return task_count(other) > 0; }));
  lost.signal(SIGKILL);
  client.join();
  Stored stored(nats().url());
  EXPECT_TRUE(eventually([&] { return stored.of_jobs().empty(); }))
      << testing::PrintToString(stored.of_jobs());
}

TEST_F(Loss, front_that_is_told_to_end_finishes_what_its_client_waits_for) {
  ServerProcess& front = start(quick);  // that works, and nobody else does
  ASSERT_TRUE(has_workers(front, 1));
  std::optional<httplib::Result> answer;
  std::thread client(
      [&] { answer.emplace(front.client().Post("/render", scene, "application/json")); });
  EXPECT_TRUE(eventually([&] { return task_count(front) > 0; }));
  front.signal(SIGTERM);
  client.join();
  const httplib::Result& image = *answer;
  ASSERT_TRUE(image) << httplib::to_string(image.error()) << front.log();
  EXPECT_EQ(image->status, 200) << image->body;
  EXPECT_TRUE(image->body == alone("/render", scene));
  EXPECT_EQ(front.wait(), 0) << front.log();
}

TEST_F(Loss, front_that_is_told_to_end_twice_waits_for_no_worker) {
  ServerProcess& front = start_front(quick);
  start_worker(quick);
  ASSERT_TRUE(has_workers(front, 1));
  std::optional<httplib::Result> answer;
  std::thread client(
      [&] { answer.emplace(front.client().Post("/render", endless_scene(), "application/json")); });
  EXPECT_TRUE(eventually([&] { return task_count(front) > 0; }));
  front.signal(SIGTERM);
  std::this_thread::sleep_for(200ms);  // so that it is not the same signal
  front.signal(SIGTERM);
  EXPECT_EQ(front.wait(20s), 0) << front.log();
  if (front.wait(0s) != 0) front.signal(SIGKILL);
  client.join();
  const httplib::Result& refused = *answer;
  ASSERT_TRUE(refused) << httplib::to_string(refused.error());
  EXPECT_EQ(refused->status, 503) << refused->body;
}

TEST_F(Loss, worker_that_is_told_to_end_leaves_its_tasks_in_order) {
  const Flags patient{"--task-timeout", "60"};
  const ServerProcess& front = start_front(patient);
  ServerProcess& first = start_worker(patient);
  ASSERT_TRUE(has_workers(front, 1));
  const std::string longer = long_scene(140);  // than the other takes to start
  const std::string job = post_job(front, "", longer);
  ASSERT_TRUE(is_half_way(front, job));
  start_worker(patient);
  ASSERT_TRUE(has_workers(front, 2));
  ASSERT_EQ(status_of(front, job), "running") << "it was too short";
  first.signal(SIGTERM);
  EXPECT_EQ(first.wait(10s), 0) << first.log();
  EXPECT_TRUE(has_workers(front, 1)) << "it took no leave";
  expect_picture_of(longer, front, job, 45s);
}

}  // namespace
}  // namespace raytracer::test
