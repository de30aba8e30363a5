#include "server/image_cache.h"

#include <atomic>
#include <chrono>
#include <future>
#include <utility>
#include <variant>

#include "server/problem.h"

namespace raytracer {

/// One render and those who wait for it.
struct ImageCache::SingleFlight {
  /// What all are told: an exception would be one object that several threads throw.
  using Ending = std::variant<std::shared_ptr<const FinishedImage>, Problem>;

  RenderProgress progress;  ///< stopped when the last has left: nobody may join it any more
  int waiter_count = 0;     ///< behind the mutex
  std::promise<Ending> promise;
  std::shared_future<Ending> ending{promise.get_future()};
};

/// One of those who wait, from when it was counted until it leaves.
class ImageCache::Waiter {
 public:
  Waiter(ImageCache& cache, SingleFlight& flight) : cache_(cache), flight_(flight) {}
  ~Waiter() { leave(); }
  Waiter(const Waiter&) = delete;
  Waiter& operator=(const Waiter&) = delete;

  void leave() {
    const std::scoped_lock lock(cache_.mutex_);
    if (!has_left_.exchange(true) && --flight_.waiter_count == 0)
      cache_.admission_.stop(flight_.progress);
  }
  bool has_left() const { return has_left_; }

 private:
  ImageCache& cache_;
  SingleFlight& flight_;
  std::atomic<bool> has_left_{false};
};

Delivery ImageCache::fetch(const std::optional<std::string>& tag, const httplib::Request& client,
                           const Make& make) {
  auto flight = std::make_shared<SingleFlight>();
  bool is_first = true;
  {
    const std::scoped_lock lock(mutex_);
    if (tag) {
      if (auto image = memory_.find(*tag)) return {std::move(image), {}, "hit"};
      std::shared_ptr<SingleFlight>& joined = in_flight_[*tag];
      is_first = !joined || joined->progress.stop;
      if (is_first) joined = flight;
      flight = joined;
    }
    ++flight->waiter_count;
  }
  Waiter waiter(*this, *flight);
  const auto watched = disconnect_watch_.watch(client, [&] { waiter.leave(); });
  return is_first ? make_for_all(tag, make, *flight) : wait_for(*flight, waiter);
}

Delivery ImageCache::make_for_all(const std::optional<std::string>& tag, const Make& make,
                                  SingleFlight& flight) {
  const auto end = [&](SingleFlight::Ending ending) {
    flight.promise.set_value(std::move(ending));
    if (!tag) return;  // only now: no request finds it in neither place
    const std::scoped_lock lock(mutex_);
    const auto entry = in_flight_.find(*tag);
    if (entry != in_flight_.end() && entry->second.get() == &flight) in_flight_.erase(entry);
  };
  std::shared_ptr<const FinishedImage> image;
  try {
    image = std::make_shared<const FinishedImage>(make(flight.progress));
    if (tag) memory_.keep(*tag, image, image->memory() + tag->size());
  } catch (const HttpError& error) {
    end(error.problem());
    throw;
  } catch (...) {
    end(internal_error());
    throw;
  }
  end(image);
  return {image, image->stages};
}

Delivery ImageCache::wait_for(const SingleFlight& flight, const Waiter& waiter) {
  constexpr std::chrono::milliseconds between_looks{50};
  const auto begin = std::chrono::steady_clock::now();
  admission_.require_open();
  const Quota::Share place = sharers_.take(1);
  while (flight.ending.wait_for(between_looks) != std::future_status::ready)
    if (waiter.has_left()) refuse(499, "The client has left");
  const std::chrono::duration<double, std::milli> waited = std::chrono::steady_clock::now() - begin;
  const SingleFlight::Ending& ending = flight.ending.get();
  if (const auto* const problem = std::get_if<Problem>(&ending)) throw HttpError(*problem);
  Stages stages;
  stages.queue_ms = waited.count();
  return {std::get<std::shared_ptr<const FinishedImage>>(ending), stages, "shared"};
}

}  // namespace raytracer
