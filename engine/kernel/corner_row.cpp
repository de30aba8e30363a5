#include "engine/kernel/corner_row.h"

#include <algorithm>
#include <cmath>

namespace raytracer {
namespace {

/// What grows from 0 to 1 over the side, in the plane of a triangle of which `across` is the normal
/// and `base` the side that it is 0 on.
Vec3 slope_over(const Vec3& base, const Vec3& side, const Vec3& across) {
  const Vec3 inward = cross(across, base);
  const double rise = dot(inward, side);
  return rise != 0 ? inward / rise : Vec3{};
}

}  // namespace

template <typename T>
CornerRow<T> corner_row(const std::array<Vec3, 3>& corners, const CornerValues& values,
                        std::size_t item) {
  // Of what single cannot hold no ray meets more than a corner.
  constexpr double most = sizeof(T) == sizeof(float) ? 1e18 : 1e150;
  const auto bounded = [most](const Vec3& v) {
    const auto within = [most](double x) { return std::clamp(x, -most, most); };
    return Vec3{within(v.x), within(v.y), within(v.z)};
  };
  const Vec3 ab = corners[1] - corners[0];
  const Vec3 ac = corners[2] - corners[0];
  const int exponent = std::ilogb(std::max(max_abs(ab), max_abs(ac)));
  const Vec3 b = scaled(ab, -exponent);
  const Vec3 c = scaled(ac, -exponent);
  const Vec3 across = unit(cross(b, c));
  const Vec3 b_slope = bounded(scaled(slope_over(c, b, across), -exponent));
  const Vec3 c_slope = bounded(scaled(slope_over(b, c, across), -exponent));
  CornerRow<T> row{};
  row.b_slope = narrowed<T>(b_slope);
  row.c_slope = narrowed<T>(c_slope);
  row.b_offset = static_cast<T>(std::clamp(-dot(b_slope, corners[0]), -most, most));
  row.c_offset = static_cast<T>(std::clamp(-dot(c_slope, corners[0]), -most, most));
  if (!values.normals.empty()) {
    const auto normals = values.normals_of(item);
    row.has_normals = 1;
    row.normal = narrowed<T>(normals[0]);
    row.b_normal = narrowed<T>(normals[1] - normals[0]);
    row.c_normal = narrowed<T>(normals[2] - normals[0]);
  }
  if (!values.colors.empty()) {
    const auto colors = values.of(values.colors, item);
    row.has_colors = 1;
    row.color = narrowed<T>(colors[0]);
    row.b_color = narrowed<T>(colors[1] - colors[0]);
    row.c_color = narrowed<T>(colors[2] - colors[0]);
  }
  return row;
}

template CornerRow<float> corner_row<float>(const std::array<Vec3, 3>&, const CornerValues&,
                                            std::size_t);
template CornerRow<double> corner_row<double>(const std::array<Vec3, 3>&, const CornerValues&,
                                              std::size_t);

}  // namespace raytracer
