#include "engine/tradeoff/curve.h"

#include <algorithm>

namespace raytracer {
namespace {

bool dominates(const CurvePoint& a, const CurvePoint& b) {
  constexpr double same = 1.01;
  return a.trace_ms <= b.trace_ms && a.error.rmse <= same * b.error.rmse &&
         (a.trace_ms < b.trace_ms || a.error.rmse < b.error.rmse);
}

}  // namespace

void mark_pareto(std::vector<CurvePoint>& points) {
  for (CurvePoint& point : points)
    point.pareto = std::none_of(points.begin(), points.end(), [&](const CurvePoint& other) {
      return !other.settings.changes_picture() && dominates(other, point);
    });
}

}  // namespace raytracer
