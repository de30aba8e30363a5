// What counts of a time that is measured again and again.
#include "tests/measure/tradeoff/settled_time.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace raytracer::published {
namespace {

/// The times of one run after another, the last of them again and again.
struct Runs {
  std::vector<double> times_ms;
  std::size_t count = 0;

  double settled() {
    return settled_ms([this] {
      const double time_ms = times_ms[count < times_ms.size() ? count : times_ms.size() - 1];
      ++count;
      return time_ms;
    });
  }
};

TEST(SettledTime, first_run_does_not_count) {
  Runs runs{{500, 30}};
  EXPECT_EQ(runs.settled(), 30);
  EXPECT_EQ(runs.count, 2U);
}

TEST(SettledTime, of_long_runs_is_that_of_the_first) {
  Runs runs{{1000, 30}};
  EXPECT_EQ(runs.settled(), 1000);
  EXPECT_EQ(runs.count, 1U);
}

TEST(SettledTime, of_short_runs_is_their_median) {
  Runs runs{{7, 9, 1, 2, 4}};
  EXPECT_EQ(runs.settled(), 4);  // of 9, 1, 2, 4 and 4
  EXPECT_EQ(runs.count, 6U);
}

TEST(SettledTime, of_no_time_at_all_is_found) {
  Runs runs{{0}};
  EXPECT_EQ(runs.settled(), 0);
}

}  // namespace
}  // namespace raytracer::published
