#include "engine/sample/subpixel_objects.h"

#include <algorithm>
#include <cmath>

#include "engine/errors/error_model.h"
#include "engine/image/pixel_spreads.h"
#include "engine/math/projection.h"

namespace raytracer {

SubpixelObjects::SubpixelObjects(const PackedScene& scene, int channels) : channels_(channels) {
  const View& view = scene.view;
  const auto stride = static_cast<std::size_t>(PixelSpreads::whole_subtiles(view.width));
  pixels_.resize(stride * static_cast<std::size_t>(PixelSpreads::whole_subtiles(view.height)));
  const Projection projection(view);
  const auto within = [](double place, int count) {
    return static_cast<int>(std::clamp(place, 0.0, static_cast<double>(count)));
  };
  // A piece fills this share of the rectangle in which it is seen.
  const auto add = [&](const PixelRectangle& seen, double share) {
    const int x_end = within(std::ceil(seen.x_end), view.width);
    const int y_end = within(std::ceil(seen.y_end), view.height);
    for (int y = within(seen.y_begin, view.height); y < y_end; ++y)
      for (int x = within(seen.x_begin, view.width); x < x_end; ++x) {
        const double across = std::min(seen.x_end, x + 1.0) - std::max<double>(seen.x_begin, x);
        const double down = std::min(seen.y_end, y + 1.0) - std::max<double>(seen.y_begin, y);
        const auto area = static_cast<float>(share * across * down);
        Areas& areas = pixels_[static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x)];
        areas.sum += area;
        areas.sum_of_squares += area * area;
      }
  };
  for_each_kind([&]<class Kind>(std::type_identity<Kind>) {
    if constexpr (HasSubpixelPieces<Kind>)
      for (const auto& primitive : of_kind<Kind>(scene.primitives))
        for_each_subpixel_piece(primitive, projection, add);
  });
}

double SubpixelObjects::error2(std::size_t pixel, int samples) const {
  using Model = SampleErrorModel;
  const Areas& areas = pixels_[pixel];
  if (areas.sum == 0) return 0;
  return channels_ * Model::subpixel_contrast2 * static_cast<double>(areas.sum_of_squares) *
         std::exp(-samples * static_cast<double>(areas.sum) * Model::subpixel_miss_rate);
}

}  // namespace raytracer
