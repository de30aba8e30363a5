#include "engine/render/region.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include "engine/image/subtile_errors.h"
#include "engine/render/built_scene.h"
#include "engine/render/tracing.h"
#include "engine/sample/error_rules.h"
#include "engine/sample/neighbour_error.h"
#include "engine/sample/pattern.h"
#include "engine/sample/refinement.h"

namespace raytracer {
namespace {

/// Of a region's rows of blocks: where its errors lie among those of an image `width` pixels wide,
/// and how many they are.
template <typename Visit>
void for_each_block_row(const Tile& region, int width, const Visit& visit) {
  const std::size_t count = subtiles_in_block * blocks_along(region.width());
  for (int y = region.y_begin; y < region.y_end; y += block_side)
    visit(subtiles_in_block * block_index(region.x_begin, y, blocks_along(width)), count);
}

bool is_inside(const Tile& region, int width_px, int height_px) {
  return region.x_begin >= 0 && region.x_begin < region.x_end && region.x_end <= width_px &&
         region.y_begin >= 0 && region.y_begin < region.y_end && region.y_end <= height_px;
}

template <typename Channel>
std::size_t row_length(const Tile& region, const Raster<Channel>& image) {
  return image.length_of(region.width());
}

}  // namespace

std::vector<Tile> regions_of(int width_px, int height_px, int side_px) {
  return split_into_tiles(width_px, height_px, side_px);
}

template <typename Channel>
std::optional<RegionRendering<Channel>> render_region(const PreparedScene& scene,
                                                      const Tile& region, WorkerPool& pool,
                                                      RenderProgress& progress) {
  const BuiltScene& built = scene.built();
  if (built.plan.sampling.value == Sampling::contract)
    throw std::logic_error("a contract looks at the whole image");
  if (sizeof(Channel) == 1 && needs_floats(built.scene))
    throw std::logic_error("an image with a cover is made of floats");
  const Camera& camera = built.scene.camera;
  if (!is_inside(region, camera.width, camera.height))
    throw std::invalid_argument("the region is not one of this image");
  Tracing tracing{built, pool, progress};
  const SamplePattern pattern = sample_pattern(built.scene.render.samples.value_or(1));
  std::optional<SubtileErrors> errors;
  if (pattern.has_half_buffers()) errors.emplace(camera.width, camera.height);
  const auto image =
      tracing.pass<Channel>(pattern, {.subtiles = errors ? &*errors : nullptr}, region);
  if (!image) return {};

  RegionRendering<Channel> part{
      .region = region,
      .error_multiplier = choose_error_multiplier(built.plan.statistics).initial,
      .precision = built.plan.precision.value,
      .light_samples = light_samples_of(built.plan, built.scene.render.samples.value_or(1)),
      .beyond = tracing.beyond};
  const std::size_t length = row_length(region, *image);
  part.values.reserve(length * static_cast<std::size_t>(region.height()));
  for (int y = region.y_begin; y < region.y_end; ++y) {
    const Channel* const row = image->pixel(region.x_begin, y);
    part.values.insert(part.values.end(), row, row + length);
  }
  if (errors)
    for_each_block_row(region, camera.width, [&](std::size_t begin, std::size_t count) {
      const double* const row = errors->all().data() + begin;
      part.subtile_error2.insert(part.subtile_error2.end(), row, row + count);
    });
  return part;
}

bool samples_tell_error(int samples) { return sample_pattern(samples).has_half_buffers(); }

template <typename Channel>
ImageOfRegions<Channel>::ImageOfRegions(int width_px, int height_px, int samples, int channels)
    : samples_(samples) {
  rendering_.image = Raster<Channel>(width_px, height_px, channels);
  std::fill(rendering_.image.values.begin(), rendering_.image.values.end(), Channel{0});
  rendering_.pixel_count = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  rendering_.samples_per_pixel = samples;
  if (samples_tell_error(samples)) subtile_error2_ = SubtileErrors(width_px, height_px).all();
}

template <typename Channel>
void ImageOfRegions<Channel>::add(const RegionRendering<Channel>& part) {
  Raster<Channel>& image = rendering_.image;
  const Tile& region = part.region;
  const std::size_t length = row_length(region, image);
  std::size_t error_count = 0;
  if (!subtile_error2_.empty())
    for_each_block_row(region, image.width,
                       [&](std::size_t, std::size_t count) { error_count += count; });
  if (!is_inside(region, image.width, image.height) ||
      part.values.size() != length * static_cast<std::size_t>(region.height()) ||
      part.subtile_error2.size() != error_count)
    throw std::invalid_argument("the region is not one of this image");

  const Channel* from = part.values.data();
  for (int y = region.y_begin; y < region.y_end; ++y, from += length)
    std::copy_n(from, length, image.pixel(region.x_begin, y));
  const double* error2 = part.subtile_error2.data();
  if (error_count > 0)
    for_each_block_row(region, image.width, [&](std::size_t begin, std::size_t count) {
      std::copy_n(error2, count, subtile_error2_.data() + begin);
      error2 += count;
    });
  error_multiplier_ = part.error_multiplier;
  rendering_.precision = part.precision;
  rendering_.light_samples = part.light_samples;
  rendering_.beyond += part.beyond;
}

template <typename Channel>
BasicRendering<Channel> ImageOfRegions<Channel>::finish() && {
  rendering_.estimated_error =
      subtile_error2_.empty()
          ? neighbour_error(rendering_.image, samples_)
          : rms_of(error_multiplier_ * sum_of(subtile_error2_), rendering_.image.values.size());
  return std::move(rendering_);
}

template std::optional<RegionRendering<float>> render_region(const PreparedScene&, const Tile&,
                                                             WorkerPool&, RenderProgress&);
template std::optional<RegionRendering<unsigned char>> render_region(const PreparedScene&,
                                                                     const Tile&, WorkerPool&,
                                                                     RenderProgress&);
template class ImageOfRegions<float>;
template class ImageOfRegions<unsigned char>;

}  // namespace raytracer
