// Who counts as silent: by what was heard while one looked on, whatever clocks say.
#include "server/cluster/members.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <thread>
#include <vector>

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

std::vector<Member> heard(std::int64_t one_ms, std::int64_t other_ms) {
  std::vector<Member> members(2);
  members[0].name = "one";
  members[0].heard_ms = one_ms;
  members[1].name = "other";
  members[1].heard_ms = other_ms;
  return members;
}

class AttendanceTest : public testing::Test {
 protected:
  /// Looks for so long, while only "other" has a heartbeat.
  void look_on(std::chrono::milliseconds how_long) {
    const auto end = std::chrono::steady_clock::now() + how_long;
    while (std::chrono::steady_clock::now() < end) {
      attendance_.look(heard(one_ms_, ++other_ms_));
      std::this_thread::sleep_for(1ms);
    }
  }

  static constexpr std::chrono::milliseconds longest_silence{400};
  Attendance attendance_{longest_silence};
  std::int64_t one_ms_ = 1'000;
  std::int64_t other_ms_ = 9'000'000'000;  // whoever stamps it: it only has to change
};

TEST_F(AttendanceTest, silent_is_who_gave_no_sign_for_long) {
  look_on(longest_silence / 4);
  EXPECT_FALSE(attendance_.is_silent("one"));
  look_on(longest_silence);
  EXPECT_TRUE(attendance_.is_silent("one"));
  EXPECT_FALSE(attendance_.is_silent("other"));
  ++one_ms_;
  look_on(1ms);
  EXPECT_FALSE(attendance_.is_silent("one"));
}

TEST_F(AttendanceTest, who_is_not_there_has_as_long_to_come) {
  look_on(1ms);
  EXPECT_FALSE(attendance_.is_silent("third"));
  look_on(longest_silence / 4);
  EXPECT_FALSE(attendance_.is_silent("third"));
  look_on(longest_silence);
  EXPECT_TRUE(attendance_.is_silent("third"));
}

TEST_F(AttendanceTest, whoever_could_not_look_concludes_nothing) {
  look_on(longest_silence * 5 / 4);
  ASSERT_TRUE(attendance_.is_silent("one"));
  attendance_.interrupt();
  look_on(1ms);
  EXPECT_FALSE(attendance_.is_silent("one"));
  look_on(longest_silence * 5 / 4);
  ASSERT_TRUE(attendance_.is_silent("one"));
  std::this_thread::sleep_for(2100ms);  // as one that was stopped
  look_on(1ms);
  EXPECT_FALSE(attendance_.is_silent("one"));
}

}  // namespace
}  // namespace raytracer::test
