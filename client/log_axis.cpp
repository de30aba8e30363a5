#include "client/log_axis.h"

#include <algorithm>
#include <cmath>

namespace raytracer::client {

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

}  // namespace raytracer::client
