// What the store promises to those who use it: what is in use stays, what is done twice counts
// once.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>

#include "server/cluster/news.h"
#include "server/cluster/shared_job.h"
#include "tests/cluster/cluster_test.h"
#include "tests/cluster/stored.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

class ClusterStoreTest : public ClusterTest {};

TEST_F(ClusterStoreTest, scene_that_lost_some_chunks_is_stored_again) {
  Stored stored(nats().url());
  stored.store.ensure_streams();
  const std::string text(2'500'000, 'a');
  const std::string digest = ClusterStore::digest_of(text);
  stored.store.put_document(digest, text);
  EXPECT_EQ(stored.store.document(digest), text);
  stored.connection.purge("raytracer_scenes", "raytracer.scene.chunk." + digest + ".1");
  EXPECT_THROW(stored.store.document(digest), NatsRefused);
  stored.store.put_document(digest, text);
  EXPECT_EQ(stored.store.document(digest), text);
}

TEST_F(ClusterStoreTest, scene_that_an_earlier_build_stored_is_read) {
  Stored stored(nats().url());
  stored.store.ensure_streams();
  const std::string text = "a scene";
  const std::string digest = ClusterStore::digest_of(text);
  stored.connection.put("raytracer.scene.chunk." + digest + ".0", text);
  stored.connection.put("raytracer.scene.text." + digest, "parts 1");
  EXPECT_EQ(stored.store.document(digest), text);
}

TEST_F(ClusterStoreTest, posted_scene_whose_parts_were_mixed_is_mended_when_it_comes_again) {
  Stored stored(nats().url());
  stored.store.ensure_streams();
  stored.store.keep_scene("id", "a scene");
  stored.connection.put("raytracer.kept.chunk.id.0", "a  scene");
  EXPECT_EQ(stored.store.kept_scene("id"), std::nullopt);
  stored.store.keep_scene("id", "a scene");
  EXPECT_EQ(stored.store.kept_scene("id"), "a scene");
}

TEST_F(ClusterStoreTest, scene_that_an_open_job_needs_stays_when_room_is_wanted) {
  StoreLimits limits;
  limits.most_bytes = 16 << 20;  // a quarter of it for scenes
  Stored stored(nats().url(), limits);
  stored.store.ensure_streams();
  const std::string text(2'500'000, 'a');
  const std::string other(1'900'000, 'b');
  JobRecord record = stored.new_job("one", "build", text, 16, 16, 1);
  ASSERT_TRUE(stored.store.put_job(record));
  const std::string other_digest = ClusterStore::digest_of(other);
  EXPECT_THROW(stored.store.put_document(other_digest, other), StreamFull);
  EXPECT_EQ(stored.store.document(record.document), text);
  ASSERT_TRUE(stored.store.put_result("one", 0, "a picture"));
  stored.store.put_document(other_digest, other);
  EXPECT_EQ(stored.store.document(other_digest), other);
  EXPECT_THROW(stored.store.document(record.document), NatsRefused) << "there was room for both";
}

TEST_F(ClusterStoreTest, scene_that_is_used_again_is_kept_as_long_as_its_last_job) {
  StoreLimits limits;
  limits.longest_kept = 4s;
  Stored stored(nats().url(), limits);
  stored.store.ensure_streams();
  const std::string text = "a scene";
  const std::string digest = ClusterStore::digest_of(text);
  stored.store.put_document(digest, text);
  std::this_thread::sleep_for(2600ms);
  stored.store.put_document(digest, text);
  std::this_thread::sleep_for(2000ms);
  EXPECT_EQ(stored.store.document(digest), text);
}

TEST_F(ClusterStoreTest, result_that_comes_twice_counts_once) {
  Stored stored(nats().url());
  stored.store.ensure_streams();
  for (const std::string& bytes : {std::string("small"), std::string(3'000'000, 'x')}) {
    const std::string id = "job" + std::to_string(bytes.size());
    JobRecord record = stored.new_job(id, "build", "", 16, 16, 8);
    ASSERT_TRUE(stored.store.put_job(record));
    EXPECT_TRUE(stored.store.put_result(id, 7, bytes));
    EXPECT_FALSE(stored.store.put_result(id, 7, std::string(3'000'000, 'y')));
    EXPECT_EQ(stored.store.results(id), std::set<int>{7});
    EXPECT_EQ(stored.store.result(id, 7)->data, bytes);
  }
  const auto subjects = stored.connection.subjects("raytracer_results", ">");
  EXPECT_EQ(subjects.size(), 2U + 6U) << "parts of a result that did not count are left";
}

TEST_F(ClusterStoreTest, result_that_nobody_wants_any_more_does_not_stay) {
  Stored stored(nats().url());
  stored.store.ensure_streams();
  for (const std::string& bytes : {std::string("small"), std::string(3'000'000, 'x')}) {
    JobRecord record = stored.new_job("job" + std::to_string(bytes.size()), "build", "", 16, 16, 8);
    ASSERT_TRUE(stored.store.put_job(record));
    stored.store.fail_job(record.id, "it cannot be done");
    EXPECT_FALSE(stored.store.put_result(record.id, 1, bytes));
    EXPECT_TRUE(stored.connection.subjects("raytracer_results", ">").empty());
    // What another had stored of a result when there was no more room.
    stored.connection.put("raytracer.result.part." + record.id + ".token.0", "something");
    stored.store.fail_job(record.id, "there is no room");
    EXPECT_TRUE(stored.connection.subjects("raytracer_results", ">").empty());
    stored.store.remove_job(record.id);
    EXPECT_FALSE(stored.store.put_result(record.id, 2, bytes));
    EXPECT_TRUE(stored.of_jobs().empty());
  }
}

TEST_F(ClusterStoreTest, record_that_was_changed_meanwhile_is_not_replaced) {
  Stored stored(nats().url());
  stored.store.ensure_streams();
  JobRecord record = stored.new_job("job", "build", "", 16, 16, 0);
  ASSERT_TRUE(stored.store.put_job(record));
  JobRecord mine = *stored.store.job("job");
  JobRecord theirs = mine;
  theirs.task_count = 5;
  EXPECT_TRUE(stored.store.put_job(theirs));
  mine.task_count = 7;
  EXPECT_FALSE(stored.store.put_job(mine));
  EXPECT_EQ(stored.store.job("job")->task_count, 5);
  stored.store.remove_job("job");
  EXPECT_FALSE(stored.store.put_job(theirs)) << "a removed job came back";
  EXPECT_TRUE(stored.of_jobs().empty());
}

TEST_F(ClusterStoreTest, task_is_queued_once) {
  Stored stored(nats().url());
  stored.store.ensure_streams();
  const JobRecord record = stored.new_job("job", "build", "", 64, 16, 16);
  stored.queue(record);
  stored.store.queue_tasks(record, {3, 4, 5});
  ASSERT_EQ(stored.store.open_jobs().size(), 1U);
  EXPECT_EQ(stored.store.open_jobs().front().waiting, 16U);
}

TEST_F(ClusterStoreTest, job_is_not_asked_for_again_at_once_when_nats_does_not_answer) {
  Stored stored(nats().url());
  News news(stored.store, true);
  const JobRecord record = stored.new_job("job", "build", "", 16, 16, 1);  // there is no stream yet
  const SharedJob job(record, stored.store, news);
  const std::uint64_t before = nats().received_messages();
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 200; ++i) EXPECT_EQ(job.state().status, JobStatus::running);
  const auto most = (std::chrono::steady_clock::now() - begin) / 10ms + 5;
  EXPECT_LE(nats().received_messages() - before, static_cast<std::uint64_t>(most));
}

TEST_F(ClusterStoreTest, jobs_are_listed_while_others_end) {
  Stored stored(nats().url());
  stored.store.ensure_streams();
  const JobRecord record = stored.new_job("job", "build", "", 64, 16, 1);
  std::atomic<bool> has_ended = false;
  std::thread ends([&] {
    Stored other(nats().url());
    for (int i = 0; i < 1000; ++i) {
      other.store.queue_tasks(record, {});
      other.store.close_job(record);
    }
    has_ended = true;
  });
  int unread = 0;
  while (!has_ended) {
    try {
      stored.store.open_jobs();
    } catch (const NatsRefused&) {
      ++unread;
    }
  }
  ends.join();
  EXPECT_EQ(unread, 0);
}

}  // namespace
}  // namespace raytracer::test
