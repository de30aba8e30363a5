#include "server/cluster/nats.h"

#include <fmt/format.h>
#include <nats/nats.h>

#include <utility>

#include "server/cluster/nats_link.h"
#include "server/cluster/nats_options.h"
#include "server/cluster/nats_status.h"

namespace raytracer {
namespace {

using std::chrono::milliseconds;

template <typename Duration>
std::int64_t nanoseconds(Duration duration) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(duration).count();
}

template <typename T, void (*destroy)(T*)>
struct Destroy {
  void operator()(T* object) const { destroy(object); }
};
using MessagePointer = std::unique_ptr<natsMsg, Destroy<natsMsg, natsMsg_Destroy>>;
using InfoPointer = std::unique_ptr<jsStreamInfo, Destroy<jsStreamInfo, jsStreamInfo_Destroy>>;

/// Nothing if there is no such stream. With the subjects that hold something, of those that match
/// `filter` if there is one.
InfoPointer find_info(const NatsSession& session, const std::string& stream,
                      const char* filter = nullptr) {
  jsOptions options;
  jsOptions_Init(&options);
  options.Stream.Info.SubjectsFilter = filter;
  jsStreamInfo* info = nullptr;
  jsErrCode error{};
  const natsStatus status =
      js_GetStreamInfo(&info, session.context(), stream.c_str(), &options, &error);
  if (status == NATS_NOT_FOUND) return nullptr;
  require(status, filter != nullptr ? std::string("listing ") + filter : "asking for " + stream,
          error);
  return InfoPointer(info);
}

InfoPointer info_of(const NatsSession& session, const std::string& stream,
                    const char* filter = nullptr) {
  InfoPointer info = find_info(session, stream, filter);
  if (!info) throw NatsUnavailable("NATS has no stream " + stream + " yet");
  return info;
}

StreamLimits limits_in(const jsStreamConfig& config) {
  return {config.MaxBytes, std::chrono::duration_cast<std::chrono::seconds>(
                               std::chrono::nanoseconds(config.MaxAge))};
}

}  // namespace

TaskMessage::TaskMessage(NatsLink& link, natsMsg* message)
    : link_(&link), subject_(natsMsg_GetSubject(message)), reply_(natsMsg_GetReply(message)) {
  jsMsgMetaData* data = nullptr;
  if (natsMsg_GetMetaData(&data, message) != NATS_OK) return;
  deliveries_ = data->NumDelivered;
  queued_ms_ = data->Timestamp / 1'000'000;
  jsMsgMetaData_Destroy(data);
}

// https://docs.nats.io/reference/reference-protocols/nats_api_reference: libnats would answer by
// the connection that the message came by, and that may be lost.
void TaskMessage::acknowledge() const { link_->publish(reply_, "+ACK"); }
void TaskMessage::say_in_progress() const { link_->publish(reply_, "+WPI"); }
void TaskMessage::hand_back(milliseconds delay) const {
  link_->publish(reply_, fmt::format(R"(-NAK {{"delay": {}}})", nanoseconds(delay)));
}

TaskSource::TaskSource(NatsLink& link, const std::string& stream, const std::string& consumer)
    : link_(&link), session_(link.session()) {
  jsSubOptions options;
  jsSubOptions_Init(&options);
  options.Stream = stream.c_str();
  options.Consumer = consumer.c_str();
  options.ManualAck = true;
  natsSubscription* subscription = nullptr;
  jsErrCode error{};
  const natsStatus status = js_PullSubscribe(&subscription, session_->context(), nullptr,
                                             consumer.c_str(), nullptr, &options, &error);
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
  if (list.Count > 0) task.emplace(*link_, list.Msgs[0]);
  natsMsgList_Destroy(&list);
  return task;
}

NatsConnection::NatsConnection(const std::string& url, NatsNote note)
    : link_(std::make_unique<NatsLink>(url, std::move(note))) {}

NatsConnection::~NatsConnection() = default;

bool NatsConnection::is_connected() const { return link_->is_up(); }

std::size_t NatsConnection::most_message_bytes() const {
  return static_cast<std::size_t>(natsConnection_GetMaxPayload(link_->session()->connection()));
}

void NatsConnection::ensure_stream(const StreamSpec& spec) {
  const auto session = link_->session();
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
  const natsStatus status = js_AddStream(nullptr, session->context(), &config, nullptr, &error);
  // One of that name with other limits is somebody's wish.
  if (error == JSStreamNameExistErr) return;
  const std::string what = fmt::format("making the stream {}", spec.name);
  if (status == NATS_NO_RESPONDERS)
    throw NatsUnavailable(what + ": this NATS has no JetStream (nats-server --jetstream)");
  if (status != NATS_OK && !is_away(status) && !is_passing(status, error)) {
    const std::string reason = last_words();
    if (find_info(*session, spec.name)) return;  // NATS looks for room before it looks for the name
    throw NatsRefused(
        fmt::format("{} of {} bytes (--max-stored): {}", what, spec.most_bytes, reason));
  }
  require(status, what, error);
}

StreamLimits NatsConnection::limits_of(const std::string& stream) {
  const auto session = link_->session();
  return limits_in(*info_of(*session, stream)->Config);
}

StreamLimits NatsConnection::change_stream(const std::string& name, const StreamLimits& wish) {
  if (!wish.longest_kept && !wish.most_bytes) return {};
  const auto session = link_->session();
  const InfoPointer info = find_info(*session, name);
  if (!info) return {};
  jsStreamConfig& config = *info->Config;
  StreamLimits before = limits_in(config);
  if (before.longest_kept == wish.longest_kept || !wish.longest_kept) before.longest_kept.reset();
  if (before.most_bytes == wish.most_bytes || !wish.most_bytes) before.most_bytes.reset();
  if (!before.longest_kept && !before.most_bytes) return {};
  // NATS would make room by dropping what was promised to be kept.
  if (before.most_bytes && *wish.most_bytes < static_cast<std::int64_t>(info->State.Bytes))
    throw NatsRefused(fmt::format("the stream {} holds {} bytes, more than the {} wished", name,
                                  info->State.Bytes, *wish.most_bytes));
  if (wish.longest_kept) {
    config.MaxAge = nanoseconds(*wish.longest_kept);
    config.Duplicates = std::min(config.Duplicates, config.MaxAge);  // or it is refused
  }
  if (wish.most_bytes) config.MaxBytes = *wish.most_bytes;
  jsErrCode error{};
  const natsStatus status = js_UpdateStream(nullptr, session->context(), &config, nullptr, &error);
  if (status != NATS_OK && !is_away(status) && !is_passing(status, error))
    throw NatsRefused(fmt::format("changing the stream {}: {}", name, last_words()));
  require(status, "changing the stream " + name, error);
  return before;
}

StreamFill NatsConnection::fill_of(const std::string& stream) {
  const auto session = link_->session();
  const InfoPointer info = info_of(*session, stream);
  const std::int64_t most =
      info->Config->MaxBytes;  // -1, as an operator may have made it: no limit
  return {info->State.Bytes, static_cast<std::uint64_t>(most < 0 ? INT64_MAX : most),
          info->State.LastSeq};
}

void NatsConnection::put(const std::string& subject, std::string_view data) {
  const auto session = link_->session();
  jsErrCode error{};
  const natsStatus status = js_Publish(nullptr, session->context(), subject.c_str(), data.data(),
                                       static_cast<int>(data.size()), nullptr, &error);
  require(status, "storing " + subject, error);
}

std::optional<std::uint64_t> NatsConnection::replace(const std::string& subject,
                                                     std::string_view data,
                                                     std::uint64_t sequence) {
  const auto session = link_->session();
  jsPubOptions options;
  jsPubOptions_Init(&options);
  options.ExpectNoMessage = sequence == 0;
  options.ExpectLastSubjectSeq = sequence;
  jsErrCode error{};
  jsPubAck* made = nullptr;
  const natsStatus status = js_Publish(&made, session->context(), subject.c_str(), data.data(),
                                       static_cast<int>(data.size()), &options, &error);
  if (error == JSStreamWrongLastSequenceErr) return {};
  require(status, "storing " + subject, error);
  const std::unique_ptr<jsPubAck, Destroy<jsPubAck, jsPubAck_Destroy>> answer(made);
  return answer->Sequence;
}

void NatsConnection::create_all(const std::vector<std::string>& subjects) {
  const auto session = link_->session();
  // Its own: a context waits for all that was ever published with it, and for ever for what NATS
  // never answered.
  const auto context = session->new_context();
  jsPubOptions options;
  jsPubOptions_Init(&options);
  options.ExpectNoMessage = true;
  for (const std::string& subject : subjects)
    require(js_PublishAsync(context.get(), subject.c_str(), nullptr, 0, &options),
            "storing " + subject);
  options.MaxWait = NatsSession::longest_answer.count();
  // Those that were there already are told as errors, to nobody.
  require(js_PublishAsyncComplete(context.get(), &options), "storing many");
}

std::optional<StoredMessage> NatsConnection::get(const std::string& stream,
                                                 const std::string& subject) {
  const auto session = link_->session();
  jsDirectGetMsgOptions options;
  jsDirectGetMsgOptions_Init(&options);
  options.LastBySubject = subject.c_str();
  natsMsg* made = nullptr;
  const natsStatus status =
      js_DirectGetMsg(&made, session->context(), stream.c_str(), nullptr, &options);
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
  const auto session = link_->session();
  const InfoPointer info = info_of(*session, stream, filter.c_str());
  std::vector<std::string> names;
  if (const jsStreamStateSubjects* const found = info->State.Subjects)
    for (int i = 0; i < found->Count; ++i) names.emplace_back(found->List[i].Subject);
  return names;
}

void NatsConnection::purge(const std::string& stream, const std::string& filter) {
  const auto session = link_->session();
  jsOptions options;
  jsOptions_Init(&options);
  options.Stream.Purge.Subject = filter.c_str();
  jsErrCode error{};
  const natsStatus status = js_PurgeStream(session->context(), stream.c_str(), &options, &error);
  require(status, "removing " + filter, error);
}

void NatsConnection::ensure_consumer(const std::string& stream, const ConsumerSpec& spec) {
  const auto session = link_->session();
  constexpr std::int64_t endless = -1;  // what was tried too often is for its result to say
  constexpr std::int64_t most_running = 1'000'000;
  jsConsumerConfig config;
  jsConsumerConfig_Init(&config);
  config.Durable = spec.name.c_str();
  config.FilterSubject = spec.subjects.c_str();
  config.Description = spec.description.c_str();
  config.AckPolicy = js_AckExplicit;
  config.AckWait = nanoseconds(spec.time_to_acknowledge);
  config.MaxDeliver = endless;
  config.MaxAckPending = most_running;
  config.InactiveThreshold = nanoseconds(spec.longest_idle);
  jsErrCode error{};
  const natsStatus status =
      js_AddConsumer(nullptr, session->context(), stream.c_str(), &config, nullptr, &error);
  if (error == JSConsumerNameExistErr) return;
  require(status, "handing out tasks", error);
}

void NatsConnection::remove_consumer(const std::string& stream, const std::string& name) {
  const auto session = link_->session();
  // NATS may still be writing the files that it is to remove. It says so, though the consumer has
  // ended: then it finds none at the next try.
  constexpr int most_tries = 3;
  jsErrCode error{};
  natsStatus status = NATS_OK;
  for (int i = 0; i < most_tries; ++i) {
    status = js_DeleteConsumer(session->context(), stream.c_str(), name.c_str(), nullptr, &error);
    if (status == NATS_OK || status == NATS_NOT_FOUND || error == JSConsumerNotFoundErr) return;
    if (is_away(status) || is_passing(status, error)) break;
  }
  require(status, "ending " + name, error);
}

std::vector<std::string> NatsConnection::consumer_names(const std::string& stream) {
  const auto session = link_->session();
  jsConsumerNamesList* listed = nullptr;
  jsErrCode error{};
  const natsStatus status =
      js_ConsumerNames(&listed, session->context(), stream.c_str(), nullptr, &error);
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
  const auto session = link_->session();
  jsConsumerInfo* told = nullptr;
  jsErrCode error{};
  const natsStatus status =
      js_GetConsumerInfo(&told, session->context(), stream.c_str(), name.c_str(), nullptr, &error);
  if (status == NATS_NOT_FOUND) return std::nullopt;
  require(status, "asking what is handed out of " + name, error);
  const std::unique_ptr<jsConsumerInfo, Destroy<jsConsumerInfo, jsConsumerInfo_Destroy>> info(told);
  const char* const description = info->Config->Description;
  return ConsumerFill{name, description != nullptr ? description : "", info->NumPending,
                      static_cast<std::uint64_t>(info->NumAckPending)};
}

TaskSource NatsConnection::source(const std::string& stream, const std::string& consumer) {
  return {*link_, stream, consumer};
}

void NatsConnection::signal(const std::string& subject, std::string_view data) {
  link_->publish(subject, data);
}

std::shared_ptr<const void> NatsConnection::listen(const std::string& subject, Listener listener) {
  return link_->listen(subject, std::move(listener));
}

}  // namespace raytracer
