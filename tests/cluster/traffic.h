// Clients that ask all the time, and note what fails.
#pragma once

#include <httplib.h>

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace raytracer::test {

/// Requests from many connections at once, each as soon as the former is answered, until it ends.
class Traffic {
 public:
  using Send = std::function<httplib::Result(httplib::Client&, int number)>;

  Traffic(int connections, const std::function<httplib::Client()>& connect, const Send& send);
  ~Traffic() { end(); }
  Traffic(const Traffic&) = delete;
  Traffic& operator=(const Traffic&) = delete;

  /// Returns after so many answers more; false if they take too long.
  bool go_on(int count) const;
  /// A line for each request that failed.
  std::string end();
  int answered() const { return answered_; }

 private:
  std::atomic<bool> over_{false};
  std::atomic<int> sent_{0};
  std::atomic<int> answered_{0};
  std::mutex mutex_;
  std::string failed_;
  std::vector<std::thread> threads_;
};

}  // namespace raytracer::test
