#include "engine/plan/light_sampling.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <string>

namespace raytracer {
namespace {

// Of each soft light, for each pixel: what scenes are promised.
constexpr int least_places = 64;
constexpr int most_places = 4096;
// Of each sample of a fixed number, however many a pixel has, and of a sky. Chosen: fewer would not
// fill what is looked up together.
constexpr int least_per_set = 8;
constexpr int most_per_set = 128;
constexpr int most_sets = 512;
// Of a disc, of each sample of a contract, whose estimates see what so few leave out. Measured
// under a wide sun and a lamp: 16 took 2.4 times as long for 0.01, 1.3 to 2 times for 0.003; 8
// took 1.4 to 1.6 times, 0.85 to 1.2 times.
constexpr int least_per_contract_set = 4;
// What a set's share of a sky is off by, which the mean of all sets keeps, as it is a quotient: it
// falls as the square of their places. Measured on random points under a sky that is partly hidden:
// 8 places 0.0033, 16 less than 0.001.
constexpr double bias_of_one_place = 0.2;
// Of a target, what that may come to. Chosen.
constexpr double bias_share = 1.0 / 3;
// Places of a sky by the root of a pixel's samples, so that it falls with what they err. Chosen: of
// 64 samples, 16 places each, the bias is a third of the error; 32 leave 0.0002.
constexpr double bias_growth = 1.5;
constexpr int most_by_bias = 32;
// Primitives times directions, so that to build their grids takes less than to look into them, for
// each sample of a pixel. Measured: 1,000 spheres in 512 directions take 40 ms of one thread.
constexpr double most_entries_per_sample = 4e6;
// The same for each look into them of a pilot, of 9 ns: half of its time.
constexpr double most_entries_per_look = 0.05;
// The same for each millisecond of a budget: a quarter of it.
constexpr double most_entries_per_ms = 3e3;
// In all: some 500 MB.
constexpr double most_entries = 16e6;
// Measured on random points under skies that are partly hidden and lamps before straight edges:
// 1,024 places err by 0.0024 and 0.0019.
constexpr double error_of_one_place = 2.5;
// Of a target, what all places may leave out, which no refinement mends. Chosen.
constexpr double left_out_share = 0.5;
// On a disc's rim, for whoever has to find out whether a point sees any of it. Measured with
// ambient light of 0.35 in the shadow of a ball: 64 places of equal areas alone erred by 0.0074
// under a lamp and 0.0048 under a sun, with 16 on the rim by 0.0012 and 0.0009, with 32 by 0.0005,
// with 64 by less than 0.0004.
constexpr int least_on_rim = 32;
constexpr int most_on_rim = 256;
constexpr double error_of_one_on_rim = 0.02;
// Where directions are swept, along all of them for every point: half as many on the rim, and of
// each set, which is all that a point can ask. 20,000 spheres under a sun took 0.92 to 0.97 of the
// time that they took with 64 places and none on the rim, of a single sample 1.11 to 1.17; with 32
// on it 1.2 to 1.25.
constexpr int swept_on_rim = least_on_rim / 2;
constexpr int least_swept = 32;
// Times the sets that a target needs. Chosen: pixels of many samples then have some for each.
constexpr int spare_sets = 2;
// Of a pixel under a budget, before any is chosen.
constexpr int compared_samples = 4;

/// Of a pixel: a block's points are written down at once.
constexpr int most_swept_samples = 4096;

int power_of_two_from(double least) {
  return static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::ceil(least))));
}

/// What of a scene says how many places its lights need.
struct SoftScene {
  double grid_entries = 0;  ///< for each place: primitives in its directions' grids
  bool has_sky = false;
  bool has_disc = false;
  bool asks_for_any = false;  ///< each sample has to find out whether it sees any of a light
  bool is_swept = false;      ///< so that it can ask no other set than its own
};

/// Whether directions are swept for all points of many tiles: where a few are refined at a time, or
/// light comes through what hides it, each looks for itself.
bool are_swept(const RenderSettings& settings, const Features& features) {
  const bool is_one_pass = !settings.target_rmse && !settings.budget_ms;
  return is_one_pass && !features.transmits && features.shared_lights > 0 &&
         settings.samples.value_or(1) <= most_swept_samples && has_enough_for_sweeps(features);
}

SoftScene describe(const Scene& scene, const Features& features) {
  SoftScene soft;
  soft.grid_entries = 2 * static_cast<double>(features.primitive_count() * features.shared_lights);
  soft.has_sky = std::any_of(scene.lights.begin(), scene.lights.end(),
                             [](const Light& light) { return shape_of(light) == LightShape::sky; });
  soft.has_disc = std::any_of(scene.lights.begin(), scene.lights.end(), [](const Light& light) {
    return shape_of(light) == LightShape::disc;
  });
  soft.asks_for_any = features.has_ambient && scene.shadows == Shadows::black;
  soft.is_swept = are_swept(scene.render, features);
  return soft;
}

/// The sets that grids of so many entries are enough for, a power of two.
int affordable_sets(double entries, int per_set, const SoftScene& soft, int least, int most) {
  const double of_set = per_set * soft.grid_entries;
  if (!(of_set > 0)) return most;
  const double sets =
      std::clamp(entries / of_set, static_cast<double>(least), static_cast<double>(most));
  return static_cast<int>(std::bit_floor(static_cast<unsigned>(sets)));
}

int places_of_each(int samples) {
  return std::max((least_places + samples - 1) / samples, least_per_set);
}

/// By how many places a sample finds out whether it sees any of a light: more for more samples, as
/// what few leave out no sample mends. Chosen: as errors of samples fall at the least.
int places_to_be_sure(int samples) {
  constexpr double samples_of_least = 16;
  return static_cast<int>(least_places * std::max(1.0, std::sqrt(samples / samples_of_least)));
}

/// Of a fixed number of samples for each pixel.
LightSampling for_samples(int samples, const SoftScene& soft) {
  LightSampling sampling;
  sampling.per_set = places_of_each(samples);
  if (soft.has_sky)
    sampling.per_set =
        std::max(sampling.per_set,
                 std::min(power_of_two_from(bias_growth * std::sqrt(samples)), most_by_bias));
  if (soft.asks_for_any && soft.has_disc)
    sampling.on_rim = soft.is_swept ? swept_on_rim : least_on_rim;
  if (soft.asks_for_any && soft.is_swept)
    sampling.per_set = std::max(sampling.per_set, soft.has_sky ? least_places : least_swept);
  // As many as a single set of all of a pixel's places would have are there in any case.
  const double entries = std::max(std::min(most_entries_per_sample * samples, most_entries),
                                  least_places * soft.grid_entries);
  sampling.sets =
      affordable_sets(entries, sampling.per_set, soft, 1,
                      power_of_two_from(std::min(4.0 * samples, static_cast<double>(most_sets))));
  const int per_pixel = std::min(samples, sampling.sets);
  sampling.per_set = std::max(sampling.per_set, places_of_each(per_pixel));
  sampling.is_alone = per_pixel == 1;
  if (soft.asks_for_any && !soft.is_swept)
    sampling.sets_to_be_sure = std::min(
        sampling.sets, (places_to_be_sure(samples) + sampling.per_set - 1) / sampling.per_set);
  return sampling;
}

/// How many places leave out the share of a target that they may.
double places_for(double target) { return error_of_one_place / (left_out_share * target); }

/// The same on a rim, whose places leave out less.
int on_rim_for(const std::optional<double>& target) {
  if (!target) return least_on_rim;
  return power_of_two_from(std::clamp(error_of_one_on_rim / (left_out_share * *target),
                                      1.0 * least_on_rim, 1.0 * most_on_rim));
}

/// All sets together leave out at most a share of the target; `samples` are those of the first
/// pixels that tell an error.
LightSampling for_contract(const RenderSettings& settings, int samples, double pixels,
                           const SoftScene& soft) {
  LightSampling sampling;
  double per_set = soft.has_sky ? places_of_each(samples) : least_per_contract_set;
  double places = least_places;
  if (settings.target_rmse) {
    const double target = *settings.target_rmse;
    if (soft.has_sky)
      per_set = std::clamp(std::sqrt(bias_of_one_place / (bias_share * target)),
                           static_cast<double>(least_per_set), static_cast<double>(most_per_set));
    places = std::clamp(places_for(target), places, static_cast<double>(most_places));
  }
  sampling.per_set = power_of_two_from(per_set);
  const int needed = power_of_two_from(places / sampling.per_set);
  double entries =
      std::min(most_entries_per_look * pixels * samples * sampling.per_set, most_entries);
  if (settings.budget_ms) entries = std::min(entries, most_entries_per_ms * *settings.budget_ms);
  sampling.sets = affordable_sets(entries, sampling.per_set, soft, needed, spare_sets * needed);
  sampling.is_alone = false;
  if (soft.asks_for_any) {
    sampling.sets_to_be_sure = needed;
    if (soft.has_disc) sampling.on_rim = on_rim_for(settings.target_rmse);
  }
  return sampling;
}

/// The most directions that rays to soft lights share, all lights together: both ends of a sky's
/// axes, or those of a disc with its rim, which has no more than its sets.
std::size_t shared_directions(const LightSampling& sampling, const Features& features) {
  return features.shared_lights * 2 * static_cast<std::size_t>(sampling.sets * sampling.per_set);
}

/// A choice's last words.
std::string rim_of(const LightSampling& sampling) {
  return sampling.on_rim == 0
             ? ""
             : fmt::format("; and at {} on a disc's rim, where a point sees none of these",
                           sampling.on_rim);
}

}  // namespace

Choice<LightSampling> choose_light_sampling(const Scene& scene, const Features& features,
                                            int first_samples) {
  const RenderSettings& settings = scene.render;
  if (features.soft_lights == 0)
    return {LightSampling{}, because("no light is larger than a point")};
  const SoftScene soft = describe(scene, features);
  if (!settings.target_rmse && !settings.budget_ms) {
    const LightSampling sampling = for_samples(settings.samples.value_or(1), soft);
    if (sampling.sets == 1)
      return {sampling, because("the same for all pixels: grids for more directions would take "
                                "longer to build than to look into{}",
                                rim_of(sampling))};
    return {sampling, because("in {} sets, of which neighbouring pixels and samples use different "
                              "ones: grain in place of bands{}",
                              sampling.sets, rim_of(sampling))};
  }
  const double pixels = scene.camera.pixel_count();
  const LightSampling sampling =
      for_contract(settings, settings.budget_ms ? compared_samples : first_samples, pixels, soft);
  const int taken = sampling.sets * sampling.per_set;
  if (!settings.target_rmse)
    return {sampling, because("each sample at {} places of each soft light, of {} in all: pixels "
                              "that are refined look at more of them{}",
                              sampling.per_set, taken, rim_of(sampling))};
  if (places_for(*settings.target_rmse) > most_places)
    return {sampling, because("each sample at {} places of each soft light, of {} in all, the most "
                              "that a target gets: what they leave out may exceed it{}",
                              sampling.per_set, taken, rim_of(sampling))};
  return {sampling,
          because("each sample at {} places of each soft light, of {} in all, which leave "
                  "out at most half of the target: pixels that are refined look at more of "
                  "them{}",
                  sampling.per_set, taken, rim_of(sampling))};
}

SoftLightSearch choose_soft_light_search(const RenderSettings& settings, const Features& features,
                                         const LightSampling& sampling) {
  if (features.shared_lights == 0) return {};
  return {shared_directions(sampling, features), are_swept(settings, features),
          settings.budget_ms ? std::min(most_entries_per_ms * *settings.budget_ms, most_entries)
                             : most_entries};
}

int light_samples_per_pixel(const LightSampling& sampling, double samples) {
  return static_cast<int>(sampling.per_set * std::clamp(samples, 1.0, 1.0 * sampling.sets));
}

std::size_t light_rays_per_sample(const Scene& scene) {
  std::size_t rays = 0;
  for (const Light& light : scene.lights) rays += is_soft(light) ? least_places : 1;
  return rays;
}

}  // namespace raytracer
