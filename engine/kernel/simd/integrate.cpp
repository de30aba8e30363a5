#include "engine/kernel/simd/integrate.h"

#include "engine/kernel/simd/instruction_sets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/kernel/simd/integrate.cpp"  // this file, once per target
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "engine/kernel/simd/part_integral-inl.h"
#include "engine/kernel/simd/store-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

inline constexpr int all_parts_count = parts_across * parts_across;

/// The places of a part's pixels in its block, as far as the block has them.
struct PlacesOfPart {
  std::array<std::uint8_t, std::size_t{part_side} * part_side> places;
  std::size_t count = 0;

  HWY_INLINE PlacesOfPart(int part, int width, int height) {
    const int x_begin = part % parts_across * part_side;
    const int y_begin = part / parts_across * part_side;
    for (int y = y_begin; y < std::min(y_begin + part_side, height); ++y)
      for (int x = x_begin; x < std::min(x_begin + part_side, width); ++x)
        places[count++] = static_cast<std::uint8_t>(x + block_side * y);
  }
};

template <class D, typename T = hn::TFromD<D>>
HWY_INLINE V3<hn::Vec<D>> background_of(D d, const SimdScene<T>& scene, Transfer transfer) {
  return resolved(d, clamped(d, broadcast(d, scene.background)), hn::Set(d, T(1)), transfer);
}

template <class D>
HWY_INLINE void store_part(const PartIntegral<D>& part, const PlacesOfPart& pixels,
                           const Tile& tile, Image& image, PixelSpreads& spreads) {
  for (std::size_t k = 0; k < pixels.count; ++k) {
    const int x = tile.x_begin + pixels.places[k] % block_side;
    const int y = tile.y_begin + pixels.places[k] / block_side;
    float* const pixel = image.pixel(x, y);
    pixel[0] = static_cast<float>(part.red[k]);
    pixel[1] = static_cast<float>(part.green[k]);
    pixel[2] = static_cast<float>(part.blue[k]);
    spreads.set(spreads.index(x, y),
                {static_cast<float>(part.error2[k]), static_cast<float>(part.variance[k])});
  }
}

template <typename T>
IntegratedBlock integrate_block(const SimdScene<T>& scene, const LinePattern& pattern,
                                Transfer transfer, const Tile& tile, Image& image,
                                PixelSpreads& spreads) {
  using D = hn::ScalableTag<T>;
  const D d;
  using Part = PartIntegral<D>;
  const Block block{tile.x_begin, tile.y_begin, tile.x_end - tile.x_begin,
                    tile.y_end - tile.y_begin, tile.parts};
  BlockContents<T> contents(scene, tile.x_begin / block_side, tile.y_begin / block_side);
  const auto fill_with_background = [&](std::uint32_t parts) HWY_ATTR {
    fill_parts(PlainRow(d, background_of(d, scene, transfer)), block, parts, Canvas(&image));
  };
  if (contents.parts == 0) {
    fill_with_background(Tile::all_parts);
    return {};
  }
  Part part(d, scene, contents, pattern, transfer, tile.x_begin, tile.y_begin);
  IntegratedBlock result;
  std::uint32_t empty = 0;
  for (int i = 0; i < all_parts_count; ++i) {
    const auto bit = std::uint32_t{1} << i;
    if ((contents.parts & bit) == 0) {
      empty |= bit;
      continue;
    }
    const PlacesOfPart pixels(i, block.width, block.height);
    if (pixels.count == 0) continue;
    const auto outcome = part.run(d, i, std::span(pixels.places).first(pixels.count));
    if (outcome == Part::Outcome::nothing_there) empty |= bit;
    if (outcome == Part::Outcome::not_exact ||
        (outcome == Part::Outcome::done && !part.found_all())) {
      result.left = static_cast<std::uint16_t>(result.left | bit);
    } else if (outcome == Part::Outcome::done) {
      store_part(part, pixels, tile, image, spreads);
      result.beyond += part.beyond_range();
    }
  }
  if (empty != 0) fill_with_background(empty);
  return result;
}

template <typename T>
void integrate_pixels(const SimdScene<T>& scene, const LinePattern& pattern, Transfer transfer,
                      const BlockPixels& pixels, SampledPixel* results) {
  using D = hn::ScalableTag<T>;
  const D d;
  using Part = PartIntegral<D>;
  BlockContents<T> contents(scene, pixels.x_begin / block_side, pixels.y_begin / block_side);
  Part part(d, scene, contents, pattern, transfer, pixels.x_begin, pixels.y_begin);
  const auto part_at = [&](std::size_t i) {
    const int place = pixels.places[i];
    return place / block_side / part_side * parts_across + place % block_side / part_side;
  };
  const V3<hn::Vec<D>> background = background_of(d, scene, transfer);
  const SampledPixel empty{{static_cast<float>(hn::GetLane(background.x)),
                            static_cast<float>(hn::GetLane(background.y)),
                            static_cast<float>(hn::GetLane(background.z))}};
  const std::size_t at_once = part.pixels_at_once();
  std::size_t end = 0;
  for (std::size_t begin = 0; begin < pixels.places.size(); begin = end) {
    const int number = part_at(begin);
    while (end < pixels.places.size() && end - begin < at_once && part_at(end) == number) ++end;
    if (part.run(d, number, pixels.places.subspan(begin, end - begin)) != Part::Outcome::done) {
      std::fill(results + begin, results + end, empty);
      continue;
    }
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t k = i - begin;
      results[i] = {{static_cast<float>(part.red[k]), static_cast<float>(part.green[k]),
                     static_cast<float>(part.blue[k])},
                    {static_cast<float>(part.error2[k]), static_cast<float>(part.variance[k])},
                    part.is_number(k)};
    }
  }
}

IntegratedBlock block_in_single(const SimdScene<float>& scene, const LinePattern& pattern,
                                Transfer transfer, const Tile& block, Image& image,
                                PixelSpreads& spreads) {
  return integrate_block(scene, pattern, transfer, block, image, spreads);
}
IntegratedBlock block_in_double(const SimdScene<double>& scene, const LinePattern& pattern,
                                Transfer transfer, const Tile& block, Image& image,
                                PixelSpreads& spreads) {
  return integrate_block(scene, pattern, transfer, block, image, spreads);
}
void pixels_in_single(const SimdScene<float>& scene, const LinePattern& pattern, Transfer transfer,
                      const BlockPixels& pixels, SampledPixel* results) {
  integrate_pixels(scene, pattern, transfer, pixels, results);
}
void pixels_in_double(const SimdScene<double>& scene, const LinePattern& pattern, Transfer transfer,
                      const BlockPixels& pixels, SampledPixel* results) {
  integrate_pixels(scene, pattern, transfer, pixels, results);
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raytracer {
namespace {

HWY_EXPORT(block_in_single);
HWY_EXPORT(block_in_double);
HWY_EXPORT(pixels_in_single);
HWY_EXPORT(pixels_in_double);

}  // namespace

IntegratedBlock integrate_block(const SimdScene<float>& scene, const LinePattern& pattern,
                                Transfer transfer, const Tile& block, std::int64_t target,
                                Image& image, PixelSpreads& spreads) {
  return HWY_DISPATCH_TABLE(block_in_single)[dispatch_index(target)](scene, pattern, transfer,
                                                                     block, image, spreads);
}

IntegratedBlock integrate_block(const SimdScene<double>& scene, const LinePattern& pattern,
                                Transfer transfer, const Tile& block, std::int64_t target,
                                Image& image, PixelSpreads& spreads) {
  return HWY_DISPATCH_TABLE(block_in_double)[dispatch_index(target)](scene, pattern, transfer,
                                                                     block, image, spreads);
}

void integrate_pixels(const SimdScene<float>& scene, const LinePattern& pattern, Transfer transfer,
                      const BlockPixels& pixels, std::int64_t target,
                      std::span<SampledPixel> results) {
  HWY_DISPATCH_TABLE(pixels_in_single)
  [dispatch_index(target)](scene, pattern, transfer, pixels, results.data());
}

void integrate_pixels(const SimdScene<double>& scene, const LinePattern& pattern, Transfer transfer,
                      const BlockPixels& pixels, std::int64_t target,
                      std::span<SampledPixel> results) {
  HWY_DISPATCH_TABLE(pixels_in_double)
  [dispatch_index(target)](scene, pattern, transfer, pixels, results.data());
}

}  // namespace raytracer
#endif  // HWY_ONCE
