#include "server/request_log.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cstdio>
#include <ctime>
#include <random>
#include <utility>

namespace raytracer {
namespace {

/// On one line of a terminal, between quotes: no quotes, no control characters, no endless length.
std::string escaped(std::string_view text, char least = ' ') {
  constexpr std::size_t most = 200;
  std::string result;
  for (const char c : text.substr(0, most)) {
    if (c >= least && c < '\x7f' && c != '"' && c != '\\')
      result += c;
    else
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  }
  return text.size() > most ? result + "..." : result;
}

/// A client's text, as one word.
std::string word(std::string_view text) { return text.empty() ? "-" : escaped(text, '!'); }

/// What an id may be that comes from outside: it stands in the log and in the answer.
bool is_plain_id(std::string_view text) {
  constexpr std::size_t longest = 64;
  constexpr std::string_view allowed =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._:";
  return !text.empty() && text.size() <= longest &&
         text.find_first_not_of(allowed) == std::string_view::npos;
}

void print_line(std::string_view text) {
  // One write, so that lines of several threads do not mix.
  const std::string line =
      fmt::format("{:%Y-%m-%dT%H:%M:%SZ} {}\n", fmt::gmtime(std::time(nullptr)), text);
  std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace

RequestLog::RequestLog(bool quiet)
    : quiet_(quiet), id_prefix_(fmt::format("{:08x}", std::random_device()())) {}

std::string RequestLog::begin(const httplib::Request& request) {
  const std::scoped_lock lock(mutex_);
  const auto [entry, is_new] = open_.try_emplace(std::this_thread::get_id());
  if (is_new) {
    const std::string given = request.get_header_value("X-Request-Id");
    const std::uint64_t number = ++count_;
    entry->second = {is_plain_id(given) ? given : fmt::format("{}-{}", id_prefix_, number),
                     Clock::now()};
  }
  return entry->second.id;
}

double RequestLog::end(const httplib::Request& request, const httplib::Response& response) {
  Open ended{"-", Clock::now()};
  {
    const std::scoped_lock lock(mutex_);
    const auto entry = open_.find(std::this_thread::get_id());
    if (entry != open_.end()) {
      ended = std::move(entry->second);
      open_.erase(entry);
    }
    changed_.notify_all();
  }
  const std::chrono::duration<double> took = Clock::now() - ended.began;
  if (quiet_) return took.count();
  const std::string length = response.get_header_value("Content-Length");
  print_line(fmt::format("id={} request=\"{} {}\" status={} duration_ms={:.1f} bytes={} client={}",
                         ended.id, word(request.method), word(request.target), response.status,
                         took.count() * 1000, length.empty() ? "-" : length,
                         word(request.remote_addr)));
  return took.count();
}

void RequestLog::note(std::string_view text) {
  std::string id;
  {
    const std::scoped_lock lock(mutex_);
    const auto entry = open_.find(std::this_thread::get_id());
    if (entry != open_.end()) id = fmt::format("id={} ", entry->second.id);
  }
  print_line(fmt::format("{}note=\"{}\"", id, escaped(text)));
}

bool RequestLog::wait_until_empty(std::chrono::milliseconds timeout) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, timeout, [&] { return open_.empty(); });
}

}  // namespace raytracer
