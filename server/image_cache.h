// Pictures on request, each rendered once (single flight): one that was rendered lately is cached,
// one that is being rendered is waited for, any other is rendered by the request that asks first.
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
#include "server/disconnect_watch.h"
#include "server/finished_image.h"
#include "server/lru_cache.h"
#include "server/problem.h"

namespace raytracer {

/// How a request came to its picture.
enum class Origin { rendered, shared, cached };

struct Delivery {
  std::shared_ptr<const FinishedImage> image;
  Origin origin = Origin::rendered;
  double waited_ms = 0;  ///< for another's render; 0 for those who rendered or found it
};

/// What a client wants.
struct ImageRequest {
  std::optional<std::string> tag;    ///< its entity tag; none: it will never be the same again
  bool bypass_cache = false;         ///< neither cached nor shared, but rendered now
  ConnectionEndpoints connection{};  ///< the client's
};

/// Every member function may be called from any thread.
class ImageCache {
 public:
  /// Keeps `most_bytes` of pictures. The others must outlive it.
  ImageCache(std::size_t most_bytes, Admission& admission, DisconnectWatch& disconnect_watch);

  /// Makes the picture; throws HttpError, also if `progress.stop` was set before it was done.
  using Make = std::function<FinishedImage(RenderProgress& progress)>;

  /// The picture, after a wait if need be. Throws HttpError: what `make` throws, to all who wait
  /// for that; 429 if too many wait; 499 if the client has left.
  Delivery fetch(const ImageRequest& request, const Make& make);

  LruCounts cache_counts() const { return memory_.counts(); }
  /// How many waited for another's render instead of rendering.
  std::uint64_t shared_count() const;

 private:
  struct SingleFlight;
  class Waiter;

  Delivery make_for_all(const ImageRequest& request, const Make& make, SingleFlight& flight);
  Delivery wait_for(SingleFlight& flight, const Waiter& waiter);
  void finish(SingleFlight& flight, std::shared_ptr<const FinishedImage> image, Problem problem);
  void stop_sharing(const SingleFlight& flight);

  Admission& admission_;
  DisconnectWatch& disconnect_watch_;
  LruCache<FinishedImage> memory_;

  mutable std::mutex mutex_;  ///< of all that is in flight
  std::map<std::string, std::shared_ptr<SingleFlight>>
      in_flight_;  ///< by tag, renders that may be joined
  std::uint64_t shared_count_ = 0;
};

}  // namespace raytracer
