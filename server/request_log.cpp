#include "server/request_log.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cstdio>
#include <ctime>

namespace raytracer {
namespace {

/// A client's text on one line of a terminal: no control characters, no endless length.
std::string printable(std::string_view text) {
  constexpr std::size_t most = 200;
  std::string result;
  for (const char c : text.substr(0, most)) {
    if (c > ' ' && c < '\x7f')
      result += c;
    else
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  }
  if (text.size() > most) result += "...";
  return result.empty() ? "-" : result;
}

void print_line(std::string_view text) {
  // One write, so that lines of several threads do not mix.
  const std::string line =
      fmt::format("{:%Y-%m-%dT%H:%M:%SZ} {}\n", fmt::gmtime(std::time(nullptr)), text);
  std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace

void RequestLog::begin() {
  const std::scoped_lock lock(mutex_);
  began_.try_emplace(std::this_thread::get_id(), Clock::now());
}

void RequestLog::end(const httplib::Request& request, const httplib::Response& response) {
  std::chrono::duration<double, std::milli> took{0};
  {
    const std::scoped_lock lock(mutex_);
    const auto entry = began_.find(std::this_thread::get_id());
    if (entry != began_.end()) {
      took = Clock::now() - entry->second;
      began_.erase(entry);
    }
    changed_.notify_all();
  }
  if (quiet_) return;
  const std::string length = response.get_header_value("Content-Length");
  print_line(fmt::format("{} {} {} {:.1f} ms {} B", printable(request.method),
                         printable(request.target), response.status, took.count(),
                         length.empty() ? "0" : length));
}

void RequestLog::note(std::string_view text) { print_line(text); }

bool RequestLog::wait_until_empty(std::chrono::milliseconds timeout) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, timeout, [&] { return began_.empty(); });
}

}  // namespace raytracer
