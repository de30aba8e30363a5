// The pool: every task once, callers in turn, stops and exceptions.

#include "engine/parallel/worker_pool.h"

#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>

#ifdef __linux__
#include <sys/resource.h>
#endif

namespace raytracer::test {
namespace {

const std::atomic<bool> never{false};

TEST(WorkerPool, runs_each_index_once_on_any_number_of_threads) {
  for (const std::size_t threads : {1U, 2U, 3U, 8U}) {
    WorkerPool pool(threads);
    EXPECT_EQ(pool.thread_count(), threads);
    for (const std::size_t count : {0U, 1U, 2U, 7U, 1000U}) {
      std::vector<std::atomic<int>> calls(count);
      pool.run(
          count, [&](std::size_t i) { ++calls[i]; }, never);
      for (const auto& call : calls) EXPECT_EQ(call, 1);
    }
  }
}

TEST(WorkerPool, has_at_least_one_thread) {
  WorkerPool pool(0);
  EXPECT_EQ(pool.thread_count(), 1U);
  int calls = 0;
  pool.run(
      3, [&](std::size_t) { ++calls; }, never);
  EXPECT_EQ(calls, 3);
}

TEST(WorkerPool, serves_many_callers_at_once) {
  WorkerPool pool(2);
  constexpr std::size_t callers = 6;
  constexpr std::size_t count = 500;
  std::vector<std::vector<std::atomic<int>>> calls(callers);
  std::vector<std::thread> threads;
  for (auto& own : calls) {
    own = std::vector<std::atomic<int>>(count);
    threads.emplace_back([&] {
      for (int round = 0; round < 5; ++round)
        pool.run(
            count, [&](std::size_t i) { ++own[i]; }, never);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& own : calls)
    for (const auto& call : own) EXPECT_EQ(call, 5);
}

/// A caller of tasks that each take `task_ms`: for 20 s, far longer than what is tried beside it,
/// and an end if that had to wait for it.
class LongCaller {
 public:
  LongCaller(WorkerPool& pool, int task_ms)
      : thread_([this, &pool, task_ms] {
          pool.run(
              static_cast<std::size_t>(20'000 / task_ms),
              [&](std::size_t) {
                ++calls_;
                std::this_thread::sleep_for(std::chrono::milliseconds(task_ms));
              },
              stop_);
        }) {
    while (calls_ == 0) std::this_thread::yield();
  }
  ~LongCaller() {
    stop_ = true;
    thread_.join();
  }
  int calls() const { return calls_; }

 private:
  std::atomic<bool> stop_{false};
  std::atomic<int> calls_{0};
  std::thread thread_;
};

TEST(WorkerPool, short_batch_waits_for_one_long_task_and_not_for_one_before_each_of_its_own) {
  WorkerPool pool(1);
  const LongCaller long_caller(pool, 20);
  for (int round = 0; round < 5; ++round) {
    std::vector<int> long_calls_before;
    const int at_arrival = long_caller.calls();
    pool.run(
        10, [&](std::size_t) { long_calls_before.push_back(long_caller.calls()); }, never);
    ASSERT_EQ(long_calls_before.size(), 10U);
    // One may end just as the short batch arrives.
    EXPECT_LE(long_calls_before.front(), at_arrival + 1);
    EXPECT_EQ(long_calls_before.back(), long_calls_before.front()) << round;
  }
}

TEST(WorkerPool, stream_of_short_batches_leaves_a_long_one_its_share) {
  WorkerPool pool(1);
  const LongCaller long_caller(pool, 5);
  std::atomic<bool> is_over{false};
  std::atomic<int> short_calls{0};
  constexpr int stream_count = 3;  // several, so that one of them waits at any time
  std::vector<std::thread> streams;
  streams.reserve(stream_count);
  for (int i = 0; i < stream_count; ++i)
    streams.emplace_back([&] {
      while (!is_over)
        pool.run(
            4,
            [&](std::size_t) {
              ++short_calls;
              std::this_thread::sleep_for(std::chrono::milliseconds(1));
            },
            never);
    });
  const int before = long_caller.calls();
  std::this_thread::sleep_for(std::chrono::seconds(1));
  const int long_calls = long_caller.calls() - before;
  is_over = true;
  for (std::thread& stream : streams) stream.join();
  // A quarter of the time each is fair; what is asked holds on a machine with much else to do, too.
  EXPECT_GE(5 * long_calls, short_calls / 8);
  EXPECT_GE(short_calls, long_calls);
}

TEST(WorkerPool, runs_no_more_tasks_at_once_than_it_has_threads) {
  WorkerPool pool(2);
  const std::atomic<bool> stop{false};
  std::atomic<int> running{0};
  std::atomic<int> most{0};
  std::vector<std::thread> callers(4);
  for (std::thread& caller : callers)
    caller = std::thread([&] {
      for (int batch = 0; batch < 50; ++batch)
        pool.run(
            8,
            [&](std::size_t) {
              const int now = ++running;
              for (int before = most; before < now && !most.compare_exchange_weak(before, now);) {
              }
              std::this_thread::sleep_for(std::chrono::microseconds(20));
              --running;
            },
            stop);
    });
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(most, 2);
}

TEST(WorkerPool, caller_of_the_only_batch_works_on_it_too) {
  WorkerPool pool(1);
  const std::atomic<bool> stop{false};
  std::size_t own = 0;
  for (int batch = 0; batch < 1000 && own == 0; ++batch)
    pool.run(
        4,
        [&, caller = std::this_thread::get_id()](std::size_t) {
          if (std::this_thread::get_id() == caller) ++own;
        },
        stop);
  EXPECT_GT(own, 0U);
}

TEST(WorkerPool, in_the_background_leaves_its_callers_priority_alone) {
  WorkerPool pool(2, Priority::background);
  std::atomic<int> calls{0};
  const std::thread::id caller = std::this_thread::get_id();
#ifdef __linux__
  const int usual = getpriority(PRIO_PROCESS, 0);
#endif
  for (int batch = 0; batch < 100; ++batch)
    pool.run(4, [&](std::size_t) {
      ++calls;
      EXPECT_NE(std::this_thread::get_id(), caller);
#ifdef __linux__
      EXPECT_EQ(getpriority(PRIO_PROCESS, 0), std::min(usual + 10, 19));
#endif
    });
  EXPECT_EQ(calls, 400);
#ifdef __linux__
  EXPECT_EQ(getpriority(PRIO_PROCESS, 0), usual);
#endif
}

TEST(WorkerPool, begins_no_task_once_stop_is_set) {
  WorkerPool pool(2);
  std::atomic<bool> stop{false};
  std::atomic<int> calls{0};
  pool.run(
      10'000,
      [&](std::size_t i) {
        ++calls;
        if (i == 10) stop = true;
        while (i > 10 && !stop) std::this_thread::yield();
      },
      stop);
  // The other thread may have begun the next task before the flag was set.
  EXPECT_GE(calls, 11);
  EXPECT_LE(calls, 12);
  pool.run(
      5, [&](std::size_t) { ADD_FAILURE(); }, stop);
}

TEST(WorkerPool, stops_from_another_thread) {
  WorkerPool pool(2);
  std::atomic<bool> stop{false};
  std::atomic<int> calls{0};
  std::thread stopper([&] {
    while (calls < 4) std::this_thread::yield();
    stop = true;
  });
  pool.run(
      1'000'000,
      [&](std::size_t) {
        ++calls;
        std::this_thread::sleep_for(std::chrono::microseconds(100));
      },
      stop);
  stopper.join();
  EXPECT_LT(calls, 1'000'000);
}

TEST(WorkerPool, throws_a_tasks_exception_at_its_caller_and_serves_on) {
  WorkerPool pool(1);
  for (int round = 0; round < 20; ++round) {
    int calls = 0;
    EXPECT_THROW(pool.run(
                     1000,
                     [&](std::size_t i) {
                       ++calls;
                       if (i == 3) throw std::runtime_error("task");
                     },
                     never),
                 std::runtime_error);
    EXPECT_EQ(calls, 4);
    int next = 0;
    pool.run(
        10, [&](std::size_t) { ++next; }, never);
    EXPECT_EQ(next, 10);
  }
}

TEST(WorkerPool, begins_no_task_on_any_thread_once_one_has_thrown) {
  for (int round = 0; round < 20; ++round) {
    WorkerPool pool(2);
    std::atomic<bool> throws{false};
    std::atomic<bool> fourth_runs{false};
    std::atomic<bool> is_known{false};
    std::atomic<bool> is_over{false};
    // Of two places one is this task's, and one the fourth's, which waits: the one that threw has
    // told the pool.
    std::thread witness([&] {
      while (!is_over)
        pool.run(
            1,
            [&](std::size_t) {
              if (throws && fourth_runs) is_known = true;
            },
            never);
    });
    std::atomic<int> calls{0};
    EXPECT_THROW(pool.run(
                     1000,
                     [&](std::size_t i) {
                       ++calls;
                       if (i == 3) {
                         throws = true;
                         throw std::runtime_error("task");
                       }
                       if (i > 4) is_known = true;  // one too many: fail, do not hang
                       if (i == 4) fourth_runs = true;
                       while (i > 3 && !is_known) std::this_thread::yield();
                     },
                     never),
                 std::runtime_error);
    is_over = true;
    witness.join();
    // The other thread may have begun the next task before.
    EXPECT_GE(calls, 4);
    EXPECT_LE(calls, 5);
  }
}

TEST(WorkerPool, keeps_one_callers_exception_from_another) {
  WorkerPool pool(2);
  std::atomic<int> good{0};
  std::thread bad_caller([&] {
    for (int round = 0; round < 50; ++round)
      EXPECT_THROW(pool.run(
                       20, [](std::size_t) { throw std::runtime_error("bad"); }, never),
                   std::runtime_error);
  });
  for (int round = 0; round < 50; ++round)
    EXPECT_NO_THROW(pool.run(
        20, [&](std::size_t) { ++good; }, never));
  bad_caller.join();
  EXPECT_EQ(good, 1000);
}

TEST(WorkerPool, is_destroyed_idle_or_after_work) {
  for (int round = 0; round < 50; ++round) {
    WorkerPool idle(4);
    WorkerPool used(4);
    used.run(
        3, [](std::size_t) {}, never);
  }
}

}  // namespace
}  // namespace raytracer::test
