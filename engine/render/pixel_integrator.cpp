#include "engine/render/pixel_integrator.h"

#include <cmath>

#include "engine/math/block.h"
#include "engine/sample/pattern.h"
#include "engine/sample/refinement.h"

namespace raytracer {
namespace {

std::size_t lines_of(int samples) {
  return static_cast<std::size_t>(std::lround(std::sqrt(samples)));
}

std::uint32_t part_bit(std::uint8_t place) {
  const int column = place % block_side / part_side;
  const int row = place / block_side / part_side;
  return std::uint32_t{1} << (row * parts_across + column);
}

}  // namespace

BeyondRange PixelIntegrator::integrate(std::size_t block, const Tile& tile, int samples,
                                       Image& image, PixelSpreads& spreads) {
  IntegratedBlock integrated =
      integrate_block(tracer_, {lines_of(samples)}, transfer_, tile, image, spreads);
  left_[block] = integrated.left;
  if (integrated.left == 0) return integrated.beyond;
  Tile left = tile;
  left.parts = integrated.left;
  integrated.beyond += render_tile(tracer_, staggered_pattern(rung_of_samples(samples)), transfer_,
                                   left, &image, {.pixels = &spreads});
  return integrated.beyond;
}

void PixelIntegrator::integrate(std::size_t block, int samples, const BlockPixels& pixels,
                                std::span<SampledPixel> results) const {
  const LinePattern lines{lines_of(samples)};
  const std::uint32_t left = left_[block];
  if (left == 0) {
    integrate_pixels(tracer_, lines, transfer_, pixels, results);
    return;
  }
  const auto for_those = [&](bool are_left, const auto& visit) {
    std::vector<std::uint8_t> places;
    for (const std::uint8_t place : pixels.places)
      if (((part_bit(place) & left) != 0) == are_left) places.push_back(place);
    if (places.empty()) return;
    std::vector<SampledPixel> these(places.size());
    visit(BlockPixels{pixels.x_begin, pixels.y_begin, places}, these);
    auto next = these.begin();
    for (std::size_t i = 0; i < results.size(); ++i)
      if (((part_bit(pixels.places[i]) & left) != 0) == are_left) results[i] = *next++;
  };
  for_those(false, [&](const BlockPixels& these, std::span<SampledPixel> to) {
    integrate_pixels(tracer_, lines, transfer_, these, to);
  });
  for_those(true, [&](const BlockPixels& these, std::span<SampledPixel> to) {
    sample_pixels(tracer_, sample_pattern(rung_of_samples(samples)), transfer_, these, to);
  });
}

}  // namespace raytracer
