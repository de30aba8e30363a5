// What the rays of a batch meet, if they are many: in trees all of them at once.

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Whether a batch's rays go through the tree of a kind together. To try the primitives of a single
/// leaf packet by packet is as good.
template <class Kind, typename T>
HWY_INLINE bool is_streamed(const Geometry<Kind, T>& geometry) {
  if constexpr (Kind::search == Search::bounded)
    return geometry.finder(RayKind::followed) == Finder::tree && geometry.tree.leaves.size() > 1;
  return false;
}

/// What is found otherwise.
struct OutsideStreams {};

template <typename T, class Visit>
HWY_INLINE void for_each_geometry(const PacketScene<T>& scene, OutsideStreams, const Visit& visit) {
  for_each_geometry(scene.geometry, [&](const auto& geometry) RAYTRACER_INLINE_ATTR {
    if (!is_streamed(geometry)) visit(geometry);
  });
}

/// Whether a scene has such a tree, and rays that follow others and do not branch.
template <typename T>
HWY_INLINE bool has_streams(const PacketScene<T>& scene) {
  if (scene.max_depth == 0 || scene.transmits) return false;
  bool streams = false;
  for_each_geometry(scene,
                    [&](const auto& geometry) HWY_ATTR { streams |= is_streamed(geometry); });
  return streams;
}

/// Rays that follow are traced together of so many blocks, where some go through trees as streams.
inline constexpr std::size_t blocks_at_once = 8;

/// Packets whose rays keep together go through trees as such; the rest of the batch goes as a
/// stream.
template <typename T>
class BatchHits {
 public:
  /// Fewer are taken through trees packet by packet.
  static constexpr std::size_t many = 64;

  template <class Batch>
  HWY_NOINLINE void find(const PacketScene<T>& scene, const Batch& batch) {
    const hn::ScalableTag<T> d;
    const auto far_away = hn::Set(d, std::numeric_limits<T>::max());
    streamed_.clear();
    for (std::size_t i = 0; i < batch.count(); i += hn::Lanes(d)) {
      const auto active = hn::FirstN(d, batch.count() - i);
      const auto packet = batch.packet(d, i, active, {});
      const auto& from = packet.from;
      const auto& direction = packet.direction;
      // A mirroring floor's do.
      const bool keeps_together = agreement(d, direction, active) > T(0.8);
      const auto hit = keeps_together ? find_followed(d, scene, from, direction, far_away, active)
                                      : find_followed(d, scene, from, direction, far_away, active,
                                                      OutsideStreams());
      rays_.set_hit(d, i, hit);
      if (!keeps_together) {
        rays_.set_ray(d, i, tree_rays(d, from, direction));
        for (std::size_t ray = i; ray < std::min(i + hn::Lanes(d), batch.count()); ++ray)
          streamed_.push_back(static_cast<StreamLists::Number>(ray));
      }
      if (!scene.has_own_normals) continue;
      const hn::Vec<decltype(d)> own[] = {hit.u, hit.v, hit.normal.x, hit.normal.y, hit.normal.z};
      for (std::size_t column = 0; column < own_columns; ++column)
        hn::Store(own[column], d, own_[column] + i);
    }
    if (streamed_.empty()) return;
    for_each_geometry(scene, [&]<class Kind>(const Geometry<Kind, T>& geometry) HWY_ATTR {
      const auto ray = [&](auto d8, std::size_t i) HWY_ATTR { return batch.ray(d8, i); };
      if constexpr (Kind::search == Search::bounded)
        if (is_streamed(geometry)) intersect_tree(geometry.tree, streamed_, ray, rays_, lists_);
    });
  }

  /// Of the rays from the i-th on.
  template <class D, class V = hn::Vec<D>>
  HWY_INLINE Hit<V> packet(D d, const PacketScene<T>& scene, std::size_t i) const {
    const V none = hn::Set(d, T(-1));
    Hit<V> hit{hn::Load(d, rays_.t + i), hn::Load(d, rays_.id + i), none, none};
    if (!scene.has_own_normals) return hit;
    const auto own = [&](std::size_t column) HWY_ATTR { return hn::Load(d, own_[column] + i); };
    hit.u = own(0);
    hit.v = own(1);
    hit.normal = {own(2), own(3), own(4)};
    return hit;
  }

 private:
  static constexpr std::size_t own_columns = 5;

  static constexpr std::size_t most = blocks_at_once * block_pixels;
  static_assert(most <= rays_in_batch);

  StreamRays<T, most> rays_;
  alignas(64) T own_[own_columns][most];  ///< u, v and normal, of kinds that compute them
  std::vector<StreamLists::Number> streamed_;
  StreamLists lists_;
};

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
