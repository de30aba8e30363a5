#include "engine/sample/subpixel_objects.h"

#include <algorithm>
#include <cmath>

#include "engine/errors/error_model.h"
#include "engine/math/projection.h"

namespace raytracer {
namespace {

using Model = SampleErrorModel;

/// The share of a pixel that objects of so much area cover, which lie anywhere in it.
double covered(double area) { return -std::expm1(-area); }

}  // namespace

SubpixelObjects::SubpixelObjects(const PackedScene& scene, int channels)
    : contrast2_(channels * Model::subpixel_contrast2) {
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

void SubpixelObjects::learn_contrast(const PixelSpreads& spreads, int samples) {
  // A pixel of which they cover c varies by c (1 - c) of their squared contrast.
  double seen = 0;
  double of_contrast = 0;
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    if (pixels_[i].sum == 0) continue;
    const double cover = covered(pixels_[i].sum);
    seen += samples * static_cast<double>(spreads.variance[i]);
    of_contrast += samples * cover * (1 - cover);
  }
  const double most = contrast2_;
  contrast2_ =
      std::min(most, (seen + Model::subpixel_prior * most) / (of_contrast + Model::subpixel_prior));
}

double SubpixelObjects::error2(std::size_t pixel, int samples) const {
  const Areas& areas = pixels_[pixel];
  if (areas.sum == 0) return 0;
  const double sum = areas.sum;
  const double cover = covered(sum);
  const double shown = cover / sum;
  return contrast2_ * shown * shown * static_cast<double>(areas.sum_of_squares) *
         std::exp(-samples * cover * Model::subpixel_miss_rate);
}

}  // namespace raytracer
