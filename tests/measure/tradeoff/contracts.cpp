#include "tests/measure/tradeoff/contracts.h"

#include <array>
#include <utility>

#include "engine/tradeoff/difference.h"
#include "tests/measure/tradeoff/exact_picture.h"

namespace raytracer::published {
namespace {

struct Size {
  int width_px;
  int height_px;
};
constexpr std::array sizes{Size{175, 125}, Size{88, 63}, Size{44, 31}};

/// From a first picture of a few samples.
double predicted_seconds(const Scene& scene, int samples, WorkerPool& pool) {
  constexpr int few = 12;
  constexpr double with_earlier = 4.0 / 3;  // pictures of a fourth of the samples, and so on
  Overrides overrides;
  overrides.samples = few;
  overrides.precision = Precision::double_precision;
  return render_with(scene, overrides, pool).trace_ms / 1000 * with_earlier * samples / few;
}

struct Subject {
  Scene scene;
  ExactPicture exact;
};

/// The first size with a picture that is exact enough, and done in time: a smaller one has four
/// times the samples for the same time.
std::optional<Subject> choose_subject(const std::string& document, double wanted_error, int samples,
                                      double most_seconds, WorkerPool& pool) {
  std::optional<Subject> best;
  for (const Size size : sizes) {
    Overrides overrides;
    overrides.width = size.width_px;
    overrides.height = size.height_px;
    Scene scene = measure::read_document(document, overrides);
    if (predicted_seconds(scene, samples, pool) > most_seconds) continue;
    ExactPicture exact = render_exactly(scene, samples, pool);
    if (!best || exact.estimated_error < best->exact.estimated_error)
      best = Subject{std::move(scene), std::move(exact)};
    if (best->exact.estimated_error <= wanted_error) break;
    samples *= 4;
  }
  return best;
}

}  // namespace

std::optional<ContractFigures> measure_contracts(const measure::NamedScene& measured,
                                                 const std::vector<double>& targets,
                                                 int exact_samples, double most_seconds,
                                                 WorkerPool& pool) {
  const double wanted_error = targets.back() / 4;
  const std::optional<Subject> subject =
      choose_subject(measured.document(), wanted_error, exact_samples, most_seconds, pool);
  if (!subject) return {};
  const auto& [scene, exact] = *subject;
  ContractFigures figures{.scene = measured.name,
                          .width_px = scene.camera.width,
                          .height_px = scene.camera.height,
                          .exact_samples = exact.samples,
                          .exact_error = exact.estimated_error};
  for (const double target : targets) {
    Overrides overrides;
    overrides.target_rmse = target;
    const Rendering rendering = render_with(scene, overrides, pool);
    figures.targets.push_back({.target = target,
                               .rmse = difference(rendering.image, exact.image).rmse,
                               .estimated_error = rendering.estimated_error,
                               .samples_per_pixel = rendering.samples_per_pixel,
                               .stop = rendering.stop,
                               .trace_ms = rendering.trace_ms});
  }
  return figures;
}

}  // namespace raytracer::published
