// A curve as a drawing: error against time, both logarithmic.
//
// Self-contained: no script, no font and no picture from elsewhere. Its colours follow the
// reader's choice of light or dark. Shape and colour both say what was set, so that either is
// enough; points of the Pareto front are filled, joined and named.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "client/curve.h"
#include "client/log_plot.h"

namespace raytracer::client {
namespace {

constexpr std::string_view style =
    R"(    svg { --single: #0b6a63; --double: #9a4a00; --target: #3647b8; --other: #6a6f72 }
    @media (prefers-color-scheme: dark) { svg { --single: #5cc4ba; --double: #f0a35e;
      --target: #9aa8ff; --other: #979da0 } }
    .name { font-size: 11px }
    .front { fill: none; stroke: var(--soft); stroke-width: 1.5 }
    .point { stroke-width: 1.6; fill: var(--page) }
    .single { stroke: var(--single) } .single.best { fill: var(--single) }
    .double { stroke: var(--double) } .double.best { fill: var(--double) }
    .target { stroke: var(--target) } .target.best { fill: var(--target) }
    .other { stroke: var(--other) } .other.best { fill: var(--other) }
)";

/// What was set, as the drawing tells it apart: by colour, and by the outline of its mark.
struct Kind {
  std::string_view css_class;
  std::string_view name;
  std::string_view outline;  ///< as an SVG path, from the point
};

constexpr Kind single{"single", "samples, single precision",
                      "m-4.5 0a4.5 4.5 0 1 0 9 0a4.5 4.5 0 1 0 -9 0z"};
constexpr Kind in_double{"double", "samples, double precision", "m0 -5.5l5 9h-10z"};
constexpr Kind target{"target", "target error", "m-4 -4h8v8h-8z"};
constexpr Kind incomplete{"other", "parts of the picture left out",
                          "m0 -5.5l5.5 5.5l-5.5 5.5l-5.5 -5.5z"};

const Kind& kind_of(const CurvePoint& point) {
  if (point.changes_picture) return incomplete;
  if (point.has_target) return target;
  return point.is_double ? in_double : single;
}

std::string mark(const Kind& kind, bool is_best, double x, double y, const std::string& title) {
  return fmt::format("  <path class=\"point {}{}\" d=\"M{:.1f} {:.1f}{}\">{}</path>\n",
                     kind.css_class, is_best ? " best" : "", x, y, kind.outline,
                     title.empty() ? "" : "<title>" + svg_escaped(title) + "</title>");
}

std::string legend() {
  constexpr double x = LogPlot::right + 32;
  double y = LogPlot::top + 8;
  std::string text;
  for (const Kind& kind : {single, in_double, target, incomplete}) {
    text += mark(kind, false, x, y - 4, "") + svg_text(x + 14, y, "", kind.name);
    y += 22;
  }
  y += 10;
  for (const std::string_view line : {"Filled: nothing else is as fast",
                                      "and as accurate, parts of the", "picture left out aside."}) {
    text += svg_text(x - 6, y, "class=\"soft\"", line);
    y += 17;
  }
  return text;
}

/// Names beside points: below the front, where nothing else is, or above it where no mark is in
/// the way; where there is no room, none.
class Names {
 public:
  void keep_clear_of_mark(double x, double y) { taken_.push_back({x - 6, y - 6, x + 6, y + 6}); }

  std::string place(double x, double y, const std::string& name) {
    constexpr double letter = 5.9;
    constexpr double tall = 12;
    const double length = letter * static_cast<double>(name.size());
    const std::array<Box, 2> places{{{x - 8 - length, y + 3, x - 8, y + 3 + tall},
                                     {x + 8, y - 7 - tall, x + 8 + length, y - 7}}};
    for (const Box& box : places) {
      if (box.x0 < LogPlot::left || box.x1 > LogPlot::right || box.y1 > LogPlot::bottom ||
          std::any_of(taken_.begin(), taken_.end(),
                      [&](const Box& other) { return box.overlaps(other); }))
        continue;
      taken_.push_back(box);
      return svg_text(box.x0, box.y1 - 2, "class=\"name\"", name);
    }
    return "";
  }

 private:
  struct Box {
    double x0, y0, x1, y1;
    bool overlaps(const Box& other) const {
      return x0 < other.x1 && other.x0 < x1 && y0 < other.y1 && other.y0 < y1;
    }
  };
  std::vector<Box> taken_;
};

std::string marks(const std::vector<CurvePoint>& points, const LogPlot& plot) {
  std::string line;
  std::string drawn;
  std::string names;
  Names placed;
  for (const CurvePoint& point : points)
    placed.keep_clear_of_mark(plot.x(point.trace_ms), plot.y(point.rmse));
  for (const CurvePoint& point : points) {
    const double x = plot.x(point.trace_ms);
    const double y = plot.y(point.rmse);
    if (point.pareto && !point.changes_picture) {
      line += fmt::format("{}{:.1f} {:.1f}", line.empty() ? "M" : "L", x, y);
      names += placed.place(x, y, point.name);
    }
    drawn += mark(kind_of(point), point.pareto, x, y,
                  fmt::format("{}: {:.3g} ms, rmse {:.2g}, largest {:.2g}, {:.2g} % off by more "
                              "than 1/255",
                              point.name, point.trace_ms, point.rmse, point.max_error,
                              100 * point.off_share));
  }
  return fmt::format("  <path class=\"front\" d=\"{}\"/>\n{}{}", line, drawn, names);
}

}  // namespace

std::string curve_svg(const Curve& curve, const std::string& label) {
  std::vector<double> times_ms;
  std::vector<double> errors;
  for (const CurvePoint& point : curve.points) {
    times_ms.push_back(point.trace_ms);
    errors.push_back(point.rmse);
  }
  const LogPlot plot(times_ms, errors);
  const std::string measured = fmt::format(
      "{} x {} pixels on {} thread{}; errors against {} samples per pixel in double precision, "
      "off by at most {:.1g} by estimate",
      curve.width_px, curve.height_px, curve.thread_count, curve.thread_count == 1 ? "" : "s",
      curve.reference_samples, curve.reference_error);
  return plot.document("What accuracy costs: " + label, measured, style,
                       marks(curve.points, plot) + legend());
}

}  // namespace raytracer::client
