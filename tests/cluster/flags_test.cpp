// The flags of a cluster, and what a server says of itself with and without them.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/cluster/cluster_test.h"
#include "tests/process/program.h"
#include "tests/service/documents.h"

namespace raytracer::test {
namespace {

TEST(ClusterFlags, have_variables) {
  const auto said_with = [](const std::string& variable, const std::string& value) {
    Process process({RAYTRACER_SERVER_PATH,
                     {"--host", "0.0.0.0", "--port", "0"},
                     "",
                     {{variable, value}, {"RAYTRACER_TOKEN", "s3cret"}}});
    EXPECT_EQ(process.wait(std::chrono::seconds(5)), 1) << variable << ' ' << process.err();
    return process.err();
  };
  EXPECT_NE(said_with("RAYTRACER_WORKER", "1").find("--worker goes with --nats"),
            std::string::npos);
  EXPECT_NE(said_with("RAYTRACER_NO_WORK", "true").find("--no-work goes with --nats"),
            std::string::npos);
  EXPECT_NE(said_with("RAYTRACER_WORKER", "maybe").find("--worker"), std::string::npos);
}

TEST(ClusterFlags, wrong_ones_are_refused_with_their_names) {
  const std::string url = "nats://127.0.0.1:1";
  struct Wrong {
    Flags flags;
    std::string names;
  };
  const std::vector<Wrong> all{{{"--worker"}, "--nats"},
                               {{"--no-work"}, "--nats"},
                               {{"--nats", url, "--worker", "--no-work"}, "--no-work"},
                               {{"--nats", ""}, "--nats"},
                               {{"--nats", "http://[::"}, "--nats"},
                               {{"--nats", "nats://127.0.0.1:99999"}, "--nats"},
                               {{"--share-from", "-1"}, "--share-from"},
                               {{"--share-from", "soon"}, "--share-from"},
                               {{"--task-timeout", "0"}, "--task-timeout"},
                               {{"--task-timeout", "nan"}, "--task-timeout"},
                               {{"--keep", "0"}, "--keep"},
                               {{"--keep", "1.5"}, "--keep"},
                               {{"--max-stored", "1"}, "--max-stored"},
                               {{"--max-stored", "1e99"}, "--max-stored"}};
  for (Wrong wrong : all) {
    wrong.flags.insert(wrong.flags.begin(), {"--port", "0"});
    const std::string said = testing::PrintToString(wrong.flags);
    Process process({RAYTRACER_SERVER_PATH, wrong.flags});
    EXPECT_EQ(process.wait(std::chrono::seconds(5)), 1) << said << process.err();
    EXPECT_NE(process.err().find(wrong.names), std::string::npos) << said << process.err();
  }
}

TEST(ClusterFlags, refused_url_is_shown_without_its_password) {
  Process process(
      {RAYTRACER_SERVER_PATH, {"--port", "0", "--nats", "nats://somebody:secret@127.0.0.1:99999"}});
  EXPECT_EQ(process.wait(std::chrono::seconds(5)), 1);
  EXPECT_NE(process.err().find("nats://...@127.0.0.1:99999"), std::string::npos) << process.err();
  EXPECT_EQ(process.err().find("secret"), std::string::npos) << process.err();
}

TEST(ClusterFlags, wrong_file_of_credentials_is_refused_with_its_variable) {
  for (const char* const variable : {"NATS_CREDS", "NATS_CA", "NATS_CERT"}) {
    Process process({RAYTRACER_SERVER_PATH,
                     {"--port", "0", "--nats", "nats://127.0.0.1:1"},
                     "",
                     {{variable, "/nonexistent"}}});
    EXPECT_EQ(process.wait(std::chrono::seconds(5)), 1) << variable << process.err();
    EXPECT_NE(process.err().find(variable), std::string::npos) << process.err();
  }
}

TEST(ClusterFlags, server_alone_says_that_it_is) {
  const ServerProcess server;
  expect_problem(get(server, "/cluster"), 404, "--nats");
}

class ClusterRoutes : public ClusterTest {};

TEST_F(ClusterRoutes, worker_answers_for_itself_only) {
  const ServerProcess& worker = start_worker();
  for (const char* const path : {"/healthz", "/readyz", "/metrics", "/version"})
    EXPECT_EQ(get(worker, path).status, 200) << path;
  for (const char* const path :
       {"/", "/scenes", "/render?scene=demo", "/cluster", "/jobs/1", "/openapi.json"})
    EXPECT_EQ(get(worker, path).status, 404) << path;
  EXPECT_EQ(post(worker, "/jobs", small_scene).status, 404);
}

TEST_F(ClusterRoutes, cluster_names_its_members) {
  const ServerProcess& front = start_front();
  start_worker({"--threads", "3"});
  ASSERT_TRUE(has_workers(front, 1));
  ASSERT_TRUE(eventually([&] { return cluster_of(front).at("fronts").size() == 1; }));
  const nlohmann::json cluster = cluster_of(front);
  EXPECT_EQ(cluster.at("tasks"), (nlohmann::json{{"waiting", 0}, {"running", 0}}));
  EXPECT_EQ(cluster.at("redelivered"), 0);
  const nlohmann::json version = json_of(get(front, "/version"));
  for (const auto& [kind, threads] : {std::pair("workers", 3), std::pair("fronts", 1)}) {
    ASSERT_EQ(cluster.at(kind).size(), 1U) << cluster;
    const nlohmann::json& member = cluster.at(kind).at(0);
    EXPECT_NE(member.at("name"), "");
    EXPECT_EQ(member.at("build"), version.at("build_id"));
    EXPECT_EQ(member.at("instruction_set"), version.at("instruction_set"));
    EXPECT_EQ(member.at("renderer"), cluster.at("fronts").at(0).at("renderer"));
    EXPECT_EQ(member.at("threads"), threads);
    EXPECT_EQ(member.at("tasks_done"), 0);
    EXPECT_LT(member.at("last_heard_s"), 5);
  }
  EXPECT_EQ(get(front, "/render?scene=demo&samples=1&width=900&height=700").status, 200);
  EXPECT_TRUE(eventually([&] {
    std::uint64_t done = 0;
    const nlohmann::json now = cluster_of(front);
    for (const nlohmann::json& member : now.at("workers"))
      done += member.at("tasks_done").get<std::uint64_t>();
    return done > 0;
  }));
}

TEST_F(ClusterRoutes, job_that_waits_for_a_build_names_it_as_the_cluster_does) {
  const ServerProcess& front = start_front();
  ASSERT_TRUE(eventually([&] { return cluster_of(front).is_object(); }));
  const std::string job = post_job(front, "", small_scene);
  EXPECT_TRUE(eventually([&] {
    const nlohmann::json fronts = cluster_of(front).at("fronts");
    return !fronts.empty() &&
           json_of(get(front, job)).value("detail", "").find(fronts.at(0).at("renderer")) !=
               std::string::npos;
  })) << get(front, job).body;
}

}  // namespace
}  // namespace raytracer::test
