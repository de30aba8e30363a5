// The pool: every task once, callers in turn, stops and exceptions.

#include "engine/parallel/worker_pool.h"

#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>

namespace raytracer::test {
namespace {

const std::atomic<bool> never{false};

TEST(WorkerPool, RunsEachIndexOnceOnAnyNumberOfThreads) {
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

TEST(WorkerPool, HasAtLeastOneThread) {
  WorkerPool pool(0);
  EXPECT_EQ(pool.thread_count(), 1U);
  int calls = 0;
  pool.run(
      3, [&](std::size_t) { ++calls; }, never);
  EXPECT_EQ(calls, 3);
}

TEST(WorkerPool, ServesManyCallersAtOnce) {
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

TEST(WorkerPool, LetsAShortBatchPassALongOne) {
  WorkerPool pool(1);
  std::atomic<int> long_done{0};
  std::atomic<bool> long_began{false};
  constexpr int long_count = 400;
  std::thread long_caller([&] {
    pool.run(
        long_count,
        [&](std::size_t) {
          long_began = true;
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
          ++long_done;
        },
        never);
  });
  while (!long_began) std::this_thread::yield();
  pool.run(
      5, [](std::size_t) {}, never);
  EXPECT_LT(long_done, long_count / 2);
  long_caller.join();
  EXPECT_EQ(long_done, long_count);
}

TEST(WorkerPool, BeginsNoTaskOnceStopIsSet) {
  WorkerPool pool(2);
  std::atomic<bool> stop{false};
  std::atomic<int> calls{0};
  pool.run(
      10'000,
      [&](std::size_t i) {
        ++calls;
        if (i == 10) stop = true;
      },
      stop);
  EXPECT_GE(calls, 11);
  EXPECT_LE(calls, 20);
  pool.run(
      5, [&](std::size_t) { ADD_FAILURE(); }, stop);
}

TEST(WorkerPool, StopsFromAnotherThread) {
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

TEST(WorkerPool, ThrowsATasksExceptionAtItsCallerAndServesOn) {
  WorkerPool pool(2);
  for (int round = 0; round < 20; ++round) {
    std::atomic<int> calls{0};
    EXPECT_THROW(pool.run(
                     1000,
                     [&](std::size_t i) {
                       ++calls;
                       if (i == 3) throw std::runtime_error("task");
                     },
                     never),
                 std::runtime_error);
    EXPECT_LT(calls, 1000);
    std::atomic<int> next{0};
    pool.run(
        10, [&](std::size_t) { ++next; }, never);
    EXPECT_EQ(next, 10);
  }
}

TEST(WorkerPool, KeepsOneCallersExceptionFromAnother) {
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

TEST(WorkerPool, IsDestroyedIdleOrAfterWork) {
  for (int round = 0; round < 50; ++round) {
    WorkerPool idle(4);
    WorkerPool used(4);
    used.run(
        3, [](std::size_t) {}, never);
  }
}

}  // namespace
}  // namespace raytracer::test
