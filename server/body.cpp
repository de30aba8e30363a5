#include "server/body.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <iterator>
#include <optional>

#include "engine/engine.h"
#include "server/problem.h"

namespace raytracer {
namespace {

/// Digits only; one that no int64 holds is as good as the largest.
std::optional<std::int64_t> read_length(std::string_view text) {
  if (text.empty() || text.find_first_not_of("0123456789") != std::string_view::npos) return {};
  std::int64_t length = INT64_MAX;
  std::from_chars(text.data(), text.data() + text.size(), length);
  return length;
}

/// Room for `count` more bytes of a body that shall have `length`, and for the reader behind them.
/// In few large steps, because what is there is held twice while it grows: an eighth of the whole
/// at most, since the step from there is to the whole. Room that is not written takes no memory.
void make_room(std::string& body, std::size_t count, std::size_t length) {
  constexpr std::size_t first_room = 65'536;
  constexpr std::size_t growth = 8;
  const std::size_t needed = body.size() + count;
  if (needed + DocumentText::read_ahead <= body.capacity()) return;
  const std::size_t room = std::max({first_room, needed, growth * body.size()});
  body.reserve((room > length / growth ? length : room) + DocumentText::read_ahead);
}

}  // namespace

bool announces_body(const httplib::Request& request) {
  const auto [begin, end] = request.headers.equal_range("Content-Length");
  return request.has_header("Transfer-Encoding") ||
         std::any_of(begin, end, [](const auto& field) { return field.second != "0"; });
}

std::optional<std::int64_t> body_length(const httplib::Request& request) {
  const auto [begin, end] = request.headers.equal_range("Content-Length");
  if (begin == end) return {};
  const std::optional<std::int64_t> length = read_length(begin->second);
  if (!length || std::next(begin) != end) refuse(400, "Content-Length must be one number of bytes");
  return length;
}

std::string read_body(Call& call, std::int64_t length, Quota::Portion& memory) {
  using Clock = std::chrono::steady_clock;
  constexpr std::int64_t bytes_per_s = 1'000'000;
  const auto deadline = Clock::now() + std::chrono::seconds(30 + length / bytes_per_s);
  std::string body;
  const bool is_complete = (*call.content)([&](const char* bytes, std::size_t count) {
    // What is only announced costs nobody else anything.
    memory.add(static_cast<std::int64_t>(count));
    make_room(body, count, static_cast<std::size_t>(length));
    body.append(bytes, count);
    return Clock::now() < deadline;
  });
  if (!is_complete || static_cast<std::int64_t>(body.size()) != length)
    refuse(408, fmt::format("Only {} of the body's {} bytes arrived in time", body.size(), length));
  call.body_was_read = true;
  return body;
}

}  // namespace raytracer
