#include "client/formats/triangulate.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace raytracer::client {
namespace {

struct FlatPoint {
  double x;
  double y;
  bool operator==(const FlatPoint&) const = default;
};

/// Twice the area of a triangle; positive if it runs counterclockwise.
double doubled_area(FlatPoint a, FlatPoint b, FlatPoint c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

struct Flattened {
  std::array<double, 3> normal{};
  /// In the plane of two axes, counterclockwise, of about the size 1, whatever that of the polygon
  /// is. Empty if it has no area.
  std::vector<FlatPoint> corners;
};

Flattened flatten(const std::vector<std::array<double, 3>>& corners) {
  double largest = 0;
  for (const auto& corner : corners)
    for (const double coordinate : corner) largest = std::max(largest, std::abs(coordinate));
  int exponent = 0;
  std::frexp(largest, &exponent);
  // Relative to the first corner, first made small enough for differences to be finite.
  std::vector<std::array<double, 3>> sides(corners.size());
  double extent = 0;
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      sides[i][axis] =
          std::ldexp(corners[i][axis], -exponent) - std::ldexp(corners[0][axis], -exponent);
      extent = std::max(extent, std::abs(sides[i][axis]));
    }
  if (extent == 0) return {};
  for (auto& side : sides)
    for (double& coordinate : side) coordinate /= extent;
  std::array<double, 3> normal{};  // M. Newell's: twice the areas of the projections
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const auto& a = sides[i];
    const auto& b = sides[(i + 1) % sides.size()];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t u = (axis + 1) % 3;
      const std::size_t v = (axis + 2) % 3;
      normal[axis] += a[u] * b[v] - a[v] * b[u];
    }
  }
  const auto magnitude = [](double a, double b) { return std::abs(a) < std::abs(b); };
  const auto axis = static_cast<std::size_t>(
      std::max_element(normal.begin(), normal.end(), magnitude) - normal.begin());
  if (!(std::abs(normal[axis]) > 4 * std::numeric_limits<double>::epsilon())) return {};
  const std::size_t u = (axis + (normal[axis] > 0 ? 1 : 2)) % 3;
  const std::size_t v = (axis + (normal[axis] > 0 ? 2 : 1)) % 3;
  Flattened flat{normal, {}};
  for (const auto& side : sides) flat.corners.push_back({side[u], side[v]});
  return flat;
}

/// What is left of a polygon while ears are cut off.
class EarClipper {
 public:
  explicit EarClipper(std::vector<FlatPoint> corners)
      : corners_(std::move(corners)), left_(corners_.size()) {
    const auto count = static_cast<std::uint32_t>(corners_.size());
    for (std::uint32_t i = 0; i < count; ++i) {
      next_.push_back((i + 1) % count);
      previous_.push_back((i + count - 1) % count);
    }
    for (std::uint32_t i = 0; i < count; ++i)
      if (area_at(i) <= 0) concave_.push_back(i);
  }

  Triangulation result() {
    Triangulation result;
    std::uint32_t corner = 0;
    for (std::size_t refused = 0; left_ >= 3;) {
      // Where no ear is found the sides cross, or what is left is thinner than rounding.
      const bool is_forced = refused > left_;
      // What crosses itself has no exact filling to search for.
      const bool is_cut = result.crosses_itself ? area_at(corner) > 0 : is_ear(corner);
      if (!is_forced && !is_cut) {
        corner = next_[corner];
        ++refused;
        continue;
      }
      const double area = area_at(corner);
      constexpr double rounding = 1e-9;
      result.crosses_itself |= is_forced && std::abs(area) > rounding;
      if (area != 0) result.triangles.push_back({previous_[corner], corner, next_[corner]});
      corner = cut_off(corner);
      refused = 0;
    }
    return result;
  }

 private:
  double area_at(std::uint32_t corner) const {
    return doubled_area(corners_[previous_[corner]], corners_[corner], corners_[next_[corner]]);
  }

  bool is_ear(std::uint32_t corner) const {
    if (area_at(corner) <= 0) return false;
    const FlatPoint a = corners_[previous_[corner]];
    const FlatPoint b = corners_[corner];
    const FlatPoint c = corners_[next_[corner]];
    return std::none_of(concave_.begin(), concave_.end(), [&](std::uint32_t other) {
      const FlatPoint p = corners_[other];
      // A slit has corners in the same place, which hinder nobody.
      if (p == a || p == b || p == c) return false;
      return doubled_area(a, b, p) >= 0 && doubled_area(b, c, p) >= 0 && doubled_area(c, a, p) >= 0;
    });
  }

  /// Returns the corner to go on with: not the neighbour, so that no fan of slivers arises.
  std::uint32_t cut_off(std::uint32_t corner) {
    const std::uint32_t before = previous_[corner];
    const std::uint32_t after = next_[corner];
    next_[before] = after;
    previous_[after] = before;
    --left_;
    std::erase_if(concave_, [&](std::uint32_t other) {
      return other == corner || other == before || other == after;
    });
    for (const std::uint32_t neighbour : {before, after})
      if (area_at(neighbour) <= 0) concave_.push_back(neighbour);
    return next_[after];
  }

  std::vector<FlatPoint> corners_;
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> previous_;
  std::vector<std::uint32_t> concave_;  ///< the corners that may lie in another's triangle
  std::size_t left_;
};

}  // namespace

Triangulation triangulate(const std::vector<std::array<double, 3>>& corners) {
  Flattened flat = flatten(corners);
  if (flat.corners.empty()) return {};
  Triangulation result = EarClipper(std::move(flat.corners)).result();
  result.normal = flat.normal;
  return result;
}

}  // namespace raytracer::client
