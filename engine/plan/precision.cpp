#include "engine/plan/precision.h"

#include <algorithm>
#include <cmath>

#include "engine/math/tolerances.h"

namespace raytracer {
namespace {

// The error model of arithmetic, as engine/errors/error_model.h is that of samples: each number is
// derived, measured or chosen.
//
// The bounds are far from what happens: on the bench's and the shipped scenes, 700 x 500 and
// 3840 x 2160, at most 0.032 % of the pixels differ from double by more than a level where these
// tolerances choose single (a mesh of 100,000 triangles; a million spheres: 0.019 %, 250,000 of a
// pixel each: 0.003 %), and 1.1 % in the one scene whose mirrors they keep from it. What edges may
// be displaced by is each kind's own affair.

constexpr auto single_rounding = static_cast<double>(unit_roundoff<float>);
constexpr double double_rounding = unit_roundoff<double>;
// Roundings on the way from a coordinate to a pixel. Measured on those scenes: 3; chosen: twice
// that, and more.
constexpr double kappa = 8;
// What curved mirrors show may be displaced by this, in pixels. Calibrated on those scenes.
constexpr double mirror_tolerance_px = 1.0 / 16;
// What a normal may turn by, in radians, and a point be displaced by, in radii of what it is on.
// Calibrated likewise.
constexpr double surface_tolerance = 1.0 / 192;
// The least distance of a light from a surface, of what it is computed from. Chosen.
constexpr double least_clearance = 1.0 / 256;
// Two surfaces are apart if rounding moves neither past the other. Derived: each by as much, both
// as they meet a ray and as a shadow's ray leaves.
constexpr double gap_roundings = 4 * kappa;
// What counts for nothing, in pixels. Chosen: a thousandth of what single displaces where it
// suffices.
constexpr double exact_px = 1e-6;
// What every picture's values are rounded to, and the few roundings of a colour before it. Chosen:
// more than the operations from a sample to a pixel.
constexpr double colour_rounding = 16 * single_rounding;
// What a highlight may change by, and bent rays be turned by: the square of the cosine beyond a
// surface is 1 - ior^2 (1 - cos^2). Derived: no more than by rounding to 8 bits.
constexpr double half_level = 0.5 / 255;
// What shading may change by. Chosen: the bound is many times what was seen on those scenes.
constexpr double most_levels = 16;
// The least size of which a single holds the square. Derived: it is a normal number, above 2^-126.
constexpr double least_in_single = 0x1p-60;
// Derived: the integers that a single holds.
constexpr std::size_t most_numbered = std::size_t{1} << 24;
// Derived: more than an image's side; also for what is no number.
constexpr double beyond_every_image_px = 1e6;

double rounding_of(Precision precision) {
  return precision == Precision::double_precision ? double_rounding : single_rounding;
}

/// By how much an error of direction grows in a kind's shadows, whose edges are as far as their
/// occluders', where nothing is seen nearer than `nearest`.
double growth_in_shadow(const ShadowReach& shadow, const SceneStatistics& statistics,
                        double nearest) {
  if (!(shadow.path > 0)) return 1;
  const double most = shadow.path / nearest;
  return 1 + (nearest >= statistics.nearest_edge() ? std::min(most, shadow.growth) : most);
}

/// In those of all kinds.
double growth_in_shadows(const SceneStatistics& statistics, double nearest) {
  double growth = 1;
  for (const ShadowReach& shadow : statistics.shadows)
    growth = std::max(growth, growth_in_shadow(shadow, statistics, nearest));
  return growth;
}

/// The same of what is sought from the eye as from anywhere.
double growth_anywhere(const SceneStatistics& statistics) {
  double distance = 0;
  for (std::size_t kind = 0; kind < statistics.shadows.size(); ++kind)
    distance = std::max(distance, std::min(statistics.shadows[kind].path,
                                           statistics.kinds[kind].meeting_distance()));
  return distance > 0 ? 1 + distance / statistics.nearest : 1;
}

/// Of the kind whose shadows single displaces most against what is tolerated of its edges, where
/// nothing is nearer than what is nearest.
struct DisplacedShadows {
  double error_px = 0;
  double tolerance_px = 1;
  double path = 0;

  bool are_tolerated() const { return error_px <= tolerance_px; }
};
DisplacedShadows most_displaced_shadows(const SceneStatistics& statistics) {
  const double direction_error_px = direction_error_in_single(statistics);
  DisplacedShadows most;
  for_each_kind([&]<class Kind>(std::type_identity<Kind>) {
    const ShadowReach& shadow = statistics.shadows[kind_index<Kind>];
    const double error_px =
        direction_error_px * growth_in_shadow(shadow, statistics, statistics.nearest);
    if (shadow.path > 0 && !(error_px / Kind::tolerance_px <= most.error_px / most.tolerance_px))
      most = {error_px, Kind::tolerance_px, shadow.path};
  });
  return most;
}

/// Whether most of what is in view is nearer: each primitive counts by what it covers of the image.
bool is_most_nearer(const SceneStatistics& statistics, double distance) {
  const GeometryStatistics& all = statistics.all;
  return all.blocks > 0 && all.block_distances <= distance * all.blocks;
}

/// Whether the scene has shadows under point lights of kinds whose shadow rays start at the shaded
/// points: edges near the light are magnified far from it.
bool has_spreading_shadows(const Features& features, const SceneStatistics& statistics) {
  bool has = false;
  for_each_kind([&]<class Kind>(std::type_identity<Kind>) {
    if (is_sought_from_points<Kind>(features.primitives[kind_index<Kind>], statistics.pixels))
      has = features.casts_shadows && features.light_count(LightRays::converging) > 0;
  });
  return has;
}

/// By how much an error grows in them. Double suffices unless the light is within a millionth of
/// the scene of them.
double growth_by_spread(const Features& features, const SceneStatistics& statistics) {
  return has_spreading_shadows(features, statistics) ? statistics.shadow_spread : 1;
}

/// Of the kinds that the scene has.
double least_tolerance_px(const Features& features) {
  double least = infinity;
  for_each_kind([&]<class Kind>(std::type_identity<Kind>) {
    if (features.primitives[kind_index<Kind>] > 0) least = std::min(least, Kind::tolerance_px);
  });
  return least;
}

}  // namespace

const char* name_of(Precision precision) {
  if (precision == Precision::mixed) return "mixed";
  return precision == Precision::single_precision ? "single" : "double";
}

double direction_error_in_single(const SceneStatistics& statistics) {
  return kappa * single_rounding / statistics.pixel_angle;
}

ArithmeticError predict_arithmetic_error(Precision precision, const Features& features,
                                         const SceneStatistics& statistics) {
  const double rounding = kappa * rounding_of(precision);
  const double nearest = statistics.nearest_edge();
  double growth = 1;
  if (precision == Precision::mixed)
    growth = growth_in_shadows(statistics, std::max(nearest, nearest_in_single(statistics)));
  else
    growth = std::max(growth_in_shadows(statistics, nearest), statistics.magnification);
  if (precision == Precision::single_precision)
    growth = std::max(growth, growth_by_spread(features, statistics));
  ArithmeticError error;
  const double displacement_px = rounding / statistics.pixel_angle * growth;
  error.displacement_px =
      displacement_px < beyond_every_image_px ? displacement_px : beyond_every_image_px;
  // A turn of the normal changes the diffuse part by as much, a highlight by the root of its
  // exponent more.
  const double normal_error = rounding * (1 + statistics.all.distance_in_radii());
  const double shading_error =
      normal_error * (1 + std::sqrt(features.shininess)) + rounding * features.shininess;
  const double share = colour_rounding + std::max(statistics.brightest, 1.0) * shading_error;
  error.levels = share < 1 ? 255 * share : 255;
  return error;
}

double nearest_in_single(const SceneStatistics& statistics) {
  const double direction_error_px = direction_error_in_single(statistics);
  double nearest = 0;
  for_each_kind([&]<class Kind>(std::type_identity<Kind>) {
    const ShadowReach& shadow = statistics.shadows[kind_index<Kind>];
    const double growth = growth_in_shadow(shadow, statistics, statistics.nearest);
    if (!(shadow.path > 0) || direction_error_px * growth <= Kind::tolerance_px) return;
    // Where the growth along the longest path is as much as is tolerated.
    const double left_px = Kind::tolerance_px - direction_error_px;
    nearest =
        std::max(nearest, left_px > 0 ? shadow.path * direction_error_px / left_px : infinity);
  });
  return nearest;
}

double lamp_reach_in_single(const LampDistances& lamp, const Features& features,
                            const SceneStatistics& statistics) {
  const double direction_error_px = direction_error_in_single(statistics);
  return has_spreading_shadows(features, statistics)
             ? lamp.nearest * least_tolerance_px(features) / direction_error_px
             : infinity;
}

bool are_paths_magnified(const SceneStatistics& statistics) {
  const double direction_error_px = direction_error_in_single(statistics);
  return direction_error_px * statistics.magnification > mirror_tolerance_px;
}

Choice<Precision> choose_precision(Precision requested, const Features& features,
                                   const SceneStatistics& statistics) {
  using enum Precision;
  if (requested != double_precision && statistics.all.smallest < least_in_single)
    return {double_precision, because("single does not hold the square of a size that is {:.2g} of "
                                      "the extent",
                                      statistics.all.smallest)};
  const std::size_t primitives = features.primitive_count();
  if (requested != double_precision && primitives > most_numbered)
    return {double_precision, because("single cannot number {} primitives apart", primitives)};
  if (requested != automatic) return {requested, because("it is asked for")};

  const double tolerance_px = least_tolerance_px(features);
  const double direction_error_px = direction_error_in_single(statistics);
  if (direction_error_px > tolerance_px)
    return {double_precision,
            because("single would displace edges by {:.2g} pixels: a pixel is only {:.2g} "
                    "radians wide",
                    direction_error_px, statistics.pixel_angle)};

  // Samples traced again are sought from the eye as others are from anywhere, which so near to
  // something loses digits even of double.
  const double growth_on_nearest = growth_anywhere(statistics);
  const double near_error_px = kappa * double_rounding / statistics.pixel_angle * growth_on_nearest;
  if (!(near_error_px <= exact_px))
    return {double_precision,
            because("single would displace shadows by {:.2g} pixels: occluders up to {:.3g} "
                    "times as far as the nearest surface",
                    direction_error_px * growth_on_nearest, growth_on_nearest - 1)};

  const double surface_error = kappa * single_rounding * statistics.all.distance_in_radii();
  if (surface_error > surface_tolerance)
    return {double_precision,
            because("single would displace points by {:.2g} radii of what they are on: it is "
                    "up to {:.3g} radii away",
                    surface_error, statistics.all.distance_in_radii())};

  if (statistics.light_clearance < least_clearance)
    return {double_precision,
            because("single could not tell a light from the surface {:.2g} of its distance away",
                    statistics.light_clearance)};

  const DisplacedShadows displaced = most_displaced_shadows(statistics);
  const double spread_error_px = direction_error_px * growth_by_spread(features, statistics);
  // What is beyond is to be the lesser part: planes that go on, and little else.
  const bool are_lamps_in_reach =
      std::all_of(statistics.lamps.begin(), statistics.lamps.end(), [&](const LampDistances& lamp) {
        return lamp_reach_in_single(lamp, features, statistics) > lamp.bounded / 2;
      });
  if (!(spread_error_px <= tolerance_px) && !are_lamps_in_reach)
    return {double_precision,
            because("single would displace shadows by {:.2g} pixels: a point light shines {:.3g} "
                    "times as far as to the nearest thing that hides it",
                    spread_error_px, statistics.shadow_spread)};
  const double shadow_error_px =
      std::max({direction_error_px, displaced.error_px, spread_error_px});

  if (statistics.gap < gap_roundings * single_rounding)
    return {double_precision,
            because("single could not tell apart two surfaces that are {:.2g} of their "
                    "distance from each other",
                    statistics.gap)};

  const double highlight_error = kappa * single_rounding * features.shininess;
  if (highlight_error > half_level)
    return {double_precision,
            because("single would change highlights by {:.2g}: shininess is {:.3g}",
                    highlight_error, features.shininess)};

  const double bending_error = kappa * single_rounding * features.ior * features.ior;
  if (bending_error > half_level)
    return {double_precision, because("single would turn bent rays by {:.2g}: an index of "
                                      "refraction is {:.3g}",
                                      bending_error, features.ior)};

  const double levels = predict_arithmetic_error(single_precision, features, statistics).levels;
  if (levels > most_levels)
    return {double_precision,
            because("single may change shaded surfaces by {:.2g} levels of 255", levels)};

  if (!(spread_error_px <= tolerance_px))
    return {mixed,
            because("single would displace shadows by {:.2g} pixels where a point light shines "
                    "{:.3g} times as far as to the nearest thing that hides it: what is so "
                    "far from it is traced in double",
                    spread_error_px, statistics.shadow_spread)};
  if (!displaced.are_tolerated() && is_most_nearer(statistics, nearest_in_single(statistics)))
    return {
        double_precision,
        because("single would displace shadows by {:.2g} pixels, and {:.2g} are allowed: "
                "occluders are up to {:.3g} times as far as the nearest surface, and most of "
                "what is in view is near",
                displaced.error_px, displaced.tolerance_px, displaced.path / statistics.nearest)};
  if (!displaced.are_tolerated())
    return {mixed,
            because("single would displace shadows by {:.2g} pixels, and {:.2g} are allowed: "
                    "occluders are up to {:.3g} times as far as the nearest surface; what is "
                    "nearer than {:.2g} of the extent is traced in double",
                    displaced.error_px, displaced.tolerance_px, displaced.path / statistics.nearest,
                    nearest_in_single(statistics))};

  if (are_paths_magnified(statistics))
    return {mixed, because("single displaces edges by at most {:.2g} pixels, but curved mirrors or "
                           "lenses may magnify that {:.3g} times: double carries the paths of rays "
                           "from one to the next",
                           direction_error_px, statistics.magnification)};

  return {single_precision,
          because("it suffices: single displaces edges by at most {:.2g} pixels and shadows by "
                  "at most {:.2g}, and {:.2g} are allowed",
                  direction_error_px, shadow_error_px,
                  displaced.path > 0 ? displaced.tolerance_px : tolerance_px)};
}

}  // namespace raytracer
