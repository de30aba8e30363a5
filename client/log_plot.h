// A drawing of errors against times, both logarithmic: its page, axes and words; what is drawn on
// it is its user's.
//
// Self-contained: no script, no font and no picture from elsewhere. Its colours follow the
// reader's choice of light or dark, with --page, --ink, --soft and --line for what is drawn.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace raytracer::client {

/// An axis on which equal ratios are equally long.
class LogAxis {
 public:
  /// Spans the positive ones of `values` with some room at both ends; one decade for none.
  explicit LogAxis(const std::vector<double>& values);

  /// From 0, the least, to 1. What is not positive stands at 0.
  double place(double value) const;

  /// Powers of ten that the axis spans; if those are fewer than three, also twos and fives.
  std::vector<double> ticks() const;

 private:
  double begin_;  ///< decimal logarithms
  double end_;
};

class LogPlot {
 public:
  // The area of the points and the whole, in the drawing's own units; y downwards.
  static constexpr double width = 860;
  static constexpr double height = 520;
  static constexpr double left = 78;
  static constexpr double right = 620;
  static constexpr double top = 76;
  static constexpr double bottom = 456;

  /// Spans what is to be drawn.
  LogPlot(const std::vector<double>& times_ms, const std::vector<double>& errors);

  double x(double ms) const { return left + across_.place(ms) * (right - left); }
  double y(double error) const { return bottom - up_.place(error) * (bottom - top); }

  /// A complete SVG document: two lines of heading, the axes, then `content`. `style` is CSS that
  /// stands after the plot's own.
  std::string document(std::string_view title, std::string_view subtitle, std::string_view style,
                       std::string_view content) const;

 private:
  std::string axes() const;

  LogAxis across_;
  LogAxis up_;
};

/// As XML takes it, control characters left out.
std::string svg_escaped(std::string_view text);

/// A <text> element; `attributes` as they are written, or none.
std::string svg_text(double x, double y, std::string_view attributes, std::string_view text);

}  // namespace raytracer::client
