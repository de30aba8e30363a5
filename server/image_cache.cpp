#include "server/image_cache.h"

#include <chrono>
#include <utility>

namespace raytracer {

/// One render and those who wait for it. Everything but `progress` is behind the mutex.
struct ImageCache::SingleFlight {
  std::string tag;  ///< by which others may join it
  RenderProgress progress;
  int waiter_count = 0;
  bool is_done = false;
  std::shared_ptr<const FinishedImage> image;
  Problem problem;  ///< why there is no image
  std::condition_variable changed;
};

/// One of those who wait, from when it was counted until it leaves.
class ImageCache::Waiter {
 public:
  Waiter(ImageCache& cache, std::shared_ptr<SingleFlight> flight)
      : cache_(cache), flight_(std::move(flight)) {}
  ~Waiter() { leave(); }
  Waiter(const Waiter&) = delete;
  Waiter& operator=(const Waiter&) = delete;

  void leave() {
    const std::scoped_lock lock(cache_.mutex_);
    if (std::exchange(has_left_, true)) return;
    if (--flight_->waiter_count == 0 && !flight_->is_done) {
      flight_->progress.stop = true;
      cache_.stop_sharing(*flight_);
    }
    flight_->changed.notify_all();
  }

  /// With the mutex held.
  bool has_left() const { return has_left_; }

 private:
  ImageCache& cache_;
  const std::shared_ptr<SingleFlight> flight_;
  bool has_left_ = false;
};

ImageCache::ImageCache(std::size_t most_bytes, Admission& admission,
                       DisconnectWatch& disconnect_watch)
    : admission_(admission), disconnect_watch_(disconnect_watch), memory_(most_bytes) {}

std::uint64_t ImageCache::shared_count() const {
  const std::scoped_lock lock(mutex_);
  return shared_count_;
}

Delivery ImageCache::fetch(const ImageRequest& request, const Make& make) {
  std::shared_ptr<SingleFlight> flight;
  bool is_first = false;
  {
    const std::scoped_lock lock(mutex_);
    const bool may_share = request.tag && !request.bypass_cache;
    if (may_share) {
      if (auto image = memory_.find(*request.tag)) return {std::move(image), Origin::cached};
      flight = in_flight_[*request.tag];
    }
    is_first = !flight;
    if (is_first) {
      flight = std::make_shared<SingleFlight>();
      if (may_share) {
        flight->tag = *request.tag;
        in_flight_[*request.tag] = flight;
      }
    }
    ++flight->waiter_count;
  }
  Waiter waiter(*this, flight);
  const DisconnectWatch::Registration registration(disconnect_watch_, request.connection,
                                                   [&] { waiter.leave(); });
  return is_first ? make_for_all(request, make, *flight) : wait_for(*flight, waiter);
}

Delivery ImageCache::make_for_all(const ImageRequest& request, const Make& make,
                                  SingleFlight& flight) {
  try {
    auto image = std::make_shared<const FinishedImage>(make(flight.progress));
    // Cached before it is done: no request finds it in neither place.
    if (request.tag) memory_.keep(*request.tag, image, image->memory() + request.tag->size());
    finish(flight, image, {});
    return {std::move(image), Origin::rendered};
  } catch (const HttpError& refusal) {
    finish(flight, nullptr, refusal.problem());
    throw;
  } catch (...) {
    finish(flight, nullptr, internal_error());
    throw;
  }
}

Delivery ImageCache::wait_for(SingleFlight& flight, const Waiter& waiter) {
  const auto begin = std::chrono::steady_clock::now();
  const AdmissionWaiter waiting = admission_.add_waiter();
  std::unique_lock lock(mutex_);
  ++shared_count_;
  flight.changed.wait(lock, [&] { return flight.is_done || waiter.has_left(); });
  if (waiter.has_left()) throw HttpError(client_closed_request());
  if (!flight.image) throw HttpError(flight.problem);
  const std::chrono::duration<double, std::milli> waited = std::chrono::steady_clock::now() - begin;
  return {flight.image, Origin::shared, waited.count()};
}

void ImageCache::finish(SingleFlight& flight, std::shared_ptr<const FinishedImage> image,
                        Problem problem) {
  const std::scoped_lock lock(mutex_);
  flight.image = std::move(image);
  flight.problem = std::move(problem);
  flight.is_done = true;
  stop_sharing(flight);
  flight.changed.notify_all();
}

/// With the mutex held: nobody may join it any more.
void ImageCache::stop_sharing(const SingleFlight& flight) {
  const auto entry = in_flight_.find(flight.tag);
  if (entry != in_flight_.end() && entry->second.get() == &flight) in_flight_.erase(entry);
}

}  // namespace raytracer
