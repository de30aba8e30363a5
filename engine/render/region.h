// A picture in parts: regions that are traced apart, on this machine or on others of the same
// build, and put together to the same bytes.
#pragma once

#include <optional>
#include <vector>

#include "engine/image/tile.h"
#include "engine/math/block.h"
#include "engine/render/prepared_scene.h"
#include "engine/render/render.h"

namespace raytracer {

/// A part of a picture, and what its samples told.
template <typename Channel>
struct RegionRendering {
  Tile region{};
  std::vector<Channel> values{};         ///< of its pixels, row by row
  std::vector<double> subtile_error2{};  ///< of its blocks, row by row; empty if nothing tells them
  double error_multiplier = 1;           ///< for the sum of these
  Precision precision = Precision::double_precision;
  int light_samples = 0;  ///< as RenderReport has them
  BeyondRange beyond;
};

/// A region's sides are multiples of it, but at the image's edge.
inline constexpr int region_unit_px = block_side;

/// The regions of an image, as the tiles that cover it: `side_px` is a multiple of region_unit_px.
std::vector<Tile> regions_of(int width_px, int height_px, int side_px);

/// Traces one region with as many samples per pixel as the scene says, on the pool's threads;
/// nothing if `progress.stop` ended it. Throws std::logic_error if the scene has a contract, which
/// looks at the whole image, or bytes are asked for where needs_floats(); std::invalid_argument if
/// there is no such region.
template <typename Channel>
std::optional<RegionRendering<Channel>> render_region(const PreparedScene& scene,
                                                      const Tile& region, WorkerPool& pool,
                                                      RenderProgress& progress);

/// Whether the error of an image with so many samples per pixel is told by these, and is the same
/// however its pixels are stored.
bool samples_tell_error(int samples);

/// An image as its regions come in.
template <typename Channel>
class ImageOfRegions {
 public:
  /// Of an image with so many samples per pixel; black before anything came.
  ImageOfRegions(int width_px, int height_px, int samples, int channels = 3);

  /// Each region once. Throws std::invalid_argument if there is no such region in the image.
  void add(const RegionRendering<Channel>& part);

  const Raster<Channel>& so_far() const { return rendering_.image; }

  /// What render() would have made, once all regions are there; but for the times.
  BasicRendering<Channel> finish() &&;

 private:
  BasicRendering<Channel> rendering_;
  int samples_;
  double error_multiplier_ = 1;
  std::vector<double> subtile_error2_;  ///< of the whole image; empty if nothing tells them
};

}  // namespace raytracer
