#include "server/admission.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "server/problem.h"

namespace raytracer {

Admission::Admission(std::size_t most_running, std::size_t most_waiting)
    : most_running_(most_running), most_waiting_(most_waiting) {}

Admission::Slot::Slot(Admission& admission, RenderProgress& progress)
    : admission_(admission), progress_(progress) {
  const std::scoped_lock lock(admission_.mutex_);
  if (admission_.closed_) admission_.refuse_closed();
  if (admission_.running_.size() >= admission_.most_running_) admission_.require_place();
  admission_.waiting_.push_back(this);
  admission_.let_in_next();
}

Admission::Slot::~Slot() {
  const std::scoped_lock lock(admission_.mutex_);
  if (is_running_ && !progress_.stop) {
    const std::chrono::duration<double> render = Clock::now() - started_;
    admission_.mean_render_s_ += 0.2 * (render.count() - admission_.mean_render_s_);
  }
  std::erase(admission_.running_, this);
  std::erase(admission_.waiting_, this);
  admission_.let_in_next();
  if (admission_.running_.empty() && admission_.waiting_.empty()) admission_.emptied_.notify_all();
}

bool Admission::Slot::wait_until_admitted() {
  std::unique_lock lock(admission_.mutex_);
  changed_.wait(lock, [&] { return is_running_ || progress_.stop || admission_.closed_; });
  if (!is_running_ && !progress_.stop) admission_.refuse_closed();
  return !progress_.stop;
}

double Admission::Slot::queue_ms() const {
  return std::chrono::duration<double, std::milli>(started_ - entered_).count();
}

void Admission::stop(RenderProgress& progress) {
  const std::scoped_lock lock(mutex_);
  progress.stop = true;
  const auto slot = std::find_if(waiting_.begin(), waiting_.end(), [&](const Slot* waiting) {
    return &waiting->progress_ == &progress;
  });
  if (slot == waiting_.end()) return;
  (*slot)->changed_.notify_all();
  waiting_.erase(slot);
}

std::shared_ptr<const void> Admission::add_waiter(RenderProgress& progress) {
  const std::scoped_lock lock(mutex_);
  if (closed_) refuse_closed();
  require_place();
  elsewhere_.push_back({&progress, Clock::now()});
  return {&progress, [this](const RenderProgress* own) {
            const std::scoped_lock lock_at_end(mutex_);
            std::erase_if(elsewhere_, [&](const Elsewhere& one) { return one.progress == own; });
            emptied_.notify_all();
          }};
}

void Admission::require_place() const {
  if (may_wait()) return;
  refuse(429,
         fmt::format("{} renders wait already (--max-queue); try again later",
                     waiting_.size() + elsewhere_.size()),
         {{"Retry-After", std::to_string(seconds_until_served())}});
}

/// Until all are served nobody else can take this server's place.
void Admission::refuse_closed() const {
  refuse(503, "The server is shutting down and takes no new work",
         {{"Retry-After", std::to_string(seconds_until_served())}});
}

void Admission::require_open() const {
  if (!closed_) return;  // without waiting for the mutex
  const std::scoped_lock lock(mutex_);
  refuse_closed();
}

void Admission::close() {
  const std::scoped_lock lock(mutex_);
  closed_ = true;
  for (Slot* const slot : waiting_) slot->changed_.notify_all();
}

void Admission::stop_running() {
  const std::scoped_lock lock(mutex_);
  for (Slot* const slot : running_) slot->progress_.stop = true;
  for (Slot* const slot : waiting_) slot->progress_.stop = true;
  for (const Elsewhere& one : elsewhere_) one.progress->stop = true;
}

Admission::Load Admission::load() const {
  const std::scoped_lock lock(mutex_);
  return {running_.size(), waiting_.size() + elsewhere_.size()};
}

bool Admission::is_full() const {
  const std::scoped_lock lock(mutex_);
  // Who would be made elsewhere always needs a place.
  return !may_wait() && (running_.size() >= most_running_ || !elsewhere_.empty());
}

bool Admission::wait_until_empty(std::chrono::milliseconds timeout) const {
  std::unique_lock lock(mutex_);
  return emptied_.wait_for(
      lock, timeout, [&] { return running_.empty() && waiting_.empty() && elsewhere_.empty(); });
}

void Admission::let_in_next() {
  while (!closed_ && running_.size() < most_running_ && !waiting_.empty()) {
    Slot* const next = waiting_.front();
    waiting_.pop_front();
    running_.push_back(next);
    next->started_ = Clock::now();
    next->is_running_ = true;
    next->changed_.notify_all();
  }
}

long Admission::retry_after_s() const {
  const std::scoped_lock lock(mutex_);
  return seconds_until_served();
}

/// How long it will take in all.
double Admission::whole_s(const RenderProgress& progress, double so_far_s) const {
  constexpr double tells_from = 0.01;  // a render's fraction, of the time that it will take
  const double fraction = progress.fraction;
  // One that has been at it for longer than most, and does not tell, will take as long again.
  return fraction < tells_from ? std::max(mean_render_s_, 2 * so_far_s)
                               : so_far_s / std::min(fraction, 1.0);
}

long Admission::seconds_until_served() const {
  double longest_s = mean_render_s_;
  double longest_left_s = 0;
  double running_s = 0;
  const auto now = Clock::now();
  const auto seconds_since = [&](Clock::time_point begin) {
    return std::chrono::duration<double>(now - begin).count();
  };
  for (const Slot* const slot : running_) {
    const double so_far_s = seconds_since(slot->started_);
    const double all_s = whole_s(slot->progress_, so_far_s);
    running_s += all_s - so_far_s;
    longest_left_s = std::max(longest_left_s, all_s - so_far_s);
    longest_s = std::max(longest_s, all_s);
  }
  for (const Elsewhere& one : elsewhere_) {
    const double so_far_s = seconds_since(one.began);
    longest_left_s = std::max(longest_left_s, whole_s(*one.progress, so_far_s) - so_far_s);
  }
  const double waiting_s = longest_s * static_cast<double>(waiting_.size());
  const double all_s =
      std::max(longest_left_s, (running_s + waiting_s) / static_cast<double>(most_running_));
  return std::lround(std::clamp(std::ceil(all_s), 1.0, longest_retry_after_s));
}

}  // namespace raytracer
