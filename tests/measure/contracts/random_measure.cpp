#include "tests/measure/contracts/random_measure.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "engine/plan/light_sampling.h"
#include "engine/tradeoff/difference.h"
#include "tests/measure/contracts/random_scene.h"
#include "tests/measure/scenes/named_scene.h"

namespace raytracer::published {
namespace {

constexpr double share_of_target = 1.0 / 6;  // adds 1.4 % to the rms of an error of the target
constexpr double share_to_know = 1.0 / 3;    // adds 5.4 %

struct ExactPicture {
  Image image;
  int samples;
  double error;
};

Image render_many(const Scene& scene, int samples, WorkerPool& pool) {
  Overrides overrides;
  overrides.samples = samples;
  overrides.precision = Precision::double_precision;
  Limits limits;
  limits.samples = samples;
  limits.work = std::numeric_limits<std::int64_t>::max();
  RenderProgress progress;
  return render(with_overrides(scene, overrides), limits, pool, progress).image;
}

/// About, from the eye and from there to the lights, of points that are in the dark, and the same
/// behind mirrors and in glass.
double rays_of_picture(const Scene& scene, int samples) {
  constexpr double by_glass = 8;  // where there may be mirrors, too
  constexpr double by_mirrors = 2;
  Overrides overrides;
  overrides.samples = samples;
  const Scene many = with_overrides(scene, overrides);
  const Features features = find_features(many);
  const LightSampling places = choose_light_sampling(many, features, samples).value;
  const int of_soft = places.per_set * places.sets_to_be_sure + places.on_rim;
  double rays = 1;
  for (const Light& light : many.lights) rays += is_soft(light) ? of_soft : 1;
  const double followed = features.transmits ? by_glass : features.reflects ? by_mirrors : 1;
  return scene.camera.pixel_count() * samples * rays * followed;
}

/// Errors fall at least as the root of the number of samples: the picture before has twice the
/// error, and lies at least twice the later one's error from it.
ExactPicture render_exactly(const Scene& scene, double wanted_error, double most_rays,
                            WorkerPool& pool) {
  // Multiples of five, which no contract has: else samples coincide.
  constexpr int few = 60;
  constexpr int usual = 240;
  const int first = rays_of_picture(scene, usual) > most_rays ? few : usual;
  Image earlier = render_many(scene, first / 4, pool);
  for (int samples = first;; samples *= 4) {
    Image image = render_many(scene, samples, pool);
    const double error = difference(image, earlier).rmse / 2;
    if (error <= wanted_error || rays_of_picture(scene, 4 * samples) > most_rays)
      return {std::move(image), samples, error};
    earlier = std::move(image);
  }
}

}  // namespace

MeasuredScene measure_random_scene(std::uint64_t seed, const std::vector<double>& targets,
                                   double most_rays, WorkerPool& pool) {
  const RandomScene random = random_scene(seed);
  const Scene scene = measure::read_document(random.document, {});
  const double wanted_error = share_of_target * *std::min_element(targets.begin(), targets.end());
  const ExactPicture exact = render_exactly(scene, wanted_error, most_rays, pool);
  MeasuredScene measured{.seed = seed,
                         .summary = random.summary,
                         .exact_samples = exact.samples,
                         .exact_error = exact.error};
  for (const double target : targets) {
    if (exact.error > share_to_know * target) {
      measured.targets.push_back({.target = target, .is_known = false});
      continue;
    }
    Overrides overrides;
    overrides.target_rmse = target;
    RenderProgress progress;
    const Rendering rendering = render(with_overrides(scene, overrides), Limits{}, pool, progress);
    measured.targets.push_back({.target = target,
                                .rmse = difference(rendering.image, exact.image).rmse,
                                .estimated_error = rendering.estimated_error,
                                .samples_per_pixel = rendering.samples_per_pixel,
                                .stop = rendering.stop});
  }
  return measured;
}

}  // namespace raytracer::published
