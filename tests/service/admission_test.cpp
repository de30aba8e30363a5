// Who may render: a few at once, a bounded queue, then 429.
#include "server/admission.h"

#include <gtest/gtest.h>

#include <chrono>
#include <regex>
#include <string>
#include <thread>
#include <vector>

#include "server/problem.h"
#include "tests/process/patience.h"
#include "tests/service/documents.h"
#include "tests/service/service.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

/// A server whose places, running and waiting, are all taken by jobs that would take minutes.
class FullServer : public testing::Test {
 protected:
  FullServer() : server_({"--threads", "1", "--max-queue", "2"}) {
    for (;;) {
      const Answer answer = post(server_, "/jobs", endless_scene());
      if (answer.status != 202) break;
      jobs_.push_back(answer.get_header_value("Location"));
    }
  }
  ServerProcess server_;
  std::vector<std::string> jobs_;
};

TEST_F(FullServer, further_render_is_429_with_the_time_to_wait) {
  EXPECT_GE(jobs_.size(), 3U);
  const Answer refused = post(server_, "/render", small_scene);
  expect_problem(refused, 429, "--max-queue");
  static const std::regex seconds("[1-9][0-9]*");
  EXPECT_TRUE(std::regex_match(refused.get_header_value("Retry-After"), seconds));
}

TEST(Admission, predicts_by_what_renders_that_run_have_done) {
  Admission admission(1, 1);
  RenderProgress running;
  const Admission::Slot slot(admission, running);
  running.fraction = 0.02;
  std::this_thread::sleep_for(100ms);
  EXPECT_GE(admission.retry_after_s(), 5);
  RenderProgress waiting;
  const Admission::Slot next(admission, waiting);
  EXPECT_GE(admission.retry_after_s(), 10);
  running.fraction = 0.001;  // so little tells nothing
  std::this_thread::sleep_for(1100ms);
  EXPECT_GE(admission.retry_after_s(), 3);
  running.fraction = 1;
  EXPECT_LE(admission.retry_after_s(), 3);
}

TEST(Admission, those_who_wait_for_others_fill_it_and_tell_how_long) {
  Admission admission(1, 1);
  EXPECT_FALSE(admission.is_full());
  RenderProgress elsewhere;
  const auto waiter = admission.add_waiter(elsewhere);
  EXPECT_TRUE(admission.is_full()) << "another would be refused";
  elsewhere.fraction = 0.02;
  std::this_thread::sleep_for(100ms);
  EXPECT_GE(admission.retry_after_s(), 5);
  RenderProgress another;
  EXPECT_THROW(admission.add_waiter(another), HttpError);
}

TEST(Admission, without_a_queue_is_full_only_while_somebody_runs) {
  Admission admission(1, 0);
  EXPECT_FALSE(admission.is_full());
  RenderProgress running;
  const Admission::Slot slot(admission, running);
  EXPECT_TRUE(admission.is_full());
}

TEST_F(FullServer, is_healthy_but_not_ready) {
  EXPECT_EQ(get(server_, "/healthz").status, 200);
  EXPECT_EQ(get(server_, "/readyz").status, 503);
}

TEST_F(FullServer, still_answers_what_needs_no_rendering) {
  EXPECT_EQ(get(server_, "/scenes").status, 200);
  EXPECT_EQ(get(server_, "/").status, 200);
  EXPECT_EQ(post(server_, "/render", "{}").status, 422);
  EXPECT_EQ(post(server_, "/render", small_scene, {{"If-None-Match", "*"}}).status, 304);
}

TEST_F(FullServer, takes_work_again_when_there_is_room) {
  for (const std::string& job : jobs_) EXPECT_EQ(request(server_, "DELETE", job).status, 204);
  EXPECT_TRUE(eventually([&] { return post(server_, "/render", small_scene).status == 200; }, 5s));
  EXPECT_EQ(get(server_, "/readyz").status, 200);
}

TEST_F(FullServer, refusal_is_quick) {
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 20; ++i) EXPECT_EQ(post(server_, "/render", small_scene).status, 429);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, patience(2s));
}

}  // namespace
}  // namespace raytracer::test
