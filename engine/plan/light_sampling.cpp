#include "engine/plan/light_sampling.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace raytracer {
namespace {

// Of each soft light, for each pixel: what scenes are promised.
constexpr int least_places = 64;
constexpr int most_places = 1024;
// Of each sample, however many a pixel has. Chosen: fewer would not fill what is looked up
// together.
constexpr int least_per_set = 8;
constexpr int most_sets = 512;
// Parts of a lattice, if there are enough places: even themselves, and as the numbers of samples
// are, of twos and threes.
constexpr std::array numbers_shared_out{12, 4};
// Under a budget, if there is no time for more. Chosen.
constexpr int least_in_budget = 16;
// What a ray to a light takes one thread. Measured on the shipped scene `evening`: 9 ns.
constexpr double ray_ms = 1e-5;
// Of primitives times directions for each sample of a pixel, so that to build their grids takes
// less than to look into them. Measured: 1,000 spheres in 512 directions take 40 ms of one thread.
constexpr double most_entries_per_sample = 4e6;
// In all: some 500 MB.
constexpr double most_entries = 16e6;
// What a target allows for each place. Measured on random points under skies that are half or in
// patches hidden: 64 places err by 0.016, 128 by 0.0093. Images err less, where most points see all
// of a light or nothing: so 36 of 36 targets, 0.03 to 0.003, were kept on 12 scenes.
constexpr double error_of_one_place = 2.5;

/// Of a pixel: a block's points are written down at once.
constexpr int most_swept_samples = 4096;

/// Each sample has at least `least`.
LightSampling for_samples(int samples, double primitives, int least) {
  LightSampling sampling;
  sampling.per_set = std::max((least_places + samples - 1) / samples, least);
  const double entries = 2 * sampling.per_set * primitives;  // of a set
  // As many as a single set of all of a pixel's places would have are there in any case.
  const double allowed = std::max(std::min(most_entries_per_sample * samples, most_entries),
                                  2 * least_places * primitives);
  const int wanted = std::min(4 * samples, most_sets);
  const double sets = std::clamp(allowed / entries, 1.0, static_cast<double>(wanted));
  sampling.sets = static_cast<int>(std::bit_floor(static_cast<unsigned>(sets)));
  const int per_pixel = std::min(samples, sampling.sets);
  sampling.per_set = std::max(sampling.per_set, (least_places + per_pixel - 1) / per_pixel);
  return sampling;
}

/// So many for each pixel.
LightSampling shared_out(int places) {
  for (const int sets : numbers_shared_out)
    if (places >= least_per_set * sets)
      return {.sets = sets, .per_set = (places + sets - 1) / sets, .is_shared_out = true};
  return {.sets = 1, .per_set = places};
}

/// So many that a first picture, of a sixteenth of the pixels, takes half of the time.
int for_budget(double budget_ms, const Scene& scene) {
  double places = 0;  // of all lights together for each of a set's
  for (const Light& light : scene.lights)
    if (is_soft(light)) places += rays_of(light) == LightRays::parallel ? 2 : 1;
  const double pixels = static_cast<double>(scene.camera.width) * scene.camera.height / 16;
  const double affordable = budget_ms / 2 / (pixels * places * ray_ms);
  return static_cast<int>(
      std::clamp(affordable, static_cast<double>(least_in_budget), 2.0 * least_places));
}

}  // namespace

Choice<LightSampling> choose_light_sampling(const Scene& scene, const Features& features) {
  const RenderSettings& settings = scene.render;
  LightSampling sampling;
  if (features.soft_lights == 0) return {sampling, because("no light is larger than a point")};
  if (settings.target_rmse) {
    const double needed = std::ceil(error_of_one_place / *settings.target_rmse);
    const auto places = static_cast<int>(
        std::clamp(needed, static_cast<double>(least_places), static_cast<double>(most_places)));
    // A budget's passes are foreseen by what a sample of the last one took.
    sampling =
        settings.budget_ms ? LightSampling{.sets = 1, .per_set = places} : shared_out(places);
    const int taken = sampling.sets * sampling.per_set;
    const char* const shared = sampling.is_shared_out ? "; a pixel's samples share them out" : "";
    if (needed > most_places)
      return {sampling, because("the most that are taken of each soft light: what {} places leave "
                                "out may exceed the target, and is in no estimate{}",
                                taken, shared)};
    return {sampling,
            because("what {} places of each soft light leave out is less than the target{}", taken,
                    shared)};
  }
  if (settings.budget_ms) {
    sampling.per_set = for_budget(*settings.budget_ms, scene);
    return {sampling, because("{} to {} places, by what half of the budget allows", least_in_budget,
                              2 * least_places)};
  }
  // Where a light brings the ambient part, each sample has to find out whether it sees any of it.
  const bool is_seen_or_not = features.has_ambient && scene.shadows == Shadows::black;
  const int least_per_sample = is_seen_or_not ? least_places : least_per_set;
  const auto primitives = static_cast<double>(features.primitive_count() * features.soft_lights);
  sampling = for_samples(settings.samples.value_or(1), std::max(primitives, 1.0), least_per_sample);
  if (sampling.sets == 1)
    return {sampling, because("the same for all pixels: grids for more directions would take "
                              "longer to build than to look into")};
  return {sampling, because("in {} sets, of which neighbouring pixels and samples use different "
                            "ones: grain in place of bands",
                            sampling.sets)};
}

std::size_t shared_directions(const LightSampling& sampling, const Features& features) {
  return features.shared_lights * 2 * static_cast<std::size_t>(sampling.sets * sampling.per_set);
}

SoftLightSearch choose_soft_light_search(const RenderSettings& settings, const Features& features,
                                         const LightSampling& sampling) {
  if (features.shared_lights == 0) return {};
  const bool is_one_pass = !settings.target_rmse && !settings.budget_ms;
  return {shared_directions(sampling, features),
          is_one_pass && !features.transmits && settings.samples.value_or(1) <= most_swept_samples};
}

int light_samples_per_pixel(const LightSampling& sampling, int samples) {
  return sampling.per_set *
         (sampling.is_shared_out ? sampling.sets : std::min(samples, sampling.sets));
}

std::size_t light_rays_per_sample(const Scene& scene) {
  std::size_t rays = 0;
  for (const Light& light : scene.lights) rays += is_soft(light) ? least_places : 1;
  return rays;
}

}  // namespace raytracer
