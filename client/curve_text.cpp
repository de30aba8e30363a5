#include "client/curve_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "client/log_axis.h"

namespace raytracer::client {
namespace {

char mark_of(const CurvePoint& point) {
  if (point.changes_picture) return '~';
  return point.pareto ? '*' : 'o';
}

std::string table(std::vector<CurvePoint> points) {
  std::stable_sort(points.begin(), points.end(), [](const CurvePoint& a, const CurvePoint& b) {
    return a.trace_ms < b.trace_ms;
  });
  std::string text = fmt::format("  {:>9}  {:>9}  {:>7}  {:>14}  {}\n", "trace, ms", "rmse",
                                 "largest", "off by > 1/255", "settings");
  for (const CurvePoint& point : points)
    text += fmt::format("{} {:>9.2f}  {:>9.2g}  {:>7.2g}  {:>12.2f} %  {}\n", mark_of(point),
                        point.trace_ms, point.rmse, point.max_error, 100 * point.off_share,
                        in_words(point.settings));
  return text;
}

std::string plot(const std::vector<CurvePoint>& points) {
  constexpr std::size_t width = 64;
  constexpr std::size_t height = 16;
  constexpr std::size_t margin = 9;  // of the numbers on the left
  const LogAxis across(values_of(points, &CurvePoint::trace_ms));
  const LogAxis up(values_of(points, &CurvePoint::rmse));
  const auto column_of = [&](double ms) {
    return static_cast<std::size_t>(std::lround(across.place(ms) * (width - 1)));
  };
  const auto row_of = [&](double rmse) {
    return height - 1 - static_cast<std::size_t>(std::lround(up.place(rmse) * (height - 1)));
  };
  std::vector<std::string> rows(height, std::string(margin, ' ') + '|' + std::string(width, ' '));
  for (const double tick : up.ticks()) {
    std::string& row = rows[row_of(tick)];
    row.replace(0, margin + 1, fmt::format("{:>{}g} +", tick, margin - 1));
  }
  // What matters most is put last, over what stands in the same place.
  for (const char mark : {'~', 'o', '*'})
    for (const CurvePoint& point : points)
      if (mark_of(point) == mark)
        rows[row_of(point.rmse)][margin + 1 + column_of(point.trace_ms)] = mark;

  std::string line = std::string(margin, ' ') + '+' + std::string(width, '-');
  std::string numbers(margin + 1 + width, ' ');
  for (const double tick : across.ticks()) {
    const std::string number = fmt::format("{:g}", tick);
    const std::size_t at = margin + 1 + column_of(tick);
    line[at] = '+';
    if (at + number.size() <= numbers.size()) numbers.replace(at, number.size(), number);
  }
  std::string text = "    rmse\n";
  for (const std::string& row : rows) text += row.substr(0, row.find_last_not_of(' ') + 1) + '\n';
  return text + line + '\n' + numbers + " ms\n";
}

std::string choices(const Curve& curve) {
  constexpr std::array wanted_errors{0.03, 0.01, 0.003, 0.001, 0.0005};
  std::string text = "The cheapest for an error of at most\n";
  for (const double wanted : wanted_errors) {
    const CurvePoint* const point = cheapest(curve, wanted);
    text += point ? fmt::format("  {:<7g} {:>9.2f} ms  {}\n", wanted, point->trace_ms,
                                as_options(point->settings))
                  : fmt::format("  {:<7g} nothing that was measured\n", wanted);
  }
  return text;
}

}  // namespace

std::string curve_text(const Curve& curve, const std::string& label) {
  return fmt::format(
      "{}: {} x {} pixels, {} thread{}\n"
      "Errors are against {} samples per pixel in double precision, which are\n"
      "estimated to be off by at most {:.1g} themselves.\n\n"
      "{}\n{}\n"
      "* nothing else is as fast and as accurate   ~ parts of the picture are left out\n\n{}",
      label, curve.width_px, curve.height_px, curve.thread_count,
      curve.thread_count == 1 ? "" : "s", curve.reference_samples, curve.reference_error,
      table(curve.points), plot(curve.points), choices(curve));
}

}  // namespace raytracer::client
