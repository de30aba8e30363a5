#include "engine/kernel/simd/render_tile.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/kernel/simd/render_tile.cpp"  // this file, once per target
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/kernel/simd/beyond_range-inl.h"
#include "engine/kernel/simd/block-inl.h"
#include "engine/kernel/simd/packet-inl.h"
#include "engine/kernel/simd/rays-inl.h"
#include "engine/kernel/simd/reflect-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// The directions from the eye through a block's pixels.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
class EyeRays {
 public:
  HWY_INLINE EyeRays(D d, const SimdScene<T>& scene, const Block& block, double stagger)
      : scene_(scene),
        block_(block),
        offsets_(d),
        stagger_(stagger),
        step_x_(2.0 / scene.view.width),
        step_y_(2.0 / scene.view.height) {}

  /// Through `sample` of the packet's pixels. The image point runs from -1 to 1; a packet's corner
  /// is computed in double, within the packet T is enough.
  HWY_INLINE V3<V> direction(D d, const PacketPlace<D>& place, const SamplePoint& sample) const {
    const double corner_x = (block_.x_begin + place.x + sample.x) * step_x_ - 1;
    const double corner_y =
        (scene_.view.height - 1 - block_.y_begin - place.y + sample.y) * step_y_ - 1;
    V right = offsets_.x;
    V down = offsets_.y;
    if (stagger_ > 0) {
      const Staggers<D> staggers(d, place);
      const auto across = static_cast<T>(away_from_middle(sample.x, stagger_));
      const auto up = static_cast<T>(away_from_middle(sample.y, stagger_));
      right = hn::MulAdd(staggers.x, hn::Set(d, across), right);
      down = hn::NegMulAdd(staggers.y, hn::Set(d, up), down);
    }
    const V x = hn::MulAdd(right, hn::Set(d, static_cast<T>(step_x_)),
                           hn::Set(d, static_cast<T>(corner_x)));
    const V y = hn::NegMulAdd(down, hn::Set(d, static_cast<T>(step_y_)),
                              hn::Set(d, static_cast<T>(corner_y)));
    return unit(d, mul_add(broadcast(d, scene_.right), x,
                           mul_add(broadcast(d, scene_.up), y, broadcast(d, scene_.forward))));
  }

  /// The lanes whose pixels are in the block.
  HWY_INLINE hn::Mask<D> active(D d, const PacketPlace<D>& place) const {
    return hn::And(hn::Lt(offsets_.x, hn::Set(d, static_cast<T>(block_.width - place.x))),
                   hn::Lt(offsets_.y, hn::Set(d, static_cast<T>(block_.height - place.y))));
  }

 private:
  const SimdScene<T>& scene_;
  const Block& block_;
  LaneOffsets<D> offsets_;
  double stagger_;
  double step_x_;
  double step_y_;
};

/// What rays from the eye may meet in a block.
struct BlockContents {
  BlockEntries spheres;
  BlockEntries triangles;
  std::uint32_t square_parts;  ///< parts that may show a square, as in BlockEntries
  std::uint32_t parts;         ///< parts that may show anything

  template <typename T>
  BlockContents(const SimdScene<T>& scene, int column, int row)
      : spheres(scene.bins.block(column, row)),
        triangles(scene.bins.block_triangles(column, row)),
        square_parts(scene.bins.square_parts(column, row)),
        parts(square_parts) {
    constexpr std::uint32_t all = 0xFFFF;
    for (const BlockEntries& block : {spheres, triangles})
      for (std::size_t i = 0; i < block.entries.size(); ++i) parts |= block.parts[i];
    const bool by_tree = (scene.has_triangles && !scene.has_triangle_bins) ||
                         (!scene.spheres.empty() && !scene.has_sphere_bins);
    if (!scene.planes.empty() || by_tree) parts = all;
  }
};

/// Colours of one sample of a block's pixels, not yet clamped.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE void trace_sample(D d, const SimdScene<T>& scene, const Block& block,
                             const BlockContents& contents, const EyeRays<D>& rays,
                             const SamplePoint& sample, BlockColours<T>& colours) {
  using Shape = PacketShape<D>;
  const V zero = hn::Zero(d);
  const V none = hn::Set(d, T(-1));
  const Start<V> eye{{zero, zero, zero}, {zero, zero, zero}, none, none, none};
  RayBlock<T> reflected;
  for (int i = 0; i < Shape::packets; ++i) {
    const PacketPlace<D> place(i);
    if (!place.is_in(block)) continue;
    const std::size_t first = static_cast<std::size_t>(i) * Shape::lanes;
    const V3<V> direction = rays.direction(d, place, sample);
    const auto active = rays.active(d, place);
    Nearest<V> nearest{hn::Set(d, std::numeric_limits<T>::max()), none, none, none};
    if (scene.has_sphere_bins)
      show_spheres_to_eye(d, scene, contents.spheres, place.part(), direction, active, nearest);
    else if (!scene.spheres.empty())
      show_tree(d, scene.sphere_tree, eye, direction, active, nearest);
    if (scene.has_triangle_bins)
      show_triangles_to_eye(d, scene, contents.triangles, place.part(), direction, active, nearest);
    else if (scene.has_triangles)
      show_tree(d, scene.triangle_tree, eye, direction, active, nearest);
    show_planes(d, scene, eye, direction, active, nearest);
    if ((contents.square_parts >> place.part() & 1U) != 0)
      show_squares<false>(d, scene, eye, direction, active, nearest);
    const Packet<V> packet{eye, direction, hn::Set(d, T(1)), hn::Iota(d, static_cast<T>(first))};
    store(d, shade_packet(d, scene, packet, nearest, active, scene.reflects, reflected), first,
          colours);
  }
  if (reflected.count > 0) trace_reflections(scene, reflected, colours);
}

/// 1 / count.
template <class D, typename T = hn::TFromD<D>>
HWY_INLINE hn::Vec<D> share_of(D d, std::size_t count) {
  return hn::Set(d, static_cast<T>(1 / static_cast<double>(count)));
}

/// A pixel's colour of the sum of its clamped samples.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V3<V> resolved(D d, const V3<V>& sum, V share, Transfer transfer) {
  const V3<V> mean = clamped(d, scale(sum, share));  // of singles it may exceed 1 by a rounding
  return {encoded(d, transfer, mean.x), encoded(d, transfer, mean.y), encoded(d, transfer, mean.z)};
}

/// Adds to each part's error what the means of the two halves of its samples differ by.
template <class D, typename T>
HWY_NOINLINE void add_part_errors(D d, const Block& block, const EyeRays<D>& rays,
                                  const BlockColours<T>& sums_of_half, const BlockColours<T>& sums,
                                  std::size_t half, Transfer transfer, double* part_errors) {
  using V = hn::Vec<D>;
  using Shape = PacketShape<D>;
  const V share = share_of(d, half);
  for (int i = 0; i < Shape::packets; ++i) {
    const PacketPlace<D> place(i);
    if (!place.is_in(block)) continue;
    const std::size_t first = static_cast<std::size_t>(i) * Shape::lanes;
    const V3<V> one = load(d, sums_of_half, first);
    const V3<V> other = sub(load(d, sums, first), one);
    const V3<V> difference =
        sub(resolved(d, one, share, transfer), resolved(d, other, share, transfer));
    const V squares = hn::IfThenElseZero(rays.active(d, place), dot(difference, difference));
    part_errors[place.part()] +=
        PartErrors::share * static_cast<double>(hn::GetLane(hn::SumOfLanes(d, squares)));
  }
}

/// The colour of a pixel that shows nothing, with the roundings of one whose rays were traced.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE V3<V> resolved_background(D d, const SimdScene<T>& scene, std::size_t sample_count,
                                     Transfer transfer) {
  const V3<V> sample = clamped(d, broadcast(d, scene.background));
  V3<V> sum = sample;
  for (std::size_t i = 1; i < sample_count; ++i) sum = add(sample, sum);
  return resolved(d, sum, share_of(d, sample_count), transfer);
}

template <typename T>
void render_block(const SimdScene<T>& scene, const SamplePattern& pattern, Transfer transfer,
                  const Block& whole, const V3<hn::Vec<hn::ScalableTag<T>>>& background,
                  const Canvas& canvas, double* part_errors, BlockColours<T>& sums_of_half,
                  BeyondRange& beyond) {
  using D = hn::ScalableTag<T>;
  const D d;
  using V = hn::Vec<D>;
  using Shape = PacketShape<D>;
  const BlockContents contents(scene, whole.x_begin / block_side, whole.y_begin / block_side);
  Block block = whole;
  block.parts &= contents.parts;
  if (block.parts != whole.parts)
    fill_parts(d, background, whole, whole.parts & ~contents.parts, canvas);
  if (block.parts == 0) return;

  const EyeRays<D> rays(d, scene, block, pattern.stagger);
  BlockColours<T> sums;
  BlockColours<T> colours;
  BlockBeyondRange<D> block_beyond;
  for (std::size_t sample = 0; sample < pattern.points.size(); ++sample) {
    if (sample > 0 && sample == pattern.first_half) sums_of_half = sums;
    trace_sample(d, scene, block, contents, rays, pattern.points[sample], colours);
    Highest<D> highest(d);
    for (int packet = 0; packet < Shape::packets; ++packet) {
      if (!PacketPlace<D>(packet).is_in(block)) continue;
      const std::size_t i = static_cast<std::size_t>(packet) * Shape::lanes;
      const V3<V> colour = load(d, colours, i);
      highest.include(colour);
      const V3<V> seen = clamped(d, colour);
      store(d, sample == 0 ? seen : add(seen, load(d, sums, i)), i, sums);
    }
    if (HWY_UNLIKELY(highest.is_beyond_range(d)))
      block_beyond.note(d, block, colours,
                        [&](const auto& place) HWY_ATTR { return rays.active(d, place); });
  }
  if (part_errors != nullptr)
    add_part_errors(d, block, rays, sums_of_half, sums, pattern.first_half, transfer, part_errors);
  const V share = share_of(d, pattern.points.size());
  for (int i = 0; i < Shape::packets; ++i) {
    if (!PacketPlace<D>(i).is_in(block)) continue;
    const std::size_t first = static_cast<std::size_t>(i) * Shape::lanes;
    store(d, resolved(d, load(d, sums, first), share, transfer), first, sums);
  }
  store_block(d, sums, block, canvas);
  block_beyond.add_to(beyond);
}

template <typename T>
TracedTile render_blocks(const SimdScene<T>& scene, const SamplePattern& pattern, Transfer transfer,
                         const Tile& tile, const Canvas& canvas, PartErrors* errors) {
  TracedTile traced{HWY_TARGET, {}};
  const hn::ScalableTag<T> d;
  const auto background = resolved_background(d, scene, pattern.points.size(), transfer);
  BlockColours<T> sums_of_half;
  const bool tells_errors = errors != nullptr && pattern.has_halves();
  for (int y = tile.y_begin; y < tile.y_end; y += block_side)
    for (int x = tile.x_begin; x < tile.x_end; x += block_side)
      render_block(scene, pattern, transfer,
                   {x, y, std::min(block_side, tile.x_end - x),
                    std::min(block_side, tile.y_end - y), tile.parts},
                   background, canvas, tells_errors ? errors->of_block(x, y) : nullptr,
                   sums_of_half, traced.beyond);
  return traced;
}

TracedTile render_single(const SimdScene<float>& scene, const SamplePattern& pattern,
                         Transfer transfer, const Tile& tile, const Canvas& canvas,
                         PartErrors* errors) {
  return render_blocks(scene, pattern, transfer, tile, canvas, errors);
}

TracedTile render_double(const SimdScene<double>& scene, const SamplePattern& pattern,
                         Transfer transfer, const Tile& tile, const Canvas& canvas,
                         PartErrors* errors) {
  return render_blocks(scene, pattern, transfer, tile, canvas, errors);
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

Machine this_machine(std::size_t thread_count) {
  // Highway asks the processor each time, which of a virtual one takes as long as a small picture.
  static const InstructionSet best = supported_instruction_sets().front();
  return {best, thread_count};
}

TracedTile render_tile(const SimdScene<float>& scene, const SamplePattern& pattern,
                       Transfer transfer, const Tile& tile, std::int64_t target,
                       const Canvas& canvas, PartErrors* errors) {
  return HWY_DISPATCH_TABLE(render_single)[table_index(target)](scene, pattern, transfer, tile,
                                                                canvas, errors);
}

TracedTile render_tile(const SimdScene<double>& scene, const SamplePattern& pattern,
                       Transfer transfer, const Tile& tile, std::int64_t target,
                       const Canvas& canvas, PartErrors* errors) {
  return HWY_DISPATCH_TABLE(render_double)[table_index(target)](scene, pattern, transfer, tile,
                                                                canvas, errors);
}

}  // namespace raytracer
#endif  // HWY_ONCE
