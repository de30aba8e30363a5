#include "engine/tradeoff/reference.h"

#include <cmath>
#include <utility>

#include "engine/tradeoff/difference.h"

namespace raytracer {
namespace {

constexpr int growth = 4;
constexpr double share_of_allowance = 0.5;

/// How many images will probably follow the one after an image of this error, if each is off by
/// samples^-3/4.
int expected_to_follow(double error, double wanted_error) {
  const double fall = std::pow(growth, 0.75);
  int count = 0;
  for (double next = error / fall; next > wanted_error; next /= fall) ++count;
  return count;
}

/// The first one's part of the time of that many images more, each `growth` times as long.
double share_of_first(int following) {
  return (growth - 1) / (std::pow(growth, following + 1) - 1);
}

}  // namespace

std::optional<Reference> render_reference(Trials& trials, double wanted_error,
                                          double progress_end) {
  CurveSettings settings;
  settings.samples = least_reference_samples / growth;
  settings.precision = Precision::double_precision;
  double begin = 0;
  const auto render_next = [&](int following) {
    const double end = begin + (progress_end - begin) * share_of_first(following);
    trials.progress().begin_step(begin, end);
    begin = end;
    return trials.render(settings, *settings.samples);
  };
  const auto may_go_on_to = [&](double samples, double ms) {
    return samples <= static_cast<double>(trials.limits().samples) &&
           trials.affords(settings, samples, ms, share_of_allowance);
  };

  constexpr int usual_count = 4;
  std::optional<Trial> earlier = render_next(usual_count);
  if (!earlier) return {};
  for (int following = usual_count - 1;;) {
    *settings.samples *= growth;
    std::optional<Trial> later = render_next(following);
    if (!later) return {};
    Rendering& rendering = later->rendering;
    const double apart = difference(rendering.image, earlier->rendering.image).rmse;
    const double error = apart / (std::sqrt(growth) - 1);
    const double next = static_cast<double>(*settings.samples) * growth;
    const double next_ms = later->call_ms * growth;
    if (error <= wanted_error || !may_go_on_to(next, next_ms))
      return Reference{std::move(rendering.image), {settings, error, rendering.trace_ms}};
    const bool is_last = !may_go_on_to(growth * next, growth * next_ms);
    following = is_last ? 0 : expected_to_follow(error, wanted_error);
    earlier = std::move(later);
  }
}

}  // namespace raytracer
