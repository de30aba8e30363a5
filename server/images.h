// Pictures on request, each made once: one that was made lately is remembered, one that is being
// made is waited for, any other is made by the request that asks first.
//
// A picture belongs to all who wait for it. It is given up when the last of them has left, whoever
// began it. Those who wait for another's render are counted among the queue's waiting ones, because
// each holds a connection.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "engine/engine.h"
#include "server/admission.h"
#include "server/connection.h"
#include "server/departures.h"
#include "server/finished_image.h"
#include "server/lru_memory.h"
#include "server/problem.h"

namespace raytracer {

/// How a request came to its picture.
enum class Origin { made, shared, remembered };

struct Delivery {
  std::shared_ptr<const FinishedImage> image;
  Origin origin = Origin::made;
  double waited_ms = 0;  ///< for another's render; 0 for those who made or found it
};

/// What a client wants.
struct ImageWish {
  std::optional<std::string> tag;  ///< its entity tag; none: it will never be the same again
  bool anew = false;               ///< neither remembered nor shared, but made now
  ConnectionEnds connection{};     ///< the client's
};

/// Every member function may be called from any thread.
class Images {
 public:
  /// Remembers `most_bytes` of pictures. The others must outlive it.
  Images(std::size_t most_bytes, Admission& admission, Departures& departures);

  /// Makes the picture; throws Refusal, also if `progress.stop` was set before it was done.
  using Make = std::function<FinishedImage(RenderProgress& progress)>;

  /// The picture, after a wait if need be. Throws Refusal: what `make` throws, to all who wait for
  /// that; 429 if too many wait; 499 if the client has left.
  Delivery fetch(const ImageWish& wish, const Make& make);

  LruCounts remembered() const { return memory_.counts(); }
  /// How many waited for another's render instead of rendering.
  std::uint64_t shared_count() const;

 private:
  struct Flight;
  class Passenger;

  Delivery make_now(const ImageWish& wish, const Make& make, Flight& flight);
  Delivery wait_for(Flight& flight, const Passenger& passenger);
  void land(Flight& flight, std::shared_ptr<const FinishedImage> image, Problem problem);
  void close(const Flight& flight);

  Admission& admission_;
  Departures& departures_;
  LruMemory<FinishedImage> memory_;

  mutable std::mutex mutex_;                                ///< of all flights
  std::map<std::string, std::shared_ptr<Flight>> flights_;  ///< by tag, those that may be joined
  std::uint64_t shared_count_ = 0;
};

}  // namespace raytracer
