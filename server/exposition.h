// Prometheus' text format, version 0.0.4: families of samples, each with its HELP and TYPE.
// https://prometheus.io/docs/instrumenting/exposition_formats/
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace raytracer {

/// How often values fell up to each bound, and their sum.
struct Histogram {
  /// `upper_bounds` ascend and outlive the histogram.
  explicit Histogram(std::span<const double> upper_bounds)
      : bounds(upper_bounds), counts(upper_bounds.size() + 1) {}

  void observe(double value);

  std::span<const double> bounds;
  std::vector<std::uint64_t> counts;  ///< of each bound alone; the last of what is beyond all
  double sum = 0;
};

class Exposition {
 public:
  using Label = std::pair<std::string_view, std::string_view>;
  using Labels = std::initializer_list<Label>;

  /// Begins a family; samples belong to the last one begun. `type` is counter, gauge or histogram.
  void family(std::string_view name, std::string_view type, std::string_view help);

  /// A family of one sample.
  void family(std::string_view name, std::string_view type, std::string_view help, double value);

  void sample(double value, Labels labels = {});
  void sample(const Histogram& histogram, Labels labels = {});

  const std::string& text() const { return text_; }

 private:
  void line(std::string_view suffix, std::span<const Label> labels, std::string_view value);

  std::string name_;
  std::string text_;
};

}  // namespace raytracer
