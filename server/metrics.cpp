#include "server/metrics.h"

namespace raytracer {
namespace {

constexpr std::array<double, 16> seconds{0.0001, 0.0003, 0.001, 0.003, 0.01, 0.03, 0.1,  0.3,
                                         1,      3,      10,    30,    100,  300,  1000, 3000};
constexpr std::array<double, 12> ratios{0.25, 0.5, 0.7, 0.8, 0.9, 1, 1.1, 1.25, 1.5, 2, 4, 10};

constexpr std::array<std::string_view, 5> stage_names{"parse", "plan", "build", "trace", "encode"};
constexpr std::array<int, 3> refusals{413, 429, 503};

}  // namespace

Metrics::Metrics()
    : queue_seconds_(seconds),
      stage_seconds_(stage_names.size(), Histogram(seconds)),
      actual_to_predicted_(ratios) {
  for (const int status : refusals) refused_[status] = 0;
}

void Metrics::answered(std::string_view method, std::string_view route, int status, double took_s) {
  const std::scoped_lock lock(mutex_);
  const RouteKey key(method, route);
  ++requests_[{key, status}];
  request_seconds_.try_emplace(key, seconds).first->second.observe(took_s);
}

void Metrics::refused(int status) {
  const std::scoped_lock lock(mutex_);
  const auto count = refused_.find(status);
  if (count != refused_.end()) ++count->second;
}

void Metrics::waited(double queue_ms) {
  const std::scoped_lock lock(mutex_);
  queue_seconds_.observe(queue_ms / 1000);
}

void Metrics::took(Stage stage, double ms) {
  const std::scoped_lock lock(mutex_);
  observe(stage, ms);
}

void Metrics::observe(Stage stage, double ms) {
  stage_seconds_[static_cast<std::size_t>(stage)].observe(ms / 1000);
}

void Metrics::rendered(const RenderReport& report, const std::optional<std::string>& digest) {
  const std::scoped_lock lock(mutex_);
  observe(Stage::plan, report.plan_ms);
  observe(Stage::build, report.build_ms);
  observe(Stage::trace, report.trace_ms);
  ++renders_;
  const auto pixels = static_cast<double>(report.pixel_count);
  pixels_ += pixels;
  samples_ += pixels * report.samples_per_pixel;
  clamped_pixels_ += static_cast<double>(report.beyond.clamped);
  nan_pixels_ += static_cast<double>(report.beyond.not_numbers);
  const auto foreseen_ms = digest ? predicted_ms_.find(*digest) : nullptr;
  if (!foreseen_ms || *foreseen_ms <= 0) return;
  actual_to_predicted_.observe(report.trace_ms / *foreseen_ms);
  predicted_s_ += *foreseen_ms / 1000;
  actual_s_ += report.trace_ms / 1000;
}

void Metrics::cancelled() {
  const std::scoped_lock lock(mutex_);
  ++cancelled_;
}

void Metrics::predicted(const std::optional<std::string>& digest, const Prediction& prediction) {
  if (!digest) return;
  predicted_ms_.keep(*digest, std::make_shared<const double>(prediction.trace_ms), 1);
}

void Metrics::write(Exposition& out) const {
  const std::scoped_lock lock(mutex_);
  out.family("raytracer_http_requests_total", "counter", "Requests answered, by route and status.");
  for (const auto& [key, count] : requests_) {
    const auto& [route, status] = key;
    const std::string status_text = std::to_string(status);
    out.sample(static_cast<double>(count),
               {{"method", route.first}, {"route", route.second}, {"status", status_text}});
  }
  out.family("raytracer_http_request_duration_seconds", "histogram",
             "From a request's header to the end of its answer, by route.");
  for (const auto& [route, histogram] : request_seconds_)
    out.sample(histogram, {{"method", route.first}, {"route", route.second}});
  out.family("raytracer_http_requests_refused_total", "counter",
             "Requests refused: over a limit (413), no room (429), shutting down (503).");
  for (const auto& [status, count] : refused_)
    out.sample(static_cast<double>(count), {{"status", std::to_string(status)}});

  out.family("raytracer_queue_duration_seconds", "histogram",
             "What renders and plans waited in the queue.");
  out.sample(queue_seconds_);
  out.family("raytracer_stage_duration_seconds", "histogram", "The stages of renders.");
  for (std::size_t i = 0; i < stage_names.size(); ++i)
    out.sample(stage_seconds_[i], {{"stage", stage_names[i]}});
  out.family("raytracer_renders_total", "counter", "Renders done.", static_cast<double>(renders_));
  out.family("raytracer_renders_cancelled_total", "counter",
             "Renders stopped because their client left, their job was deleted, or the server "
             "ended.",
             static_cast<double>(cancelled_));
  out.family("raytracer_pixels_rendered_total", "counter", "Pixels of the renders done.", pixels_);
  out.family("raytracer_samples_rendered_total", "counter",
             "Samples in the images of the renders done.", samples_);
  out.family("raytracer_pixels_clamped_total", "counter",
             "Pixels of the renders done with a sample brighter than 1, which is cut off.",
             clamped_pixels_);
  out.family("raytracer_pixels_nan_total", "counter",
             "Pixels of the renders done with a sample that was no number: 0, or a fault here.",
             nan_pixels_);

  out.family("raytracer_trace_actual_to_predicted_ratio", "histogram",
             "Trace time over the time predicted, of renders whose plan was asked for before.");
  out.sample(actual_to_predicted_);
  out.family("raytracer_trace_predicted_seconds_total", "counter",
             "Trace time predicted, of renders whose plan was asked for before.", predicted_s_);
  out.family("raytracer_trace_actual_seconds_total", "counter",
             "Trace time taken by the renders whose plan was asked for before.", actual_s_);
}

}  // namespace raytracer
