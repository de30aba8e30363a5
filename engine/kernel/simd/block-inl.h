// A block of pixels: how packets cover it, its colours, and their way into the image.

#if defined(RAYTRACER_KERNEL_SIMD_BLOCK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_BLOCK_INL_H_
#undef RAYTRACER_KERNEL_SIMD_BLOCK_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_BLOCK_INL_H_
#endif

#include <hwy/contrib/math/math-inl.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <variant>

#include "engine/image/image.h"
#include "engine/image/tile.h"
#include "engine/kernel/sample_point.h"
#include "engine/kernel/simd/packet-inl.h"
#include "engine/math/block.h"

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
  std::uint32_t parts;  ///< those to trace, as Tile::parts
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

  /// Of the parts that a tile or a screen bin's entries speak of.
  int part() const { return y / part_side * parts_across + x / part_side; }
  /// Whether the block has it, and it is to be traced.
  bool is_in(const Block& block) const {
    return x < block.width && y < block.height && (block.parts >> part() & 1U) != 0;
  }
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

/// stagger_of() the lanes' pixels.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
struct Staggers {
  V x;
  V y;

  HWY_INLINE Staggers(D d, const PacketPlace<D>& place) {
    using Shape = PacketShape<D>;
    HWY_ALIGN T across[Shape::lanes];
    HWY_ALIGN T up[Shape::lanes];
    for (int lane = 0; lane < Shape::lanes; ++lane) {
      const SamplePoint moved =
          stagger_of(place.x + lane % Shape::width, place.y + lane / Shape::width);
      across[lane] = static_cast<T>(moved.x);
      up[lane] = static_cast<T>(moved.y);
    }
    x = hn::Load(d, across);
    y = hn::Load(d, up);
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

/// What store_interleaved() writes: StoreInterleaved3 of part of a vector may write a whole one.
template <class D, typename Channel>
struct Interleaved {
  HWY_ALIGN Channel values[3 * PacketShape<D>::lanes + HWY_MAX_BYTES / sizeof(Channel)];
};

/// The lanes' channels in single precision, which is what an image of floats holds.
template <class D>
HWY_INLINE hn::Vec<hn::Rebind<float, D>> in_single(D, hn::Vec<D> channel) {
  if constexpr (sizeof(hn::TFromD<D>) == sizeof(float))
    return channel;
  else
    return hn::DemoteTo(hn::Rebind<float, D>(), channel);
}

/// As to_byte() in engine/image/image.h, from single precision and exact in double.
template <class DFloat, class DDouble = hn::Rebind<double, DFloat>>
HWY_INLINE hn::Vec<hn::Rebind<std::int32_t, DFloat>> to_levels(DFloat, hn::Vec<DFloat> channel) {
  const DDouble in_double;
  const auto raised = hn::Add(hn::Mul(hn::PromoteTo(in_double, channel), hn::Set(in_double, 255)),
                              hn::Set(in_double, 0.5));
  return hn::DemoteTo(hn::Rebind<std::int32_t, DFloat>(), raised);
}

/// The lanes' 8-bit values.
template <class D>
HWY_INLINE hn::Vec<hn::Rebind<std::uint8_t, D>> to_bytes(D d, hn::Vec<D> channel) {
  const hn::Rebind<std::uint8_t, D> bytes;
#if HWY_TARGET != HWY_SCALAR  // which has no halves
  if constexpr (sizeof(hn::TFromD<D>) == sizeof(float)) {
    // In double they take two vectors.
    const hn::Half<D> half;
    const hn::Rebind<std::int32_t, D> levels;
    return hn::DemoteTo(bytes, hn::Combine(levels, to_levels(half, hn::UpperHalf(half, channel)),
                                           to_levels(half, hn::LowerHalf(half, channel))));
  } else  // NOLINT(readability-else-after-return): the two are of different types
#endif
    return hn::DemoteTo(bytes, to_levels(hn::Rebind<float, D>(), in_single(d, channel)));
}

/// The lanes as red, green, blue, red ...
template <class D>
HWY_INLINE void store_interleaved(D d, const V3<hn::Vec<D>>& colour, float* to) {
  hn::StoreInterleaved3(in_single(d, colour.x), in_single(d, colour.y), in_single(d, colour.z),
                        hn::Rebind<float, D>(), to);
}
template <class D>
HWY_INLINE void store_interleaved(D d, const V3<hn::Vec<D>>& colour, std::uint8_t* to) {
  hn::StoreInterleaved3(to_bytes(d, colour.x), to_bytes(d, colour.y), to_bytes(d, colour.z),
                        hn::Rebind<std::uint8_t, D>(), to);
}

template <class D, typename Channel, typename T = hn::TFromD<D>>
HWY_INLINE void store_block(D d, const BlockColours<T>& colours, const Block& block,
                            Raster<Channel>& image) {
  using Shape = PacketShape<D>;
  // All packets before the first copy: a processor waits long for what it has just stored in other
  // pieces.
  Interleaved<D, Channel> packets[Shape::packets];
  for (int i = 0; i < Shape::packets; ++i)
    if (PacketPlace<D>(i).is_in(block))
      store_interleaved(d, load(d, colours, static_cast<std::size_t>(i) * Shape::lanes),
                        packets[i].values);
  const std::ptrdiff_t stride = 3 * static_cast<std::ptrdiff_t>(image.width);
  for (int i = 0; i < Shape::packets; ++i) {
    const PacketPlace<D> place(i);
    if (!place.is_in(block)) continue;
    const auto copy_rows = [&](int row_count, int row_length) HWY_ATTR {
      const Channel* from = packets[i].values;
      Channel* to = image.pixel(block.x_begin + place.x, block.y_begin + place.y);
      for (int row = 0; row < row_count; ++row, to += stride, from += 3 * Shape::width)
        std::memcpy(to, from, 3 * static_cast<std::size_t>(row_length) * sizeof(Channel));
    };
    const int columns = std::min(Shape::width, block.width - place.x);
    const int rows = std::min(Shape::height, block.height - place.y);
    if (columns == Shape::width && rows == Shape::height)
      copy_rows(Shape::height, Shape::width);  // of lengths that the compiler knows
    else
      copy_rows(rows, columns);
  }
}

/// As many rows of a part or of a block, begun at (x, y) of it and cut off at its end, as `row`.
template <typename Channel>
HWY_INLINE void fill_rows(const Channel* row, const Block& block, int x, int y, int side,
                          Raster<Channel>& image) {
  const int columns = std::min(side, block.width - x);
  const int rows = std::min(side, block.height - y);
  if (columns <= 0 || rows <= 0) return;
  const std::ptrdiff_t stride = 3 * static_cast<std::ptrdiff_t>(image.width);
  Channel* to = image.pixel(block.x_begin + x, block.y_begin + y);
  for (int i = 0; i < rows; ++i, to += stride) {
    if (columns == side)
      std::memcpy(to, row, 3 * static_cast<std::size_t>(side) * sizeof(Channel));
    else
      std::memcpy(to, row, 3 * static_cast<std::size_t>(columns) * sizeof(Channel));
  }
}

/// A block's row of pixels of one colour, as the images hold it.
struct PlainRow {
  HWY_ALIGN float floats[std::size_t{3} * block_side + HWY_MAX_BYTES / sizeof(float)];
  HWY_ALIGN std::uint8_t bytes[std::size_t{3} * block_side + HWY_MAX_BYTES];

  template <class D>
  HWY_INLINE PlainRow(D d, const V3<hn::Vec<D>>& colour) {
    for (int x = 0; x < block_side; x += PacketShape<D>::lanes) {
      store_interleaved(d, colour, floats + std::ptrdiff_t{3} * x);
      store_interleaved(d, colour, bytes + std::ptrdiff_t{3} * x);
    }
  }
};

template <typename Channel>
HWY_INLINE void fill_parts(const Channel* row, const Block& block, std::uint32_t parts,
                           Raster<Channel>& image) {
  // Lengths that the compiler knows.
  if (parts == Tile::all_parts) {
    fill_rows(row, block, 0, 0, block_side, image);
    return;
  }
  for (int part = 0; part < parts_across * parts_across; ++part)
    if ((parts >> part & 1U) != 0)
      fill_rows(row, block, part % parts_across * part_side, part / parts_across * part_side,
                part_side, image);
}

/// Stores a block's finished pixels.
template <class D, typename T = hn::TFromD<D>>
HWY_INLINE void store_block(D d, const BlockColours<T>& colours, const Block& block,
                            const Canvas& canvas) {
  if (Image* const* image = std::get_if<Image*>(&canvas))
    store_block(d, colours, block, **image);
  else
    store_block(d, colours, block, *std::get<ByteImage*>(canvas));
}

/// Stores one colour in all pixels of some of a block's parts.
HWY_INLINE void fill_parts(const PlainRow& row, const Block& block, std::uint32_t parts,
                           const Canvas& canvas) {
  if (Image* const* image = std::get_if<Image*>(&canvas))
    fill_parts(row.floats, block, parts, **image);
  else
    fill_parts(row.bytes, block, parts, *std::get<ByteImage*>(canvas));
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
