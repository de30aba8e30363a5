// What a point light sees through the faces of the cube around it, and how wide cells suit that.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "engine/finders/light_plane.h"
#include "engine/math/box.h"

namespace raytracer {

inline constexpr int cube_faces = 6;

/// What of a face something is seen through.
struct FaceRectangle {
  double u_low = infinity;
  double v_low = infinity;
  double u_high = -infinity;
  double v_high = -infinity;

  bool empty() const { return !(u_low < u_high && v_low < v_high); }
  double width() const { return u_high - u_low; }
  double height() const { return v_high - v_low; }
  void include(const FaceRectangle& other) {
    u_low = std::min(u_low, other.u_low);
    v_low = std::min(v_low, other.v_low);
    u_high = std::max(u_high, other.u_high);
    v_high = std::max(v_high, other.v_high);
  }
};

namespace light_cube {

/// From a cube's middle to its corner, in halves of its side; a little more.
inline constexpr double root_three = 1.7321;

}  // namespace light_cube

/// A box as it is seen from the origin through a face of the cube around that.
class BoxInFace {
 public:
  BoxInFace(const Box& box, int face) {
    const auto axis = face / 2;
    const auto range = [&](int of) {
      return Range{component(box.low, of % 3), component(box.high, of % 3)};
    };
    along_ = range(axis);
    if (face % 2 != 0) along_ = {-along_.high, -along_.low};
    u_ = range(axis + 1);
    v_ = range(axis + 2);
  }

  /// Whether something of it may be seen through the face or, by `beyond`, beside it.
  bool is_seen(double beyond) const {
    return along_.high * (1 + beyond) >= std::max(u_.least(), v_.least()) && along_.high > 0;
  }
  /// What of the face it may cover, and of what is beside the face by `beyond`.
  FaceRectangle rectangle(double beyond) const {
    const double edge = 1 + beyond;
    if (!(along_.low > 0)) return {-edge, -edge, edge, edge};
    const double per_near = 1 / along_.low;
    const double per_far = 1 / along_.high;
    const auto low = [&](const Range& across) {
      return std::clamp(across.low * (across.low < 0 ? per_near : per_far), -edge, edge);
    };
    const auto high = [&](const Range& across) {
      return std::clamp(across.high * (across.high > 0 ? per_near : per_far), -edge, edge);
    };
    return {low(u_), low(v_), high(u_), high(v_)};
  }
  /// A lower bound of how far along the face's axis what is seen of it lies.
  double least_along() const {
    const double square =
        u_.least() * u_.least() + v_.least() * v_.least() + along_.least() * along_.least();
    return std::max(along_.low, std::sqrt(square) / light_cube::root_three);
  }

 private:
  struct Range {
    double low = 0;
    double high = 0;
    /// Of the distances from 0.
    double least() const { return std::max({low, -high, 0.0}); }
  };
  Range along_;
  Range u_;
  Range v_;
};

/// The least distance of a box from the origin.
inline double distance_of(const Box& box) {
  const auto least = [&](int axis) {
    return std::max({component(box.low, axis), -component(box.high, axis), 0.0});
  };
  return length({least(0), least(1), least(2)});
}

/// A box with `margin` more on all sides.
inline Box enlarged(const Box& box, double margin) {
  const Vec3 all{margin, margin, margin};
  return {box.low - all, box.high + all};
}

namespace light_cube {

/// Where cells may begin that begin at `low` or before, exactly in T.
template <typename T>
double begin_below(double low) {
  constexpr auto epsilon = static_cast<double>(std::numeric_limits<T>::epsilon());
  return static_cast<double>(static_cast<T>(low - epsilon * std::abs(low)));
}

/// Through which faces of the cube a box is seen, and what of them it may cover.
struct SeenBox {
  unsigned faces = 0;  ///< a bit for each
  std::array<FaceRectangle, cube_faces> rectangles;

  SeenBox(const Box& box, double beyond) {
    for (int face = 0; face < cube_faces; ++face) {
      const BoxInFace in(box, face);
      if (!in.is_seen(beyond)) continue;
      faces |= 1U << face;
      rectangles[static_cast<std::size_t>(face)] = in.rectangle(beyond);
    }
  }
  bool is_seen_through(std::size_t face) const { return (faces >> face & 1U) != 0; }
  double width() const {
    double most = 0;
    for (std::size_t face = 0; face < cube_faces; ++face)
      if (is_seen_through(face))
        most = std::max({most, rectangles[face].width(), rectangles[face].height()});
    return most;
  }
};

/// What primitives are seen through, and how much of it all of them cover in sum.
struct Seen {
  std::array<FaceRectangle, cube_faces> faces;
  std::size_t primitive_count = 0;
  double count = 0;  ///< of pairs of a primitive and a face
  double areas = 0;
  double sides = 0;  ///< half their circumferences

  void include(const SeenBox& box) {
    ++primitive_count;
    for (std::size_t face = 0; face < cube_faces; ++face) {
      if (!box.is_seen_through(face)) continue;
      const FaceRectangle& rectangle = box.rectangles[face];
      faces[face].include(rectangle);
      count += 1;
      areas += rectangle.width() * rectangle.height();
      sides += rectangle.width() + rectangle.height();
    }
  }
  void include(const Seen& other) {
    for (std::size_t face = 0; face < faces.size(); ++face) faces[face].include(other.faces[face]);
    primitive_count += other.primitive_count;
    count += other.count;
    areas += other.areas;
    sides += other.sides;
  }
};

/// What of the faces is cut into cells: what is seen, from where T can tell that it begins.
template <typename T>
std::array<FaceRectangle, cube_faces> windows_of(const Seen& seen) {
  std::array<FaceRectangle, cube_faces> windows = seen.faces;
  for (FaceRectangle& window : windows) {
    if (window.empty()) window = {2, 2, 2, 2};  // beyond the face
    window.u_low = begin_below<T>(window.u_low);
    window.v_low = begin_below<T>(window.v_low);
  }
  return windows;
}

/// Of the widest, as wide or high as it is.
inline double widest_of(const std::array<FaceRectangle, cube_faces>& windows) {
  double widest = 0;
  for (const FaceRectangle& window : windows)
    widest = std::max({widest, window.width(), window.height()});
  return widest;
}

/// How wide cells are to be, against what is seen, where much lies one behind the other. A cell k
/// times as wide as what is seen, of which `depth` cover each place, has depth (1 + k)^2 entries,
/// and each primitive comes into (1 + 1 / k)^2 cells.
inline double width_where_crowded(const Seen& seen, double area) {
  constexpr double few = 16;
  constexpr double most_entries = 1 << 17;  // are sorted in a few milliseconds
  const double count = std::max(seen.count, 1.0);
  const double depth = seen.areas / area;
  const double of_entries = std::max(std::sqrt(most_entries / count) - 1, 0.1);
  return std::max(std::sqrt(few / depth) - 1, 1 / of_entries);
}

/// How wide cells suit what is seen.
template <typename T>
double cell_width(const Seen& seen, const CellWidths& widths) {
  constexpr double not_zero = 1e-30;
  const std::array<FaceRectangle, cube_faces> windows = windows_of<T>(seen);
  double area = 0;
  for (const FaceRectangle& window : windows) area += window.width() * window.height();
  const double count = std::max(seen.count, 1.0);
  // What is seen along a line would have more cells than are worth clearing.
  const double most_across = std::min(widths.most_across, 2 * std::sqrt(count));
  const double of_area = std::min(widths.of_area, width_where_crowded(seen, area));
  return std::max({widths.per_primitive * std::sqrt(area / count),
                   of_area * std::sqrt(seen.areas / count), widths.of_side * seen.sides / count,
                   widest_of(windows) / most_across, not_zero});
}

}  // namespace light_cube

}  // namespace raytracer
