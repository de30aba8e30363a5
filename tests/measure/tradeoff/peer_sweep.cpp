#include "tests/measure/tradeoff/peer_sweep.h"

#include <algorithm>
#include <iostream>
#include <limits>
#include <optional>
#include <utility>

#include "engine/tradeoff/difference.h"
#include "tests/measure/tradeoff/settled_time.h"

namespace raytracer::published {

peers::Drawing draw(const peers::Peer& peer, const peers::Setting& setting, Transfer transfer) {
  peers::Drawing drawing;
  const auto trace_ms = [&] {
    drawing = setting.draw();
    return drawing.times.trace_ms;
  };
  drawing.times.trace_ms = peer.is_program() ? trace_ms() : settled_ms(trace_ms);
  drawing.image = peers::stored(std::move(drawing.image), transfer);
  return drawing;
}

PeerSweep sweep_peer(peers::Peer& peer, const Image& exact, Transfer transfer,
                     double least_target) {
  PeerSweep sweep;
  for (const peers::Ladder& ladder : peer.ladders()) {
    double error_before = std::numeric_limits<double>::infinity();
    for (const peers::Setting& setting : ladder.settings) {
      if (std::any_of(sweep.settings.begin(), sweep.settings.end(),
                      [&](const peers::Setting& known) { return known.name == setting.name; }))
        continue;  // on an earlier ladder
      const peers::Drawing drawing = draw(peer, setting, transfer);
      const std::optional<std::size_t> known = cheapest_within(sweep.points, least_target);
      const double rmse = difference(drawing.image, exact).rmse;
      sweep.settings.push_back(setting);
      const std::string way = drawing.way.empty() ? "" : ", " + drawing.way;
      std::cerr << "  " << peer.name() << ' ' << setting.name << way << ": "
                << drawing.times.trace_ms << " ms, " << rmse << std::endl;
      sweep.points.push_back({setting.name + way, drawing.times.trace_ms, rmse});
      if (rmse <= least_target || rmse > ladder.worth_it * error_before ||
          (known && drawing.times.trace_ms > sweep.points[*known].trace_ms))
        break;
      error_before = rmse;
    }
  }
  return sweep;
}

}  // namespace raytracer::published
