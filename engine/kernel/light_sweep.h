// A sweep: for which points of many tiles something hides one direction of a soft light.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/finders/swept_points.h"
#include "engine/kernel/light_ledger.h"
#include "engine/kernel/packet_scene.h"
#include "engine/kernel/sweep_order.h"

namespace raytracer {

/// What to look into: a direction that points share, or both ends of a sky's axis.
struct SweptDirection {
  std::size_t light;  ///< among the soft ones
  std::size_t place;  ///< as SoftLight numbers them
};

/// Sets in `dark` the bits of those lanes of the ledgers' packets, taken one ledger after another,
/// that look at the direction and have something before it that is found by sweeps.
void sweep_direction(const PacketScene<float>& scene, const SweptDirection& direction,
                     std::span<const LightLedger<float>> ledgers, const SweepOrder& order,
                     std::int64_t target, SweptPoints<float>& points,
                     LightLedger<float>::Lanes* dark);
void sweep_direction(const PacketScene<double>& scene, const SweptDirection& direction,
                     std::span<const LightLedger<double>> ledgers, const SweepOrder& order,
                     std::int64_t target, SweptPoints<double>& points,
                     LightLedger<double>::Lanes* dark);

}  // namespace raytracer
