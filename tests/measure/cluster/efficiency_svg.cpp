#include "tests/measure/cluster/efficiency_svg.h"

#include <fmt/format.h>

#include <cmath>

namespace raytracer::measure {
namespace {

constexpr double left = 60, right = 640, top = 20, bottom = 330;
constexpr double decades = 3;  // from 10 to 10,000 workers

double across(std::size_t workers) {
  return left + (std::log10(static_cast<double>(workers)) - 1) / decades * (right - left);
}
double down(double efficiency) { return bottom - efficiency * (bottom - top); }

std::string text(double x, double y, const char* anchor, const std::string& words) {
  return fmt::format("  <text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y,
                     anchor, words);
}

}  // namespace

std::string efficiency_svg(const std::vector<EfficiencyCurve>& curves) {
  std::string svg =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 660 380\" width=\"660\" "
      "height=\"380\" role=\"img\">\n  <title>Efficiency against workers</title>\n  <style>\n"
      "    svg { --page: #fff; --ink: #1b1d1e; --line: #dfe2e3; --c0: #0b6a63; --c1: #9a4a00 }\n"
      "    @media (prefers-color-scheme: dark) { svg { --page: #111213; --ink: #e6e8e8;\n"
      "      --line: #2e3133; --c0: #5cc4ba; --c1: #f0a35e } }\n"
      "    text { font: 12px system-ui, sans-serif; fill: var(--ink) }\n"
      "    .grid { stroke: var(--line) } .curve { fill: none; stroke-width: 2 }\n  </style>\n"
      "  <rect width=\"100%\" height=\"100%\" fill=\"var(--page)\"/>\n";
  for (const std::size_t workers : {10UL, 100UL, 1000UL, 10'000UL}) {
    svg += fmt::format("  <path class=\"grid\" d=\"M{0:.1f} {1}V{2}\"/>\n", across(workers), top,
                       bottom);
    svg += text(across(workers), bottom + 18, "middle", std::to_string(workers));
  }
  for (const int percents : {0, 25, 50, 75, 100}) {
    const double y = down(percents / 100.0);
    svg += fmt::format("  <path class=\"grid\" d=\"M{} {:.1f}H{}\"/>\n", left, y, right);
    svg += text(left - 8, y + 4, "end", fmt::format("{} %", percents));
  }
  svg += text((left + right) / 2, bottom + 40, "middle", "workers of one thread");
  for (std::size_t i = 0; i < curves.size(); ++i) {
    std::string path;
    for (const SimulatedJob& job : curves[i].jobs)
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", across(job.workers),
                          down(job.efficiency));
    svg += fmt::format("  <path class=\"curve\" stroke=\"var(--c{})\" d=\"{}\"/>\n", i % 2, path);
    const double y = bottom - 40 + 18 * static_cast<double>(i);
    svg += fmt::format("  <path class=\"curve\" stroke=\"var(--c{})\" d=\"M{} {}h24\"/>\n", i % 2,
                       left + 12, y);
    svg += text(left + 44, y + 4, "start", curves[i].name);
  }
  return svg + "</svg>\n";
}

}  // namespace raytracer::measure
