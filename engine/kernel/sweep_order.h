// In which order primitives pass over the points of a sweep.
//
// What hides a point is near it more often than not, and most primitives of a large scene are
// behind those that are seen. So those near points come first; what they hide leaves out most
// others.
#pragma once

#include <array>
#include <span>

#include "engine/finders/swept_points.h"
#include "engine/kernel/light_ledger.h"
#include "engine/kernel/packet_scene.h"

namespace raytracer {

/// Of all kinds; those that do not sweep have none.
using SweepOrder = std::array<BlockOrder, ObjectKinds::count>;

/// For all points of the ledgers, whichever direction they look.
template <typename T>
SweepOrder order_sweeps(const PacketScene<T>& scene, std::span<const LightLedger<T>> ledgers);

}  // namespace raytracer
