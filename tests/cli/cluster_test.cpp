// `raytracer cluster`, against servers that answer as a test wants.
#include <gtest/gtest.h>

#include <string>
#include <thread>

#include "tests/cli/client.h"

namespace raytracer::test {
namespace {

/// Answers GET /cluster with this status and body.
class Stub {
 public:
  Stub(int status, std::string body, const std::string& type = "application/json") {
    http_.Get("/cluster", [=](const httplib::Request&, httplib::Response& response) {
      response.status = status;
      response.set_content(body, type);
    });
    url_ = "http://127.0.0.1:" + std::to_string(http_.bind_to_any_port("127.0.0.1"));
    thread_ = std::thread([this] { http_.listen_after_bind(); });
  }
  ~Stub() {
    http_.stop();
    thread_.join();
  }
  Stub(const Stub&) = delete;
  Stub& operator=(const Stub&) = delete;

  const std::string& url() const { return url_; }

 private:
  httplib::Server http_;
  std::string url_;
  std::thread thread_;
};

TEST(ClusterCommand, prints_a_line_for_each_worker_and_the_tasks) {
  const Stub stub(200, R"({"workers": [
    {"name": "oak-1234", "build": "0123abc", "instruction_set": "AVX2", "threads": 16,
     "tasks_done": 1205, "last_heard_s": 0.42}], "fronts": [
    {"name": "elm-7", "build": "0123abc", "instruction_set": "AVX3", "threads": 2,
     "tasks_done": 0, "last_heard_s": 12.0}],
    "tasks": {"waiting": 3, "running": 2}, "redelivered": 1})");
  const Outcome outcome = run_client({"cluster", "--server", stub.url()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out,
            "worker    build    instructions  threads  tasks done  last heard\n"
            "oak-1234  0123abc  AVX2          16       1205        0.4 s ago\n"
            "elm-7     0123abc  AVX3          2        takes none  12.0 s ago\n"
            "tasks: 3 waiting, 2 running, 1 redelivered\n");
}

TEST(ClusterCommand, says_why_a_server_is_none) {
  const Stub stub(404, R"({"status": 404, "detail": "This server works alone; see --nats"})",
                  "application/problem+json");
  const Outcome outcome = run_client({"cluster", "--server", stub.url()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find("This server works alone; see --nats"), std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find(stub.url()), std::string::npos) << outcome.err;
}

TEST(ClusterCommand, asks_for_a_server) { expect_input_error(run_client({"cluster"}), "--server"); }

TEST(ClusterCommand, asks_the_server_that_the_environment_names) {
  const Stub stub(404, R"({"status": 404, "detail": "asked"})", "application/problem+json");
  const Outcome outcome = run_client({"cluster"}, "", {{"RAYTRACER_SERVER", stub.url()}});
  EXPECT_NE(outcome.err.find("asked"), std::string::npos) << outcome.err;
}

TEST(ClusterCommand, answer_of_something_else_is_status_2) {
  for (const char* const body :
       {R"({"workers": []})", R"({"workers": 3, "tasks": {}, "redelivered": 0})",
        R"({"workers": [{"name": 5}], "tasks": {"waiting": 0, "running": 0}, "redelivered": 0})",
        "[]", "<html>hello</html>"}) {
    const Stub stub(200, body);
    const Outcome outcome = run_client({"cluster", "--server", stub.url()});
    EXPECT_EQ(outcome.status, 2) << body;
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find(stub.url()), std::string::npos) << outcome.err;
  }
}

}  // namespace
}  // namespace raytracer::test
