// Sweeps, once for each set of instructions.
#include "engine/kernel/light_sweep.h"

#include "engine/kernel/this_machine.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/kernel/simd/light_sweep.cpp"  // this file, once per target
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/kernel/simd/kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {
namespace {

void sweep_in_single(const PacketScene<float>& scene, const SweptDirection& direction,
                     std::span<const LightLedger<float>> ledgers, const SweepOrder& order,
                     SweptPoints<float>& points, LightLedger<float>::Lanes* dark) {
  sweep(scene, direction, ledgers, order, points, dark);
}

void sweep_in_double(const PacketScene<double>& scene, const SweptDirection& direction,
                     std::span<const LightLedger<double>> ledgers, const SweepOrder& order,
                     SweptPoints<double>& points, LightLedger<double>::Lanes* dark) {
  sweep(scene, direction, ledgers, order, points, dark);
}

}  // namespace
}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raytracer {
namespace {

HWY_EXPORT(sweep_in_single);
HWY_EXPORT(sweep_in_double);

}  // namespace

void sweep_direction(const PacketScene<float>& scene, const SweptDirection& direction,
                     std::span<const LightLedger<float>> ledgers, const SweepOrder& order,
                     std::int64_t target, SweptPoints<float>& points,
                     LightLedger<float>::Lanes* dark) {
  HWY_DISPATCH_TABLE(sweep_in_single)
  [dispatch_index(target)](scene, direction, ledgers, order, points, dark);
}

void sweep_direction(const PacketScene<double>& scene, const SweptDirection& direction,
                     std::span<const LightLedger<double>> ledgers, const SweepOrder& order,
                     std::int64_t target, SweptPoints<double>& points,
                     LightLedger<double>::Lanes* dark) {
  HWY_DISPATCH_TABLE(sweep_in_double)
  [dispatch_index(target)](scene, direction, ledgers, order, points, dark);
}

}  // namespace raytracer
#endif  // HWY_ONCE
