// NATS is killed and comes back: what needs nobody else goes on meanwhile, and jobs go on after.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <optional>
#include <string>
#include <thread>

#include "tests/cluster/cluster_test.h"
#include "tests/cluster/stored.h"
#include "tests/service/documents.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

class NatsAway : public ClusterTest {};

/// Whether all tasks of the one job that there is are queued (they wait, run or are done), as the
/// front knows.
bool are_all_queued(const ServerProcess& front, const std::string& nats_url) {
  Stored stored(nats_url);
  const bool are_stored = eventually([&] {
    for (const OpenJob& open : stored.store.open_jobs()) {
      const std::optional<JobRecord> record = stored.store.job(open.id);
      const std::size_t done = stored.store.results(open.id).size();
      if (record && record->task_count > 0 &&
          done + open.waiting + open.running >= static_cast<std::size_t>(record->task_count))
        return true;
    }
    return false;
  });
  // What NATS answers it now comes after what NATS has answered it of the tasks.
  return are_stored && cluster_of(front).is_object();
}

TEST_F(NatsAway, jobs_go_on_when_it_is_back_and_small_renders_meanwhile) {
  // Every render but the smallest is shared.
  const ServerProcess& working = start({"--share-from", "50"});
  const ServerProcess& front = start_front({"--share-from", "50"});
  start_worker();
  ASSERT_TRUE(has_workers(front, 2));
  const std::string scene = long_scene(140);
  const std::string job = post_job(front, "", scene);
  ASSERT_TRUE(is_half_way(front, job));
  nats().kill();
  for (const ServerProcess* const server : {&working, &front}) {
    EXPECT_TRUE(eventually([&] { return readiness(*server) == "degraded"; }));
    const auto begin = std::chrono::steady_clock::now();
    const Answer small = get(*server, "/render?scene=first-sphere&samples=1&width=96&height=72");
    EXPECT_EQ(small.status, 200) << small.body;
    EXPECT_LT(std::chrono::steady_clock::now() - begin, patience(2s));
    for (const Answer& refused :
         {post(*server, "/jobs", small_scene), get(*server, job), get(*server, "/cluster")}) {
      expect_problem(refused, 503, "cluster cannot be reached");
      EXPECT_TRUE(refused.has_header("Retry-After"));
    }
  }
  const std::string big = long_scene(61);
  const Answer refused = post(front, "/render", big);
  expect_problem(refused, 503, "cluster cannot be reached");
  EXPECT_TRUE(refused.has_header("Retry-After"));
  const Answer rendered = post(working, "/render", big);
  EXPECT_EQ(rendered.status, 200) << rendered.body;
  EXPECT_FALSE(rendered.has_header("Render-Tasks"));

  nats().start();
  for (const ServerProcess* const server : {&working, &front})
    EXPECT_TRUE(eventually([&] { return readiness(*server) == "ok"; }));
  ASSERT_TRUE(ends_done(front, job));
  EXPECT_TRUE(get(front, job + "/image").body == alone("/render", scene));
  EXPECT_TRUE(get(front, "/render?scene=demo&samples=1&width=900&height=700").body ==
              alone("/render?scene=demo&samples=1&width=900&height=700"));
}

TEST_F(NatsAway, at_the_start_it_need_not_be_there) {
  nats().kill();
  const ServerProcess& front = start_front({"--share-from", "200"});
  start_worker();
  EXPECT_EQ(readiness(front), "degraded");
  EXPECT_EQ(get(front, "/render?scene=first-sphere&samples=1&width=96&height=72").status, 200);
  nats().start();
  EXPECT_TRUE(has_workers(front, 1));
  EXPECT_TRUE(ends_done(front, post_job(front, "", small_scene)));
}

TEST_F(NatsAway, task_that_ends_meanwhile_is_kept_and_is_not_a_loss) {
  const ServerProcess& front = start_front();
  const ServerProcess& worker = start_worker();
  ASSERT_TRUE(has_workers(front, 1));
  Stored stored(nats().url());
  const std::string scene = long_scene(100);
  JobRecord record = stored.new_job("one", stored.renderer(), scene, 350, 352, 1);
  record.samples = samples_of_long_scene(100);
  stored.queue(record);
  // Then it has all that it needs.
  ASSERT_TRUE(
      eventually([&] { return metric_of(worker, "raytracer_cluster_scene_bytes_total") > 0; }));
  nats().kill();
  // Where the machine is so slow that it is traced longer, nothing is shown.
  std::this_thread::sleep_for(4s);
  nats().start();
  ASSERT_TRUE(ends_done(front, "/jobs/one"));
  EXPECT_TRUE(get(front, "/jobs/one/image").body == alone("/render", scene));
  EXPECT_EQ(worker.log().find("was left"), std::string::npos) << worker.log();
  EXPECT_EQ(metric_of(worker, "raytracer_cluster_tasks_total"), 1);
}

TEST_F(NatsAway, front_that_is_told_to_end_twice_does_not_wait_for_it) {
  ServerProcess& front = start({"--share-from", "100000"});  // it renders all by itself
  ASSERT_TRUE(has_workers(front, 1));
  post_job(front, "", long_scene(60));
  const auto rendered = [&] { return metric_of(front, "raytracer_renders_total"); };
  ASSERT_EQ(rendered(), 0) << "it was too short";  // asked later, it may wait for NATS's answer
  nats().kill();
  ASSERT_TRUE(eventually([&] { return rendered() == 1; }));
  front.signal(SIGTERM);
  std::this_thread::sleep_for(200ms);  // so that it is not the same signal
  front.signal(SIGTERM);
  EXPECT_EQ(front.wait(20s), 0) << front.log();
}

TEST_F(NatsAway, render_that_its_client_gave_up_meanwhile_is_forgotten) {
  const ServerProcess& front = start_front();
  start_worker();
  ASSERT_TRUE(has_workers(front, 1));
  std::thread client([&] {
    httplib::Client connection = front.client();
    connection.set_read_timeout(patience(2s));
    EXPECT_FALSE(connection.Post("/render", endless_scene(), "application/json"));
  });
  // A render that cannot be queued has failed by itself.
  EXPECT_TRUE(are_all_queued(front, nats().url()));
  nats().kill();
  client.join();
  EXPECT_TRUE(eventually([&] { return front.log().find("status=499") != std::string::npos; }))
      << front.log();
  nats().start();
  Stored stored(nats().url());
  EXPECT_TRUE(eventually([&] { return stored.of_jobs().empty(); }))
      << testing::PrintToString(stored.of_jobs());
}

/// A client that waits for the front's picture of the scene gets it, whatever `disturb()` does once
/// all of its tasks are queued: half a job would be refused.
void expect_picture_though(const ServerProcess& front, const std::string& nats_url,
                           const std::string& scene, const std::function<void()>& disturb) {
  Answer image;
  std::thread client([&] { image = post(front, "/render", scene); });
  EXPECT_TRUE(are_all_queued(front, nats_url));
  disturb();
  client.join();
  ASSERT_EQ(image.status, 200) << image.body;
  EXPECT_TRUE(image.body == alone("/render", scene));
}

TEST_F(NatsAway, client_that_waits_for_a_shared_render_gets_it) {
  const ServerProcess& front = start_front();
  start_worker();
  ASSERT_TRUE(has_workers(front, 1));
  expect_picture_though(front, nats().url(), long_scene(60), [&] {
    nats().kill();
    nats().start();
  });
}

TEST_F(NatsAway, client_gets_its_render_though_another_front_hears_nothing_of_its_own) {
  const ServerProcess& front = start_front();
  const ServerProcess& other = start_front();
  start_worker();
  for (const auto away : {1s, 3s}) {
    ASSERT_TRUE(has_workers(front, 1));
    ASSERT_TRUE(has_workers(other, 1));
    const std::string scene = long_scene(60 + static_cast<int>(away.count()));  // one not cached
    expect_picture_though(front, nats().url(), scene, [&] {
      nats().kill();
      std::this_thread::sleep_for(away);
      nats().start();
    });
  }
}

TEST_F(NatsAway, render_whose_record_is_lost_is_shared_again) {
  const ServerProcess& front = start_front();
  start_worker();
  ASSERT_TRUE(has_workers(front, 1));
  expect_picture_though(front, nats().url(), long_scene(60), [&] {
    Stored stored(nats().url());
    for (const std::string& id : stored.store.job_ids()) stored.store.remove_job(id);
  });
}

}  // namespace
}  // namespace raytracer::test
