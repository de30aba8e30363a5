#include "engine/kernel/simd/render_block.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/kernel/simd/render_block.cpp"  // this file, once per target
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <limits>

#include "engine/kernel/simd/packet-inl.h"
#include "engine/kernel/simd/rays-inl.h"
#include "engine/kernel/simd/reflect-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

template <typename T>
void add_clamped(const BlockSums<T>& sample, BlockSums<T>& sums) {
  const hn::ScalableTag<T> d;
  const auto one = hn::Set(d, T(1));
  for (std::size_t i = 0; i < block_pixels; i += hn::Lanes(d)) {
    const auto add_channel = [&](const T* from, T* to) HWY_ATTR {
      hn::Store(hn::Add(hn::Load(d, to + i), hn::Min(hn::Load(d, from + i), one)), d, to + i);
    };
    add_channel(sample.red, sums.red);
    add_channel(sample.green, sums.green);
    add_channel(sample.blue, sums.blue);
  }
}

/// How a packet covers pixels: as near to a square as its lanes allow, because neighbours in both
/// directions meet the same things.
template <class D>
struct PacketShape {
  static constexpr int lanes = static_cast<int>(hn::MaxLanes(D()));
  static constexpr int width = lanes >= 8 ? 4 : lanes >= 2 ? 2 : 1;
  static constexpr int height = lanes / width;
};

/// Copies a packet's values to where their pixels are in the block, or adds them.
template <class D, typename T = hn::TFromD<D>>
HWY_INLINE void store_packet(D d, hn::Vec<D> values, int pixel, T* block_values) {
  using Shape = PacketShape<D>;
  HWY_ALIGN T lanes[Shape::lanes];
  hn::Store(values, d, lanes);
  for (int y = 0; y < Shape::height; ++y)
    for (int x = 0; x < Shape::width; ++x)
      block_values[pixel + y * block_side + x] = lanes[y * Shape::width + x];
}

/// The block's lanes as pixel coordinates within a packet.
template <typename T>
struct LaneOffsets {
  alignas(64) T x[64 / sizeof(T)];
  alignas(64) T y[64 / sizeof(T)];
};

template <class D, typename T = hn::TFromD<D>>
LaneOffsets<T> lane_offsets(D) {
  using Shape = PacketShape<D>;
  LaneOffsets<T> offsets{};
  for (int lane = 0; lane < Shape::lanes; ++lane) {
    offsets.x[lane] = static_cast<T>(lane % Shape::width);
    const int row = lane / Shape::width;
    offsets.y[lane] = static_cast<T>(row);
  }
  return offsets;
}

template <typename T>
void render_pixels(const SimdScene<T>& scene, const PixelBlock& block, double sample_x,
                   double sample_y, BlockSums<T>& sums) {
  const hn::ScalableTag<T> d;
  using V = hn::Vec<decltype(d)>;
  using Shape = PacketShape<decltype(d)>;
  const V zero = hn::Zero(d);
  const V none = hn::Set(d, T(-1));
  const View& view = scene.view;
  const bool reflects = scene.reflects && scene.max_depth > 0;

  BlockSums<T> sample{};
  RayBlock<T> reflected;
  const V3<V> forward = broadcast(d, scene.forward);
  const V3<V> right = broadcast(d, scene.right);
  const V3<V> up = broadcast(d, scene.up);
  const std::span<const ScreenEntry> entries =
      scene.bins.block(block.x_begin / block_side, block.y_begin / block_side);
  const LaneOffsets<T> offsets = lane_offsets(d);
  const V offset_x = hn::Load(d, offsets.x);
  const V offset_y = hn::Load(d, offsets.y);
  // The image point in units of half the image, from -1 to 1. A packet's corner is computed in
  // double; within the packet T is enough.
  const double step_x = 2.0 / view.width;
  const double step_y = 2.0 / view.height;
  for (int row = 0; row < block.height; row += Shape::height) {
    for (int column_begin = 0; column_begin < block.width; column_begin += Shape::width) {
      const int pixel = row * block_side + column_begin;
      const double corner_x = (block.x_begin + column_begin + sample_x) * step_x - 1;
      const double corner_y = (view.height - 1 - block.y_begin - row + sample_y) * step_y - 1;
      const V x = hn::MulAdd(offset_x, hn::Set(d, static_cast<T>(step_x)),
                             hn::Set(d, static_cast<T>(corner_x)));
      const V y = hn::NegMulAdd(offset_y, hn::Set(d, static_cast<T>(step_y)),
                                hn::Set(d, static_cast<T>(corner_y)));
      const V3<V> direction = unit(d, mul_add(right, x, mul_add(up, y, forward)));
      const auto active =
          hn::And(hn::Lt(offset_x, hn::Set(d, static_cast<T>(block.width - column_begin))),
                  hn::Lt(offset_y, hn::Set(d, static_cast<T>(block.height - row))));

      Nearest<V> nearest{hn::Set(d, std::numeric_limits<T>::max()), none, none, none};
      const Start<V> eye{{zero, zero, zero}, {zero, zero, zero}, none, none, none};
      const int part = row / 4 * 4 + column_begin / 4;
      show_spheres_to_eye(d, scene, entries, part, direction, active, nearest);
      if (!scene.triangles.empty()) show_tree(d, scene, eye, direction, active, false, nearest);
      show_squares_and_planes(d, scene, eye, direction, active, nearest);

      const V pixels = hn::MulAdd(offset_y, hn::Set(d, T(block_side)),
                                  hn::Add(offset_x, hn::Set(d, static_cast<T>(pixel))));
      const Packet<V> packet{eye, direction, hn::Set(d, T(1)), pixels};
      V3<V> colour;
      shade_packet(d, scene, packet, nearest, active, reflects, reflected, colour);
      store_packet(d, colour.x, pixel, sample.red);
      store_packet(d, colour.y, pixel, sample.green);
      store_packet(d, colour.z, pixel, sample.blue);
    }
  }
  if (reflects) {
    RayBlock<T> next;
    for (int depth = 1; reflected.count > 0; ++depth) {
      trace_reflected(scene, reflected, depth < scene.max_depth, next, sample);
      std::swap(reflected, next);
    }
  }
  add_clamped(sample, sums);
}

std::int64_t render_single(const SimdScene<float>& scene, const PixelBlock& block, double sample_x,
                           double sample_y, BlockSums<float>& sums) {
  render_pixels(scene, block, sample_x, sample_y, sums);
  return HWY_TARGET;
}

std::int64_t render_double(const SimdScene<double>& scene, const PixelBlock& block, double sample_x,
                           double sample_y, BlockSums<double>& sums) {
  render_pixels(scene, block, sample_x, sample_y, sums);
  return HWY_TARGET;
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raytracer {
namespace {

HWY_EXPORT(render_single);
HWY_EXPORT(render_double);

/// The place of a target's function in Highway's tables.
std::size_t table_index(std::int64_t target) {
  hwy::ChosenTarget chosen;
  chosen.Update(target);
  return chosen.GetIndex();
}

}  // namespace

std::vector<InstructionSet> supported_instruction_sets() {
  std::vector<InstructionSet> sets;
  const std::int64_t supported = hwy::SupportedTargets() & HWY_TARGETS;
  for (std::int64_t bit = 1; bit > 0 && bit <= supported; bit <<= 1)
    if ((supported & bit) != 0) sets.push_back({bit, hwy::TargetName(bit)});
  return sets;
}

Machine this_machine() { return {supported_instruction_sets().front()}; }

std::int64_t render_block(const SimdScene<float>& scene, const PixelBlock& block, double sample_x,
                          double sample_y, std::int64_t target, BlockSums<float>& sums) {
  return HWY_DISPATCH_TABLE(render_single)[table_index(target)](scene, block, sample_x, sample_y,
                                                                sums);
}

std::int64_t render_block(const SimdScene<double>& scene, const PixelBlock& block, double sample_x,
                          double sample_y, std::int64_t target, BlockSums<double>& sums) {
  return HWY_DISPATCH_TABLE(render_double)[table_index(target)](scene, block, sample_x, sample_y,
                                                                sums);
}

}  // namespace raytracer
#endif  // HWY_ONCE
