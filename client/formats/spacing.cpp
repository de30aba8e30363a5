#include "client/formats/spacing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "client/formats/threads.h"
#include "client/formats/triple.h"

namespace raytracer::client {

double typical_spacing(const std::vector<model::Triple>& places, std::size_t most_threads) {
  // Each is asked about all others: of many particles a few have to do.
  constexpr std::size_t least_asked = 7;
  constexpr std::size_t most_asked = 32;
  constexpr std::size_t most_looks = std::size_t{1} << 25;
  const std::size_t asked =
      std::clamp(most_looks / std::max<std::size_t>(1, places.size()), least_asked, most_asked);
  const std::size_t step = std::max<std::size_t>(1, places.size() / asked);
  constexpr double none = std::numeric_limits<double>::max();
  std::vector<double> nearest((places.size() + step - 1) / step, none);  // squared
  const std::size_t threads = std::min(most_threads, nearest.size());
  in_threads(threads, [&](std::size_t thread) {
    for (std::size_t i = thread; i < nearest.size(); i += threads) {
      double least = none;
      for (const model::Triple& other : places) {
        const model::Triple way = difference(places[i * step], other);
        const double squared_distance = dot(way, way);
        if (squared_distance > 0 && squared_distance < least) least = squared_distance;
      }
      nearest[i] = least;
    }
  });
  std::erase(nearest, none);
  if (nearest.empty()) return 1;
  const auto middle = nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2);
  std::nth_element(nearest.begin(), middle, nearest.end());
  return std::sqrt(*middle);
}

}  // namespace raytracer::client
