// All samples of a block's pixels, added up.

#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Adds to each subtile's error what the means of its half buffers differ by; to each pixel's in
/// linear light.
template <class D, typename T = hn::TFromD<D>>
HWY_NOINLINE void tell_errors(D d, const Block& block, const BlockRays<D>& rays,
                              const BlockSums<D>& sums, Transfer transfer,
                              const TileErrors& errors) {
  using V = hn::Vec<D>;
  using Shape = PacketShape<D>;
  const Transfer told_after = errors.pixels != nullptr ? Transfer::linear : transfer;
  for (int i = 0; i < Shape::packets; ++i) {
    const PacketPlace<D> place(i);
    if (!place.is_in(block)) continue;
    const std::size_t first = static_cast<std::size_t>(i) * Shape::lanes;
    const Spread<V> told = sums.spread(d, first, told_after);
    const auto active = rays.active(d, place);
    const V error2 = hn::IfThenElseZero(active, told.error2);
    if (errors.subtiles != nullptr)
      errors.subtiles->of_block(block.x_begin, block.y_begin)[place.subtile()] +=
          static_cast<double>(hn::GetLane(hn::SumOfLanes(d, error2)));
    if (errors.pixels == nullptr) continue;
    HWY_ALIGN T errors2[Shape::lanes];
    HWY_ALIGN T variances[Shape::lanes];
    hn::Store(error2, d, errors2);
    hn::Store(hn::IfThenElseZero(active, told.variance), d, variances);
    const std::size_t corner =
        errors.pixels->index(block.x_begin + place.x, block.y_begin + place.y);
    for (int lane = 0; lane < Shape::lanes; ++lane)
      errors.pixels->set(corner + errors.pixels->index(lane % Shape::width, lane / Shape::width),
                         {static_cast<float>(errors2[lane]), static_cast<float>(variances[lane])});
  }
}

/// What a tile's blocks have in common.
template <typename T>
struct TileTask {
  const PacketScene<T>& scene;
  const SamplePattern& pattern;
  TileOutput output;
  LightLedger<T>* ledger;
};

/// A block with its samples' colours, as many as have been added.
template <typename T>
class SampledBlock {
  using D = hn::ScalableTag<T>;
  using V = hn::Vec<D>;
  using Shape = PacketShape<D>;

 public:
  SampledBlock(const SampledBlock&) = delete;
  SampledBlock& operator=(const SampledBlock&) = delete;
  SampledBlock(const TileTask<T>& task, const Block& block, const BlockCandidates<T>& candidates,
               std::size_t number)
      : task_(task),
        block_(block),
        candidates_(candidates),
        rays_(D(), task.scene, block, task.pattern.jitter),
        first_pixel_(number * block_pixels),
        sums_(task.pattern, has_cover(task.output.canvas), task.output.errors.pixels != nullptr) {}

  /// A sample of its pixels, but for the rays that follow, which are queued.
  void trace_from_eye(std::size_t sample, RayQueues<T>& queues, SampleColours<T>& colours) {
    // Later samples find in the caches what the first has met.
    const bool fetches = sample == 0 && task_.scene.fetches_light_cells;
    HWY_NAMESPACE::trace_from_eye(D(), rays_.eye, packets(sample), fetches, queues, colours,
                                  cover_of_sample());
  }

  /// Adds the sample once all of it is known.
  void add(std::size_t sample, const SampleColours<T>& colours) {
    sums_.add(D(), sample, block_, rays_, colours);
  }

  /// After the last sample.
  void finish(BeyondRange& beyond) {
    const D d;
    const TileOutput& output = task_.output;
    if (output.errors.are_wanted())
      tell_errors(d, block_, rays_, sums_, output.transfer, output.errors);
    const auto at = [](int packet) { return static_cast<std::size_t>(packet) * Shape::lanes; };
    store_block(
        d, [&](int packet) HWY_ATTR { return sums_.mean(d, at(packet), output.transfer); },
        [&](int packet) HWY_ATTR { return sums_.covered_mean(d, at(packet), output.transfer); },
        block_, output.canvas);
    sums_.beyond().add_to(beyond);
  }

  SamplePackets<D> packets(std::size_t sample) {
    return {rays_,
            candidates_,
            block_,
            task_.pattern.points[sample],
            light_set_of_sample(task_.scene, task_.pattern, sample, task_.ledger),
            first_pixel_};
  }
  /// Which of its rays have met something, if that is wanted.
  T* cover_of_sample() { return sums_.cover_of_sample(); }

 private:
  const TileTask<T>& task_;
  Block block_;
  BlockCandidates<T> candidates_;
  BlockRays<D> rays_;
  std::size_t first_pixel_;  ///< its number among those that are queued together
  BlockSums<D> sums_;
};

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
