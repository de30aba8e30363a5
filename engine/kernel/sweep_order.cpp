#include "engine/kernel/sweep_order.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace raytracer {
namespace {

/// Whether points lie on it, for each primitive by its number.
template <typename T>
std::vector<bool> seen_primitives(std::size_t count, std::span<const LightLedger<T>> ledgers) {
  std::vector<bool> seen(count, false);
  for (const LightLedger<T>& ledger : ledgers)
    for (std::size_t i = 0; i < ledger.packet_count(); ++i) {
      const T* const ids = ledger.packet(i) + LightLedger<T>::id * ledger.lanes();
      for (std::size_t lane = 0; lane < ledger.lanes(); ++lane)
        if ((ledger.active(i) >> lane & 1U) != 0) seen[static_cast<std::size_t>(ids[lane])] = true;
    }
  return seen;
}

}  // namespace

template <typename T>
SweepOrder order_sweeps(const PacketScene<T>& scene, std::span<const LightLedger<T>> ledgers) {
  SweepOrder order;
  const std::vector<bool> seen = seen_primitives(scene.primitives.size(), ledgers);
  scene.geometry.for_each([&]<class Kind>(const Geometry<Kind, T>& geometry) {
    if constexpr (Kind::has_light_sweep) {
      if (geometry.finder(RayKind::to_soft_light) != Finder::light_sweep) return;
      using Swept = typename Geometry<Kind, T>::Layout::Swept;
      const auto& ids = geometry.swept.values[Swept::column_id];
      BlockOrder& of_kind = order[kind_index<Kind>];
      of_kind.blocks.resize(geometry.swept.blocks.size());
      for (std::uint32_t i = 0; i < of_kind.blocks.size(); ++i) of_kind.blocks[i] = i;
      const auto is_near = [&](std::uint32_t block) {
        const std::size_t begin = block * Swept::in_block;
        const std::size_t end = std::min(begin + Swept::in_block, geometry.count);
        for (std::size_t i = begin; i < end; ++i)
          if (seen[static_cast<std::size_t>(ids[i])]) return true;
        return false;
      };
      const auto others =
          std::stable_partition(of_kind.blocks.begin(), of_kind.blocks.end(), is_near);
      of_kind.near_count = static_cast<std::size_t>(others - of_kind.blocks.begin());
    }
  });
  return order;
}

template SweepOrder order_sweeps(const PacketScene<float>&, std::span<const LightLedger<float>>);
template SweepOrder order_sweeps(const PacketScene<double>&, std::span<const LightLedger<double>>);

}  // namespace raytracer
