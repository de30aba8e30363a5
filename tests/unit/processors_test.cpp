// The processor that a thread runs on, and how it gets off one.

#include "engine/parallel/processors.h"

#include <gtest/gtest.h>

#include <atomic>

#include "engine/parallel/worker_pool.h"
#ifdef __linux__
#include <sched.h>
#endif

namespace raytracer::test {
namespace {

#ifdef __linux__

/// What this thread may run on.
cpu_set_t allowed_processors() {
  cpu_set_t allowed;
  EXPECT_EQ(sched_getaffinity(0, sizeof allowed, &allowed), 0);
  return allowed;
}

TEST(LeaveProcessors, moves_to_another_and_may_run_on_all_again) {
  const cpu_set_t allowed = allowed_processors();
  if (CPU_COUNT(&allowed) < 2) GTEST_SKIP() << "there is one processor";
  // The scheduler may move the thread back between the two lines, though not time after time.
  bool moved = false;
  for (int i = 0; i < 50 && !moved; ++i) {
    const int before = current_processor();
    leave_processors({before});
    moved = current_processor() != before;
  }
  EXPECT_TRUE(moved);
  const cpu_set_t after = allowed_processors();
  EXPECT_TRUE(CPU_EQUAL(&after, &allowed));
}

TEST(LeaveProcessors, stays_where_all_are_busy) {
  const cpu_set_t before = allowed_processors();
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(static_cast<unsigned>(current_processor()), &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);  // of the first thread
  const int here = current_processor();
  leave_processors({here});
  EXPECT_EQ(current_processor(), here);
  const cpu_set_t after = allowed_processors();
  EXPECT_TRUE(CPU_EQUAL(&after, &one));
  EXPECT_EQ(sched_setaffinity(0, sizeof before, &before), 0);
}

TEST(LeaveProcessors, threads_of_a_pool_may_run_on_all) {
  const cpu_set_t allowed = allowed_processors();
  const std::atomic<bool> never{false};
  std::atomic<int> narrowed{0};
  WorkerPool pool(3);
  for (int batch = 0; batch < 200; ++batch)
    pool.run(
        8,
        [&](std::size_t) {
          const cpu_set_t own = allowed_processors();
          if (!CPU_EQUAL(&own, &allowed)) ++narrowed;
        },
        never);
  EXPECT_EQ(narrowed, 0);
}

#else

TEST(LeaveProcessors, does_nothing_where_processors_are_unknown) {
  EXPECT_EQ(current_processor(), -1);
  leave_processors({0});
}

#endif

}  // namespace
}  // namespace raytracer::test
