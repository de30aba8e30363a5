// GET /metrics: Prometheus' text format, and that the figures are those of what happened.
#include "server/metrics.h"

#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "tests/process/patience.h"
#include "tests/process/program.h"
#include "tests/service/documents.h"
#include "tests/service/raw_connection.h"
#include "tests/service/service.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

/// Samples by "name{labels}".
using Samples = std::map<std::string, double>;

Samples samples_of(const std::string& text) {
  Samples samples;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#')) continue;
    const std::size_t space = line.rfind(' ');
    EXPECT_TRUE(samples.emplace(line.substr(0, space), std::stod(line.substr(space + 1))).second)
        << "twice: " << line;
  }
  return samples;
}

Samples scrape(const ServerProcess& server) { return samples_of(get(server, "/metrics").body); }

/// What the format and the naming rules ask of each family of samples.
class FormatRules {
 public:
  void check(const std::string& text) {
    EXPECT_TRUE(text.ends_with('\n'));
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) check_line(line);
  }

 private:
  void check_line(const std::string& line) {
    static const std::regex help("# HELP (raytracer_[a-z_]+) [A-Z].*\\.");
    static const std::regex type("# TYPE (raytracer_[a-z_]+) (counter|gauge|histogram)");
    static const std::regex sample(
        R"re((raytracer_[a-z_]+)(?:\{((?:[a-z_]+="(?:[^"\\]|\\.)*",?)+)\})? ([0-9.e+-]+))re");
    std::smatch match;
    if (std::regex_match(line, match, help)) {
      helped_ = match.str(1);
    } else if (std::regex_match(line, match, type)) {
      begin_family(match.str(1), match.str(2));
    } else if (std::regex_match(line, match, sample)) {
      check_sample(match.str(1), match.str(2), std::stod(match.str(3)));
    } else {
      ADD_FAILURE() << "not of the format: " << line;
    }
  }

  void begin_family(const std::string& name, const std::string& type) {
    EXPECT_EQ(name, helped_) << "HELP comes right before TYPE";
    EXPECT_TRUE(families_.insert(name).second) << name << " begins twice";
    EXPECT_EQ(name.ends_with("_total"), type == "counter") << name;
    name_ = name;
    type_ = type;
  }

  void check_sample(const std::string& name, const std::string& labels, double value) {
    if (type_ != "histogram") {
      EXPECT_EQ(name, name_);
      return;
    }
    const std::string part = name.substr(std::min(name.size(), name_.size()));
    EXPECT_TRUE(name.starts_with(name_) &&
                (part == "_bucket" || part == "_sum" || part == "_count"))
        << name << " is not in " << name_;
    if (part == "_bucket") {
      const std::string series = labels.substr(0, labels.find("le=\""));
      if (series != series_ || ends_with_infinity_) last_bucket_ = 0;
      EXPECT_GE(value, last_bucket_) << name << labels;
      series_ = series;
      last_bucket_ = value;
      ends_with_infinity_ = labels.find("le=\"+Inf\"") != std::string::npos;
    }
    if (part == "_count") {
      EXPECT_TRUE(ends_with_infinity_) << name;
      EXPECT_EQ(value, last_bucket_) << name;
    }
  }

  std::set<std::string> families_;
  std::string helped_;
  std::string name_;
  std::string type_;
  std::string series_;
  double last_bucket_ = 0;
  bool ends_with_infinity_ = false;
};

/// A server that has met most of what can happen.
class ServerMetrics : public testing::Test {
 protected:
  ServerMetrics() {
    post(server_, "/plan", small_scene);
    post(server_, "/render", small_scene);
    post(server_, "/render?width=5000&height=5000", small_scene);
    get(server_, "/nothing");
    const std::string job =
        post(server_, "/jobs?samples=3", small_scene).get_header_value("Location");
    EXPECT_TRUE(
        eventually([&] { return json_of(get(server_, job)).value("status", "") == "done"; }));
    get(server_, job + "/image");
    // A request is counted when its answer has gone, and another connection may be faster.
    const char* const last =
        R"(raytracer_http_requests_total{method="GET",route="/jobs/{id}/image",status="200"})";
    EXPECT_TRUE(eventually([&] { return scrape(server_)[last] == 1; }));
  }
  ServerProcess server_;
};

TEST_F(ServerMetrics, are_of_the_format) {
  const Answer answer = get(server_, "/metrics");
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(answer.get_header_value("Content-Type"), "text/plain; version=0.0.4; charset=utf-8");
  FormatRules().check(answer.body);
}

TEST_F(ServerMetrics, please_promtool) {
  if (run({"promtool", {"--version"}}).status == 127) GTEST_SKIP() << "there is no promtool here";
  const Outcome outcome = run({"promtool", {"check", "metrics"}, get(server_, "/metrics").body});
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.out + outcome.err, "");
}

TEST_F(ServerMetrics, count_requests_by_route_and_status) {
  Samples samples = scrape(server_);
  const auto requests = [&](const std::string& labels) {
    return samples["raytracer_http_requests_total{" + labels + "}"];
  };
  EXPECT_EQ(requests(R"(method="POST",route="/render",status="200")"), 1);
  EXPECT_EQ(requests(R"(method="POST",route="/render",status="413")"), 1);
  EXPECT_EQ(requests(R"(method="GET",route="/jobs/{id}/image",status="200")"), 1);
  EXPECT_EQ(requests(R"(method="other",route="none",status="404")"), 1);
  EXPECT_EQ(samples[R"(raytracer_http_requests_refused_total{status="413"})"], 1);
  EXPECT_EQ(samples[R"(raytracer_http_requests_refused_total{status="429"})"], 0);
  EXPECT_EQ(
      samples[R"(raytracer_http_request_duration_seconds_count{method="POST",route="/render"})"],
      2);
}

TEST_F(ServerMetrics, count_what_was_rendered) {
  Samples samples = scrape(server_);
  EXPECT_EQ(samples["raytracer_renders_total"], 2);
  EXPECT_EQ(samples["raytracer_pixels_rendered_total"], 2 * 12 * 8);
  EXPECT_EQ(samples["raytracer_samples_rendered_total"], (1 + 3) * 12 * 8);
  EXPECT_EQ(samples.at("raytracer_pixels_nan_total"), 0);
  EXPECT_EQ(samples["raytracer_queue_duration_seconds_count"], 3);  // a plan waits, too
  for (const char* const stage : {"plan", "build", "trace", "encode"}) {
    const std::string labels = std::string("{stage=\"") + stage + "\"}";
    EXPECT_EQ(samples["raytracer_stage_duration_seconds_count" + labels], 2) << stage;
    EXPECT_GT(samples["raytracer_stage_duration_seconds_sum" + labels], 0) << stage;
  }
  EXPECT_GE(samples[R"(raytracer_stage_duration_seconds_count{stage="parse"})"], 3);
  EXPECT_EQ(samples[R"(raytracer_jobs{status="done"})"], 1);
  EXPECT_EQ(samples[R"(raytracer_jobs{status="queued"})"], 0);
}

TEST_F(ServerMetrics, count_pixels_that_are_clamped) {
  const double before = scrape(server_).at("raytracer_pixels_clamped_total");
  nlohmann::json bright = nlohmann::json::parse(small_scene);
  bright["ambient"] = 1;
  bright["shadows"] = "off";
  bright["objects"] = {{{"type", "plane"}, {"point", {0, 0, 0}}, {"normal", {0, 0, 1}}}};
  bright["lights"] = {{{"type", "distant"}, {"direction", {0, 0, 1}}, {"intensity", 1}},
                      {{"type", "distant"}, {"direction", {0, 0, -1}}, {"intensity", 1}}};
  EXPECT_EQ(post(server_, "/render", bright.dump()).status, 200);
  EXPECT_GT(scrape(server_).at("raytracer_pixels_clamped_total"), before);
}

TEST_F(ServerMetrics, compare_the_prediction_with_what_came) {
  Samples samples = scrape(server_);
  EXPECT_EQ(samples["raytracer_trace_actual_to_predicted_ratio_count"], 1)
      << "of the two renders, one was planned";
  EXPECT_GT(samples["raytracer_trace_predicted_seconds_total"], 0);
  EXPECT_GT(samples["raytracer_trace_actual_seconds_total"], 0);
}

TEST_F(ServerMetrics, say_what_the_process_is_and_takes) {
  const Answer answer = get(server_, "/metrics");
  const nlohmann::json version = json_of(get(server_, "/version"));
  EXPECT_NE(answer.body.find(fmt::format(
                R"(raytracer_build_info{{version="{}",build_id="{}",instruction_set="{}"}} 1)",
                version.value("version", ""), version.value("build_id", ""),
                version.value("instruction_set", ""))),
            std::string::npos);
#ifdef __linux__
  Samples samples = samples_of(answer.body);
  EXPECT_GT(samples["raytracer_process_resident_memory_bytes"], 1e6);
  EXPECT_GT(samples["raytracer_process_threads"], 4);
#endif
}

TEST(MetricsOfAFullServer, are_answered_and_show_the_queue) {
  const ServerProcess server({"--threads", "1", "--max-queue", "1"});
  std::string job;
  for (int i = 0; i < 5; ++i)
    job = post(server, "/jobs", endless_scene()).get_header_value("Location");
  EXPECT_EQ(post(server, "/render", small_scene).status, 429);
  Samples full = scrape(server);
  EXPECT_EQ(full["raytracer_renders_running"], 4);
  EXPECT_EQ(full["raytracer_queue_length"], 1);
  EXPECT_EQ(full["raytracer_queue_limit"], 1);
  EXPECT_EQ(full[R"(raytracer_http_requests_refused_total{status="429"})"], 1);
  EXPECT_TRUE(eventually([&] {
    Samples samples = scrape(server);
    return samples[R"(raytracer_jobs{status="running"})"] == 4 &&
           samples[R"(raytracer_jobs{status="queued"})"] == 1;
  }));
  EXPECT_EQ(full["raytracer_renders_cancelled_total"], 0);
  EXPECT_EQ(request(server, "DELETE", job).status, 204);
  EXPECT_TRUE(eventually([&] { return scrape(server)["raytracer_renders_cancelled_total"] == 1; }));
  EXPECT_EQ(scrape(server)["raytracer_queue_length"], 0);
}

TEST(MetricsOfDisconnects, count_the_render_of_a_client_that_left) {
  const ServerProcess server({"--threads", "1"});
  {
    RawConnection client(server.port());
    client.send(
        fmt::format("POST /render HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
                    "Content-Length: {}\r\n\r\n{}",
                    endless_scene().size(), endless_scene()));
    ASSERT_TRUE(eventually([&] { return scrape(server)["raytracer_renders_running"] == 1; }));
  }
  EXPECT_TRUE(eventually([&] { return scrape(server)["raytracer_renders_cancelled_total"] == 1; }));
}

TEST(MetricsText, escapes_labels_and_counts_up_to_each_bound) {
  raytracer::Metrics metrics;
  for (const double seconds : {0.05, 0.1, 0.25, 5000.0})
    metrics.observe("http_request_duration_seconds", seconds, {"quote\" back\\ line\n", "/x"});
  const std::string text = metrics.text();
  const std::string name = "raytracer_http_request_duration_seconds";
  const std::string label = R"({method="quote\" back\\ line\n",route="/x")";
  for (const std::string& line : std::initializer_list<std::string>{
           "# TYPE " + name + " histogram\n", name + "_bucket" + label + ",le=\"0.03\"} 0\n",
           name + "_bucket" + label + ",le=\"0.1\"} 2\n",
           name + "_bucket" + label + ",le=\"0.3\"} 3\n",
           name + "_bucket" + label + ",le=\"+Inf\"} 4\n", name + "_sum" + label + "} 5000.4\n",
           name + "_count" + label + "} 4\n"})
    EXPECT_NE(text.find(line), std::string::npos) << line << text;
}

}  // namespace
}  // namespace raytracer::test
