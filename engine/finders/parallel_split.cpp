#include "engine/finders/parallel_split.h"

#include <algorithm>
#include <utility>

namespace raytracer {
namespace {

constexpr std::uint32_t chunk_size = 4096;

std::size_t chunk_count(const Range& range) { return (range.size() + chunk_size - 1) / chunk_size; }

Range chunk_range(const Range& range, std::size_t chunk) {
  const std::uint32_t begin = range.begin + static_cast<std::uint32_t>(chunk) * chunk_size;
  return {begin, std::min(range.end, begin + chunk_size)};
}

/// Ranges that are walked through as if they were one.
class Walk {
 public:
  Walk(const std::vector<Range>& ranges, std::uint32_t start) : ranges_(ranges) {
    while (start >= ranges_[range_].size()) start -= ranges_[range_++].size();
    at_ = ranges_[range_].begin + start;
  }
  std::uint32_t next() {
    const std::uint32_t place = at_++;
    if (at_ == ranges_[range_].end && ++range_ < ranges_.size()) at_ = ranges_[range_].begin;
    return place;
  }

 private:
  const std::vector<Range>& ranges_;
  std::size_t range_ = 0;
  std::uint32_t at_ = 0;
};

}  // namespace

template <typename Task>
void ParallelSplit::for_chunks(const Range& range, const Task& task) {
  pool_.run(chunk_count(range), [&](std::size_t chunk) { task(chunk, chunk_range(range, chunk)); });
}

Part ParallelSplit::bound(const Range& range) {
  std::vector<Part> parts(chunk_count(range));
  for_chunks(range, [&](std::size_t chunk, const Range& part) {
    parts[chunk] = raytracer::bound(records_, part);
  });
  Part all{range, {}, {}};
  for (const Part& part : parts) {
    all.box.include(part.box);
    all.centers.include(part.centers);
  }
  return all;
}

Bins ParallelSplit::count(const Range& range, const BinScale& scale) {
  std::vector<Bins> bins(chunk_count(range));
  for_chunks(range, [&](std::size_t chunk, const Range& part) {
    bins[chunk].count(scale, records_, part);
  });
  for (std::size_t chunk = 1; chunk < bins.size(); ++chunk) bins[0].add(bins[chunk]);
  return bins[0];
}

Sides ParallelSplit::partition(const Range& range, const BinScale& scale, const Cut& cut) {
  std::vector<Sides> sides(chunk_count(range));
  for_chunks(range, [&](std::size_t chunk, const Range& part) {
    sides[chunk] = raytracer::partition(records_, part, scale, cut);
  });
  Sides all{range.begin, {}, {}};
  for (std::size_t chunk = 0; chunk < sides.size(); ++chunk) {
    all.below.include(sides[chunk].below);
    all.above.include(sides[chunk].above);
    all.middle += sides[chunk].middle - chunk_range(range, chunk).begin;
  }
  exchange(range, sides, all.middle);
  return all;
}

/// Each chunk is in order; what lies on the wrong side of the whole's middle changes places.
void ParallelSplit::exchange(const Range& range, const std::vector<Sides>& sides,
                             std::uint32_t middle) {
  std::vector<Range> late;   // above the cut, but before the middle
  std::vector<Range> early;  // below the cut, but behind the middle
  std::uint32_t count = 0;
  for (std::size_t chunk = 0; chunk < sides.size(); ++chunk) {
    const Range part = chunk_range(range, chunk);
    const Range above{sides[chunk].middle, std::min(part.end, middle)};
    const Range below{std::max(part.begin, middle), sides[chunk].middle};
    if (above.begin < above.end) {
      late.push_back(above);
      count += above.size();
    }
    if (below.begin < below.end) early.push_back(below);
  }
  for_chunks({0, count}, [&](std::size_t, const Range& part) {
    Walk first(late, part.begin);
    Walk second(early, part.begin);
    for (std::uint32_t i = part.begin; i < part.end; ++i)
      std::swap(records_[first.next()], records_[second.next()]);
  });
}

}  // namespace raytracer
