#include "tests/cluster/traffic.h"

#include <fmt/format.h>

#include <chrono>

#include "tests/process/patience.h"

namespace raytracer::test {

Traffic::Traffic(int connections, const std::function<httplib::Client()>& connect,
                 const Send& send) {
  for (int i = 0; i < connections; ++i)
    threads_.emplace_back([this, connect, send] {
      httplib::Client client = connect();
      while (!over_) {
        const int number = ++sent_;
        const httplib::Result answer = send(client, number);
        ++answered_;
        if (answer && answer->status == 200) continue;
        const std::scoped_lock lock(mutex_);
        failed_ += fmt::format("{}: {}\n", number,
                               answer ? std::to_string(answer->status) + " " + answer->body
                                      : httplib::to_string(answer.error()));
      }
    });
}

bool Traffic::go_on(int count) const {
  const int wanted = answered_ + count;
  return eventually([&] { return answered_ >= wanted; }, std::chrono::seconds(60));
}

std::string Traffic::end() {
  over_ = true;
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
  return failed_;
}

}  // namespace raytracer::test
