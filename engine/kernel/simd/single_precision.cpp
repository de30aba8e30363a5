// The kernels in single precision, once for each set of instructions.
#include "engine/kernel/simd/render_tile.h"
#include "engine/kernel/simd/sample_pixels.h"
#include "engine/kernel/this_machine.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/kernel/simd/single_precision.cpp"  // this file, once per target
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/kernel/simd/kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {
namespace {

TracedTile render(const PacketScene<float>& scene, const SamplePattern& pattern, Transfer transfer,
                  const Tile& tile, const Canvas& canvas, const TileErrors& errors,
                  LightLedger<float>* ledger) {
  return render_blocks(scene, pattern, transfer, tile, canvas, errors, ledger);
}

void ask(const PacketScene<float>& scene, const SamplePattern& pattern, const Tile& tile,
         LightLedger<float>& ledger) {
  record_blocks(scene, pattern, tile, ledger);
}

void sample(const PacketScene<float>& scene, const SamplePattern& pattern, Transfer transfer,
            std::span<const BlockPixels> blocks, SampledPixel* results) {
  sample_blocks(scene, pattern, transfer, blocks, results);
}

}  // namespace
}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raytracer {
namespace {

HWY_EXPORT(render);
HWY_EXPORT(ask);
HWY_EXPORT(sample);

}  // namespace

TracedTile render_tile(const PacketScene<float>& scene, const SamplePattern& pattern,
                       Transfer transfer, const Tile& tile, std::int64_t target,
                       const Canvas& canvas, const TileErrors& errors, LightLedger<float>* ledger) {
  return HWY_DISPATCH_TABLE(render)[dispatch_index(target)](scene, pattern, transfer, tile, canvas,
                                                            errors, ledger);
}

void record_tile(const PacketScene<float>& scene, const SamplePattern& pattern, const Tile& tile,
                 std::int64_t target, LightLedger<float>& ledger) {
  HWY_DISPATCH_TABLE(ask)[dispatch_index(target)](scene, pattern, tile, ledger);
}

void sample_pixels(const PacketScene<float>& scene, const SamplePattern& pattern, Transfer transfer,
                   std::span<const BlockPixels> blocks, std::int64_t target,
                   std::span<SampledPixel> results) {
  HWY_DISPATCH_TABLE(sample)
  [dispatch_index(target)](scene, pattern, transfer, blocks, results.data());
}

}  // namespace raytracer
#endif  // HWY_ONCE
