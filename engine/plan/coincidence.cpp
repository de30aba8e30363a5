#include "engine/plan/coincidence.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace raytracer {
namespace {

constexpr double widest = 1e-4;               // gaps beyond this no precision has trouble with
constexpr std::size_t most = 10'000;          // sorted and compared in about a millisecond
constexpr std::ptrdiff_t most_compared = 64;  // of each with those next to it

struct Keyed {
  Placement placement;
  double key;  ///< of near ones near, and of others hardly ever
};

/// Those of one kind; none if there are too many, or they have none.
template <typename Primitives>
std::vector<Keyed> placements(const Primitives& primitives) {
  std::vector<Keyed> keyed;
  if (primitives.size() > most) return keyed;
  for (const auto& primitive : primitives) {
    const auto placement = placement_of(primitive);
    if (!placement) return {};
    constexpr Vec3 slanted{0.8192, 0.6711, 0.5497};  // of no symmetry that scenes have
    keyed.push_back({*placement, dot(placement->place, slanted) + dot(placement->other, slanted) +
                                     0.4503 * placement->size});
  }
  return keyed;
}

double least_gap_among(std::vector<Keyed> all) {
  std::sort(all.begin(), all.end(), [](const Keyed& a, const Keyed& b) { return a.key < b.key; });
  double least = infinity;
  for (auto a = all.begin(); a != all.end(); ++a) {
    const double reach = a->placement.reach;
    const auto end = a + std::min(most_compared, all.end() - a);
    for (auto b = a + 1; b < end && b->key - a->key <= 2 * widest * reach; ++b) {
      const double gap = length(a->placement.place - b->placement.place) +
                         length(a->placement.other - b->placement.other) +
                         std::abs(a->placement.size - b->placement.size);
      if (gap > 0 && gap < widest * reach) least = std::min(least, gap / reach);
    }
  }
  return least;
}

}  // namespace

double least_gap(const PackedScene& packed) {
  double least = infinity;
  for_each_kind([&]<class Kind>(std::type_identity<Kind>) {
    least = std::min(least, least_gap_among(placements(of_kind<Kind>(packed.primitives))));
  });
  return least;
}

}  // namespace raytracer
