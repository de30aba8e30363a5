// The connection to NATS: made, lost, made again, for as long as the link lives.
//
// libnats mends connections too, but then it keeps to itself why it fails, and gives up for good
// once NATS has refused its credentials twice: a connection that is lost is replaced here.
#pragma once

#include <nats/nats.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "server/cluster/nats.h"

namespace raytracer {

/// A connection that stood when it was made; once it is lost it stays so. Whoever holds it may use
/// it: what is lost says so.
class NatsSession {
 public:
  static constexpr std::chrono::milliseconds longest_answer{5000};

  /// Owns it.
  explicit NatsSession(natsConnection* connection) : connection_(connection) {}

  natsConnection* connection() const { return connection_.get(); }
  /// Throws NatsUnavailable.
  std::unique_ptr<jsCtx, void (*)(jsCtx*)> new_context() const;
  /// One for all. Only after it was opened.
  jsCtx* context() const { return context_.get(); }
  /// Throws NatsUnavailable.
  void open() { context_ = new_context(); }

 private:
  struct Destroy {
    void operator()(natsConnection* connection) const { natsConnection_Destroy(connection); }
  };
  std::unique_ptr<natsConnection, Destroy> connection_;
  std::unique_ptr<jsCtx, void (*)(jsCtx*)> context_{nullptr, &jsCtx_Destroy};
};

/// Every member function may be called from any thread.
class NatsLink {
 public:
  /// As NatsConnection's constructor.
  NatsLink(std::string url, NatsNote note);
  ~NatsLink();
  NatsLink(const NatsLink&) = delete;
  NatsLink& operator=(const NatsLink&) = delete;

  /// Waits for nothing.
  bool is_up() const { return is_up_; }
  /// Throws NatsAway.
  std::shared_ptr<const NatsSession> session() const;
  /// Does nothing if there is no connection.
  void publish(const std::string& subject, std::string_view data);
  /// As NatsConnection::listen(): over all connections to come.
  std::shared_ptr<const void> listen(const std::string& subject, NatsConnection::Listener listener);

 private:
  class Subscription;

  /// Tries once.
  void connect();
  void take(natsConnection* connection);
  void keep_up(const std::stop_token& end);
  void drop();
  /// Each text once, until it is back.
  void say(const std::string& trouble);
  static void closed(natsConnection* connection, void* self);

  const std::string url_;
  const std::string place_;  ///< the URL as messages show it
  const NatsNote note_;
  std::atomic<bool> is_up_ = false;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::shared_ptr<const NatsSession> session_;
  bool is_closed_ = true;   ///< libnats has ended the connection, or there was none
  std::string last_words_;  ///< why
  std::vector<std::weak_ptr<Subscription>> subscriptions_;
  std::set<std::string> said_;  ///< since it was up; for the thread that connects
  std::jthread keeper_;
};

}  // namespace raytracer
