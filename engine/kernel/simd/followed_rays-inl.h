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

  /// Of so many blocks. Without memory if the scene has none.
  FollowedRays(const PacketScene<T>& scene, std::size_t block_count)
      : batch_size_(branch ? of_branching : block_count * block_pixels),
        has_rests_(scene.exact.carries_paths) {
    if (scene.max_depth == 0 || scene.transmits != branch) return;
    taken_ = make_batch();
    next_ = make_batch();
    if constexpr (branch)
      mirrored_ = make_batch();
    else if (has_streams(scene))
      hits_.reset(new BatchHits<T>);
  }

  /// Adds the lanes of `mask`, at least one, that mirrors send on or that go through surfaces;
  /// `rest` as RayBatch::add() has it.
  template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
  HWY_INLINE void add(D d, const Packet<V>& rays, const RayRest<V>* rest, M mask,
                      bool is_mirrored) {
    std::unique_ptr<Batch>& batch = branch && is_mirrored ? mirrored_ : next_;
    if (branch && !batch->has_room_for(hn::Lanes(d))) put_aside(batch);
    batch->add(d, rays, rest, mask);
  }

  /// Takes a batch, and returns how many rays it has: 0 once none is left.
  std::size_t take() {
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
  /// The shipped glass takes 1.2 times as long with 64, 1.05 with 256.
  static constexpr std::size_t of_branching = 1024;

  std::unique_ptr<Batch> make_batch() const {
    return std::make_unique<Batch>(batch_size_, has_rests_);
  }
  HWY_NOINLINE void put_aside(std::unique_ptr<Batch>& batch) {
    aside_.push_back(std::move(batch));
    batch = make_batch();
  }

  std::size_t batch_size_;  ///< where none branch, no more follow than came
  bool has_rests_;
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

  /// Of as many blocks as are traced together.
  RayQueues(const PacketScene<T>& scene, std::size_t block_count)
      : single(scene, block_count), branching(scene, block_count) {}
};

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
