// What the points of a tile ask of the directions that rays to soft lights share, and what they are
// told.
//
// All points of many tiles look the same ways. So a tile is traced twice: at first its points are
// only written down; then each direction is swept for all of them at once (light_sweep.h), and
// nothing is kept of it but a bit for each point; then the tile is traced again, the same in every
// step, and takes the answers in the order in which it asked.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/math/block.h"
#include "engine/memory/page_allocator.h"
#include "engine/packets/lane_bits.h"

namespace raytracer {

template <typename T>
class LightLedger {
 public:
  /// What is written down of a point: where it is, the surface's normal, that which shades, and the
  /// number of the primitive.
  enum Column : std::size_t {
    x,
    y,
    z,
    normal_x,
    normal_y,
    normal_z,
    shading_x,
    shading_y,
    shading_z,
    id,
    column_count
  };
  /// Bits for the lanes of a packet.
  using Lanes = LaneBits;

  /// Forgets what it holds; packets are going to have so many lanes.
  void begin(std::size_t lanes) {
    lanes_ = lanes;
    points_.clear();
    packets_.clear();
    tells_ = false;
  }

  /// Makes room for a packet's columns, one after another.
  T* add_packet(std::size_t light_set, Lanes active) {
    packets_.push_back({static_cast<std::uint32_t>(light_set), active});
    points_.resize(points_.size() + column_count * lanes_);
    return points_.data() + points_.size() - column_count * lanes_;
  }

  std::size_t packet_count() const { return packets_.size(); }
  std::size_t lanes() const { return lanes_; }
  /// The columns of the i-th packet.
  const T* packet(std::size_t i) const { return points_.data() + i * column_count * lanes_; }
  std::size_t light_set(std::size_t i) const { return packets_[i].light_set; }
  Lanes active(std::size_t i) const { return packets_[i].active; }

  /// From now on it tells: `dark` has, for each place of a packet's set and of the rim of each soft
  /// light in turn, the lanes that see nothing of it; places are `stride` packets apart.
  void tell(const Lanes* dark, std::size_t stride) {
    tells_ = true;
    dark_ = dark;
    stride_ = stride;
    next_ = 0;
    points_ = {};
  }
  bool tells() const { return tells_; }
  /// The number of the packet whose turn it is.
  std::size_t take_turn() { return next_++; }
  Lanes dark(std::size_t place, std::size_t packet) const {
    return dark_[place * stride_ + packet];
  }

 private:
  struct Asked {
    std::uint32_t light_set;
    Lanes active;
  };

  std::size_t lanes_ = 0;
  LargeArray<T> points_;
  std::vector<Asked> packets_;
  bool tells_ = false;
  const Lanes* dark_ = nullptr;
  std::size_t stride_ = 0;
  std::size_t next_ = 0;
};

/// Which of their places on soft lights points look at.
template <typename T>
struct LightSet {
  std::size_t index = 0;
  LightLedger<T>* ledger = nullptr;  ///< of the tile, if directions are swept

  bool is_recorded() const { return ledger != nullptr && !ledger->tells(); }
  bool is_told() const { return ledger != nullptr && ledger->tells(); }
};

/// The sets that the rays of a block use.
template <typename T>
struct LightSets {
  static constexpr std::size_t rays_in_quarter = std::size_t{block_side} * block_side / 4;

  LightSet<T> of_quarters[4];  ///< of the rays, in their order
  LightSet<T> followed;        ///< of rays that follow others
  /// Whether the rays are to be ordered by their pixels' places in squares of 2 x 2: each place
  /// then has a quarter.
  bool by_quarters = false;

  /// The same for all.
  explicit LightSets(const LightSet<T>& set) : followed(set) {
    for (LightSet<T>& of_quarter : of_quarters) of_quarter = set;
  }

  const LightSet<T>& of_ray(std::size_t ray) const { return of_quarters[ray / rays_in_quarter]; }
};

}  // namespace raytracer
