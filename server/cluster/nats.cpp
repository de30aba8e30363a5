#include "server/cluster/nats.h"

#include <fmt/format.h>
#include <nats/nats.h>

#include <condition_variable>
#include <mutex>
#include <utility>

#include "server/cluster/nats_options.h"

namespace raytracer {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds longest_answer{5000};

template <typename Duration>
std::int64_t nanoseconds(Duration duration) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(duration).count();
}

bool is_passing(natsStatus status, jsErrCode error) {
  switch (status) {
    case NATS_TIMEOUT:
    case NATS_CONNECTION_CLOSED:
    case NATS_CONNECTION_DISCONNECTED:
    case NATS_NO_SERVER:
    case NATS_NO_RESPONDERS:
    case NATS_NOT_YET_CONNECTED:
    case NATS_STALE_CONNECTION:
    case NATS_IO_ERROR:
      return true;
    default:
      return error == JSStreamNotFoundErr || error == JSClusterNotAvailErr;
  }
}

/// Throws what the status means, unless all went well. `what`: that was to be done.
void require(natsStatus status, std::string_view what, jsErrCode error = jsErrCode{}) {
  if (status == NATS_OK) return;
  natsStatus last_status = status;
  const char* const last = nats_GetLastError(&last_status);
  const std::string text = fmt::format("{}: {} ({})", what, natsStatus_GetText(status),
                                       last != nullptr && *last != '\0' ? last : "no more is said");
  if (is_passing(status, error)) throw NatsUnavailable(text);
  if (error == JSStreamStoreFailedErr || error == JSInsufficientResourcesErr ||
      error == JSStorageResourcesExceededErr || error == JSAccountResourcesExceededErr)
    throw StreamFull(
        "the cluster's store is full (--max-stored): delete jobs, or wait until old ones "
        "are forgotten; " +
        text);
  throw NatsRefused(text);
}

template <typename T, void (*destroy)(T*)>
struct Destroy {
  void operator()(T* object) const { destroy(object); }
};
using MessagePointer = std::unique_ptr<natsMsg, Destroy<natsMsg, natsMsg_Destroy>>;

natsConnection* connect(const std::string& url) {
  const OptionsPointer options = nats_options(url);
  natsConnection* connection = nullptr;
  const natsStatus status = natsConnection_Connect(&connection, options.get());
  if (status != NATS_OK && status != NATS_NOT_YET_CONNECTED)
    throw std::invalid_argument(
        fmt::format("cannot connect to NATS at {}: {}", url, nats_GetLastError(nullptr)));
  return connection;
}

using ContextPointer = std::unique_ptr<jsCtx, void (*)(jsCtx*)>;

ContextPointer context_of(natsConnection* connection) {
  // Of many at once, NATS and libnats drop what they have no room for.
  constexpr std::int64_t most_on_their_way = 1000;
  jsOptions options;
  jsOptions_Init(&options);
  options.Wait = longest_answer.count();
  options.PublishAsync.MaxPending = most_on_their_way;
  options.PublishAsync.StallWait = longest_answer.count();
  jsCtx* context = nullptr;
  require(natsConnection_JetStream(&context, connection, &options), "speaking to JetStream");
  return {context, &jsCtx_Destroy};
}

/// What listens, until nobody holds it.
class Subscription {
 public:
  Subscription(natsConnection* connection, const std::string& subject,
               NatsConnection::Listener listener)
      : listener_(std::move(listener)) {
    require(natsConnection_Subscribe(&subscription_, connection, subject.c_str(), &received, this),
            "listening");
    natsSubscription_SetOnCompleteCB(subscription_, &ended, this);
  }
  ~Subscription() {
    natsSubscription_Unsubscribe(subscription_);
    std::unique_lock lock(mutex_);
    // A listener may be under way.
    changed_.wait_for(lock, longest_answer, [this] { return has_ended_; });
    lock.unlock();
    natsSubscription_Destroy(subscription_);
  }
  Subscription(const Subscription&) = delete;
  Subscription& operator=(const Subscription&) = delete;

 private:
  static void received(natsConnection*, natsSubscription*, natsMsg* message, void* self) {
    const MessagePointer owned(message);
    static_cast<Subscription*>(self)->listener_(
        natsMsg_GetSubject(message),
        {natsMsg_GetData(message), static_cast<std::size_t>(natsMsg_GetDataLength(message))});
  }
  static void ended(void* self) {
    auto* const subscription = static_cast<Subscription*>(self);
    const std::scoped_lock lock(subscription->mutex_);
    subscription->has_ended_ = true;
    subscription->changed_.notify_all();
  }

  NatsConnection::Listener listener_;
  natsSubscription* subscription_ = nullptr;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool has_ended_ = false;
};

}  // namespace

TaskMessage::TaskMessage(natsMsg* message)
    : message_(message, &natsMsg_Destroy), subject_(natsMsg_GetSubject(message)) {
  jsMsgMetaData* data = nullptr;
  if (natsMsg_GetMetaData(&data, message) != NATS_OK) return;
  deliveries_ = data->NumDelivered;
  queued_ms_ = data->Timestamp / 1'000'000;
  jsMsgMetaData_Destroy(data);
}

void TaskMessage::acknowledge() { natsMsg_Ack(message_.get(), nullptr); }
void TaskMessage::say_in_progress() { natsMsg_InProgress(message_.get(), nullptr); }
void TaskMessage::hand_back(milliseconds delay) {
  natsMsg_NakWithDelay(message_.get(), delay.count(), nullptr);
}

TaskSource::TaskSource(jsCtx* context, const std::string& stream, const std::string& consumer) {
  jsSubOptions options;
  jsSubOptions_Init(&options);
  options.Stream = stream.c_str();
  options.Consumer = consumer.c_str();
  options.ManualAck = true;
  natsSubscription* subscription = nullptr;
  jsErrCode error{};
  const natsStatus status = js_PullSubscribe(&subscription, context, nullptr, consumer.c_str(),
                                             nullptr, &options, &error);
  require(status, "asking for tasks", error);
  subscription_.reset(subscription, &natsSubscription_Destroy);
}

std::optional<TaskMessage> TaskSource::take(milliseconds longest) {
  natsMsgList list{};
  jsErrCode error{};
  const natsStatus status =
      natsSubscription_Fetch(&list, subscription_.get(), 1, longest.count(), &error);
  if (status == NATS_TIMEOUT) return {};
  require(status, "fetching a task", error);
  std::optional<TaskMessage> task;
  if (list.Count > 0) task.emplace(std::exchange(list.Msgs[0], nullptr));
  natsMsgList_Destroy(&list);
  return task;
}

NatsConnection::NatsConnection(const std::string& url)
    : connection_(connect(url), &natsConnection_Destroy), context_(context_of(connection_.get())) {}

NatsConnection::~NatsConnection() = default;

bool NatsConnection::is_connected() const {
  return natsConnection_Status(connection_.get()) == NATS_CONN_STATUS_CONNECTED;
}

std::size_t NatsConnection::most_message_bytes() const {
  require_connection();
  return static_cast<std::size_t>(natsConnection_GetMaxPayload(connection_.get()));
}

/// A request would wait for its time to be over.
void NatsConnection::require_connection() const {
  if (!is_connected()) throw NatsUnavailable("there is no connection to NATS");
}

void NatsConnection::ensure_stream(const StreamSpec& spec) {
  require_connection();
  jsStreamConfig config;
  jsStreamConfig_Init(&config);
  const char* const subjects = spec.subjects.c_str();
  const char* list[] = {subjects};  // NOLINT: libnats' list
  config.Name = spec.name.c_str();
  config.Subjects = list;
  config.SubjectsLen = 1;
  config.Retention = spec.is_queue ? js_WorkQueuePolicy : js_LimitsPolicy;
  config.Storage = spec.is_in_memory ? js_MemoryStorage : js_FileStorage;
  config.Discard = spec.drops_oldest ? js_DiscardOld : js_DiscardNew;
  config.MaxBytes = spec.most_bytes;
  config.MaxMsgs = spec.most_messages;
  config.MaxAge = nanoseconds(spec.longest_kept);
  config.MaxMsgsPerSubject = 1;
  config.AllowDirect = true;
  jsErrCode error{};
  const natsStatus status = js_AddStream(nullptr, context_.get(), &config, nullptr, &error);
  // One of that name with other limits is somebody's wish.
  if (error == JSStreamNameExistErr) return;
  require(status, fmt::format("making the stream {}", spec.name), error);
}

StreamFill NatsConnection::fill_of(const std::string& stream) {
  require_connection();
  jsStreamInfo* made = nullptr;
  jsErrCode error{};
  const natsStatus status =
      js_GetStreamInfo(&made, context_.get(), stream.c_str(), nullptr, &error);
  require(status, "asking for a stream", error);
  const std::unique_ptr<jsStreamInfo, Destroy<jsStreamInfo, jsStreamInfo_Destroy>> info(made);
  return {info->State.Bytes, info->State.LastSeq};
}

void NatsConnection::put(const std::string& subject, std::string_view data) {
  require_connection();
  jsErrCode error{};
  const natsStatus status = js_Publish(nullptr, context_.get(), subject.c_str(), data.data(),
                                       static_cast<int>(data.size()), nullptr, &error);
  require(status, "storing " + subject, error);
}

std::optional<std::uint64_t> NatsConnection::replace(const std::string& subject,
                                                     std::string_view data,
                                                     std::uint64_t sequence) {
  require_connection();
  jsPubOptions options;
  jsPubOptions_Init(&options);
  options.ExpectNoMessage = sequence == 0;
  options.ExpectLastSubjectSeq = sequence;
  jsErrCode error{};
  jsPubAck* made = nullptr;
  const natsStatus status = js_Publish(&made, context_.get(), subject.c_str(), data.data(),
                                       static_cast<int>(data.size()), &options, &error);
  if (error == JSStreamWrongLastSequenceErr) return {};
  require(status, "storing " + subject, error);
  const std::unique_ptr<jsPubAck, Destroy<jsPubAck, jsPubAck_Destroy>> answer(made);
  return answer->Sequence;
}

void NatsConnection::create_all(const std::vector<std::string>& subjects) {
  require_connection();
  // Its own: a context waits for all that was ever published with it, and for ever for what NATS
  // never answered.
  const ContextPointer context = context_of(connection_.get());
  jsPubOptions options;
  jsPubOptions_Init(&options);
  options.ExpectNoMessage = true;
  for (const std::string& subject : subjects)
    require(js_PublishAsync(context.get(), subject.c_str(), nullptr, 0, &options),
            "storing " + subject);
  options.MaxWait = longest_answer.count();
  // Those that were there already are told as errors, to nobody.
  require(js_PublishAsyncComplete(context.get(), &options), "storing many");
}

std::optional<StoredMessage> NatsConnection::get(const std::string& stream,
                                                 const std::string& subject) {
  require_connection();
  jsDirectGetMsgOptions options;
  jsDirectGetMsgOptions_Init(&options);
  options.LastBySubject = subject.c_str();
  natsMsg* made = nullptr;
  const natsStatus status =
      js_DirectGetMsg(&made, context_.get(), stream.c_str(), nullptr, &options);
  if (status == NATS_NOT_FOUND) return {};
  require(status, "reading " + subject);
  const MessagePointer message(made);
  return StoredMessage{
      {natsMsg_GetData(made), static_cast<std::size_t>(natsMsg_GetDataLength(made))},
      natsMsg_GetTime(made) / 1'000'000,
      natsMsg_GetSequence(made)};
}

std::vector<std::string> NatsConnection::subjects(const std::string& stream,
                                                  const std::string& filter) {
  require_connection();
  jsOptions options;
  jsOptions_Init(&options);
  options.Stream.Info.SubjectsFilter = filter.c_str();
  jsStreamInfo* made = nullptr;
  jsErrCode error{};
  const natsStatus status =
      js_GetStreamInfo(&made, context_.get(), stream.c_str(), &options, &error);
  require(status, "listing " + filter, error);
  const std::unique_ptr<jsStreamInfo, Destroy<jsStreamInfo, jsStreamInfo_Destroy>> info(made);
  std::vector<std::string> names;
  if (const jsStreamStateSubjects* const found = info->State.Subjects)
    for (int i = 0; i < found->Count; ++i) names.emplace_back(found->List[i].Subject);
  return names;
}

void NatsConnection::purge(const std::string& stream, const std::string& filter) {
  require_connection();
  jsOptions options;
  jsOptions_Init(&options);
  options.Stream.Purge.Subject = filter.c_str();
  jsErrCode error{};
  const natsStatus status = js_PurgeStream(context_.get(), stream.c_str(), &options, &error);
  require(status, "removing " + filter, error);
}

void NatsConnection::ensure_consumer(const std::string& stream, const std::string& name,
                                     const std::string& filter, const std::string& description,
                                     milliseconds time, std::chrono::seconds longest_idle) {
  require_connection();
  constexpr std::int64_t endless = -1;  // what was tried too often is for its result to say
  constexpr std::int64_t most_running = 1'000'000;
  jsConsumerConfig config;
  jsConsumerConfig_Init(&config);
  config.Durable = name.c_str();
  config.FilterSubject = filter.c_str();
  config.Description = description.c_str();
  config.AckPolicy = js_AckExplicit;
  config.AckWait = nanoseconds(time);
  config.MaxDeliver = endless;
  config.MaxAckPending = most_running;
  config.InactiveThreshold = nanoseconds(longest_idle);
  jsErrCode error{};
  const natsStatus status =
      js_AddConsumer(nullptr, context_.get(), stream.c_str(), &config, nullptr, &error);
  if (error == JSConsumerNameExistErr) return;
  require(status, "handing out tasks", error);
}

void NatsConnection::remove_consumer(const std::string& stream, const std::string& name) {
  require_connection();
  jsErrCode error{};
  const natsStatus status =
      js_DeleteConsumer(context_.get(), stream.c_str(), name.c_str(), nullptr, &error);
  if (error == JSConsumerNotFoundErr || status == NATS_NOT_FOUND) return;
  require(status, "ending " + name, error);
}

std::vector<std::string> NatsConnection::consumer_names(const std::string& stream) {
  require_connection();
  jsConsumerNamesList* listed = nullptr;
  jsErrCode error{};
  const natsStatus status =
      js_ConsumerNames(&listed, context_.get(), stream.c_str(), nullptr, &error);
  if (status == NATS_NOT_FOUND && error != JSStreamNotFoundErr) return {};
  require(status, "listing what is handed out", error);
  const std::unique_ptr<jsConsumerNamesList,
                        Destroy<jsConsumerNamesList, jsConsumerNamesList_Destroy>>
      names(listed);
  return {names->List, names->List + names->Count};
}

std::vector<ConsumerFill> NatsConnection::consumers(const std::string& stream) {
  // One by one: libnats cannot read the list of all where one ends while NATS makes it.
  std::vector<ConsumerFill> consumers;
  for (const std::string& name : consumer_names(stream))
    if (const auto fill = consumer(stream, name)) consumers.push_back(*fill);
  return consumers;
}

std::optional<ConsumerFill> NatsConnection::consumer(const std::string& stream,
                                                     const std::string& name) {
  jsConsumerInfo* told = nullptr;
  jsErrCode error{};
  const natsStatus status =
      js_GetConsumerInfo(&told, context_.get(), stream.c_str(), name.c_str(), nullptr, &error);
  if (status == NATS_NOT_FOUND) return std::nullopt;
  require(status, "asking what is handed out of " + name, error);
  const std::unique_ptr<jsConsumerInfo, Destroy<jsConsumerInfo, jsConsumerInfo_Destroy>> info(told);
  const char* const description = info->Config->Description;
  return ConsumerFill{name, description != nullptr ? description : "", info->NumPending,
                      static_cast<std::uint64_t>(info->NumAckPending)};
}

TaskSource NatsConnection::source(const std::string& stream, const std::string& consumer) {
  require_connection();
  return {context_.get(), stream, consumer};
}

void NatsConnection::signal(const std::string& subject, std::string_view data) {
  if (!is_connected()) return;
  natsConnection_Publish(connection_.get(), subject.c_str(), data.data(),
                         static_cast<int>(data.size()));
}

std::shared_ptr<const void> NatsConnection::listen(const std::string& subject, Listener listener) {
  return std::make_shared<const Subscription>(connection_.get(), subject, std::move(listener));
}

}  // namespace raytracer
