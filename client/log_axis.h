// An axis on which equal ratios are equally long: where its values stand, and which are named.
#pragma once

#include <vector>

namespace raytracer::client {

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

}  // namespace raytracer::client
