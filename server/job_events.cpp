#include "server/job_events.h"

#include <fmt/format.h>

#include <chrono>
#include <exception>
#include <optional>
#include <string_view>
#include <utility>

#include "server/connection.h"

namespace raytracer {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds between_looks{100};
constexpr std::chrono::seconds longest_silence{5};  // proxies end what is silent for 30 or 60

/// One client's view of one job.
struct EventStream {
  Quota::Share share;
  std::shared_ptr<const Job> job;
  std::function<std::string(const Job&)> describe;
  int socket;
  std::optional<std::pair<JobStatus, double>> shown{};
  Clock::time_point written{};

  /// Writes what there is to say and waits a little; false if nobody listens any more, or what the
  /// job is like cannot be found out: whoever asks for the job is told why.
  bool step(httplib::DataSink& sink) try {
    if (client_has_disconnected(socket)) return false;
    const JobState state = job->state();
    if (has_ended(state.status)) {
      if (!write(sink, event(name_of(state.status)))) return false;
      sink.done();
      return true;
    }
    const std::pair now{state.status, state.progress};
    if (now != shown) {
      if (!write(sink, event("progress"))) return false;
      shown = now;
    } else if (Clock::now() - written >= longest_silence) {
      if (!write(sink, ": nothing new\n\n")) return false;
    }
    job->wait_for_end(between_looks);
    return true;
  } catch (const std::exception&) {
    return false;
  }

  std::string event(std::string_view name) const {
    return fmt::format("event: {}\ndata: {}\n\n", name, describe(*job));
  }

  bool write(httplib::DataSink& sink, const std::string& text) {
    written = Clock::now();
    return sink.write(text.data(), text.size());
  }
};

}  // namespace

void answer_events(Call& call, Quota& streams, std::shared_ptr<const Job> job,
                   std::function<std::string(const Job&)> describe) {
  constexpr const char* media_type = "text/event-stream";
  call.response.status = 200;
  if (call.is_head()) return call.response.set_header("Content-Type", media_type);
  const auto stream = std::make_shared<EventStream>(
      EventStream{streams.take(1), std::move(job), std::move(describe), find_socket(call.request)});
  const auto next = [stream](std::size_t, httplib::DataSink& sink) { return stream->step(sink); };
  if (call.request.version != "HTTP/1.0")
    return call.response.set_chunked_content_provider(media_type, next);
  // It knows no chunks: the end is that of the connection.
  call.response.set_header("Connection", "close");
  call.response.set_content_provider(media_type, next);
}

}  // namespace raytracer
