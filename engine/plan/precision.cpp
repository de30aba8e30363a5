#include "engine/plan/precision.h"

#include <algorithm>
#include <cmath>

#include "engine/plan/counted.h"

namespace raytracer {
namespace {

constexpr double single_rounding = 0x1p-24;
constexpr double kappa = 8;  // roundings on the way from a coordinate to a pixel; measured: 3

// The bounds are far from what happens: on the bench's and the shipped scenes, 700 x 500 and
// 3840 x 2160, at most 0.032 % of the pixels differ from double by more than a level where these
// tolerances choose single (a mesh of 100,000 triangles; a million spheres: 0.019 %, 250,000 of a
// pixel each: 0.003 %), and 1.1 % in the one scene whose mirrors they keep from it.
constexpr double sphere_tolerance_px = 1.0 / 64;
constexpr double triangle_tolerance_px = 1.0 / 256;  // at whose edges more is left to rounding
constexpr double mirror_tolerance_px = 1.0 / 16;
constexpr double surface_tolerance = 1.0 / 192;  // of a radius: of a normal, and of a contact

// What every picture's values are rounded to, and the few roundings of a colour before it.
constexpr double colour_rounding = 16 * single_rounding;

double rounding_of(Precision precision) {
  return precision == Precision::double_precision ? 0x1p-53 : single_rounding;
}

/// By how much an error of direction grows in a shadow, whose edge is as far as its occluder's.
double growth_along_path(const Census& census, double nearest) {
  return census.shadow_path > 0 ? 1 + census.shadow_path / nearest : 1;
}

/// By how much it grows in the shadows of triangles and squares under a point light: points look
/// for these from where they are, far from what is near the light. In double it takes a light a
/// millionth of the scene from them to show.
double growth_by_spread(const Features& features, const Census& census) {
  const bool has_such_shadows = features.casts_shadows && features.point_lights > 0 &&
                                features.triangles + features.squares > 0;
  return has_such_shadows ? census.shadow_spread : 1;
}

}  // namespace

ArithmeticError foresee_arithmetic_error(Precision precision, const Features& features,
                                         const Census& census) {
  const double rounding = kappa * rounding_of(precision);
  // Of a sphere on which the eye is, all but what is seen within a pixel of its horizon is farther.
  const double nearest =
      census.clearance > 0 ? census.clearance : census.pixel_angle * census.farthest;
  double growth = std::max(census.magnification, growth_along_path(census, nearest));
  if (precision == Precision::single_precision)
    growth = std::max(growth, growth_by_spread(features, census));
  ArithmeticError error;
  const double displacement_px = rounding / census.pixel_angle * growth;
  constexpr double beyond_every_image_px = 1e6;  // also for what is no number
  error.displacement_px =
      displacement_px < beyond_every_image_px ? displacement_px : beyond_every_image_px;
  // A turn of the normal changes the diffuse part by as much, a highlight by the root of its
  // exponent more.
  const double normal_error = rounding * (1 + census.distance_in_radii);
  const double shading_error =
      normal_error * (1 + std::sqrt(features.shininess)) + rounding * features.shininess;
  const double share = colour_rounding + std::max(census.brightest, 1.0) * shading_error;
  error.levels = share < 1 ? 255 * share : 255;
  return error;
}

Choice<Precision> choose_precision(Precision wish, const Features& features, const Census& census) {
  using enum Precision;
  constexpr double least_in_single = 0x1p-60;  // a square of it is still a normal number
  if (wish != double_precision && census.smallest < least_in_single)
    return {double_precision, because("single does not hold the square of a size that is {:.2g} of "
                                      "the extent",
                                      census.smallest)};
  constexpr std::size_t most_numbered = std::size_t{1} << 24;  // integers that a single holds
  const std::size_t primitives =
      features.spheres + features.squares + features.planes + features.triangles;
  if (wish != double_precision && primitives > most_numbered)
    return {double_precision, because("single cannot number {} primitives apart", primitives)};
  if (wish != automatic) return {wish, because("it is asked for")};

  const double tolerance_px = features.triangles > 0 ? triangle_tolerance_px : sphere_tolerance_px;
  const double direction_error_px = kappa * single_rounding / census.pixel_angle;
  if (direction_error_px > tolerance_px)
    return {double_precision,
            because("single would displace edges by {:.2g} pixels: a pixel is only {:.2g} "
                    "radians wide",
                    direction_error_px, census.pixel_angle)};

  const double mirror_error_px = direction_error_px * census.magnification;
  if (mirror_error_px > mirror_tolerance_px)
    return {double_precision,
            because("single would displace what mirrors show by {:.2g} pixels: a curved one "
                    "magnifies its error {:.3g} times",
                    mirror_error_px, census.magnification)};

  const double path_error_px = direction_error_px * growth_along_path(census, census.nearest);
  if (!(path_error_px <= tolerance_px))
    return {double_precision,
            because("single would displace shadows by {:.2g} pixels: occluders up to {:.3g} "
                    "times as far as the nearest surface",
                    path_error_px, census.shadow_path / census.nearest)};

  const double surface_error = kappa * single_rounding * census.distance_in_radii;
  if (surface_error > surface_tolerance)
    return {double_precision,
            because("single would displace points by {:.2g} radii of their sphere: it is up "
                    "to {:.3g} radii away",
                    surface_error, census.distance_in_radii)};

  constexpr double least_clearance = 1.0 / 256;
  if (census.light_clearance < least_clearance)
    return {double_precision,
            because("single could not tell a light from the surface {:.2g} of the extent away",
                    census.light_clearance)};

  const double spread_error_px = direction_error_px * growth_by_spread(features, census);
  if (!(spread_error_px <= tolerance_px))
    return {double_precision,
            because("single would displace shadows by {:.2g} pixels: a point light shines {:.3g} "
                    "times as far as to the nearest triangle or square",
                    spread_error_px, census.shadow_spread)};
  const double shadow_error_px = std::max(path_error_px, spread_error_px);

  if (census.gap < 4 * kappa * single_rounding)
    return {double_precision,
            because("single could not tell apart two surfaces that are {:.2g} of their "
                    "distance from each other",
                    census.gap)};

  constexpr double half_level = 0.5 / 255;
  const double highlight_error = kappa * single_rounding * features.shininess;
  if (highlight_error > half_level)
    return {double_precision,
            because("single would change highlights by {:.2g}: shininess is {:.3g}",
                    highlight_error, features.shininess)};

  constexpr double most_levels = 16;  // the bound is many times what was seen
  const double levels = foresee_arithmetic_error(single_precision, features, census).levels;
  if (levels > most_levels)
    return {double_precision,
            because("single may change shaded surfaces by {:.2g} levels of 255", levels)};

  return {single_precision,
          because("it suffices: single displaces edges by at most {:.2g} pixels and shadows by "
                  "at most {:.2g}, and {:.2g} are allowed",
                  direction_error_px, shadow_error_px, tolerance_px)};
}

}  // namespace raytracer
