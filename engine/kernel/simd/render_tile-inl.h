// Tiles of an image.

#include <algorithm>
#include <cstddef>
#include <new>
#include <optional>

#include "engine/memory/aligned_array.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// The colour of a pixel that shows nothing, with the roundings of one whose rays were traced.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE V3<V> resolved_background(D d, const PacketScene<T>& scene, std::size_t sample_count,
                                     Transfer transfer) {
  const V3<V> sample = clamped(d, broadcast(d, scene.background));
  const V zero = hn::Zero(d);
  V3<V> sum = sample;
  V3<V> rest{zero, zero, zero};
  for (std::size_t i = 1; i < sample_count; ++i)
    sum = sample_count < many_samples ? add(sample, sum) : add_with_rest(sum, sample, rest);
  return resolved(d, sum, share_of(d, sample_count), transfer);
}

/// Blocks that are traced together, and then stored.
template <typename T>
class BlockGroup {
 public:
  /// Where rays do not branch and tell no ledger of their order, more of those that follow are
  /// traced together than a block has.
  explicit BlockGroup(const TileTask<T>& task)
      : task_(task),
        most_(size_for(task)),
        queues_(task.scene),
        colours_(make_aligned_array<SampleColours<T>>(most_)),
        blocks_(make_aligned_array<SampledBlock<T>>(most_)) {}

  void add(const Block& block, const BlockCandidates<T>& candidates, BeyondRange& beyond) {
    new (&blocks_[count_]) SampledBlock<T>(task_, block, candidates, count_);
    if (++count_ == most_) trace(beyond);
  }

  /// Those that are left.
  void trace(BeyondRange& beyond) {
    if (count_ == 0) return;
    for (std::size_t sample = 0; sample < task_.pattern.points.size(); ++sample) {
      for (std::size_t i = 0; i < count_; ++i)
        blocks_[i].trace_from_eye(sample, queues_, colours_[i]);
      trace_queued(task_.scene, queues_, colours_.get());
      trace_doubtful(
          hn::ScalableTag<T>(), task_.scene, count_,
          [&](std::size_t i) HWY_ATTR { return blocks_[i].packets(sample); },
          [&](std::size_t i) { return blocks_[i].cover_of_sample(); }, colours_.get());
      for (std::size_t i = 0; i < count_; ++i) blocks_[i].add(sample, colours_[i]);
    }
    for (std::size_t i = 0; i < count_; ++i) blocks_[i].finish(beyond);
    count_ = 0;
  }

 private:
  static std::size_t size_for(const TileTask<T>& task) {
    return task.ledger == nullptr && has_streams(task.scene) ? blocks_at_once : 1;
  }

  const TileTask<T>& task_;
  std::size_t most_;
  RayQueues<T> queues_;
  AlignedArray<SampleColours<T>> colours_;
  AlignedArray<SampledBlock<T>> blocks_;
  std::size_t count_ = 0;
};

template <typename T>
TracedTile render_blocks(const PacketScene<T>& scene, const SamplePattern& pattern,
                         const Tile& tile, const TileOutput& output, LightLedger<T>* ledger) {
  TracedTile traced{HWY_TARGET, {}};
  const hn::ScalableTag<T> d;
  const SolidRow background(d,
                            resolved_background(d, scene, pattern.points.size(), output.transfer));
  TileTask<T> task{scene, pattern, output, ledger};
  if (!pattern.has_half_buffers()) task.output.errors = {};
  std::optional<BlockGroup<T>> group;  // of tiles that show something
  for (int y = tile.y_begin; y < tile.y_end; y += tile.block_step)
    for (int x = tile.x_begin; x < tile.x_end; x += tile.block_step) {
      const Block whole{x, y, std::min(block_side, tile.x_end - x),
                        std::min(block_side, tile.y_end - y), tile.subtiles};
      const BlockCandidates<T> candidates(scene, x / block_side, y / block_side);
      Block block = whole;
      block.subtiles &= candidates.subtiles;
      if (block.subtiles != whole.subtiles)
        fill_subtiles(background, whole, whole.subtiles & ~candidates.subtiles, output.canvas);
      if (block.subtiles == 0) continue;
      if (!group) group.emplace(task);
      group->add(block, candidates, traced.beyond);
    }
  if (group) group->trace(traced.beyond);
  return traced;
}

/// Traces a tile's samples and writes down what they ask of soft lights.
template <typename T>
void record_blocks(const PacketScene<T>& scene, const SamplePattern& pattern, const Tile& tile,
                   LightLedger<T>& ledger) {
  using D = hn::ScalableTag<T>;
  const D d;
  ledger.begin(PacketShape<D>::lanes);
  RayQueues<T> queues(scene);
  SampleColours<T> colours;
  for (int y = tile.y_begin; y < tile.y_end; y += tile.block_step)
    for (int x = tile.x_begin; x < tile.x_end; x += tile.block_step) {
      BlockCandidates<T> candidates(scene, x / block_side, y / block_side);
      const Block block{x, y, std::min(block_side, tile.x_end - x),
                        std::min(block_side, tile.y_end - y), tile.subtiles & candidates.subtiles};
      if (block.subtiles == 0) continue;
      const BlockRays<D> rays(d, scene, block, pattern.jitter);
      for (std::size_t sample = 0; sample < pattern.points.size(); ++sample)
        trace_packets(d, rays.eye,
                      SamplePackets<D>(rays, candidates, block, pattern.points[sample],
                                       light_set_of_sample(scene, pattern, sample, &ledger), 0),
                      false, queues, colours, static_cast<T*>(nullptr));
    }
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
