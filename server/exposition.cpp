#include "server/exposition.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace raytracer {
namespace {

/// A label's value between its quotes.
std::string escaped(std::string_view value) {
  std::string result;
  for (const char c : value) {
    if (c == '\\' || c == '"') result += '\\';
    if (c == '\n')
      result += "\\n";
    else
      result += c;
  }
  return result;
}

}  // namespace

void Histogram::observe(double value) {
  const auto bound = std::lower_bound(bounds.begin(), bounds.end(), value);
  ++counts[static_cast<std::size_t>(bound - bounds.begin())];
  sum += value;
}

void Exposition::family(std::string_view name, std::string_view type, std::string_view help) {
  name_ = name;
  fmt::format_to(std::back_inserter(text_), "# HELP {0} {1}\n# TYPE {0} {2}\n", name, help, type);
}

void Exposition::family(std::string_view name, std::string_view type, std::string_view help,
                        double value) {
  family(name, type, help);
  sample(value);
}

void Exposition::sample(double value, Labels labels) {
  line("", {labels.begin(), labels.size()}, fmt::format("{}", value));
}

void Exposition::sample(const Histogram& histogram, Labels labels) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    count += histogram.counts[i];
    const std::string bound =
        i < histogram.bounds.size() ? fmt::format("{}", histogram.bounds[i]) : "+Inf";
    std::vector<Label> with_bound(labels);
    with_bound.emplace_back("le", bound);
    line("_bucket", with_bound, fmt::format("{}", count));
  }
  line("_sum", {labels.begin(), labels.size()}, fmt::format("{}", histogram.sum));
  line("_count", {labels.begin(), labels.size()}, fmt::format("{}", count));
}

void Exposition::line(std::string_view suffix, std::span<const Label> labels,
                      std::string_view value) {
  text_ += name_;
  text_ += suffix;
  char before = '{';
  for (const auto& [name, text] : labels) {
    fmt::format_to(std::back_inserter(text_), "{}{}=\"{}\"", before, name, escaped(text));
    before = ',';
  }
  if (!labels.empty()) text_ += '}';
  fmt::format_to(std::back_inserter(text_), " {}\n", value);
}

}  // namespace raytracer
