#include "client/formats/lighting.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <variant>

#include "client/formats/triple.h"

namespace raytracer::client {
namespace {

using model::Triple;

constexpr double key_intensity = 0.9;

/// So that what no light reaches is not lost in black.
void fill_shadows(model::Scene& scene) {
  scene.ambient = 0.05;
  scene.is_shadow_black = false;
}

/// A unit vector. Where `up` is along the line of sight, the axis that is least along it stands in
/// for it, as scenes have it.
Triple right_of(const Triple& ahead, const Triple& up) {
  constexpr double none = 1e-12;
  Triple right = cross(ahead, unit(up));
  if (!(dot(right, right) >= none * none)) {
    Triple axis{};
    std::size_t least = 0;
    for (const std::size_t i : {std::size_t{2}, std::size_t{1}})
      if (std::abs(ahead[i]) < std::abs(ahead[least])) least = i;
    axis[least] = 1;
    right = cross(ahead, axis);
  }
  return unit(right);
}

/// What a light's intensity is multiplied with at what a view looks at. A lamp that falls off
/// spreads its light over a sphere.
struct ShareAt {
  const model::View& view;

  double operator()(const model::Lamp& lamp) const {
    if (!lamp.falls_off) return 1;
    const auto square = [](const Triple& a) { return dot(a, a); };
    // Of the eye's distance: a lamp that stands in what is looked at lights its surroundings.
    constexpr double nearest = 0.1;
    const double distance2 = square(difference(lamp.position, view.at)) +
                             nearest * nearest * square(difference(view.from, view.at));
    return 1 / (4 * std::numbers::pi * distance2);
  }
  double operator()(const model::Sun&) const { return 1; }
  double operator()(const model::Sky&) const { return 1; }
};

}  // namespace

void light_studio(model::Scene& scene) {
  const model::View& view = scene.view;
  const Triple ahead = unit(difference(view.at, view.from));
  const Triple right = right_of(ahead, view.up);
  const Triple above = cross(right, ahead);
  const auto direction = [&](double to_right, double upward, double forward) {
    return sum(sum(scaled(right, to_right), scaled(above, upward)), scaled(ahead, forward));
  };
  constexpr Triple white{1, 1, 1};
  scene.lights.emplace_back(model::Sun{direction(0.5, -0.8, 1), white, key_intensity});
  scene.lights.emplace_back(model::Sky{white, 0.5});
  fill_shadows(scene);
}

void expose(model::Scene& scene) {
  double light = 0;
  for (const model::Light& one : scene.lights) {
    const double share = std::visit(ShareAt{scene.view}, one);
    light += std::visit(
        [&](const auto& known) {
          return known.intensity * share *
                 *std::max_element(known.color.begin(), known.color.end());
        },
        one);
  }
  const double scale = key_intensity / light;
  if (std::isfinite(scale))
    for (model::Light& one : scene.lights)
      std::visit([&](auto& known) { known.intensity *= scale; }, one);
  fill_shadows(scene);
}

}  // namespace raytracer::client
