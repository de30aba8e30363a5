#include "client/log_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace raytracer::client {
namespace {

constexpr std::string_view own_style =
    R"(    svg { color-scheme: light dark; --page: #fff; --ink: #1b1d1e; --soft: #5c6265; --line: #dfe2e3 }
    @media (prefers-color-scheme: dark) { svg { --page: #111213; --ink: #e6e8e8; --soft: #a0a6a8;
      --line: #2e3133 } }
    text { font: 12px system-ui, sans-serif; fill: var(--ink) }
    .title { font-size: 16px; font-weight: 600 }
    .soft, .tick { fill: var(--soft) }
    .grid { stroke: var(--line) }
)";

}  // namespace

LogAxis::LogAxis(const std::vector<double>& values) {
  constexpr double room = 0.2;  // of a decade
  double least = 0;
  double most = 0;
  for (const double value : values) {
    if (!(value > 0)) continue;
    least = least > 0 ? std::min(least, value) : value;
    most = std::max(most, value);
  }
  if (!(most > 0)) least = most = 1;
  begin_ = std::log10(least) - room;
  end_ = std::log10(most) + room;
  if (end_ - begin_ < 1) {
    const double middle = (begin_ + end_) / 2;
    begin_ = middle - 0.5;
    end_ = middle + 0.5;
  }
}

double LogAxis::place(double value) const {
  if (!(value > 0)) return 0;
  return std::clamp((std::log10(value) - begin_) / (end_ - begin_), 0.0, 1.0);
}

std::vector<double> LogAxis::ticks() const {
  const auto within = [&](const std::vector<double>& steps) {
    std::vector<double> ticks;
    for (int decade = static_cast<int>(std::floor(begin_)); decade <= end_; ++decade)
      for (const double step : steps) {
        const double tick = step * std::pow(10, decade);
        if (std::log10(tick) >= begin_ && std::log10(tick) <= end_) ticks.push_back(tick);
      }
    return ticks;
  };
  const std::vector<double> decades = within({1});
  return decades.size() >= 3 ? decades : within({1, 2, 5});
}

LogPlot::LogPlot(const std::vector<double>& times_ms, const std::vector<double>& errors)
    : across_(times_ms), up_(errors) {}

std::string LogPlot::document(std::string_view title, std::string_view subtitle,
                              std::string_view style, std::string_view content) const {
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\" role=\"img\">\n",
      width, height);
  text += "  <title>" + svg_escaped(title) + "</title>\n  <style>\n";
  text.append(own_style).append(style);
  text += "  </style>\n  <rect width=\"100%\" height=\"100%\" fill=\"var(--page)\"/>\n";
  text += svg_text(left, 30, "class=\"title\"", title);
  text += svg_text(left, 52, "class=\"soft\"", subtitle);
  text += axes();
  return text.append(content) + "</svg>\n";
}

std::string LogPlot::axes() const {
  std::string text;
  for (const double tick : across_.ticks()) {
    text += fmt::format("  <path class=\"grid\" d=\"M{:.1f} {}V{}\"/>\n", x(tick), top, bottom);
    text += svg_text(x(tick), bottom + 18, "class=\"tick\" text-anchor=\"middle\"",
                     fmt::format("{:g}", tick));
  }
  for (const double tick : up_.ticks()) {
    text += fmt::format("  <path class=\"grid\" d=\"M{} {:.1f}H{}\"/>\n", left, y(tick), right);
    text += svg_text(left - 8, y(tick) + 4, "class=\"tick\" text-anchor=\"end\"",
                     fmt::format("{:g}", tick));
  }
  text += svg_text((left + right) / 2, bottom + 42, "text-anchor=\"middle\"",
                   "time to trace, milliseconds");
  constexpr double middle = (top + bottom) / 2;
  return text +
         svg_text(20, middle,
                  fmt::format("text-anchor=\"middle\" transform=\"rotate(-90 20 {})\"", middle),
                  "error, root mean square");
}

std::string svg_escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (static_cast<unsigned char>(c) >= ' ')
      result += c;  // XML has no place for control characters
  }
  return result;
}

std::string svg_text(double x, double y, std::string_view attributes, std::string_view text) {
  return fmt::format("  <text x=\"{:.1f}\" y=\"{:.1f}\"{}{}>{}</text>\n", x, y,
                     attributes.empty() ? "" : " ", attributes, svg_escaped(text));
}

}  // namespace raytracer::client
