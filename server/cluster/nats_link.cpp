#include "server/cluster/nats_link.h"

#include <fmt/format.h>

#include <random>
#include <utility>

#include "server/cluster/nats_options.h"

namespace raytracer {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds before_another_try{250};  // up to twice that, or all would come at once

/// What is to be mended before NATS takes this server; nothing if it need only be there. `said`:
/// libnats's own words.
std::string refusal(const std::string& place, natsStatus status, const std::string& said) {
  switch (status) {
    case NATS_CONNECTION_AUTH_FAILED:
    case NATS_NOT_PERMITTED:
      return fmt::format("NATS at {} refuses these credentials; see --nats and NATS_CREDS: {}",
                         place, said);
    case NATS_SSL_ERROR:
    case NATS_SECURE_CONNECTION_REQUIRED:
    case NATS_SECURE_CONNECTION_WANTED:
      return fmt::format(
          "NATS at {} cannot be spoken to by TLS; see tls:// in --nats, NATS_CA, NATS_CERT, "
          "NATS_KEY: {}",
          place, said);
    default:
      return "";
  }
}

}  // namespace

std::unique_ptr<jsCtx, void (*)(jsCtx*)> NatsSession::new_context() const {
  // Of many at once, NATS and libnats drop what they have no room for.
  constexpr std::int64_t most_on_their_way = 1000;
  jsOptions options;
  jsOptions_Init(&options);
  options.Wait = longest_answer.count();
  options.PublishAsync.MaxPending = most_on_their_way;
  options.PublishAsync.StallWait = longest_answer.count();
  jsCtx* context = nullptr;
  if (natsConnection_JetStream(&context, connection(), &options) != NATS_OK)
    throw NatsUnavailable("speaking to JetStream: " + nats_last_error());
  return {context, &jsCtx_Destroy};
}

/// What listens, until it ends. Of the connection's subscriptions each has a thread, which may
/// still be at its last message when another connection has another.
class NatsLink::Subscription {
 public:
  Subscription(std::string subject, NatsConnection::Listener listener)
      : subject_(std::move(subject)), listener_(std::move(listener)) {}

  /// Listens there. What fails, fails because that connection is lost again.
  void begin(const std::shared_ptr<const NatsSession>& session) {
    const std::scoped_lock lock(mutex_);
    if (has_ended_ || session_ == session) return;
    drop();
    session_ = session;
    if (natsConnection_Subscribe(&subscription_, session->connection(), subject_.c_str(), &received,
                                 this) == NATS_OK &&
        natsSubscription_SetOnCompleteCB(subscription_, &completed, this) == NATS_OK)
      ++threads_;
  }

  /// No listener is called afterwards; one that is called now is waited for.
  void end() {
    std::unique_lock lock(mutex_);
    has_ended_ = true;
    if (subscription_ != nullptr) natsSubscription_Unsubscribe(subscription_);
    drop();
    changed_.wait(lock, [this] { return threads_ == 0; });
  }

 private:
  void drop() {
    natsSubscription_Destroy(std::exchange(subscription_, nullptr));
    session_.reset();
  }

  static void received(natsConnection*, natsSubscription*, natsMsg* message, void* self) {
    const std::unique_ptr<natsMsg, void (*)(natsMsg*)> owned(message, &natsMsg_Destroy);
    static_cast<Subscription*>(self)->listener_(
        natsMsg_GetSubject(message),
        {natsMsg_GetData(message), static_cast<std::size_t>(natsMsg_GetDataLength(message))});
  }
  static void completed(void* self) {
    auto* const subscription = static_cast<Subscription*>(self);
    const std::scoped_lock lock(subscription->mutex_);
    --subscription->threads_;
    subscription->changed_.notify_all();
  }

  const std::string subject_;
  const NatsConnection::Listener listener_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::shared_ptr<const NatsSession> session_;
  natsSubscription* subscription_ = nullptr;
  int threads_ = 0;
  bool has_ended_ = false;
};

NatsLink::NatsLink(std::string url, NatsNote note)
    : url_(std::move(url)), place_(nats_place(url_)), note_(std::move(note)) {
  nats_options(url_);  // refuses what will never do
  connect();
  keeper_ = std::jthread([this](const std::stop_token& end) { keep_up(end); });
}

NatsLink::~NatsLink() {
  keeper_.request_stop();
  keeper_.join();
  std::unique_lock lock(mutex_);
  if (!session_) return;
  const auto session = session_;
  lock.unlock();
  natsConnection_Close(session->connection());
  // libnats calls closed() later, on a thread of its own.
  lock.lock();
  changed_.wait(lock, [this] { return is_closed_; });
  session_.reset();
}

std::shared_ptr<const NatsSession> NatsLink::session() const {
  const std::scoped_lock lock(mutex_);
  if (!is_up_) throw NatsAway("there is no connection to NATS");
  return session_;
}

void NatsLink::publish(const std::string& subject, std::string_view data) {
  std::shared_ptr<const NatsSession> session;
  {
    const std::scoped_lock lock(mutex_);
    if (!is_up_) return;
    session = session_;
  }
  natsConnection_Publish(session->connection(), subject.c_str(), data.data(),
                         static_cast<int>(data.size()));
}

std::shared_ptr<const void> NatsLink::listen(const std::string& subject,
                                             NatsConnection::Listener listener) {
  auto subscription = std::make_shared<Subscription>(subject, std::move(listener));
  std::shared_ptr<const NatsSession> session;
  {
    const std::scoped_lock lock(mutex_);
    std::erase_if(subscriptions_, [](const auto& known) { return known.expired(); });
    subscriptions_.push_back(subscription);
    session = session_;
  }
  if (session) subscription->begin(session);
  const void* const handle = subscription.get();
  return {handle, [subscription = std::move(subscription)](const void*) { subscription->end(); }};
}

void NatsLink::connect() {
  try {
    // Its files are read again: they may have been renewed.
    const OptionsPointer options = nats_options(url_);
    natsOptions_SetClosedCB(options.get(), &closed, this);
    {
      const std::scoped_lock lock(mutex_);
      is_closed_ = false;  // closed() may be called before it is known that it stood
    }
    natsConnection* connection = nullptr;
    const natsStatus status = natsConnection_Connect(&connection, options.get());
    if (status == NATS_OK) return take(connection);
    const std::string said = nats_last_error();
    if (const std::string trouble = refusal(place_, status, said); !trouble.empty())
      say(trouble);
    else if (said_.empty())  // else it is known that it is away
      say(fmt::format("NATS at {} cannot be reached: {}", place_, said));
  } catch (const std::exception& error) {
    say(error.what());
  }
  const std::scoped_lock lock(mutex_);
  is_closed_ = true;
}

/// It stands now.
void NatsLink::take(natsConnection* connection) {
  const auto session = std::make_shared<NatsSession>(connection);
  session->open();
  std::vector<std::weak_ptr<Subscription>> subscriptions;
  {
    const std::scoped_lock lock(mutex_);
    session_ = session;
    subscriptions = subscriptions_;
  }
  for (const auto& known : subscriptions)
    if (const auto subscription = known.lock()) subscription->begin(session);
  {
    const std::scoped_lock lock(mutex_);
    is_up_ = !is_closed_;
  }
  if (!said_.empty()) note_(fmt::format("NATS at {} is back", place_));
  said_.clear();
}

void NatsLink::keep_up(const std::stop_token& end) {
  std::minstd_rand random(std::random_device{}());
  std::uniform_int_distribution<int> more(0, static_cast<int>(before_another_try.count()));
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, end, [this] { return is_closed_; });
    if (end.stop_requested()) return;
    if (session_) {
      lock.unlock();
      drop();
      lock.lock();
    }
    changed_.wait_for(lock, end, before_another_try + milliseconds(more(random)),
                      [] { return false; });
    if (end.stop_requested()) return;
    lock.unlock();
    connect();
    lock.lock();
  }
}

/// What is lost.
void NatsLink::drop() {
  std::shared_ptr<const NatsSession> lost;
  std::string why;
  {
    const std::scoped_lock lock(mutex_);
    lost = std::exchange(session_, nullptr);
    why = last_words_;
  }
  say(fmt::format("NATS at {} is lost, only what needs nobody else goes on: {}", place_, why));
}

void NatsLink::say(const std::string& trouble) {
  if (said_.insert(trouble).second) note_(trouble);
}

void NatsLink::closed(natsConnection* connection, void* self) {
  auto* const link = static_cast<NatsLink*>(self);
  const char* said = nullptr;
  const natsStatus status = natsConnection_GetLastError(connection, &said);
  const std::scoped_lock lock(link->mutex_);
  link->is_up_ = false;
  link->is_closed_ = true;
  link->last_words_ = said != nullptr && *said != '\0' ? said : natsStatus_GetText(status);
  link->changed_.notify_all();
}

}  // namespace raytracer
