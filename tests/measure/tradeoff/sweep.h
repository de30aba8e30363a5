// Settings of one program on one scene, each with the time and the error that it had.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace raytracer::published {

struct SweepPoint {
  std::string setting{};
  double trace_ms = 0;
  double rmse = 0;  ///< true: from a picture of hundreds to thousands of samples per pixel
};

using Sweep = std::vector<SweepPoint>;

/// Where the fastest point is whose error is at most `target`; nothing if none is that good.
std::optional<std::size_t> cheapest_within(const Sweep& sweep, double target);

/// Where those whose error is at most `target` are, the fastest first, `most` at most.
std::vector<std::size_t> cheapest_few_within(const Sweep& sweep, double target, std::size_t most);

/// The least of all; infinite for none.
double least_error(const Sweep& sweep);

/// By time, those that are better than all faster ones.
Sweep front(Sweep sweep);

}  // namespace raytracer::published
