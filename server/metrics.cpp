#include "server/metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace raytracer {
namespace {

/// name="value", separated by commas, as it stands between braces.
std::string text_of(Metrics::Labels labels) {
  std::string text;
  for (const auto& [name, value] : labels) {
    if (!text.empty()) text += ',';
    text.append(name).append("=\"");
    for (const char c : value) {
      if (c == '\\' || c == '"') text += '\\';
      if (c == '\n')
        text += "\\n";
      else
        text += c;
    }
    text += '"';
  }
  return text;
}

std::string_view type_of(const MetricFamily& family) {
  if (!family.bounds.empty()) return "histogram";
  return family.name.ends_with("_total") ? "counter" : "gauge";
}

void append_sample(std::string& text, const MetricFamily& family, std::string_view suffix,
                   std::string_view labels, double value) {
  const std::string braced = labels.empty() ? "" : fmt::format("{{{}}}", labels);
  fmt::format_to(std::back_inserter(text), "raytracer_{}{}{} {}\n", family.name, suffix, braced,
                 value);
}

void append_histogram(std::string& text, const MetricFamily& family, const std::string& labels,
                      std::span<const std::uint64_t> buckets, double sum) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < buckets.size(); ++i) {
    count += buckets[i];
    const std::string bound =
        i < family.bounds.size() ? fmt::format("{}", family.bounds[i]) : "+Inf";
    append_sample(text, family, "_bucket",
                  fmt::format("{}{}le=\"{}\"", labels, labels.empty() ? "" : ",", bound),
                  static_cast<double>(count));
  }
  append_sample(text, family, "_sum", labels, sum);
  append_sample(text, family, "_count", labels, static_cast<double>(count));
}

constexpr std::array<std::string_view, 5> stage_names{"parse", "plan", "build", "trace", "encode"};

}  // namespace

/// What is known to come is shown from the start, as 0.
Metrics::Metrics() {
  for (const MetricName name : std::initializer_list<MetricName>{
           "renders_total", "renders_cancelled_total", "renders_shared_total",
           "pixels_rendered_total", "samples_rendered_total", "pixels_clamped_total",
           "pixels_nan_total", "queue_duration_seconds", "trace_actual_to_predicted_ratio",
           "trace_predicted_seconds_total", "trace_actual_seconds_total"})
    add(name, 0);
  for (const std::string_view status : {"413", "429", "503"})
    add("http_requests_refused_total", 0, {{"status", status}});
  for (const std::string_view stage : stage_names)
    add("stage_duration_seconds", 0, {{"stage", stage}});
}

Metrics::Series& Metrics::series(MetricName name, Labels labels) {
  Series& series = series_[name.row()][text_of(labels)];
  series.buckets.resize(metric_table[name.row()].bounds.size() + 1);
  return series;
}

void Metrics::add(MetricName name, double amount, Labels labels) {
  const std::scoped_lock lock(mutex_);
  series(name, labels).value += amount;
}

void Metrics::set(MetricName name, double value, Labels labels) {
  const std::scoped_lock lock(mutex_);
  series(name, labels).value = value;
}

void Metrics::observe(MetricName name, double value, Labels labels) {
  const std::span<const double> bounds = metric_table[name.row()].bounds;
  const auto bucket = std::lower_bound(bounds.begin(), bounds.end(), value) - bounds.begin();
  const std::scoped_lock lock(mutex_);
  Series& observed = series(name, labels);
  ++observed.buckets[static_cast<std::size_t>(bucket)];
  observed.value += value;
}

void Metrics::took(Stage stage, double ms) {
  observe("stage_duration_seconds", ms / 1000,
          {{"stage", stage_names[static_cast<std::size_t>(stage)]}});
}

void Metrics::rendered(const RenderReport& report, const std::optional<std::string>& digest) {
  took(Stage::plan, report.plan_ms);
  took(Stage::build, report.build_ms);
  took(Stage::trace, report.trace_ms);
  const auto pixels = static_cast<double>(report.pixel_count);
  add("renders_total");
  add("pixels_rendered_total", pixels);
  add("samples_rendered_total", pixels * report.samples_per_pixel);
  add("pixels_clamped_total", static_cast<double>(report.beyond.clamped));
  add("pixels_nan_total", static_cast<double>(report.beyond.not_numbers));
  const auto foreseen_ms = digest ? predicted_ms_.find(*digest) : nullptr;
  if (!foreseen_ms || *foreseen_ms <= 0) return;
  observe("trace_actual_to_predicted_ratio", report.trace_ms / *foreseen_ms);
  add("trace_predicted_seconds_total", *foreseen_ms / 1000);
  add("trace_actual_seconds_total", report.trace_ms / 1000);
}

void Metrics::predicted(const std::optional<std::string>& digest, const Prediction& prediction) {
  if (digest) predicted_ms_.keep(*digest, std::make_shared<const double>(prediction.trace_ms), 1);
}

std::string Metrics::text() const {
  const std::scoped_lock lock(mutex_);
  std::string text;
  for (std::size_t row = 0; row < metric_table.size(); ++row) {
    const MetricFamily& family = metric_table[row];
    if (series_[row].empty()) continue;
    fmt::format_to(std::back_inserter(text), "# HELP raytracer_{0} {1}\n# TYPE raytracer_{0} {2}\n",
                   family.name, family.help, type_of(family));
    for (const auto& [labels, series] : series_[row])
      if (family.bounds.empty())
        append_sample(text, family, "", labels, series.value);
      else
        append_histogram(text, family, labels, series.buckets, series.value);
  }
  return text;
}

}  // namespace raytracer
