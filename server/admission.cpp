#include "server/admission.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "server/problem.h"

namespace raytracer {

struct Admission::Entry {
  Entry(RenderProgress& of, Clock::time_point now) : progress(of), entered(now) {}

  RenderProgress& progress;
  Clock::time_point entered;
  Clock::time_point started{};
  std::atomic<bool> is_running{false};  ///< set with the mutex held, behind `started`
  std::condition_variable admitted{};   ///< its own: an admission wakes nobody else
};

Admission::Admission(std::size_t most_running, std::size_t most_waiting)
    : most_running_(most_running), most_waiting_(most_waiting) {}

AdmissionSlot Admission::enter(RenderProgress& progress) {
  const std::scoped_lock lock(mutex_);
  require_open();
  auto entry = std::make_unique<Entry>(progress, Clock::now());
  if (running_.size() >= most_running_ && !may_wait()) refuse_full();
  waiting_.push_back(entry.get());
  let_in_next();
  return {*this, std::move(entry)};
}

AdmissionWaiter Admission::add_waiter() {
  const std::scoped_lock lock(mutex_);
  require_open();
  if (!may_wait()) refuse_full();
  ++extra_waiters_;
  return {this, [this](const void*) { --extra_waiters_; }};
}

bool Admission::may_wait() const { return waiting_.size() + extra_waiters_ < most_waiting_; }

void Admission::refuse_full() const {
  throw HttpError({429,
                   fmt::format("{} renders wait already (--max-queue); try again later",
                               waiting_.size() + extra_waiters_),
                   {},
                   {{"Retry-After", std::to_string(retry_after_s())}}});
}

void Admission::require_open() const {
  if (closed_) throw HttpError({503, "The server is shutting down and takes no new work"});
}

void Admission::close() {
  const std::scoped_lock lock(mutex_);
  closed_ = true;
  for (Entry* const entry : waiting_) entry->admitted.notify_all();
}

void Admission::stop_running() {
  const std::scoped_lock lock(mutex_);
  for (Entry* const entry : running_) entry->progress.stop = true;
}

Admission::Load Admission::load() const {
  const std::scoped_lock lock(mutex_);
  return {running_.size(), waiting_.size() + extra_waiters_};
}

bool Admission::is_closed() const { return closed_; }

bool Admission::is_full() const {
  const std::scoped_lock lock(mutex_);
  return running_.size() >= most_running_ && !may_wait();
}

bool Admission::wait_until_empty(std::chrono::milliseconds timeout) const {
  std::unique_lock lock(mutex_);
  return emptied_.wait_for(lock, timeout, [&] { return running_.empty() && waiting_.empty(); });
}

void Admission::leave(Entry& entry) {
  const std::scoped_lock lock(mutex_);
  if (entry.is_running && !entry.progress.stop) {
    const std::chrono::duration<double> render = Clock::now() - entry.started;
    mean_render_s_ += 0.2 * (render.count() - mean_render_s_);
  }
  std::erase(running_, &entry);
  std::erase(waiting_, &entry);
  let_in_next();
  if (running_.empty() && waiting_.empty()) emptied_.notify_all();
}

void Admission::let_in_next() {
  while (!closed_ && running_.size() < most_running_ && !waiting_.empty()) {
    Entry* const next = waiting_.front();
    waiting_.pop_front();
    running_.push_back(next);
    next->started = Clock::now();
    next->is_running = true;
    next->admitted.notify_all();
  }
}

/// When those who wait now will have been served, if renders go on as they did.
long Admission::retry_after_s() const {
  double render_s = mean_render_s_;
  for (const Entry* const entry : running_) {
    const std::chrono::duration<double> so_far = Clock::now() - entry->started;
    render_s = std::max(render_s, so_far.count());
  }
  const double all_s =
      render_s * static_cast<double>(waiting_.size() + 1) / static_cast<double>(most_running_);
  return std::lround(std::clamp(std::ceil(all_s), 1.0, 600.0));
}

AdmissionSlot::AdmissionSlot(Admission& admission, std::unique_ptr<Admission::Entry> entry)
    : admission_(&admission), entry_(std::move(entry)) {}

AdmissionSlot::AdmissionSlot(AdmissionSlot&&) noexcept = default;

AdmissionSlot::~AdmissionSlot() {
  if (entry_) admission_->leave(*entry_);
}

bool AdmissionSlot::wait_until_admitted() {
  if (entry_->is_running) return !entry_->progress.stop;
  // A client's leaving sets a flag and notifies nobody, hence the short waits.
  constexpr std::chrono::milliseconds look_again{50};
  std::unique_lock lock(admission_->mutex_);
  while (!entry_->is_running) {
    if (entry_->progress.stop) return false;
    admission_->require_open();
    entry_->admitted.wait_for(lock, look_again);
  }
  return !entry_->progress.stop;
}

double AdmissionSlot::queue_ms() const {
  return std::chrono::duration<double, std::milli>(entry_->started - entry_->entered).count();
}

}  // namespace raytracer
