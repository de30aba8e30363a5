#include "tests/measure/tradeoff/peer_sweeps.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "engine/tradeoff/difference.h"
#include "tests/measure/tradeoff/settled_time.h"

namespace raytracer::published {
namespace {

using bench::EmbreeMode;
using bench::PovrayAntialiasing;

constexpr int largest_side = 32;
constexpr int floor_side = 48;
constexpr int side_in_all_modes = 6;  // beyond, only the fastest of two smaller ones

constexpr std::array povray_thresholds{0.3, 0.1, 0.03, 0.01, 0.0};
constexpr std::array recursive_depths{1, 2, 3, 4, 5, 6};
constexpr std::array flat_depths{2, 3, 4, 5, 6, 8, 11, 16, 23};

/// One method and threshold with ever more depth, while that pays.
template <std::size_t count>
void deepen(const bench::PovrayPeer& povray, const Image& exact, double least_target,
            PovrayAntialiasing setting, const std::array<int, count>& depths, PovraySweep& sweep) {
  constexpr double worth_it = 0.85;  // of the error before
  double error_before = std::numeric_limits<double>::infinity();
  for (const int depth : depths) {
    setting.depth = depth;
    const bench::PovrayFloatRun run = povray.run(setting);
    const std::optional<std::size_t> known = cheapest_within(sweep.points, least_target);
    const double rmse = difference(run.image, exact).rmse;
    sweep.settings.push_back(setting);
    sweep.points.push_back({name_of(setting), run.times.trace_ms, rmse});
    if (rmse <= least_target || rmse > worth_it * error_before ||
        (known && run.times.trace_ms > sweep.points[*known].trace_ms))
      return;
    error_before = rmse;
  }
}

}  // namespace

std::string name_of(const PovrayAntialiasing& setting) {
  return fmt::format("+AM{} +A{:.3f} +R{}", setting.method, setting.threshold, setting.depth);
}

EmbreeSweep sweep_embree(bench::EmbreePeer& embree, bench::EmbreeWorld& world, const Image& exact,
                         double least_target) {
  EmbreeSweep sweep;
  Image image(exact.width, exact.height);
  // Grids that fill packets with a pixel's samples, and others.
  std::array<EmbreeMode, 2> fastest{bench::embree_modes[0], bench::embree_modes[0]};
  bool is_reached = false;
  for (int side = 1; side <= largest_side; ++side) {
    const bool fills_packets = side * side % embree.packet_width() == 0;
    bench::set_sample_grid(world, side);
    double best_ms = std::numeric_limits<double>::infinity();
    for (const EmbreeMode mode : bench::embree_modes) {
      EmbreeMode& known = fastest[fills_packets ? 1 : 0];
      if (side > side_in_all_modes && mode != known) continue;
      const double ms = settled_ms([&] { return embree.trace(world, mode, image); });
      if (ms >= best_ms) continue;
      best_ms = ms;
      known = mode;
    }
    const double rmse = difference(image, exact).rmse;
    sweep.points.push_back({fmt::format("{0} x {0}", side), best_ms, rmse});
    is_reached = is_reached || rmse <= least_target;
    if (is_reached && fills_packets) return sweep;
  }
  if (!is_reached) {
    bench::set_sample_grid(world, floor_side);
    embree.trace(world, fastest[1], image);
    sweep.floor_rmse = difference(image, exact).rmse;
  }
  return sweep;
}

PovraySweep sweep_povray(const bench::PovrayPeer& povray, const Image& exact, double least_target) {
  PovraySweep sweep;
  for (const double threshold : povray_thresholds) {
    deepen(povray, exact, least_target, {.method = 2, .threshold = threshold}, recursive_depths,
           sweep);
    deepen(povray, exact, least_target, {.method = 1, .threshold = threshold}, flat_depths, sweep);
  }
  return sweep;
}

}  // namespace raytracer::published
