#include "tests/measure/tradeoff/trade_svg.h"

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <vector>

#include "client/log_plot.h"

namespace raytracer::published {
namespace {

using client::LogPlot;

constexpr std::string_view style =
    R"(    svg { --samples: #0b6a63; --target: #3647b8; --peer-0: #9a4a00; --peer-1: #8a2f6b;
      --peer-2: #4f6b0b }
    @media (prefers-color-scheme: dark) { svg { --samples: #5cc4ba; --target: #9aa8ff;
      --peer-0: #f0a35e; --peer-1: #e48fc4; --peer-2: #b5d468 } }
    .line { fill: none; stroke-width: 1.5 }
    .samples { stroke: var(--samples) } .target { stroke: var(--target) }
    .peer-0 { stroke: var(--peer-0) } .peer-1 { stroke: var(--peer-1) }
    .peer-2 { stroke: var(--peer-2) }
    .point { stroke-width: 1.6; fill: var(--page) }
)";

enum class Mark { circle, square, triangle, diamond, inverted_triangle };
constexpr std::array peer_marks{Mark::triangle, Mark::diamond, Mark::inverted_triangle};

struct Series {
  std::string css_class;
  Mark mark;
  std::string name;
  Sweep points;
};

std::string outline(Mark mark, double x, double y) {
  switch (mark) {
    case Mark::circle:
      return fmt::format("M{:.1f} {:.1f}a4.5 4.5 0 1 0 9 0a4.5 4.5 0 1 0 -9 0z", x - 4.5, y);
    case Mark::square:
      return fmt::format("M{:.1f} {:.1f}h8v8h-8z", x - 4, y - 4);
    case Mark::triangle:
      return fmt::format("M{:.1f} {:.1f}l5 9h-10z", x, y - 5.5);
    case Mark::inverted_triangle:
      return fmt::format("M{:.1f} {:.1f}l5 -9h-10z", x, y + 5.5);
    case Mark::diamond:
      break;
  }
  return fmt::format("M{:.1f} {:.1f}l5.5 5.5l-5.5 5.5l-5.5 -5.5z", x, y - 5.5);
}

std::string drawn_mark(const Series& series, double x, double y, const std::string& title) {
  return fmt::format("  <path class=\"point {}\" d=\"{}\">{}</path>\n", series.css_class,
                     outline(series.mark, x, y),
                     title.empty() ? "" : "<title>" + client::svg_escaped(title) + "</title>");
}

std::string drawn(const Series& series, const LogPlot& plot) {
  std::string line;
  std::string marks;
  for (const SweepPoint& point : series.points) {
    const double x = plot.x(point.trace_ms);
    const double y = plot.y(point.rmse);
    line += fmt::format("{}{:.1f} {:.1f}", line.empty() ? "M" : "L", x, y);
    marks += drawn_mark(series, x, y,
                        fmt::format("{}, {}: {:.3g} ms, rmse {:.2g}", series.name, point.setting,
                                    point.trace_ms, point.rmse));
  }
  return fmt::format("  <path class=\"line {}\" d=\"{}\"/>\n{}", series.css_class, line, marks);
}

std::string legend(const std::vector<Series>& all) {
  constexpr double x = LogPlot::right + 32;
  double y = LogPlot::top + 8;
  std::string text;
  for (const Series& series : all) {
    text += drawn_mark(series, x, y - 4, "") + client::svg_text(x + 14, y, "", series.name);
    y += 22;
  }
  y += 10;
  for (const std::string_view line :
       {"Of a peer's settings the best:", "no faster one has a smaller error."}) {
    text += client::svg_text(x - 6, y, "class=\"soft\"", line);
    y += 17;
  }
  return text;
}

}  // namespace

std::string trade_svg(const EqualErrorFigures& figures, std::size_t thread_count) {
  std::vector<Series> all{{"samples", Mark::circle, "this: fixed samples", figures.with_samples},
                          {"target", Mark::square, "this: target error", figures.with_target}};
  for (std::size_t i = 0; i < figures.peers.size(); ++i)
    if (!figures.peers[i].refusal)
      all.push_back({fmt::format("peer-{}", i), peer_marks[i % peer_marks.size()],
                     figures.peers[i].name, front(figures.peers[i].sweep)});
  std::vector<double> times_ms;
  std::vector<double> errors;
  for (const Series& series : all) {
    for (const SweepPoint& point : series.points) {
      times_ms.push_back(point.trace_ms);
      errors.push_back(point.rmse);
    }
  }
  const LogPlot plot(times_ms, errors);
  std::string content = legend(all);
  for (const Series& series : all) content += drawn(series, plot);
  return plot.document(
      "What accuracy costs: " + figures.scene,
      fmt::format("{} x {} pixels on {} threads; errors against {} samples per pixel in double "
                  "precision, off by at most {:.1g} by estimate",
                  figures.width_px, figures.height_px, thread_count, figures.exact_samples,
                  figures.exact_error),
      style, content);
}

}  // namespace raytracer::published
