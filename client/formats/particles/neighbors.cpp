#include "client/formats/particles/neighbors.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "client/formats/particles/elements.h"
#include "client/formats/triple.h"

namespace raytracer::client {
namespace {

/// Places in cubes, as a list that is sorted by cube. Cubes far outside run into each other.
class Cubes {
 public:
  Cubes(const std::vector<model::Triple>& places, double size) : size_(size) {
    entries_.reserve(places.size());
    for (std::uint32_t i = 0; i < places.size(); ++i)
      entries_.push_back({key(cube_of(places[i])), i});
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
      return a.key != b.key ? a.key < b.key : a.index < b.index;
    });
  }

  /// Calls `visit` with each pair of the same or neighbouring cubes, once.
  template <typename Visit>
  void each_pair(Visit visit) const {
    for (std::size_t begin = 0; begin < entries_.size();) {
      const std::span<const Entry> here = cube(entries_[begin].key);
      for (std::size_t i = 0; i < here.size(); ++i)
        for (std::size_t j = i + 1; j < here.size(); ++j) visit(here[i].index, here[j].index);
      for (const std::uint64_t step : steps()) {
        const std::span<const Entry> there = cube(entries_[begin].key + step);
        for (const Entry& a : here)
          for (const Entry& b : there) visit(a.index, b.index);
      }
      const std::uint64_t key_here = entries_[begin].key;
      while (begin < entries_.size() && entries_[begin].key == key_here) ++begin;
    }
  }

 private:
  struct Entry {
    std::uint64_t key;
    std::uint32_t index;
  };
  using Cube = std::array<std::uint64_t, 3>;
  static constexpr int bits = 20;
  static constexpr std::size_t most_in_a_cube = 64;

  /// From 1 to 2^20 - 2, so that a neighbour never runs into another row.
  Cube cube_of(const model::Triple& place) const {
    Cube cube{};
    constexpr double half = 1 << (bits - 1);
    for (std::size_t i = 0; i < 3; ++i)
      cube[i] = static_cast<std::uint64_t>(
          std::clamp(std::floor(place[i] / size_) + half, 1.0, 2 * half - 2));
    return cube;
  }

  static std::uint64_t key(const Cube& cube) {
    return cube[0] << (2 * bits) | cube[1] << bits | cube[2];
  }

  /// To those 13 of the 26 neighbours whose keys are greater.
  static std::array<std::uint64_t, 13> steps() {
    std::array<std::uint64_t, 13> result{};
    std::size_t count = 0;
    constexpr std::int64_t y_step = std::int64_t{1} << bits;
    constexpr std::int64_t x_step = y_step << bits;
    for (std::int64_t x = -1; x <= 1; ++x)
      for (std::int64_t y = -1; y <= 1; ++y)
        for (std::int64_t z = -1; z <= 1; ++z)
          if (const std::int64_t step = x * x_step + y * y_step + z; step > 0)
            result[count++] = static_cast<std::uint64_t>(step);
    return result;
  }

  std::span<const Entry> cube(std::uint64_t key) const {
    const auto begin = std::lower_bound(
        entries_.begin(), entries_.end(), key,
        [](const Entry& entry, std::uint64_t sought) { return entry.key < sought; });
    auto end = begin;
    while (end != entries_.end() && end->key == key &&
           static_cast<std::size_t>(end - begin) < most_in_a_cube)
      ++end;
    return {begin, end};
  }

  double size_;
  std::vector<Entry> entries_;
};

}  // namespace

std::vector<std::array<std::uint32_t, 2>> bonds_by_distance(
    const std::vector<model::Triple>& places, const std::vector<std::uint8_t>& elements) {
  if (elements.empty()) return {};
  constexpr double tolerance = 0.45;
  constexpr double least = 0.4;
  double largest = 0;
  for (const std::uint8_t element : elements) largest = std::max(largest, covalent_radius(element));
  std::vector<std::array<std::uint32_t, 2>> bonds;
  Cubes(places, 2 * largest + tolerance).each_pair([&](std::uint32_t a, std::uint32_t b) {
    constexpr std::uint8_t hydrogen = 1;
    if (elements[a] == hydrogen && elements[b] == hydrogen) return;
    const double most = covalent_radius(elements[a]) + covalent_radius(elements[b]) + tolerance;
    const model::Triple way = difference(places[a], places[b]);
    const double squared_distance = dot(way, way);
    if (squared_distance >= least * least && squared_distance <= most * most)
      bonds.push_back({std::min(a, b), std::max(a, b)});
  });
  return bonds;
}

}  // namespace raytracer::client
