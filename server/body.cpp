#include "server/body.h"

#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <iterator>
#include <optional>

#include "engine/engine.h"
#include "server/problem.h"
#include "server/request_text.h"

namespace raytracer {
namespace {

[[noreturn]] void refuse(int status, std::string detail) {
  throw HttpError({status, std::move(detail)});
}

/// Digits only; one that no int64 holds is as good as the largest.
std::optional<std::int64_t> read_length(std::string_view text) {
  if (text.empty() || text.find_first_not_of("0123456789") != std::string_view::npos) return {};
  std::int64_t length = INT64_MAX;
  std::from_chars(text.data(), text.data() + text.size(), length);
  return length;
}

/// Nothing if there is no Content-Length; 400 if there are several or it is no number.
std::optional<std::int64_t> announced_length(const httplib::Request& request) {
  const auto [begin, end] = request.headers.equal_range("Content-Length");
  if (begin == end) return {};
  const std::optional<std::int64_t> length = read_length(begin->second);
  if (!length || std::next(begin) != end) refuse(400, "Content-Length must be one number of bytes");
  return length;
}

bool is_json(const httplib::Request& request) {
  const std::string type = request.get_header_value("Content-Type");
  return lower_case(trimmed(std::string_view(type).substr(0, type.find(';')))) ==
         "application/json";
}

}  // namespace

bool announces_body(const httplib::Request& request) {
  return request.has_header("Transfer-Encoding") ||
         (request.has_header("Content-Length") &&
          request.get_header_value("Content-Length") != "0");
}

void require_no_body(const httplib::Request& request) {
  if (announces_body(request))
    refuse(400, fmt::format("{} takes no body here; send it without one", request.method));
}

void require_scene_body(const httplib::Request& request, std::int64_t most_bytes) {
  if (request.has_header("Transfer-Encoding"))
    refuse(411, "Bodies must come with a Content-Length, not with Transfer-Encoding");
  const std::string coding = header_list(request, "Content-Encoding");
  if (!coding.empty() && lower_case(coding) != "identity")
    refuse(415, fmt::format("Content-Encoding \"{}\" is not supported; send the scene as it is",
                            coding));
  const std::optional<std::int64_t> length = announced_length(request);
  if (request.has_param("scene")) {
    if (length.value_or(0) > 0)
      refuse(400, "The query names a scene and the body is one: send one of them only");
    return;
  }
  if (!length) refuse(411, "Content-Length is missing: send a scene as the body, or name ?scene=");
  if (*length > most_bytes)
    refuse(413, fmt::format("The body has {} bytes, but this server accepts {} ({})", *length,
                            most_bytes, row_of(&Limits::body).flag));
  if (!is_json(request))
    refuse(415,
           "The body must be a scene with Content-Type: application/json "
           "(curl: -H 'Content-Type: application/json')");
}

std::int64_t body_length(const httplib::Request& request) {
  return announced_length(request).value_or(0);
}

std::string read_body(Call& call, std::int64_t length) {
  using Clock = std::chrono::steady_clock;
  constexpr std::int64_t bytes_per_s = 1'000'000;
  const auto deadline = Clock::now() + std::chrono::seconds(30 + length / bytes_per_s);
  std::string body;
  body.reserve(static_cast<std::size_t>(
      length));  // growing, it would be held twice; what does not arrive is not written
  const bool is_complete = (*call.content)([&](const char* bytes, std::size_t count) {
    body.append(bytes, count);
    return Clock::now() < deadline;
  });
  if (!is_complete || static_cast<std::int64_t>(body.size()) != length)
    refuse(408, fmt::format("Only {} of the body's {} bytes arrived in time", body.size(), length));
  call.body_was_read = true;
  return body;
}

}  // namespace raytracer
