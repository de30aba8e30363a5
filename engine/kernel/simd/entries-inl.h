// The kernels' entries in precision Real, for each set of instructions and, once, for whoever calls
// the best of them.

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {
namespace {

TracedTile render(const PacketScene<Real>& scene, const SamplePattern& pattern, const Tile& tile,
                  const TileOutput& output, LightLedger<Real>* ledger) {
  return render_blocks(scene, pattern, tile, output, ledger);
}

void record(const PacketScene<Real>& scene, const SamplePattern& pattern, const Tile& tile,
            LightLedger<Real>& ledger) {
  record_blocks(scene, pattern, tile, ledger);
}

void sample(const PacketScene<Real>& scene, const SamplePattern& pattern, Transfer transfer,
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
HWY_EXPORT(record);
HWY_EXPORT(sample);

}  // namespace

TracedTile render_tile(const PacketScene<Real>& scene, const SamplePattern& pattern,
                       const Tile& tile, std::int64_t target, const TileOutput& output,
                       LightLedger<Real>* ledger) {
  return HWY_DISPATCH_TABLE(render)[dispatch_index(target)](scene, pattern, tile, output, ledger);
}

void record_tile(const PacketScene<Real>& scene, const SamplePattern& pattern, const Tile& tile,
                 std::int64_t target, LightLedger<Real>& ledger) {
  HWY_DISPATCH_TABLE(record)[dispatch_index(target)](scene, pattern, tile, ledger);
}

void sample_pixels(const PacketScene<Real>& scene, const SamplePattern& pattern, Transfer transfer,
                   std::span<const BlockPixels> blocks, std::int64_t target,
                   std::span<SampledPixel> results) {
  HWY_DISPATCH_TABLE(sample)
  [dispatch_index(target)](scene, pattern, transfer, blocks, results.data());
}

}  // namespace raytracer
#endif  // HWY_ONCE
