#include "server/event_streams.h"

#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <string_view>
#include <utility>

#include "server/connection.h"
#include "server/problem.h"

namespace raytracer {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds between_looks{100};
constexpr std::chrono::seconds longest_silence{5};  // proxies end what is silent for 30 or 60

/// One client's view of one job.
class EventStream {
 public:
  EventStream(EventStreams::Slot slot, std::shared_ptr<const Job> job,
              std::function<std::string(const Job&)> describe, int socket)
      : slot_(std::move(slot)),
        job_(std::move(job)),
        describe_(std::move(describe)),
        socket_(socket) {}

  /// Writes what there is to say and waits a little; false if nobody listens any more.
  bool step(httplib::DataSink& sink) {
    if (client_has_disconnected(socket_)) return false;
    const JobState state = job_->state();
    if (has_ended(state.status)) {
      if (!write(sink, event(name_of(state.status)))) return false;
      sink.done();
      return true;
    }
    const std::pair shown{state.status, state.progress};
    if (shown != shown_) {
      if (!write(sink, event("progress"))) return false;
      shown_ = shown;
    } else if (Clock::now() - written_ >= longest_silence) {
      if (!write(sink, ": nothing new\n\n")) return false;
    }
    job_->wait_for_end(between_looks);
    return true;
  }

 private:
  std::string event(std::string_view name) const {
    return fmt::format("event: {}\ndata: {}\n\n", name, describe_(*job_));
  }

  bool write(httplib::DataSink& sink, const std::string& text) {
    written_ = Clock::now();
    return sink.write(text.data(), text.size());
  }

  const EventStreams::Slot slot_;
  const std::shared_ptr<const Job> job_;
  const std::function<std::string(const Job&)> describe_;
  const int socket_;
  std::optional<std::pair<JobStatus, double>> shown_;
  Clock::time_point written_{};
};

}  // namespace

EventStreams::Slot EventStreams::take() {
  if (++open_ > most_event_streams) {
    --open_;
    throw HttpError({429,
                     fmt::format("{} event streams are open, and this server has no more; ask for "
                                 "the job itself from time to time instead",
                                 most_event_streams),
                     {},
                     {{"Retry-After", "1"}}});
  }
  return {this, [this](const void*) { --open_; }};
}

void answer_events(Call& call, EventStreams& streams, std::shared_ptr<const Job> job,
                   std::function<std::string(const Job&)> describe) {
  constexpr const char* media_type = "text/event-stream";
  call.response.status = 200;
  call.response.set_header("Cache-Control", "no-store");
  if (call.is_head()) return call.response.set_header("Content-Type", media_type);
  const auto stream = std::make_shared<EventStream>(
      streams.take(), std::move(job), std::move(describe), find_socket(endpoints_of(call.request)));
  const auto next = [stream](std::size_t, httplib::DataSink& sink) { return stream->step(sink); };
  if (call.request.version != "HTTP/1.0")
    return call.response.set_chunked_content_provider(media_type, next);
  // It knows no chunks: the end is that of the connection.
  call.response.set_header("Connection", "close");
  call.response.set_content_provider(media_type, next);
}

}  // namespace raytracer
