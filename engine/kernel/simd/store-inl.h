// A block's colours on their way into the image.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <variant>

#include "engine/image/image.h"
#include "engine/image/tile.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// The lanes' channels in single precision, which is what an image of floats holds.
template <class D>
HWY_INLINE hn::Vec<hn::Rebind<float, D>> in_single(D, hn::Vec<D> channel) {
  if constexpr (sizeof(hn::TFromD<D>) == sizeof(float))
    return channel;
  else
    return hn::DemoteTo(hn::Rebind<float, D>(), channel);
}

/// As to_byte() in engine/image/image.h, of channels in [0, 1]: in the lowest byte of a lane, the
/// others zero.
template <class D>
HWY_INLINE hn::Vec<hn::Rebind<std::uint32_t, D>> to_levels(D d, hn::Vec<D> channel) {
  static_assert(sizeof(hn::TFromD<D>) == sizeof(float));
  const auto raised = hn::Add(hn::Mul(channel, hn::Set(d, 255.0F)), hn::Set(d, 0.5F));
  return hn::BitCast(hn::Rebind<std::uint32_t, D>(),
                     hn::ConvertTo(hn::Rebind<std::int32_t, D>(), raised));
}

/// A packet's pixels as an image of floats holds them, with so many channels each.
template <class D, int channel_count>
struct PackedFloats {
  /// From one row of the packet to the next, in channels.
  static constexpr int row_stride = channel_count * PacketShape<D>::width;
  /// StoreInterleaved of part of a vector may write a whole one.
  HWY_ALIGN float channels[channel_count * PacketShape<D>::lanes + HWY_MAX_BYTES / sizeof(float)];

  HWY_INLINE void set(D d, const V3<hn::Vec<D>>& colour) {
    hn::StoreInterleaved3(in_single(d, colour.x), in_single(d, colour.y), in_single(d, colour.z),
                          hn::Rebind<float, D>(), channels);
  }
  HWY_INLINE void set(D d, const CoveredColour<hn::Vec<D>>& pixels) {
    const V3<hn::Vec<D>>& colour = pixels.colour;
    hn::StoreInterleaved4(in_single(d, colour.x), in_single(d, colour.y), in_single(d, colour.z),
                          in_single(d, pixels.cover), hn::Rebind<float, D>(), channels);
  }
};

/// A packet's pixels as an image of bytes holds them, four at the beginning of every 16 bytes; of
/// fewer lanes, all one after another.
template <class D>
struct PackedBytes {
  static constexpr int row_stride = PacketShape<D>::width == 4 ? 16 : 3 * PacketShape<D>::width;
  HWY_ALIGN std::uint8_t channels[4 * PacketShape<D>::lanes];

  HWY_INLINE void set(D d, const V3<hn::Vec<D>>& colour) {
    const hn::Rebind<float, D> single;
    const hn::Rebind<std::uint32_t, D> words;
    const auto red = to_levels(single, in_single(d, colour.x));
    const auto green = to_levels(single, in_single(d, colour.y));
    const auto blue = to_levels(single, in_single(d, colour.z));
    const auto pixels = hn::Or(red, hn::Or(hn::ShiftLeft<8>(green), hn::ShiftLeft<16>(blue)));
    if constexpr (PacketShape<D>::lanes >= 4) {
      alignas(16) static constexpr std::uint8_t lowest_three[16] = {0,  1,  2,  4,  5, 6, 8,  9,
                                                                    10, 12, 13, 14, 3, 7, 11, 15};
      const hn::Repartition<std::uint8_t, decltype(words)> bytes;
      hn::Store(
          hn::TableLookupBytes(hn::BitCast(bytes, pixels), hn::LoadDup128(bytes, lowest_three)),
          bytes, channels);
    } else {
      HWY_ALIGN std::uint32_t lanes[PacketShape<D>::lanes];
      hn::Store(pixels, words, lanes);
      for (int i = 0; i < 3 * PacketShape<D>::lanes; ++i)
        channels[i] = static_cast<std::uint8_t>(lanes[i / 3] >> (i % 3 * 8));
    }
  }
};

template <class D, typename Channel, int channel_count>
using PackedPixels = std::conditional_t<std::is_same_v<Channel, float>,
                                        PackedFloats<D, channel_count>, PackedBytes<D>>;

/// Of an image of so many channels.
template <int channel_count, class D, class ColourOf, typename Channel>
HWY_INLINE void store_block(D d, const ColourOf& colour_of, const Block& block,
                            Raster<Channel>& image) {
  using Shape = PacketShape<D>;
  // All packets before the first copy: a processor waits long for what it has just stored in other
  // pieces.
  PackedPixels<D, Channel, channel_count> packets[Shape::packets];
  for (int i = 0; i < Shape::packets; ++i)
    if (PacketPlace<D>(i).is_in(block)) packets[i].set(d, colour_of(i));
  const std::ptrdiff_t stride = channel_count * static_cast<std::ptrdiff_t>(image.width);
  for (int i = 0; i < Shape::packets; ++i) {
    const PacketPlace<D> place(i);
    if (!place.is_in(block)) continue;
    const auto copy_rows = [&](int row_count, int row_length) HWY_ATTR {
      const Channel* from = packets[i].channels;
      Channel* to = image.pixel(block.x_begin + place.x, block.y_begin + place.y);
      for (int row = 0; row < row_count; ++row, to += stride, from += packets[i].row_stride)
        std::memcpy(to, from,
                    channel_count * static_cast<std::size_t>(row_length) * sizeof(Channel));
    };
    const int columns = std::min(Shape::width, block.width - place.x);
    const int rows = std::min(Shape::height, block.height - place.y);
    if (columns == Shape::width && rows == Shape::height)
      copy_rows(Shape::height, Shape::width);  // of lengths that the compiler knows
    else
      copy_rows(rows, columns);
  }
}

/// As many rows of a subtile or of a block, begun at (x, y) of it and cut off at its end, as `row`.
template <int channel_count, typename Channel>
HWY_INLINE void fill_rows(const Channel* row, const Block& block, int x, int y, int side,
                          Raster<Channel>& image) {
  const int columns = std::min(side, block.width - x);
  const int rows = std::min(side, block.height - y);
  if (columns <= 0 || rows <= 0) return;
  const std::ptrdiff_t stride = channel_count * static_cast<std::ptrdiff_t>(image.width);
  Channel* to = image.pixel(block.x_begin + x, block.y_begin + y);
  for (int i = 0; i < rows; ++i, to += stride) {
    if (columns == side)
      std::memcpy(to, row, channel_count * static_cast<std::size_t>(side) * sizeof(Channel));
    else
      std::memcpy(to, row, channel_count * static_cast<std::size_t>(columns) * sizeof(Channel));
  }
}

/// A block's row of pixels of one colour that cover nothing, as the images hold it.
struct SolidRow {
  float floats[3 * block_side];
  float covered[4 * block_side];
  std::uint8_t bytes[3 * block_side];

  template <class D>
  HWY_INLINE SolidRow(D d, const V3<hn::Vec<D>>& colour) {
    PackedFloats<D, 3> in_floats;
    in_floats.set(d, colour);
    PackedBytes<D> in_bytes;
    in_bytes.set(d, colour);
    for (int pixel = 0; pixel < block_side; ++pixel) {
      for (int channel = 0; channel < 3; ++channel) {
        floats[3 * pixel + channel] = in_floats.channels[channel];
        bytes[3 * pixel + channel] = in_bytes.channels[channel];
        covered[4 * pixel + channel] = in_floats.channels[channel];
      }
      covered[4 * pixel + 3] = 0;
    }
  }
};

template <int channel_count, typename Channel>
HWY_INLINE void fill_subtiles(const Channel* row, const Block& block, std::uint32_t subtiles,
                              Raster<Channel>& image) {
  // Lengths that the compiler knows.
  if (subtiles == Tile::all_subtiles) {
    fill_rows<channel_count>(row, block, 0, 0, block_side, image);
    return;
  }
  for (int subtile = 0; subtile < subtiles_across * subtiles_across; ++subtile)
    if ((subtiles >> subtile & 1U) != 0)
      fill_rows<channel_count>(row, block, subtile % subtiles_across * subtile_side,
                               subtile / subtiles_across * subtile_side, subtile_side, image);
}

/// Whether a kernel has to find the pixels' cover.
HWY_INLINE bool has_cover(const Canvas& canvas) {
  Image* const* image = std::get_if<Image*>(&canvas);
  return image != nullptr && (*image)->channels == 4;
}

/// Stores a block's pixels: colour_of(i) are the i-th packet's, finished; covered_of(i) the same
/// with their cover.
template <class D, class ColourOf, class CoveredOf>
HWY_INLINE void store_block(D d, const ColourOf& colour_of, const CoveredOf& covered_of,
                            const Block& block, const Canvas& canvas) {
  if (has_cover(canvas))
    store_block<4>(d, covered_of, block, *std::get<Image*>(canvas));
  else if (Image* const* image = std::get_if<Image*>(&canvas))
    store_block<3>(d, colour_of, block, **image);
  else
    store_block<3>(d, colour_of, block, *std::get<ByteImage*>(canvas));
}

/// Stores one colour in all pixels of some of a block's subtiles.
HWY_INLINE void fill_subtiles(const SolidRow& row, const Block& block, std::uint32_t subtiles,
                              const Canvas& canvas) {
  if (has_cover(canvas))
    fill_subtiles<4>(row.covered, block, subtiles, *std::get<Image*>(canvas));
  else if (Image* const* image = std::get_if<Image*>(&canvas))
    fill_subtiles<3>(row.floats, block, subtiles, **image);
  else
    fill_subtiles<3>(row.bytes, block, subtiles, *std::get<ByteImage*>(canvas));
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
