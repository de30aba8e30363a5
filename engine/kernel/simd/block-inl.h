// A block of pixels: how packets cover it, its colours, and their way into the image.

#if defined(RAYTRACER_KERNEL_SIMD_BLOCK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_BLOCK_INL_H_
#undef RAYTRACER_KERNEL_SIMD_BLOCK_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_BLOCK_INL_H_
#endif

#include <hwy/contrib/math/math-inl.h>

#include <algorithm>

#include "engine/image/image.h"
#include "engine/kernel/simd/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

inline constexpr int block_pixels = block_side * block_side;

/// Pixels begin <= (x, y) < begin + size, y = 0 on top, at most `block_side` either way.
struct Block {
  int x_begin;
  int y_begin;
  int width;
  int height;
};

/// How a packet covers pixels: as near to a square as its lanes allow, because neighbours in both
/// directions meet the same things.
template <class D>
struct PacketShape {
  static constexpr int lanes = static_cast<int>(hn::MaxLanes(D()));
  static constexpr int width = lanes >= 8 ? 4 : lanes >= 2 ? 2 : 1;
  static constexpr int height = lanes / width;
  static constexpr int packets_across = block_side / width;
  static constexpr int packets = block_pixels / lanes;
};

/// Where a packet lies in its block, in pixels.
template <class D>
struct PacketPlace {
  int x;
  int y;

  explicit PacketPlace(int packet)
      : x(packet % PacketShape<D>::packets_across * PacketShape<D>::width),
        y(packet / PacketShape<D>::packets_across * PacketShape<D>::height) {}

  bool is_in(const Block& block) const { return x < block.width && y < block.height; }
  /// Of the 4 x 4 parts that a screen bin's entries speak of.
  int part() const { return y / 4 * 4 + x / 4; }
};

/// The lanes' pixels relative to their packet's.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
struct LaneOffsets {
  V x;
  V y;

  explicit HWY_INLINE LaneOffsets(D d) {
    using Shape = PacketShape<D>;
    HWY_ALIGN T across[Shape::lanes];
    HWY_ALIGN T down[Shape::lanes];
    for (int lane = 0; lane < Shape::lanes; ++lane) {
      const int row = lane / Shape::width;
      across[lane] = static_cast<T>(lane % Shape::width);
      down[lane] = static_cast<T>(row);
    }
    x = hn::Load(d, across);
    y = hn::Load(d, down);
  }
};

/// Colours of a block's pixels, packet by packet.
template <typename T>
struct BlockColours {
  alignas(64) T red[block_pixels];
  alignas(64) T green[block_pixels];
  alignas(64) T blue[block_pixels];
};

template <class D, typename T = hn::TFromD<D>>
HWY_INLINE void store(D d, const V3<hn::Vec<D>>& colour, std::size_t first, BlockColours<T>& to) {
  hn::Store(colour.x, d, to.red + first);
  hn::Store(colour.y, d, to.green + first);
  hn::Store(colour.z, d, to.blue + first);
}

template <class D, typename T = hn::TFromD<D>>
HWY_INLINE V3<hn::Vec<D>> load(D d, const BlockColours<T>& from, std::size_t first) {
  return load(d, from.red + first, from.green + first, from.blue + first);
}

/// To at most 1: a sample's colour is never negative.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V3<V> clamped(D d, const V3<V>& colour) {
  const V one = hn::Set(d, hn::TFromD<D>(1));
  return {hn::Min(colour.x, one), hn::Min(colour.y, one), hn::Min(colour.z, one)};
}

/// As encode_channel() in engine/image/transfer.h.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE V encoded(D d, Transfer transfer, V linear) {
  if (transfer == Transfer::linear) return linear;
  const auto is_dark = hn::Le(linear, hn::Set(d, T(0.0031308)));
  const V straight = hn::Mul(hn::Set(d, T(12.92)), linear);
  if (hn::AllTrue(d, is_dark)) return straight;
  const V logarithm = hn::Log(d, hn::Max(linear, hn::Set(d, T(0.003))));
  const V power = hn::Exp(d, hn::Mul(logarithm, hn::Set(d, T(1 / 2.4))));
  const V curved = hn::MulSub(hn::Set(d, T(1.055)), power, hn::Set(d, T(0.055)));
  return hn::IfThenElse(is_dark, straight, hn::Min(curved, hn::Set(d, T(1))));
}

/// Stores lanes as red, green, blue, red ... in single precision.
template <class D>
HWY_INLINE void store_interleaved(D d, const V3<hn::Vec<D>>& colour, float* to) {
  if constexpr (sizeof(hn::TFromD<D>) == sizeof(float)) {
    hn::StoreInterleaved3(colour.x, colour.y, colour.z, d, to);
  } else {
    const hn::Rebind<float, D> single;
    hn::StoreInterleaved3(hn::DemoteTo(single, colour.x), hn::DemoteTo(single, colour.y),
                          hn::DemoteTo(single, colour.z), single, to);
  }
}

/// Stores a packet's finished pixels, those that are in the block.
template <class D>
HWY_INLINE void store_pixels(D d, const V3<hn::Vec<D>>& colour, const Block& block,
                             const PacketPlace<D>& place, Image& image) {
  using Shape = PacketShape<D>;
  // StoreInterleaved3 of part of a vector may write a whole one.
  HWY_ALIGN float values[3 * Shape::lanes + HWY_MAX_BYTES / sizeof(float)];
  store_interleaved(d, colour, values);
  const int columns = std::min(Shape::width, block.width - place.x);
  const int rows = std::min(Shape::height, block.height - place.y);
  float* to = image.pixel(block.x_begin + place.x, block.y_begin + place.y);
  const std::ptrdiff_t stride = 3 * static_cast<std::ptrdiff_t>(image.width);
  if (columns == Shape::width) {
    for (int row = 0; row < rows; ++row, to += stride)
      for (int i = 0; i < 3 * Shape::width; ++i) to[i] = values[3 * Shape::width * row + i];
  } else {
    for (int row = 0; row < rows; ++row, to += stride)
      for (int i = 0; i < 3 * columns; ++i) to[i] = values[3 * Shape::width * row + i];
  }
}

/// Stores one colour in all of a block's pixels.
template <class D>
void fill_block(D d, const V3<hn::Vec<D>>& colour, const Block& block, Image& image) {
  constexpr std::size_t lanes = PacketShape<D>::lanes;
  HWY_ALIGN float packet[3 * lanes + HWY_MAX_BYTES / sizeof(float)];
  store_interleaved(d, colour, packet);
  float row[3 * block_side];
  for (int i = 0; i < 3 * block_side; ++i) row[i] = packet[i % 3];
  for (int y = 0; y < block.height; ++y)
    std::copy_n(row, 3 * static_cast<std::ptrdiff_t>(block.width),
                image.pixel(block.x_begin, block.y_begin + y));
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
