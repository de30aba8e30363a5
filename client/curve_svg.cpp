#include "client/curve_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

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

/// What was set, as the drawing tells it apart.
enum class Kind { single, in_double, target, other };

struct KindRow {
  Kind kind;
  std::string_view css_class;
  std::string_view name;
};

constexpr std::array<KindRow, 4> kinds{{{Kind::single, "single", "samples, single precision"},
                                        {Kind::in_double, "double", "samples, double precision"},
                                        {Kind::target, "target", "target error"},
                                        {Kind::other, "other", "parts of the picture left out"}}};

const KindRow& row_of(const CurvePoint& point) {
  const Kind kind = point.changes_picture                  ? Kind::other
                    : point.settings.target_rmse           ? Kind::target
                    : point.settings.precision == "double" ? Kind::in_double
                                                           : Kind::single;
  return *std::find_if(kinds.begin(), kinds.end(),
                       [kind](const KindRow& row) { return row.kind == kind; });
}

/// The outline of a kind's mark around (x, y): circle, triangle, square, diamond.
std::string outline(Kind kind, double x, double y) {
  switch (kind) {
    case Kind::single:
      return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4.5\"", x, y);
    case Kind::in_double:
      return fmt::format("<path d=\"M{:.1f} {:.1f}l5 9h-10z\"", x, y - 5.5);
    case Kind::target:
      return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"8\" height=\"8\"", x - 4, y - 4);
    case Kind::other:
      break;
  }
  return fmt::format("<path d=\"M{:.1f} {:.1f}l5.5 5.5l-5.5 5.5l-5.5 -5.5z\"", x, y - 5.5);
}

std::string mark(const KindRow& row, bool is_best, double x, double y, const std::string& title) {
  return fmt::format("  {} class=\"point {}{}\">{}</{}>\n", outline(row.kind, x, y), row.css_class,
                     is_best ? " best" : "",
                     title.empty() ? "" : "<title>" + svg_escaped(title) + "</title>",
                     row.kind == Kind::single   ? "circle"
                     : row.kind == Kind::target ? "rect"
                                                : "path");
}

std::string legend() {
  constexpr double x = LogPlot::right + 32;
  double y = LogPlot::top + 8;
  std::string text;
  for (const KindRow& row : kinds) {
    text += mark(row, false, x, y - 4, "") + svg_text(x + 14, y, "", row.name);
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
      names += placed.place(x, y, in_words(point.settings));
    }
    drawn += mark(row_of(point), point.pareto, x, y,
                  fmt::format("{}: {:.3g} ms, rmse {:.2g}, largest {:.2g}, {:.2g} % off by more "
                              "than 1/255",
                              in_words(point.settings), point.trace_ms, point.rmse, point.max_error,
                              100 * point.off_share));
  }
  return fmt::format("  <path class=\"front\" d=\"{}\"/>\n{}{}", line, drawn, names);
}

}  // namespace

std::string curve_svg(const Curve& curve, const std::string& label) {
  std::vector<CurvePoint> points = curve.points;
  std::sort(points.begin(), points.end(),
            [](const CurvePoint& a, const CurvePoint& b) { return a.trace_ms < b.trace_ms; });
  const LogPlot plot(values_of(points, &CurvePoint::trace_ms),
                     values_of(points, &CurvePoint::rmse));
  const std::string measured = fmt::format(
      "{} x {} pixels on {} thread{}; errors against {} samples per pixel in double precision, "
      "off by at most {:.1g} by estimate",
      curve.width_px, curve.height_px, curve.thread_count, curve.thread_count == 1 ? "" : "s",
      curve.reference_samples, curve.reference_error);
  return plot.document("What accuracy costs: " + label, measured, style,
                       marks(points, plot) + legend());
}

}  // namespace raytracer::client
