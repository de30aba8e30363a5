// What an object tells at the corners of its items, and between them is interpolated: normals for
// smooth shading, colours.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/math/vec.h"

namespace raytracer {

/// Of an object's items.
struct CornerValues {
  std::vector<std::array<std::uint32_t, 3>> corners;  ///< of each item, in the lists below
  std::vector<Vec3> normals;  ///< of any length but 0; none, or one for each corner
  std::vector<Rgb> colors;    ///< likewise
  std::size_t first = 0;      ///< the items of the objects before it that have some, too

  bool empty() const { return normals.empty() && colors.empty(); }
  std::array<Vec3, 3> of(const std::vector<Vec3>& values, std::size_t item) const {
    const auto& [a, b, c] = corners[item];
    return {values[a], values[b], values[c]};
  }
  /// The longest near 1 and the others in proportion: lengths count where normals are interpolated.
  std::array<Vec3, 3> normals_of(std::size_t item) const {
    std::array<Vec3, 3> around = of(normals, item);
    const double largest = std::max({max_abs(around[0]), max_abs(around[1]), max_abs(around[2])});
    for (Vec3& normal : around) normal = scaled(normal, -std::ilogb(largest));
    return around;
  }
};

/// A document's structure that has some.
template <class Document>
concept HasCornerValues = requires(const Document& x) {
  { corner_values(x) } -> std::same_as<CornerValues>;
  { has_corner_normals(x) } -> std::same_as<bool>;
  { corner_colors(x) } -> std::same_as<const std::vector<Rgb>&>;
};

/// A primitive between corners.
template <class Primitive>
concept HasCorners = requires(const Primitive& p) {
  { corners_of(p) } -> std::same_as<const std::array<Vec3, 3>&>;
};

/// How fast the direction turns, at most, where one of `normals` becomes another: their difference
/// over the shortest.
inline double turn_between(const std::array<Vec3, 3>& normals, std::size_t i, std::size_t k) {
  const double shortest = std::min({length(normals[0]), length(normals[1]), length(normals[2])});
  return length(normals[k] - normals[i]) / shortest;
}

/// The least of a triangle's heights.
inline double thickness(const std::array<Vec3, 3>& corners) {
  const Vec3 ab = corners[1] - corners[0];
  const Vec3 ac = corners[2] - corners[0];
  const double longest = std::max({length(ab), length(ac), length(ac - ab)});
  return longest > 0 ? length(cross(ab, ac)) / longest : 0;
}

/// The least radius of a sphere whose normals turn as fast as those between the corners.
inline double least_radius(const std::array<Vec3, 3>& corners, const std::array<Vec3, 3>& normals) {
  double least = infinity;
  for (std::size_t i = 0; i < 3; ++i) {
    const double turn = turn_between(normals, i, (i + 1) % 3);
    if (turn > 0) least = std::min(least, length(corners[(i + 1) % 3] - corners[i]) / turn);
  }
  return least;
}

}  // namespace raytracer
