// The streams of a cluster: what their size and age are, and what is said where they cannot be had.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <string>

#include "tests/cluster/cluster_test.h"
#include "tests/cluster/stored.h"
#include "tests/process/temporary_folder.h"
#include "tests/service/documents.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

constexpr std::int64_t least_stored = 64 << 20;

bool has_fronts(const ServerProcess& server, std::size_t count) {
  return eventually([&] {
    const nlohmann::json cluster = cluster_of(server);
    return cluster.is_object() && cluster.at("fronts").size() == count;
  });
}

class ClusterStreams : public ClusterTest {};

TEST_F(ClusterStreams, that_find_no_room_are_said_and_jobs_are_refused) {
  const TemporaryFolder folder;
  nats().kill();
  nats().start({"--config", folder.write("nats.conf", "jetstream { max_file: 1GB }").string()});
  const ServerProcess& front = start_front({"--max-stored", std::to_string(4LL << 30)});
  EXPECT_TRUE(becomes(front, "degraded"));
  EXPECT_TRUE(comes_to_say(front, "jobs are refused: making the stream raytracer_"));
  EXPECT_NE(front.log().find("insufficient storage"), std::string::npos) << front.log();
  const Answer refused = post(front, "/jobs", small_scene);
  expect_problem(refused, 503, "insufficient storage");
  EXPECT_TRUE(refused.has_header("Retry-After"));
  expect_problem(get(front, "/render?scene=demo"), 503, "");
  // Whoever asks for less gets it, and then it is there for all.
  const ServerProcess& modest = start_front({"--max-stored", std::to_string(least_stored)});
  EXPECT_TRUE(becomes(modest, "ok"));
  EXPECT_TRUE(becomes(front, "ok")) << front.log();
  EXPECT_TRUE(comes_to_say(front, "streams are there"));
  start_worker();
  ASSERT_TRUE(has_workers(front, 1));
  EXPECT_TRUE(ends_done(front, post_job(front, "", small_scene)));
}

TEST_F(ClusterStreams, are_changed_by_a_server_that_is_told_and_by_no_other) {
  const auto is_so = [&](std::chrono::seconds kept, std::int64_t bytes) {
    Stored stored(nats().url());
    return eventually([&] {
      try {
        const StreamLimits limits = stored.connection.limits_of("raytracer_results");
        return limits.longest_kept == kept && limits.most_bytes == bytes / 2;
      } catch (const NatsUnavailable&) {
        return false;  // there is none yet
      }
    });
  };
  const ServerProcess& first =
      start_front({"--keep", "1000", "--max-stored", std::to_string(2 * least_stored)});
  EXPECT_TRUE(is_so(1000s, 2 * least_stored));
  const ServerProcess& second = start_worker({"--keep", "500"});
  EXPECT_TRUE(is_so(500s, 2 * least_stored));
  EXPECT_TRUE(comes_to_say(second, "--keep 500 (before: 1000)")) << second.log();
  const ServerProcess& third = start_front({"--max-stored", std::to_string(least_stored)});
  EXPECT_TRUE(is_so(500s, least_stored));
  EXPECT_TRUE(comes_to_say(
      third, fmt::format("--max-stored {} (before: {})", least_stored, 2 * least_stored)))
      << third.log();
  const ServerProcess& other = start_front();
  EXPECT_TRUE(has_fronts(other, 3));
  EXPECT_TRUE(is_so(500s, least_stored));
  for (const ServerProcess* const server : {&first, &other})
    EXPECT_EQ(server->log().find("note="), std::string::npos) << server->log();
  // What the first wished is not what it says again when it has lost NATS for a while.
  nats().kill();
  nats().start();
  EXPECT_TRUE(becomes(first, "ok"));
  EXPECT_TRUE(has_fronts(other, 3));
  EXPECT_TRUE(is_so(500s, least_stored));
}

TEST_F(ClusterStreams, of_other_sizes_are_said_as_the_flag_would_have_to_be) {
  StoreLimits limits;
  limits.most_bytes = least_stored;
  limits.changes_most_bytes = true;
  Stored stored(nats().url(), limits);
  stored.connection.ensure_stream({.name = "raytracer_results",
                                   .subjects = "raytracer.result.>",
                                   .most_bytes = -1,
                                   .longest_kept = limits.longest_kept});
  stored.store.ensure_streams();
  EXPECT_EQ(stored.store.change_streams(),
            fmt::format("--max-stored {} (before: no limit)", least_stored));
  EXPECT_EQ(stored.store.change_streams(), "");
  stored.connection.change_stream("raytracer_results", {3'000'001, std::nullopt});
  EXPECT_EQ(stored.store.change_streams(),
            fmt::format("--max-stored {} (before: 6000002)", least_stored));
  limits.changes_most_bytes = false;
  limits.changes_longest_kept = true;
  limits.longest_kept = 500s;
  Stored other(nats().url(), limits);
  EXPECT_EQ(other.store.change_streams(), "--keep 500 (before: 86400)");
}

TEST_F(ClusterStreams, limits_are_among_those_of_the_version) {
  const ServerProcess& front = start_front({"--keep", "1000"});
  const std::string version = get(front, "/version").body;
  EXPECT_NE(version.find(R"("--keep")"), std::string::npos) << version;
  EXPECT_NE(version.find("1000"), std::string::npos) << version;
  EXPECT_NE(version.find(R"("--max-stored")"), std::string::npos) << version;
}

TEST_F(ClusterStreams, hold_what_they_hold_when_less_is_wished) {
  StoreLimits limits;
  Stored stored(nats().url(), limits);
  stored.store.ensure_streams();
  ASSERT_TRUE(eventually([&] {  // more than half of 64 MB
    stored.connection.put(
        "raytracer.result.of.one." + std::to_string(stored.store.fill_of_results().messages_ever),
        std::string(500'000, 'x'));
    return stored.store.fill_of_results().bytes > least_stored / 2;
  }));
  const std::uint64_t before = stored.store.fill_of_results().bytes;
  const ServerProcess& modest =
      start_worker({"--keep", "60", "--max-stored", std::to_string(least_stored)});
  EXPECT_TRUE(comes_to_say(modest, "raytracer_results holds")) << modest.log();
  EXPECT_TRUE(becomes(modest, "ok"));
  EXPECT_EQ(stored.store.fill_of_results().bytes, before);
}

TEST_F(ClusterStreams, may_be_told_to_keep_for_less_than_two_minutes) {
  const ServerProcess& first = start_worker();
  EXPECT_TRUE(becomes(first, "ok"));
  const ServerProcess& second = start_worker({"--keep", "60"});
  EXPECT_TRUE(comes_to_say(second, "--keep 60 (before: 86400)")) << second.log();
}

}  // namespace
}  // namespace raytracer::test
