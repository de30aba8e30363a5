// A curve as people read it in a terminal: a table, and what to choose.
#include <fmt/format.h>

#include "client/curve.h"

namespace raytracer::client {
namespace {

/// To the hundredth, and the shortest times to three digits.
std::string time_text(double ms) {
  return ms < 1 ? fmt::format("{:.3g}", ms) : fmt::format("{:.2f}", ms);
}

std::string table(const Curve& curve) {
  std::string text = fmt::format("  {:>9}  {:>9}  {:>7}  {:>14}  {}\n", "trace, ms", "rmse",
                                 "largest", "off by > 1/255", "settings");
  for (const CurvePoint& point : curve.points)
    text += fmt::format("{} {:>9}  {:>9.2g}  {:>7.2g}  {:>12.2f} %  {}\n",
                        point.changes_picture ? '~'
                        : point.pareto        ? '*'
                                              : ' ',
                        time_text(point.trace_ms), point.rmse, point.max_error,
                        100 * point.off_share, point.name);
  return text;
}

std::string choices(const Curve& curve) {
  std::string text = "The cheapest for an error of at most\n";
  for (const double wanted : {0.03, 0.01, 0.003, 0.001, 0.0005}) {
    const CurvePoint* const point = cheapest(curve, wanted);
    text += point ? fmt::format("  {:<7g} {:>9} ms  {}\n", wanted, time_text(point->trace_ms),
                                point->options)
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
      "{}\n"
      "* nothing else is as fast and as accurate   ~ parts of the picture are left out\n\n{}",
      label, curve.width_px, curve.height_px, curve.thread_count,
      curve.thread_count == 1 ? "" : "s", curve.reference_samples, curve.reference_error,
      table(curve), choices(curve));
}

}  // namespace raytracer::client
