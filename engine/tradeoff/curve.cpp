#include "engine/tradeoff/curve.h"

#include <algorithm>

namespace raytracer {
namespace {

/// What changes the picture is no rival of what does not: nobody asked for another picture.
bool is_rival(const CurvePoint& other, const CurvePoint& point) {
  return !other.settings.changes_picture() || point.settings.changes_picture();
}

bool dominates(const CurvePoint& a, const CurvePoint& b) {
  return a.trace_ms <= b.trace_ms && a.error.rmse <= b.error.rmse &&
         (a.trace_ms < b.trace_ms || a.error.rmse < b.error.rmse);
}

}  // namespace

void mark_pareto(std::vector<CurvePoint>& points) {
  for (CurvePoint& point : points)
    point.pareto = std::none_of(points.begin(), points.end(), [&](const CurvePoint& other) {
      return is_rival(other, point) && dominates(other, point);
    });
}

}  // namespace raytracer
