// The queue of rays that follow others.

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// The queue of rays to be followed. They are taken in batches, the latest first, so that few wait
/// however many there are in all. Of what follows a batch, rays that go on through surfaces come
/// before those that are mirrored: what has come the same way stays together, and unless a batch is
/// full a pixel's colours add up in an order that does not depend on the width of packets.
template <typename T, bool branch>
class FollowedRays {
 public:
  static constexpr bool branches = branch;
  LightSet<T> light_set{};  ///< of all

  /// Without memory if the scene has none.
  explicit FollowedRays(const PacketScene<T>& scene) : is_carried_(scene.exact.carries_paths) {
    if (scene.max_depth == 0 || scene.transmits != branch) return;
    taken_ = make_batch();
    next_ = make_batch();
    if constexpr (branch)
      mirrored_ = make_batch();
    else if (has_streams(scene))
      hits_.reset(new BatchHits<T>);
  }

  /// Adds the lanes of `mask`, at least one, that mirrors send on; `way` as RayBatch::add() has it.
  template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
  HWY_INLINE void add_mirrored(D d, const Packet<V>& rays, const WayTo<V>* way, M mask) {
    add_to(branch ? mirrored_ : next_, d, rays, way, turned(d, Turn::mirrored), mask);
  }
  /// The same of lanes that go on through surfaces, and of those `bends` are refracted.
  template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
  HWY_INLINE void add_refracted(D d, const Packet<V>& rays, const WayTo<V>* way, M bends, M mask) {
    const V turn = hn::IfThenElse(bends, turned(d, Turn::refracted), turned(d, Turn::straight));
    add_to(next_, d, rays, way, turn, mask);
  }

  /// Takes a batch, turns its rays if they have yet to, and returns how many it has: 0 once none is
  /// left.
  std::size_t take(const PacketScene<T>& scene) {
    if constexpr (branch) {
      if (!next_->has_room_for(mirrored_->count())) put_aside(next_);
      next_->append(*mirrored_);
    }
    taken_->clear();
    std::swap(taken_, next_);
    if (taken_->count() == 0 && !aside_.empty()) {
      taken_ = std::move(aside_.back());
      aside_.pop_back();
    }
    if constexpr (may_be_inexact<T>)
      if (is_carried_) taken_->turn(*scene.exact.scene);
    return taken_->count();
  }

  /// Whether the rays taken are worth being found all at once, which is done then.
  bool find_at_once(const PacketScene<T>& scene) {
    if constexpr (!branch)
      if (hits_ && taken_->count() >= BatchHits<T>::many) {
        hits_->find(scene, *taken_);
        return true;
      }
    return false;
  }
  /// What the rays from the i-th on have met then.
  template <class D, class V = hn::Vec<D>>
  HWY_INLINE Hit<V> hits(D d, const PacketScene<T>& scene, std::size_t i) const {
    return hits_->packet(d, scene, i);
  }

  /// The rays taken, from the i-th on.
  template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
  HWY_INLINE Packet<V> packet(D d, std::size_t i, M active) const {
    return taken_->packet(d, i, active, light_set);
  }
  /// What single rounds off of them.
  template <class D, class M = hn::Mask<D>>
  HWY_INLINE auto rest(D d, std::size_t i, M active) const {
    return taken_->rest(d, i, active);
  }

 private:
  using Batch = RayBatch<T, branch>;
  template <class D, class V = hn::Vec<D>>
  static HWY_INLINE V turned(D d, Turn turn) {
    return hn::Set(d, static_cast<T>(turn));
  }
  template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
  HWY_INLINE void add_to(std::unique_ptr<Batch>& batch, D d, const Packet<V>& rays,
                         const WayTo<V>* way, V turn, M mask) {
    if (branch && !batch->has_room_for(hn::Lanes(d))) put_aside(batch);
    batch->add(d, rays, way, turn, mask);
  }

  std::unique_ptr<Batch> make_batch() const { return std::make_unique<Batch>(is_carried_); }
  HWY_NOINLINE void put_aside(std::unique_ptr<Batch>& batch) {
    aside_.push_back(std::move(batch));
    batch = make_batch();
  }

  bool is_carried_;
  std::unique_ptr<Batch> taken_;
  std::unique_ptr<Batch> next_;
  std::unique_ptr<Batch> mirrored_;            ///< that come after the next, where rays branch
  std::vector<std::unique_ptr<Batch>> aside_;  ///< full ones, the latest last
  std::unique_ptr<BatchHits<T>> hits_;         ///< of streams
};

/// The queues of a thread, of which a scene needs one at most.
template <typename T>
struct RayQueues {
  FollowedRays<T, false> single;
  FollowedRays<T, true> branching;

  explicit RayQueues(const PacketScene<T>& scene) : single(scene), branching(scene) {}
};

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
