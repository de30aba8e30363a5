#include "engine/plan/precision.h"

#include <fmt/format.h>

#include "engine/plan/counted.h"

namespace raytracer {
namespace {

constexpr double single_rounding = 0x1p-24;
constexpr double kappa = 8;  // roundings on the way from a coordinate to a pixel; measured: 3
constexpr double tolerance_px = 1.0 / 256;

}  // namespace

Choice<Precision> choose_precision(Precision wish, const Features& features, const Census& census) {
  using enum Precision;
  if (wish != automatic) return {wish, "it is asked for"};

  const double direction_error_px = kappa * single_rounding / census.pixel_angle;
  if (direction_error_px > tolerance_px)
    return {double_precision,
            fmt::format("single would displace edges by {:.2g} pixels: a pixel is only {:.2g} "
                        "radians wide",
                        direction_error_px, census.pixel_angle)};

  constexpr std::uint64_t most_said = 10'000;  // a bound as loose as this has no more digits
  const double mirror_error_px = direction_error_px * census.magnification;
  if (mirror_error_px > tolerance_px)
    return {double_precision,
            fmt::format("single could displace what mirrors show by {}: up to {} in a row at "
                        "curved surfaces may magnify its error {} times",
                        mirror_error_px < 1 ? fmt::format("{:.2g} pixels", mirror_error_px)
                                            : "more than a pixel",
                        counted(static_cast<std::uint64_t>(features.max_depth), "reflection"),
                        census.magnification < static_cast<double>(most_said)
                            ? fmt::format("{:.0f}", census.magnification)
                            : "more than " + grouped(most_said))};

  const double shadow_error_px = direction_error_px * (1 + census.shadow_path / census.nearest);
  if (!(shadow_error_px <= tolerance_px))
    return {double_precision,
            fmt::format("single would displace shadows by {:.2g} pixels: occluders up to {:.3g} "
                        "times as far as the nearest surface",
                        shadow_error_px, census.shadow_path / census.nearest)};

  const double surface_error = kappa * single_rounding * census.distance_in_radii;
  constexpr double surface_tolerance = 1.0 / 256;  // of a radius: of a normal, and of a contact
  if (surface_error > surface_tolerance)
    return {double_precision,
            fmt::format("single would displace points by {:.2g} radii of their sphere: it is up "
                        "to {:.3g} radii away",
                        surface_error, census.distance_in_radii)};

  constexpr double least_clearance = 1.0 / 256;
  if (census.light_clearance < least_clearance)
    return {double_precision,
            fmt::format("single could not tell a light from the surface {:.2g} of the extent away",
                        census.light_clearance)};

  constexpr std::size_t most_numbered = std::size_t{1} << 24;  // integers that a single holds
  const std::size_t primitives =
      features.spheres + features.squares + features.planes + features.triangles;
  if (primitives > most_numbered)
    return {double_precision, fmt::format("single cannot number {} primitives apart", primitives)};

  constexpr double half_level = 0.5 / 255;
  const double highlight_error = kappa * single_rounding * features.shininess;
  if (highlight_error > half_level)
    return {double_precision,
            fmt::format("single would change highlights by {:.2g}: shininess is {:.3g}",
                        highlight_error, features.shininess)};

  return {single_precision,
          fmt::format("it suffices: single displaces edges by at most {:.2g} pixels and shadows by "
                      "at most {:.2g}, and {:.2g} are allowed",
                      direction_error_px, shadow_error_px, tolerance_px)};
}

}  // namespace raytracer
