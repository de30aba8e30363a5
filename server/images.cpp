#include "server/images.h"

#include <chrono>
#include <utility>

namespace raytracer {

/// One render and those who wait for it. Everything but `progress` is behind the mutex.
struct Images::Flight {
  std::string tag;  ///< by which it is among the flights that may be joined
  RenderProgress progress;
  int interested = 0;
  bool has_landed = false;
  std::shared_ptr<const FinishedImage> image;
  Problem problem;  ///< why there is no image
  std::condition_variable changed;
};

/// One of those who wait, from when it was counted as interested until it leaves.
class Images::Passenger {
 public:
  Passenger(Images& images, std::shared_ptr<Flight> flight)
      : images_(images), flight_(std::move(flight)) {}
  ~Passenger() { leave(); }
  Passenger(const Passenger&) = delete;
  Passenger& operator=(const Passenger&) = delete;

  void leave() {
    const std::scoped_lock lock(images_.mutex_);
    if (std::exchange(has_left_, true)) return;
    if (--flight_->interested == 0 && !flight_->has_landed) {
      flight_->progress.stop = true;
      images_.close(*flight_);
    }
    flight_->changed.notify_all();
  }

  /// With the mutex held.
  bool has_left() const { return has_left_; }

 private:
  Images& images_;
  const std::shared_ptr<Flight> flight_;
  bool has_left_ = false;
};

Images::Images(std::size_t most_bytes, Admission& admission, Departures& departures)
    : admission_(admission), departures_(departures), memory_(most_bytes) {}

std::uint64_t Images::shared_count() const {
  const std::scoped_lock lock(mutex_);
  return shared_count_;
}

Delivery Images::fetch(const ImageWish& wish, const Make& make) {
  std::shared_ptr<Flight> flight;
  bool is_first = false;
  {
    const std::scoped_lock lock(mutex_);
    const bool may_share = wish.tag && !wish.anew;
    if (may_share) {
      if (auto image = memory_.find(*wish.tag)) return {std::move(image), Origin::remembered};
      flight = flights_[*wish.tag];
    }
    is_first = !flight;
    if (is_first) {
      flight = std::make_shared<Flight>();
      if (may_share) {
        flight->tag = *wish.tag;
        flights_[*wish.tag] = flight;
      }
    }
    ++flight->interested;
  }
  Passenger passenger(*this, flight);
  const Departures::Watch watch(departures_, wish.connection, [&] { passenger.leave(); });
  return is_first ? make_now(wish, make, *flight) : wait_for(*flight, passenger);
}

Delivery Images::make_now(const ImageWish& wish, const Make& make, Flight& flight) {
  try {
    auto image = std::make_shared<const FinishedImage>(make(flight.progress));
    // Remembered before it lands: no request finds it in neither place.
    if (wish.tag) memory_.keep(*wish.tag, image, image->memory() + wish.tag->size());
    land(flight, image, {});
    return {std::move(image), Origin::made};
  } catch (const Refusal& refusal) {
    land(flight, nullptr, refusal.problem());
    throw;
  } catch (...) {
    land(flight, nullptr, internal_error());
    throw;
  }
}

Delivery Images::wait_for(Flight& flight, const Passenger& passenger) {
  const auto begin = std::chrono::steady_clock::now();
  const Admission::Companion companion = admission_.accompany();
  std::unique_lock lock(mutex_);
  ++shared_count_;
  flight.changed.wait(lock, [&] { return flight.has_landed || passenger.has_left(); });
  if (passenger.has_left()) throw Refusal(client_left());
  if (!flight.image) throw Refusal(flight.problem);
  const std::chrono::duration<double, std::milli> waited = std::chrono::steady_clock::now() - begin;
  return {flight.image, Origin::shared, waited.count()};
}

void Images::land(Flight& flight, std::shared_ptr<const FinishedImage> image, Problem problem) {
  const std::scoped_lock lock(mutex_);
  flight.image = std::move(image);
  flight.problem = std::move(problem);
  flight.has_landed = true;
  close(flight);
  flight.changed.notify_all();
}

/// With the mutex held: nobody may join it any more.
void Images::close(const Flight& flight) {
  const auto entry = flights_.find(flight.tag);
  if (entry != flights_.end() && entry->second.get() == &flight) flights_.erase(entry);
}

}  // namespace raytracer
