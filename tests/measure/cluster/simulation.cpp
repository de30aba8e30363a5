#include "tests/measure/cluster/simulation.h"

#include <algorithm>
#include <queue>
#include <random>

namespace raytracer::measure {
namespace {

/// Serves one after the other.
class Resource {
 public:
  /// When it is done with what arrives at `now_ms`.
  double serve(double now_ms, double takes_ms) {
    free_ms_ = std::max(free_ms_, now_ms) + takes_ms;
    busy_ms_ += takes_ms;
    return free_ms_;
  }
  double busy_ms() const { return busy_ms_; }

 private:
  double free_ms_ = 0;
  double busy_ms_ = 0;
};

enum class Kind { join, ask, done, arrived, stored, loss, task_again };

struct Event {
  double at_ms;
  Kind kind;
  std::size_t worker;
  std::uint64_t life;  ///< the worker's: what a lost one would have done does not happen
  double task_ms = 0;  ///< of the result that is on its way
  bool operator>(const Event& other) const { return at_ms > other.at_ms; }
};

/// Has two tasks at once: one is traced while the other's result travels.
struct Worker {
  std::uint64_t life = 0;
  bool is_there = false;
  double since_ms = 0;
  std::size_t task_count = 0;  ///< that it has and has not traced
  Resource thread{};
};

class Simulation {
 public:
  Simulation(const ClusterCosts& costs, const Losses& losses, std::size_t workers,
             std::size_t tasks, std::uint64_t seed)
      : costs_(costs),
        losses_(losses),
        workers_(workers),
        waiting_(tasks),
        left_(tasks),
        random_(seed) {}

  SimulatedJob run() {
    for (std::size_t i = 0; i < workers_.size(); ++i) events_.push({0, Kind::join, i, 0});
    events_.push({losses_.every_ms, Kind::loss, 0, 0});
    while (left_ > 0) {
      const Event event = events_.top();
      events_.pop();
      happen(event);
    }
    for (const Worker& worker : workers_)
      if (worker.is_there) present_ms_ += end_ms_ - worker.since_ms;
    return {workers_.size(),           end_ms_,
            traced_ms_ / present_ms_,  lost_,
            nats_.busy_ms() / end_ms_, std::max(in_.busy_ms(), out_.busy_ms()) / end_ms_,
            front_.busy_ms() / end_ms_};
  }

 private:
  void happen(const Event& event) {
    Worker& worker = workers_[event.worker];
    switch (event.kind) {
      case Kind::join: {
        worker.is_there = true;
        worker.since_ms = event.at_ms;
        const double came_ms =
            out_.serve(event.at_ms, costs_.scene_bytes / costs_.link_bytes_per_ms);
        for (int i = 0; i < 2; ++i)
          events_.push({came_ms + costs_.scene_ready_ms, Kind::ask, event.worker, worker.life});
        return;
      }
      case Kind::ask:
        if (event.life == worker.life) give_task(event.worker, event.at_ms);
        return;
      case Kind::done:
        if (event.life != worker.life) return;
        --worker.task_count;
        events_.push({in_.serve(event.at_ms, transfer_ms()), Kind::arrived, event.worker,
                      event.life, event.task_ms});
        return;
      case Kind::arrived: {
        const double stored_ms = nats_.serve(event.at_ms, costs_.nats_ms / 2);
        events_.push({stored_ms, Kind::stored, event.worker, event.life, event.task_ms});
        events_.push({stored_ms, Kind::ask, event.worker, event.life});
        return;
      }
      case Kind::stored:
        end_ms_ = front_.serve(out_.serve(event.at_ms, transfer_ms()), costs_.front_ms);
        traced_ms_ += event.task_ms;
        --left_;
        return;
      case Kind::loss:
        lose_someone(event.at_ms);
        events_.push({event.at_ms + losses_.every_ms, Kind::loss, 0, 0});
        return;
      case Kind::task_again:
        ++waiting_;
        if (!idle_.empty()) {
          const std::size_t next = idle_.back();
          idle_.pop_back();
          events_.push({event.at_ms, Kind::ask, next, workers_[next].life});
        }
        return;
    }
  }

  void give_task(std::size_t index, double now_ms) {
    if (waiting_ == 0) return idle_.push_back(index);
    --waiting_;
    Worker& worker = workers_[index];
    const std::size_t drawn =
        std::uniform_int_distribution<std::size_t>(0, costs_.task_ms.size() - 1)(random_);
    const double task_ms = costs_.task_ms[drawn];
    ++worker.task_count;
    const double taken_ms = nats_.serve(now_ms, costs_.nats_ms / 2);
    events_.push({worker.thread.serve(taken_ms, costs_.worker_ms + task_ms), Kind::done, index,
                  worker.life, task_ms});
  }

  double transfer_ms() const { return costs_.result_bytes / costs_.link_bytes_per_ms; }

  void lose_someone(double now_ms) {
    const std::size_t index =
        std::uniform_int_distribution<std::size_t>(0, workers_.size() - 1)(random_);
    Worker& worker = workers_[index];
    if (!worker.is_there) return;
    lost_ += worker.task_count;
    for (std::size_t i = 0; i < worker.task_count; ++i)
      events_.push({now_ms + losses_.timeout_ms, Kind::task_again, 0, 0});
    std::erase(idle_, index);
    present_ms_ += now_ms - worker.since_ms;
    worker = {.life = worker.life + 1};
    events_.push({now_ms + losses_.replaced_ms, Kind::join, index, worker.life});
  }

  const ClusterCosts& costs_;
  const Losses& losses_;
  std::vector<Worker> workers_;
  std::vector<std::size_t> idle_;
  std::size_t waiting_;
  std::size_t left_;
  std::size_t lost_ = 0;
  double traced_ms_ = 0;
  double present_ms_ = 0;  ///< of all workers
  double end_ms_ = 0;
  Resource nats_, in_, out_, front_;
  std::priority_queue<Event, std::vector<Event>, std::greater<>> events_;
  std::mt19937_64 random_;
};

}  // namespace

SimulatedJob simulate(const ClusterCosts& costs, const Losses& losses, std::size_t workers,
                      std::size_t tasks, std::uint64_t seed) {
  return Simulation(costs, losses, workers, tasks, seed).run();
}

}  // namespace raytracer::measure
