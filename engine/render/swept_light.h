// The soft light of many tiles, whose directions are swept for all of them at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "engine/image/tile.h"
#include "engine/image/tile_output.h"
#include "engine/kernel/light_sweep.h"
#include "engine/kernel/simd/render_tile.h"
#include "engine/render/tile_pass.h"

namespace raytracer {

/// Memory for sweeps, as much as there are at a time.
template <typename T>
class SweepMemory {
 public:
  std::unique_ptr<SweptPoints<T>> take();
  void give_back(std::unique_ptr<SweptPoints<T>> points);

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<SweptPoints<T>>> free_;
};

/// At first record() for each tile, then once sweep() or, for several threads, begin_sweeps(),
/// sweep_one() for each direction and end_sweeps(), at last render_tile() for each tile. Different
/// tiles, and different directions, may have different threads.
template <typename T>
class SweptLight {
 public:
  SweptLight(const PacketScene<T>& scene, std::int64_t target, std::size_t tile_count);

  /// Writes down what the samples of the i-th tile ask.
  void record(std::size_t i, const SamplePattern& pattern, const Tile& tile);

  /// Makes room for the answers to all that was written down, and returns how many directions
  /// there are to sweep.
  std::size_t begin_sweeps();
  /// Finds out which points see nothing along one of these.
  void sweep_one(std::size_t direction, SweepMemory<T>& memory);
  /// From now on the ledgers tell the answers.
  void end_sweeps();
  /// These three, one direction after another.
  void sweep();

  /// Traces the i-th tile, with the pattern that was recorded.
  BeyondRange render_tile(std::size_t i, const SamplePattern& pattern, const Tile& tile,
                          const TileOutput& output);

 private:
  using Lanes = typename LightLedger<T>::Lanes;
  struct Direction {
    SweptDirection swept;
    std::size_t told;  ///< its place in the ledgers
  };

  const PacketScene<T>& scene_;
  std::int64_t target_;
  std::vector<LightLedger<T>> ledgers_;
  SweepOrder order_;
  std::size_t packet_count_ = 0;
  std::vector<Direction> directions_;
  std::vector<Lanes> dark_;  ///< for each place in the ledgers, of all packets
};

/// How many samples are swept at once, where there are so many primitives: few stay in the nearest
/// caches, but all primitives pass over each batch.
std::size_t samples_at_once(std::size_t primitives);

/// All samples of the tiles' pixels, some tiles at a time.
template <typename T>
void render_swept(const PacketScene<T>& scene, std::int64_t target, const SamplePattern& pattern,
                  std::span<const Tile> tiles, const TileOutput& output, const TilePass& pass);

}  // namespace raytracer
