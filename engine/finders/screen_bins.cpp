#include "engine/finders/screen_bins.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <utility>

namespace raytracer::screen_bins {

CellRectangle subtiles_touched(const PixelRectangle& pixels, const BinGrid& blocks) {
  if (!(pixels.x_begin < pixels.x_end && pixels.y_begin < pixels.y_end)) return {};
  // A rectangle beside the image clamps to nothing.
  const auto index = [&](double pixel, int most) {
    return static_cast<int>(std::clamp(pixel / subtile_side, 0.0, static_cast<double>(most)));
  };
  const int columns = subtiles_across * blocks.columns;
  const int rows = subtiles_across * blocks.rows;
  return {index(pixels.x_begin, columns), index(pixels.y_begin, rows),
          index(pixels.x_end + subtile_side, columns), index(pixels.y_end + subtile_side, rows)};
}

void sort_by_distance(std::span<BinnedEntry> entries) {
  constexpr std::size_t few = 48;
  constexpr int digit_bits = 8;
  constexpr std::uint32_t digits = 1U << digit_bits;
  if (entries.size() <= few) {
    std::sort(entries.begin(), entries.end(), [](const BinnedEntry& a, const BinnedEntry& b) {
      return a.entry.nearest < b.entry.nearest;
    });
    return;
  }
  std::vector<BinnedEntry> other(entries.size());
  std::span<BinnedEntry> from = entries;
  std::span<BinnedEntry> to = other;
  for (int shift = 0; shift < 32; shift += digit_bits) {
    const auto digit = [shift](const BinnedEntry& binned) {
      return std::bit_cast<std::uint32_t>(binned.entry.nearest) >> shift & (digits - 1);
    };
    std::array<std::uint32_t, digits> next{};
    for (const BinnedEntry& binned : from) ++next[digit(binned)];
    if (next[digit(from[0])] == from.size()) continue;
    std::exclusive_scan(next.begin(), next.end(), next.begin(), 0U);
    for (const BinnedEntry& binned : from) to[next[digit(binned)]++] = binned;
    std::swap(from, to);
  }
  if (from.data() != entries.data()) std::copy(from.begin(), from.end(), entries.begin());
}

}  // namespace raytracer::screen_bins
