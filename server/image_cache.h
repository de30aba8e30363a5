// Pictures on request, each rendered once (single flight): one that was rendered lately is cached,
// one that is being rendered is waited for, any other is rendered by the request that asks first.
//
// A picture belongs to all who wait for it. It is given up when the last of them has left, whoever
// began it. Those who wait for another's render take no place in the queue: they are no work, and
// are bounded by themselves.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "engine/engine.h"
#include "server/admission.h"
#include "server/connection.h"
#include "server/disconnect_watch.h"
#include "server/finished_image.h"
#include "server/lru_cache.h"
#include "server/quota.h"

namespace raytracer {

/// A picture for one request.
struct Delivery {
  std::shared_ptr<const FinishedImage> image;
  Stages stages{};           ///< as far as this request waited for them
  std::string_view cache{};  ///< "hit", "shared" with another request, or nothing: it was rendered
};

/// Every member function may be called from any thread.
class ImageCache {
 public:
  /// Keeps `most_bytes` of pictures. The others must outlive it.
  ImageCache(std::size_t most_bytes, Admission& admission, DisconnectWatch& disconnect_watch)
      : admission_(admission),
        disconnect_watch_(disconnect_watch),
        memory_(most_bytes),
        // Half of the connections: the others go on being answered.
        sharers_(static_cast<std::int64_t>(most_connections() / 2),
                 "Too many wait for pictures that others asked for; try again later",
                 [&admission] { return admission.retry_after_s(); }) {}

  /// Makes the picture; throws HttpError, also if `progress.stop` was set before it was done.
  using Make = std::function<FinishedImage(RenderProgress& progress)>;

  /// The picture with this entity tag, after a wait if need be; without a tag it is neither looked
  /// for, shared nor kept. Throws HttpError: what `make` throws, to all who wait for that; 499 if
  /// the client has left; 429 if too many share; 503 if the server ends.
  Delivery fetch(const std::optional<std::string>& tag, const httplib::Request& client,
                 const Make& make);

  LruCounts cache_counts() const { return memory_.counts(); }

 private:
  struct SingleFlight;
  class Waiter;

  Delivery make_for_all(const std::optional<std::string>& tag, const Make& make,
                        SingleFlight& flight);
  Delivery wait_for(const SingleFlight& flight, const Waiter& waiter);

  Admission& admission_;
  DisconnectWatch& disconnect_watch_;
  LruCache<FinishedImage> memory_;
  Quota sharers_;

  std::mutex mutex_;                                                ///< of all that is in flight
  std::map<std::string, std::shared_ptr<SingleFlight>> in_flight_;  ///< by tag
};

}  // namespace raytracer
