// NATS and JetStream, as far as a cluster needs them: the one place that knows libnats.
//
// Streams hold one message a subject, as a table holds one row a key; the queue of tasks is a
// stream whose messages are handed out and removed. https://docs.nats.io/nats-concepts/jetstream
//
// libnats 3.4.1 reads beyond its memory when a fetch of several messages meets some that are left
// over: tasks are fetched one by one.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

struct __natsMsg;           // NOLINT: libnats' names
struct __natsSubscription;  // NOLINT

namespace raytracer {

/// NATS cannot be reached or does not answer now; later it may.
class NatsUnavailable : public std::runtime_error {
  using runtime_error::runtime_error;
};

/// NatsUnavailable because there is no connection, or none any more.
class NatsAway : public NatsUnavailable {
  using NatsUnavailable::NatsUnavailable;
};

/// NATS answered, and what it was asked for cannot be had.
class NatsRefused : public std::runtime_error {
  using runtime_error::runtime_error;
};

/// NatsRefused because the stream may not grow.
class StreamFull : public NatsRefused {
  using NatsRefused::NatsRefused;
};

struct StreamSpec {
  std::string name;
  std::string subjects;  ///< a subject with wildcards
  std::int64_t most_bytes;
  std::chrono::seconds longest_kept;
  bool is_queue = false;      ///< a message is removed once it is acknowledged
  bool is_in_memory = false;  ///< gone when NATS ends
  bool drops_oldest = false;  ///< when full, instead of refusing new ones
  std::int64_t most_messages = -1;
};

struct StoredMessage {
  std::string data;
  std::int64_t time_ms;    ///< when it was stored, since 1970
  std::uint64_t sequence;  ///< its number in the stream, never 0
};

/// Limits of a stream, whoever made it; nothing: whatever it has.
struct StreamLimits {
  std::optional<std::int64_t> most_bytes;
  std::optional<std::chrono::seconds> longest_kept;
};

struct StreamFill {
  std::uint64_t bytes = 0;
  std::uint64_t most_bytes = 0;  ///< as the stream has it, whoever wished it so
  std::uint64_t messages_ever = 0;
};

/// A consumer: it hands out the queue's messages with these subjects.
struct ConsumerSpec {
  std::string name;
  std::string subjects;     ///< a subject with wildcards
  std::string description;  ///< for whoever lists it
  std::chrono::milliseconds time_to_acknowledge;
  std::chrono::seconds longest_idle;  ///< then it is removed
};

/// The messages of a queue that one consumer hands out.
struct ConsumerFill {
  std::string name;
  std::string description;
  std::uint64_t waiting = 0;  ///< not handed out yet
  std::uint64_t running = 0;  ///< handed out, not acknowledged
};

class NatsLink;
class NatsSession;

/// A message that was handed out: whoever holds it works on it, and says so from time to time, on
/// any thread.
/// Unless it was settled it goes to others after the consumer's time to acknowledge.
class TaskMessage {
 public:
  /// The link must outlive it.
  TaskMessage(NatsLink& link, __natsMsg* message);

  const std::string& subject() const { return subject_; }
  /// How often it was handed out so far, this time included.
  std::uint64_t deliveries() const { return deliveries_; }
  /// When it was queued, in milliseconds since 1970.
  std::int64_t queued_ms() const { return queued_ms_; }

  /// It is done. Like the two below it does nothing if NATS is away: then others do it again.
  void acknowledge() const;
  void say_in_progress() const;
  void hand_back(std::chrono::milliseconds delay) const;

 private:
  NatsLink* link_;
  std::string subject_;
  std::string reply_;  ///< where NATS hears of it, by whatever connection
  std::uint64_t deliveries_ = 1;
  std::int64_t queued_ms_ = 0;
};

/// Hands out the messages of one consumer; for one thread.
class TaskSource {
 public:
  /// The link must outlive it.
  TaskSource(NatsLink& link, const std::string& stream, const std::string& consumer);

  /// The next one, if there is one within `longest`. Throws NatsUnavailable, and NatsRefused if the
  /// consumer is gone.
  std::optional<TaskMessage> take(std::chrono::milliseconds longest);

 private:
  NatsLink* link_;
  std::shared_ptr<const NatsSession> session_;
  std::shared_ptr<__natsSubscription> subscription_;
};

/// Takes a line for the log.
using NatsNote = std::function<void(const std::string& text)>;

/// A connection that mends itself; it need not stand when this is made. Every member function may
/// be called from any thread and, unless it says otherwise, throws NatsUnavailable or NatsRefused.
class NatsConnection {
 public:
  /// `url`: nats://[user:password@]host[:port], or tls://; several with commas. What else NATS's
  /// own programs take from the environment: NATS_CREDS, NATS_CA, NATS_CERT, NATS_KEY, each a
  /// file. Throws std::invalid_argument if the URL or one of the files cannot be used.
  /// `note` is told, on any thread, why it cannot be had, and when it is back.
  explicit NatsConnection(
      const std::string& url, NatsNote note = [](const std::string&) {});
  ~NatsConnection();
  NatsConnection(const NatsConnection&) = delete;
  NatsConnection& operator=(const NatsConnection&) = delete;

  /// Whether it stands now. Throws nothing, and waits for nothing.
  bool is_connected() const;

  /// The bytes of the largest message that NATS takes.
  std::size_t most_message_bytes() const;

  /// Makes the stream if there is none of that name.
  void ensure_stream(const StreamSpec& spec);
  StreamLimits limits_of(const std::string& stream);
  /// Has the stream be so, if there is one. Returns what it was of what that changed.
  StreamLimits change_stream(const std::string& name, const StreamLimits& wish);
  StreamFill fill_of(const std::string& stream);

  /// Stores it in place of what the subject held.
  void put(const std::string& subject, std::string_view data);
  /// Stores it if the subject holds the message of that sequence, or nothing for 0. Returns its own
  /// sequence, or nothing if it was not stored.
  std::optional<std::uint64_t> replace(const std::string& subject, std::string_view data,
                                       std::uint64_t sequence);
  /// Stores an empty message at each subject that holds nothing, faster.
  void create_all(const std::vector<std::string>& subjects);
  std::optional<StoredMessage> get(const std::string& stream, const std::string& subject);
  /// The subjects that hold something, of those that match.
  std::vector<std::string> subjects(const std::string& stream, const std::string& filter);
  /// Removes what the matching subjects hold.
  void purge(const std::string& stream, const std::string& filter);

  /// Makes the consumer if the queue has none of that name.
  void ensure_consumer(const std::string& stream, const ConsumerSpec& spec);
  void remove_consumer(const std::string& stream, const std::string& name);
  std::vector<ConsumerFill> consumers(const std::string& stream);
  /// Their names, by one request for many.
  std::vector<std::string> consumer_names(const std::string& stream);
  TaskSource source(const std::string& stream, const std::string& consumer);

  /// Tells those who listen() now. If NATS is away nobody hears it.
  void signal(const std::string& subject, std::string_view data);

  using Listener = std::function<void(const std::string& subject, const std::string& data)>;
  /// Calls the listener for each signal, on a thread of its own, as long as the returned lives.
  std::shared_ptr<const void> listen(const std::string& subject, Listener listener);

 private:
  /// Nothing if it has ended.
  std::optional<ConsumerFill> consumer(const std::string& stream, const std::string& name);

  std::unique_ptr<NatsLink> link_;
};

}  // namespace raytracer
