#include "server/metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace raytracer {
namespace {

/// name="value", separated by commas, as it stands between braces.
std::string label_text(const MetricFamily& family, std::span<const std::string> values) {
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) text += ',';
    text.append(family.labels[i]).append("=\"");
    for (const char c : values[i]) {
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

}  // namespace

/// What is known to come is shown from the start, as 0.
Metrics::Metrics() {
  for (std::size_t row = 0; row < metric_table.size(); ++row)
    if (metric_table[row].labels[0].empty() && type_of(metric_table[row]) != "gauge")
      series(row, {});
  for (const std::string_view status : {"413", "429", "503"})
    add("http_requests_refused_total", 0, {status});
  for (const std::string_view stage : {"parse", "plan", "build", "trace", "encode"})
    add("stage_duration_seconds", 0, {stage});
}

Metrics::Series& Metrics::series(std::size_t row, LabelValues values) {
  Series& series = series_[row][{values.begin(), values.end()}];
  series.buckets.resize(metric_table[row].bounds.size() + 1);
  return series;
}

void Metrics::add(MetricName name, double amount, LabelValues values) {
  const std::scoped_lock lock(mutex_);
  series(name.row(), values).value += amount;
}

void Metrics::set(MetricName name, double value, LabelValues values) {
  const std::scoped_lock lock(mutex_);
  series(name.row(), values).value = value;
}

void Metrics::observe(MetricName name, double value, LabelValues values) {
  const std::span<const double> bounds = metric_table[name.row()].bounds;
  const auto bucket = std::lower_bound(bounds.begin(), bounds.end(), value) - bounds.begin();
  const std::scoped_lock lock(mutex_);
  Series& observed = series(name.row(), values);
  ++observed.buckets[static_cast<std::size_t>(bucket)];
  observed.value += value;
}

void Metrics::took(std::string_view stage, double ms) {
  observe("stage_duration_seconds", ms / 1000, {stage});
}

void Metrics::rendered(const RenderReport& report, const std::optional<std::string>& digest) {
  took("plan", report.plan_ms);
  took("build", report.build_ms);
  took("trace", report.trace_ms);
  const auto pixels = static_cast<double>(report.pixel_count);
  add("renders_total");
  add("pixels_rendered_total", pixels);
  add("samples_rendered_total", pixels * report.samples_per_pixel);
  add("pixels_clamped_total", static_cast<double>(report.beyond.clamped));
  add("pixels_nan_total", static_cast<double>(report.beyond.not_numbers));
  const auto predicted_ms = digest ? predicted_ms_.find(*digest) : nullptr;
  if (!predicted_ms || *predicted_ms <= 0) return;
  observe("trace_actual_to_predicted_ratio", report.trace_ms / *predicted_ms);
  add("trace_predicted_seconds_total", *predicted_ms / 1000);
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
    for (const auto& [values, series] : series_[row]) {
      const std::string labels = label_text(family, values);
      if (family.bounds.empty())
        append_sample(text, family, "", labels, series.value);
      else
        append_histogram(text, family, labels, series.buckets, series.value);
    }
  }
  return text;
}

}  // namespace raytracer
