#include "engine/lights/light_places.h"

#include <cmath>
#include <numbers>

namespace raytracer {
namespace {

double fraction(double x) { return x - std::floor(x); }

/// A place in the unit square.
struct SquarePlace {
  double u;
  double v;

  /// The i-th of `count` of a set: Fibonacci's lattice, which covers it most evenly (J. Hannay, J.
  /// Nye, Fibonacci numerical integration on a sphere, 2004), each set shifted along R2, which
  /// keeps all that were taken so far even (M. Roberts, 2018).
  SquarePlace(std::size_t i, std::size_t count, int set) {
    constexpr double plastic = 1.32471795724474602596;  // x^3 = x + 1
    const double shift = set / plastic;
    u = (static_cast<double>(i) + fraction(0.5 + shift)) / static_cast<double>(count);
    v = fraction(static_cast<double>(i) / std::numbers::phi + set / (plastic * plastic));
  }
};

/// Places of equal areas to places of equal areas.
Vec3 in_unit_disc(const SquarePlace& place) {
  const double radius = std::sqrt(place.u);
  const double angle = 2 * std::numbers::pi * place.v;
  return {radius * std::cos(angle), radius * std::sin(angle), 0};
}

Vec3 on_unit_hemisphere(const SquarePlace& place) {
  const double z = 1 - place.u;
  const double radius = std::sqrt(1 - z * z);
  const double angle = 2 * std::numbers::pi * place.v;
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

}  // namespace

SoftLight place_samples(const PackedLight& light, const LightSampling& sampling) {
  const bool is_sky = light.shape == LightShape::sky;
  SoftLight soft{light, static_cast<std::size_t>(sampling.per_set), {}};
  soft.places.reserve(soft.per_set * static_cast<std::size_t>(sampling.sets));
  const OrthonormalBasis around = orthonormal_basis(light.place);
  const auto add = [&](const SquarePlace& place) {
    if (is_sky) return soft.places.push_back(on_unit_hemisphere(place));
    const Vec3 disc = in_unit_disc(place);
    if (light.rays != LightRays::parallel) return soft.places.push_back(disc);
    soft.places.push_back(unit(light.place + light.size * (disc.x * around.u + disc.y * around.v)));
  };
  const auto sets = static_cast<std::size_t>(sampling.sets);
  for (std::size_t set = 0; set < sets; ++set)
    for (std::size_t i = 0; i < soft.per_set; ++i)
      add(sampling.is_shared_out ? SquarePlace(i * sets + set, sets * soft.per_set, 0)
                                 : SquarePlace(i, soft.per_set, static_cast<int>(set)));
  return soft;
}

int light_set_of(int x, int y, int sample, int sets) {
  // Ordered dithering (B. Bayer, 1973).
  constexpr int order[2][2] = {{0, 2}, {3, 1}};
  return (order[y % 2][x % 2] * sets / 4 + sample) % sets;
}

}  // namespace raytracer
