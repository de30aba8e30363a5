#include "client/formats/threads.h"

#include <algorithm>
#include <future>
#include <thread>
#include <vector>

namespace raytracer::client {

std::size_t useful_threads() {
  constexpr std::size_t most = 8;  // what one thread does besides is the longest then
  static const std::size_t threads =
      std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, most);
  return threads;
}

void in_threads(std::size_t count, const std::function<void(std::size_t)>& work) {
  if (count == 0) return;
  std::vector<std::future<void>> others;  // each waits for its own, if this is left early
  for (std::size_t i = 0; i + 1 < count; ++i)
    others.push_back(
        std::async(std::launch::async | std::launch::deferred, [&work, i] { work(i); }));
  work(count - 1);
  for (std::future<void>& other : others) other.get();
}

}  // namespace raytracer::client
