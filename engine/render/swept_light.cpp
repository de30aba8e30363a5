#include "engine/render/swept_light.h"

#include <algorithm>
#include <utility>

namespace raytracer {
namespace {

/// How much of a pass's time its parts take, about.
constexpr double recorded_share = 0.05;
constexpr double swept_share = 0.85;

/// The first of the tiles, so many that their samples are at most `most_samples`, or one.
std::span<const Tile> first_batch(std::span<const Tile> tiles, std::size_t samples,
                                  std::size_t most_samples) {
  std::size_t count = 0;
  std::size_t points = 0;
  while (count < tiles.size() &&
         (count == 0 || points + tiles[count].pixel_count() * samples <= most_samples))
    points += tiles[count++].pixel_count() * samples;
  return tiles.first(count);
}

}  // namespace

std::size_t samples_at_once(std::size_t primitives) {
  constexpr std::size_t per_primitive = 16;
  constexpr std::size_t least = std::size_t{1} << 15;
  constexpr std::size_t most = std::size_t{1} << 22;  // some 200 MB, and 100 for each thread
  return std::clamp(per_primitive * primitives, least, most);
}

template <typename T>
std::unique_ptr<SweptPoints<T>> SweepMemory<T>::take() {
  const std::lock_guard lock(mutex_);
  if (free_.empty()) return std::make_unique<SweptPoints<T>>();
  std::unique_ptr<SweptPoints<T>> points = std::move(free_.back());
  free_.pop_back();
  return points;
}

template <typename T>
void SweepMemory<T>::give_back(std::unique_ptr<SweptPoints<T>> points) {
  const std::lock_guard lock(mutex_);
  free_.push_back(std::move(points));
}

template <typename T>
SweptLight<T>::SweptLight(const PacketScene<T>& scene, std::int64_t target, std::size_t tile_count)
    : scene_(scene), target_(target), ledgers_(tile_count) {}

template <typename T>
void SweptLight<T>::record(std::size_t i, const SamplePattern& pattern, const Tile& tile) {
  record_tile(scene_, pattern, tile, target_, ledgers_[i]);
}

template <typename T>
std::size_t SweptLight<T>::begin_sweeps() {
  for (const LightLedger<T>& ledger : ledgers_) packet_count_ += ledger.packet_count();
  dark_.assign(scene_.told_places * packet_count_, 0);
  if (packet_count_ == 0) return 0;
  order_ = order_sweeps<T>(scene_, ledgers_);
  for (std::size_t light = 0; light < scene_.soft_lights.size(); ++light) {
    const PacketSoftLight<T>& soft = scene_.soft_lights[light];
    for (std::size_t place = 0; place < soft.directions.size(); ++place)
      directions_.push_back({{light, place}, soft.first_told + soft.numbers.told_of(place)});
  }
  return directions_.size();
}

template <typename T>
void SweptLight<T>::sweep_one(std::size_t direction, SweepMemory<T>& memory) {
  const Direction& of = directions_[direction];
  std::unique_ptr<SweptPoints<T>> points = memory.take();
  sweep_direction(scene_, of.swept, ledgers_, order_, target_, *points,
                  dark_.data() + of.told * packet_count_);
  memory.give_back(std::move(points));
}

template <typename T>
void SweptLight<T>::end_sweeps() {
  std::size_t first = 0;
  for (LightLedger<T>& ledger : ledgers_) {
    ledger.tell(dark_.data() + first, packet_count_);
    first += ledger.packet_count();
  }
}

template <typename T>
void SweptLight<T>::sweep() {
  SweepMemory<T> memory;
  const std::size_t count = begin_sweeps();
  for (std::size_t i = 0; i < count; ++i) sweep_one(i, memory);
  end_sweeps();
}

template <typename T>
BeyondRange SweptLight<T>::render_tile(std::size_t i, const SamplePattern& pattern,
                                       const Tile& tile, const TileOutput& output) {
  return raytracer::render_tile(scene_, pattern, tile, target_, output, &ledgers_[i]).beyond;
}

template <typename T>
void render_swept(const PacketScene<T>& scene, std::int64_t target, const SamplePattern& pattern,
                  std::span<const Tile> tiles, const TileOutput& output, const TilePass& pass) {
  SweepMemory<T> memory;
  for (std::size_t first = 0; first < tiles.size() && !pass.stop;) {
    const std::span<const Tile> batch = first_batch(tiles.subspan(first), pattern.points.size(),
                                                    samples_at_once(scene.primitives.size()));
    const double share = static_cast<double>(batch.size()) / static_cast<double>(tiles.size());
    const double before = static_cast<double>(first) / static_cast<double>(tiles.size());
    SweptLight<T> light(scene, target, batch.size());
    pass.pool.run(
        batch.size(), [&](std::size_t i) { light.record(i, pattern, batch[i]); }, pass.stop);
    if (pass.stop) return;
    const std::size_t directions = light.begin_sweeps();
    std::atomic<std::size_t> swept{0};
    pass.pool.run(
        directions,
        [&](std::size_t i) {
          light.sweep_one(i, memory);
          const double part = static_cast<double>(++swept) / static_cast<double>(directions);
          pass.report(before + share * (recorded_share + swept_share * part));
        },
        pass.stop);
    if (pass.stop) return;
    light.end_sweeps();
    pass.pool.run(
        batch.size(),
        [&](std::size_t i) {
          pass.finished(first + i, light.render_tile(i, pattern, batch[i], output));
        },
        pass.stop);
    first += batch.size();
  }
}

template class SweepMemory<float>;
template class SweepMemory<double>;
template class SweptLight<float>;
template class SweptLight<double>;
template void render_swept<float>(const PacketScene<float>&, std::int64_t, const SamplePattern&,
                                  std::span<const Tile>, const TileOutput&, const TilePass&);
template void render_swept<double>(const PacketScene<double>&, std::int64_t, const SamplePattern&,
                                   std::span<const Tile>, const TileOutput&, const TilePass&);

}  // namespace raytracer
