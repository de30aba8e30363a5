#include "engine/tradeoff/measure_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "engine/tradeoff/reference.h"
#include "engine/tradeoff/trials.h"

namespace raytracer {
namespace {

// Chosen: about three to a power of ten, where pictures look different.
constexpr std::array targets{0.03, 0.01, 0.003, 0.001, 0.0005};

// Chosen: a factor of four in time is a distance that one sees on the curve.
constexpr int growth = 4;                            // of the samples from point to point
constexpr int reference_lead = 8;                    // times the samples of any point, at least
constexpr int most_samples_of_another_picture = 16;  // more do not bring back what is left out

// Chosen.
constexpr double share_of_first_pictures = 0.85;  // of the allowance; then they are repeated
constexpr std::size_t most_repetitions = 5;
constexpr double short_ms = 100;  // of a picture that is repeated

// Of the progress: by the reference, and by the first picture of each point. Chosen.
constexpr double reference_progress = 0.5;
constexpr double first_progress = 0.8;

// Of the reference, as it is estimated: it is usually a third of that, well below any target.
constexpr double wanted_reference_error = 0.0003;

CurveSettings with_samples(int samples) {
  CurveSettings settings;
  settings.samples = samples;
  return settings;
}

CurveSettings with_target(double rmse) {
  CurveSettings settings;
  settings.target_rmse = rmse;
  return settings;
}

bool has_shadows(const Scene& scene) {
  return scene.shadows != Shadows::off && !scene.lights.empty();
}

bool has_reflections(const Scene& scene) {
  return scene.render.max_depth > 0 &&
         std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const Material& material) { return material.reflectivity > 0; });
}

/// Every setting that this reference can judge.
std::vector<CurveSettings> settings_to_measure(const Scene& scene,
                                               const CurveReference& reference) {
  std::vector<CurveSettings> all;
  const int most_samples = *reference.settings.samples / reference_lead;
  for (int samples = 1; samples <= most_samples; samples *= growth)
    for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
      all.push_back(with_samples(samples));
      all.back().precision = precision;
    }
  for (int samples = 1; samples <= std::min(most_samples, most_samples_of_another_picture);
       samples *= growth) {
    if (has_shadows(scene)) {
      all.push_back(with_samples(samples));
      all.back().without_shadows = true;
    }
    if (has_reflections(scene)) {
      all.push_back(with_samples(samples));
      all.back().without_reflections = true;
    }
  }
  // Last, because nobody knows how long they take.
  for (const double target : targets)
    if (target >= reference.estimated_error) all.push_back(with_target(target));
  return all;
}

/// A point while it is measured.
struct Measurement {
  CurvePoint point;
  double call_ms = 0;  ///< of its first picture, plan and structures included
  std::vector<double> times_ms{};
};

bool are_of_a_kind(const CurveSettings& a, const CurveSettings& b) {
  return a.target_rmse.has_value() == b.target_rmse.has_value() && a.precision == b.precision &&
         a.without_shadows == b.without_shadows && a.without_reflections == b.without_reflections;
}

/// Of one picture against another, for the progress: single precision is about twice as fast, and
/// errors begin about here and fall as samples^-3/4.
double expected_work(const CurveSettings& settings) {
  constexpr double first_error = 0.05;
  const double samples =
      settings.samples ? *settings.samples : std::pow(first_error / *settings.target_rmse, 4.0 / 3);
  return settings.precision == Precision::double_precision ? 2 * samples : samples;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The measurements of one curve.
class Series {
 public:
  Series(Trials& trials, const Reference& reference) : trials_(trials), reference_(reference) {}

  /// One picture of each setting that the allowance has room for. False if it was stopped.
  bool measure_each(const std::vector<CurveSettings>& all) {
    double begin = reference_progress;
    double work = 0;
    for (const CurveSettings& settings : all) work += expected_work(settings);
    for (const CurveSettings& settings : all) {
      const double step = (first_progress - reference_progress) * expected_work(settings) / work;
      const double end = std::min(begin + step, first_progress);  // the sum's rounding may be above
      trials_.progress().begin_step(begin, end);
      begin = end;
      if (!is_worth_it(settings)) continue;
      std::optional<Trial> trial =
          trials_.render(settings, most_samples(), share_of_first_pictures);
      if (!trial) return false;
      const Rendering& rendering = trial->rendering;
      if (settings.target_rmse && rendering.stop != Stop::target) break;  // nor are smaller ones
      CurvePoint point;
      point.settings = settings;
      point.error = difference(rendering.image, reference_.image);
      point.samples_per_pixel = rendering.samples_per_pixel;
      point.estimated_error = rendering.estimated_error;
      measured_.push_back({point, trial->call_ms, {rendering.trace_ms}});
    }
    return true;
  }

  /// The short ones again, in turn, so that a busy moment does not meet all of one's repetitions.
  /// False if it was stopped.
  bool repeat_short() {
    const double step = (1 - first_progress) / (most_repetitions - 1);
    for (std::size_t round = 1; round < most_repetitions; ++round) {
      const double begin = first_progress + step * static_cast<double>(round - 1);
      trials_.progress().begin_step(begin, begin);
      for (Measurement& measurement : measured_) {
        const CurvePoint& point = measurement.point;
        if (measurement.call_ms > short_ms ||
            !trials_.affords(point.settings, point.samples_per_pixel, measurement.call_ms, 1))
          continue;
        const std::optional<Trial> trial = trials_.render(point.settings, most_samples(), 1);
        if (!trial) return false;
        measurement.times_ms.push_back(trial->rendering.trace_ms);
      }
    }
    return true;
  }

  std::vector<CurvePoint> points() && {
    std::vector<CurvePoint> points;
    for (Measurement& measurement : measured_) {
      if (!is_told_apart(measurement.point)) continue;
      measurement.point.repetitions = measurement.times_ms.size();
      measurement.point.trace_ms = median(std::move(measurement.times_ms));
      points.push_back(measurement.point);
    }
    mark_pareto(points);
    return points;
  }

 private:
  /// Whether its error is its own, not the reference's: on a busy machine that ends early.
  bool is_told_apart(const CurvePoint& point) const {
    constexpr double margin = 2;
    return point.settings.samples.value_or(1) == 1 ||
           point.error.rmse > margin * reference_.description.estimated_error;
  }

  /// For a target: beyond the reference's samples little can be told.
  int most_samples() const { return *reference_.description.settings.samples / 3 * growth; }

  /// Whether it can tell more than its cheaper neighbour did, and will probably be done in time.
  bool is_worth_it(const CurveSettings& settings) const {
    const Measurement* before = nullptr;
    for (const Measurement& measurement : measured_)
      if (are_of_a_kind(measurement.point.settings, settings)) before = &measurement;
    if (!before) return trials_.affords(settings, growth, 0, share_of_first_pictures);
    const CurvePoint& point = before->point;
    if (settings.samples && point.error.rmse <= reference_.description.estimated_error)
      return false;
    return trials_.affords(settings, growth * point.samples_per_pixel, growth * before->call_ms,
                           share_of_first_pictures);
  }

  Trials& trials_;
  const Reference& reference_;
  std::vector<Measurement> measured_{};
};

}  // namespace

std::optional<Curve> measure_curve(const Scene& scene, const Limits& limits, double most_ms,
                                   WorkerPool& pool, CurveProgress& progress) {
  Trials trials(scene, limits, most_ms, pool, progress);
  const std::optional<Reference> reference =
      render_reference(trials, wanted_reference_error, reference_progress);
  if (!reference) return {};
  Series series(trials, *reference);
  if (!series.measure_each(settings_to_measure(scene, reference->description)) ||
      !series.repeat_short())
    return {};
  progress.begin_step(1, 1);
  return Curve{scene.camera.width, scene.camera.height, pool.thread_count(), reference->description,
               std::move(series).points()};
}

}  // namespace raytracer
