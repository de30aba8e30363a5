// A block of pixels: how packets cover it, and its colours.

#include <array>
#include <cstdint>

#include "engine/kernel/sample_point.h"
#include "engine/math/block.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

inline constexpr int block_pixels = block_side * block_side;

/// Some of a block's pixels: row by row, a bit for each.
using PixelBits = std::array<std::uint16_t, block_side>;

/// Pixels begin <= (x, y) < begin + size, y = 0 on top, at most `block_side` either way.
struct Block {
  int x_begin;
  int y_begin;
  int width;
  int height;
  std::uint32_t subtiles;             ///< those to trace, as Tile::subtiles
  const PixelBits* pixels = nullptr;  ///< those of them to trace, if not all
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

  /// The place of the block's pixel (x, y), packet by packet.
  static constexpr std::size_t index_of(int x, int y) {
    const int packet = y / height * packets_across + x / width;
    const int ray = packet * lanes + y % height * width + x % width;
    return static_cast<std::size_t>(ray);
  }
};

/// Where a packet lies in its block, in pixels.
template <class D>
struct PacketPlace {
  int x;
  int y;

  explicit PacketPlace(int packet)
      : x(packet % PacketShape<D>::packets_across * PacketShape<D>::width),
        y(packet / PacketShape<D>::packets_across * PacketShape<D>::height) {}

  /// Of the subtiles that a tile or a screen bin's entries speak of.
  int subtile() const { return subtile_index(x, y); }
  /// Whether the block has it, and it is to be traced.
  bool is_in(const Block& block) const {
    return x < block.width && y < block.height && (block.subtiles >> subtile() & 1U) != 0;
  }
};

/// The pixel of a block that a ray goes through, counted as PacketShape::index_of() does.
template <class D>
struct PixelPlace {
  int x;
  int y;

  explicit PixelPlace(int ray) {
    constexpr int lanes = PacketShape<D>::lanes;
    constexpr int width = PacketShape<D>::width;
    const PacketPlace<D> packet(ray / lanes);
    x = packet.x + ray % lanes % width;
    y = packet.y + ray % lanes / width;
  }

  /// Its place in a square of 2 x 2, row by row.
  int quarter() const { return y % 2 * 2 + x % 2; }
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

/// What sample_in() does in the pixels of a block, packet by packet.
template <class D, typename T = hn::TFromD<D>>
struct PatternTurns {
  alignas(64) T is_transposed[block_pixels] = {};  ///< 1 or 0
  alignas(64) T is_mirrored[block_pixels] = {};
  alignas(64) T moved_x[block_pixels] = {};  ///< jitter_of()
  alignas(64) T moved_y[block_pixels] = {};

  constexpr PatternTurns() {
    for (int y = 0; y < block_side; ++y)
      for (int x = 0; x < block_side; ++x) {
        const std::size_t at = PacketShape<D>::index_of(x, y);
        const PatternTurn turn(x, y);
        const SamplePoint moved = jitter_of(x, y);
        is_transposed[at] = turn.is_transposed ? T(1) : T(0);
        is_mirrored[at] = turn.is_mirrored ? T(1) : T(0);
        moved_x[at] = static_cast<T>(moved.x);
        moved_y[at] = static_cast<T>(moved.y);
      }
  }
};
template <class D>
inline constexpr PatternTurns<D> pattern_turns{};

/// Moves coordinates in pixels away from the middle, by so much.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE V moved_away(D d, V at, V by) {
  const V one = hn::Set(d, T(1));
  return hn::MulAdd(hn::CopySign(one, hn::Sub(at, hn::Set(d, T(0.5)))), by, at);
}

/// Where in the lanes' pixels a sample is: sample_in(), with a jitter.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
struct LaneSamples {
  V x;
  V y;

  HWY_INLINE LaneSamples(D d, const PacketPlace<D>& place, const SamplePoint& sample,
                         double jitter) {
    const PatternTurns<D>& turns = pattern_turns<D>;
    const std::size_t first = PacketShape<D>::index_of(place.x, place.y);
    const V zero = hn::Zero(d);
    const V right = hn::Set(d, static_cast<T>(sample.x));
    const V up = hn::Set(d, static_cast<T>(sample.y));
    const auto is_transposed = hn::Gt(hn::Load(d, turns.is_transposed + first), zero);
    const auto is_mirrored = hn::Gt(hn::Load(d, turns.is_mirrored + first), zero);
    const V most = hn::Set(d, static_cast<T>(jitter));
    x = hn::IfThenElse(is_transposed, up, right);
    x = hn::IfThenElse(is_mirrored, hn::Sub(hn::Set(d, T(1)), x), x);
    x = moved_away(d, x, hn::Mul(most, hn::Load(d, turns.moved_x + first)));
    y = hn::IfThenElse(is_transposed, right, up);
    y = moved_away(d, y, hn::Mul(most, hn::Load(d, turns.moved_y + first)));
  }
};

/// Colours of a block's pixels, packet by packet.
template <typename T>
struct BlockColours {
  alignas(64) T red[block_pixels];
  alignas(64) T green[block_pixels];
  alignas(64) T blue[block_pixels];
};

/// Those of one sample.
template <typename T>
struct SampleColours : BlockColours<T> {
  /// What counts of what single cannot tell; set if somebody asks.
  alignas(64) T doubt[block_pixels];
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

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
