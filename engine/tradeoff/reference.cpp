#include "engine/tradeoff/reference.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/tradeoff/difference.h"

namespace raytracer {
namespace {

// Chosen.
constexpr int usual_growth = 4;
constexpr int usual_count = 4;  // of images after the first
constexpr double share_of_allowance = 0.6;

/// How many images will probably follow the one after an image of this error, if each is off by
/// samples^-3/4.
int expected_to_follow(double error, double wanted_error) {
  const double all = std::log(error / wanted_error) / std::log(std::pow(usual_growth, 0.75));
  return std::max(0, static_cast<int>(std::ceil(all)) - 1);
}

/// The first one's part of the time of that many images more, each `usual_growth` times as long.
double share_of_first(int following) {
  return (usual_growth - 1) / (std::pow(usual_growth, following + 1) - 1);
}

}  // namespace

std::optional<Reference> render_reference(Trials& trials, double wanted_error,
                                          double progress_end) {
  CurveSettings settings;
  settings.samples = least_reference_samples / usual_growth;
  settings.precision = Precision::double_precision;
  double begin = 0;
  const auto render_next = [&](int following) {
    const double end = begin + (progress_end - begin) * share_of_first(following);
    trials.progress().begin_step(begin, end);
    begin = end;
    return trials.render(settings, *settings.samples, share_of_allowance);
  };
  // The largest growth that is within the allowance; 1 for none.
  const auto growth_after = [&](double samples, double ms) {
    for (int growth = usual_growth; growth > 1; --growth)
      if (growth * samples <= static_cast<double>(trials.limits().samples) &&
          trials.affords(settings, growth * samples, growth * ms, share_of_allowance))
        return growth;
    return 1;
  };

  std::optional<Trial> earlier = render_next(usual_count);
  if (!earlier) return {};
  int growth = usual_growth;
  for (int following = usual_count - 1;;) {
    *settings.samples *= growth;
    std::optional<Trial> later = render_next(following);
    if (!later) return {};
    Rendering& rendering = later->rendering;
    const double apart = difference(rendering.image, earlier->rendering.image).rmse;
    const double error = apart / (std::sqrt(growth) - 1);
    const double samples = *settings.samples;
    growth = error > wanted_error ? growth_after(samples, later->call_ms) : 1;
    if (growth == 1)
      return Reference{std::move(rendering.image), {settings, error, rendering.trace_ms}};
    const bool is_last =
        growth < usual_growth || growth_after(growth * samples, growth * later->call_ms) == 1;
    following = is_last ? 0 : expected_to_follow(error, wanted_error);
    earlier = std::move(later);
  }
}

}  // namespace raytracer
