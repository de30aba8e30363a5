// The cube around a point light, cut into cells.
//
// All rays to the light end there: what may stand before a point is what is seen from the light in
// the point's direction. So each face of the cube is an image that the light sees, and every
// primitive is entered into the cells of it that its footprint may touch, as into the blocks of the
// eye's. A face has cells where primitives are seen through it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "engine/finders/binning.h"
#include "engine/finders/light_plane.h"
#include "engine/math/projection.h"
#include "engine/math/triple.h"
#include "engine/math/view.h"
#include "engine/memory/page_allocator.h"
#include "engine/parallel/sum.h"

namespace raytracer {

/// Where a face's cells begin: at (u, v) of its own from -1 to 1, as a point p looks for it. From
/// the light l, along the face's axis w, p is seen at u = (p_u - l_u) / |p_w - l_w|, which is
/// beyond a begin b by (p_u - slope p_w - start) / |p_w - l_w|, with slope = +-b and start = l_u -
/// slope l_w: however far away the light is, what is subtracted is no larger than the scene. To a
/// light that is not far p is relative, and no start is left.
template <typename T>
struct CubeFace {
  T u_slope;
  T v_slope;
  T u_start;
  T v_start;
};

inline constexpr int cube_faces = 6;

/// Cells, in the precision in which points look for theirs. A face is numbered 2 * axis, and one
/// more on the negative side; its columns run along the next axis (x to y to z to x), its rows
/// along the one after that.
template <typename T>
struct LightCube {
  std::array<CubeFace<T>, cube_faces> faces{};
  T cells_per_unit{};
  int side = 0;         ///< of a face, in cells
  bool is_far = false;  ///< the light: places are relative to the eye, and not to it

  BinGrid cells() const { return {side, cube_faces * side, 0}; }
};

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

/// How far from the eye any of them reaches.
template <typename Primitive>
double reach_of(std::span<const Primitive> primitives, WorkerPool& pool) {
  const std::size_t chunk_count = primitives.size() < few_items ? 1 : pool.thread_count();
  std::vector<double> farthest(chunk_count);
  for_each_chunk(primitives.size(), chunk_count, pool,
                 [&](std::size_t chunk, std::size_t begin, std::size_t end) {
                   double own = 0;
                   for (const Primitive& primitive : primitives.subspan(begin, end - begin)) {
                     const Box box = bounds(primitive);
                     own = std::max({own, max_abs(box.low), max_abs(box.high)});
                   }
                   farthest[chunk] = own;
                 });
  return *std::max_element(farthest.begin(), farthest.end());
}

/// Whether a light is so far from the eye, against how far the primitives reach, that its distance
/// would swallow what their places differ by. Of such a light none is beyond or around it.
inline bool is_far_light(const Vec3& light, double reach) {
  constexpr double far = 4;
  return length(light) > far * reach;
}

namespace light_cube {

/// So many that no margin of a projection counts.
inline constexpr int pixels_across_face = 1 << 30;

inline constexpr double pixels_across_unit = 0.5 * pixels_across_face;

inline double pixel_of(double place) { return (place + 1) * pixels_across_unit; }
inline double place_of(double pixel) { return pixel * (2.0 / pixels_across_face) - 1; }

/// The view from the light through a face.
inline View view_of_face(int face) {
  const std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  const auto axis = static_cast<std::size_t>(face / 2);
  const Vec3 forward = face % 2 == 0 ? axes[axis] : -axes[axis];
  // A view's rows run downwards.
  return {forward, axes[(axis + 1) % 3], -axes[(axis + 2) % 3], pixels_across_face,
          pixels_across_face};
}

/// Where cells may begin that begin at `low` or before, exactly in T.
template <typename T>
double begin_below(double low) {
  constexpr auto epsilon = static_cast<double>(std::numeric_limits<T>::epsilon());
  return static_cast<double>(static_cast<T>(low - epsilon * std::abs(low)));
}

/// What primitives are seen through, and how much of it all of them cover in sum.
struct Seen {
  std::array<FaceRectangle, cube_faces> faces;
  double count = 0;  ///< of pairs of a primitive and a face
  double areas = 0;
  double sides = 0;  ///< half their circumferences

  void include(std::size_t face, const FaceRectangle& rectangle) {
    faces[face].include(rectangle);
    count += 1;
    areas += rectangle.width() * rectangle.height();
    sides += rectangle.width() + rectangle.height();
  }
  void include(const Seen& other) {
    for (std::size_t face = 0; face < faces.size(); ++face) faces[face].include(other.faces[face]);
    count += other.count;
    areas += other.areas;
    sides += other.sides;
  }
};

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

}  // namespace light_cube

/// Where cells begin and how wide they are, in double; and who is seen through which face.
template <typename T>
struct PlannedCube {
  /// What directions are rounded by, as shares of what they differ by.
  static constexpr double turn = 64 * static_cast<double>(std::numeric_limits<T>::epsilon());

  LightCube<T> cube;
  Vec3 light;
  double margin;  ///< by which primitives are enlarged: a point finds its cell in T
  std::array<FaceRectangle, cube_faces> windows;
  LargeArray<std::uint8_t> faces;  ///< of each primitive, a bit for each face
  std::array<View, cube_faces> views;
  std::vector<Projection> projections;  ///< of the views

  /// Where something comes on a face that is `seen` from the light, in that box: in cells or, of
  /// cells cut into `across` x `across` parts, in those.
  template <typename Primitive>
  CellRectangle cells(const Primitive& seen, const Box& box, int face, int across) const {
    const auto of = static_cast<std::size_t>(face);
    const PixelRectangle pixels = footprint(projections[of], seen);
    if (!(pixels.x_begin < pixels.x_end && pixels.y_begin < pixels.y_end)) return {};
    const BoxInFace outer(box, face);
    const FaceRectangle most = outer.rectangle(turn);
    const FaceRectangle& window = windows[of];
    const double wider = wider_by(outer.least_along());
    const int side = across * cube.side;
    const auto index = [&](double place, int more) {
      const double cell = place * static_cast<double>(cube.cells_per_unit) * across + more;
      return static_cast<int>(std::clamp(cell, 0.0, static_cast<double>(side)));
    };
    const double u_wider = wider + turn * window.width();
    const double v_wider = wider + turn * window.height();
    using light_cube::place_of;
    const int row = face * side;
    return {index(std::max(place_of(pixels.x_begin) - u_wider, most.u_low) - window.u_low, 0),
            row + index(std::max(place_of(pixels.y_begin) - v_wider, most.v_low) - window.v_low, 0),
            index(std::min(place_of(pixels.x_end) + u_wider, most.u_high) - window.u_low, 1),
            row + index(std::min(place_of(pixels.y_end) + v_wider, most.v_high) - window.v_low, 1)};
  }

  /// The outline of something in a face's view that is so far from the light or farther, against
  /// cells, generous by how much more of the view may belong to those.
  template <std::size_t count>
  PartOutline<count> against_cells(const std::array<Line, count>& outline, int face,
                                   double distance) const {
    const FaceRectangle& window = windows[static_cast<std::size_t>(face)];
    const double cell = 1 / static_cast<double>(cube.cells_per_unit);
    const double wider = outline_noise * cell + wider_by(distance / light_cube::root_three) +
                         turn * std::max(window.width(), window.height());
    using light_cube::pixels_across_unit;
    return {outline, cell * pixels_across_unit, cell * pixels_across_unit,
            wider * pixels_across_unit + projection_margin_px};
  }
  /// Where in the face's view a cell begins, in rows as `cells` counts them.
  std::array<double, 2> pixel(int face, int column, int row) const {
    const FaceRectangle& window = windows[static_cast<std::size_t>(face)];
    const double cell = 1 / static_cast<double>(cube.cells_per_unit);
    return {light_cube::pixel_of(window.u_low + column * cell),
            light_cube::pixel_of(window.v_low + (row - face * cube.side) * cell)};
  }

  /// By how much of a face a point may miss its cell, so far along the face's axis.
  double wider_by(double along) const {
    constexpr double all = 4;
    const double wider = margin / along;
    return wider < all ? wider : all;  // all too where it is no number
  }
};

/// Cells that suit the primitives, at least one of which there is, none of them farther from the
/// eye than `reach`; bounds() and seen_from() are called from several threads.
template <typename T, typename Primitive>
PlannedCube<T> plan_light_cube(const Vec3& light, std::span<const Primitive> primitives,
                               double reach, const CellWidths& widths, WorkerPool& pool) {
  constexpr double turn = PlannedCube<T>::turn;
  // Boxes are taken relative to the light, from whose distance double keeps so much of a place.
  const double rounded = 32 * std::numeric_limits<double>::epsilon() * length(light);
  PlannedCube<T> planned{{}, light, turn * reach + rounded, {}, {}, {}, {}};
  planned.faces.resize(primitives.size());
  const auto seen = sum_in_parts<light_cube::Seen>(
      primitives.size(), &pool, [&](std::size_t begin, std::size_t end, light_cube::Seen& sum) {
        for (std::size_t i = begin; i < end; ++i) {
          const Box box = enlarged(bounds(seen_from(primitives[i], light)), planned.margin);
          unsigned faces = 0;
          for (int face = 0; face < cube_faces; ++face) {
            const BoxInFace in(box, face);
            if (!in.is_seen(turn)) continue;
            faces |= 1U << face;
            sum.include(static_cast<std::size_t>(face), in.rectangle(turn));
          }
          planned.faces[i] = static_cast<std::uint8_t>(faces);
        }
      });

  double area = 0;
  double widest = 0;
  for (std::size_t face = 0; face < cube_faces; ++face) {
    FaceRectangle& window = planned.windows[face];
    window = seen.faces[face];
    if (window.empty()) window = {2, 2, 2, 2};  // beyond the face
    window.u_low = light_cube::begin_below<T>(window.u_low);
    window.v_low = light_cube::begin_below<T>(window.v_low);
    area += window.width() * window.height();
    widest = std::max({widest, window.width(), window.height()});
  }
  constexpr double not_zero = 1e-30;
  const double count = std::max(seen.count, 1.0);
  // What is seen along a line would have more cells than are worth clearing.
  const double most_across = std::min(widths.most_across, 2 * std::sqrt(count));
  const double of_area = std::min(widths.of_area, light_cube::width_where_crowded(seen, area));
  const double cell = std::max(
      {widths.per_primitive * std::sqrt(area / count), of_area * std::sqrt(seen.areas / count),
       widths.of_side * seen.sides / count, widest / most_across, not_zero});
  planned.cube.cells_per_unit = static_cast<T>(1 / cell);
  planned.cube.side = static_cast<int>(widest / cell) + 1;
  planned.cube.is_far = is_far_light(light, reach);
  for (int i = 0; i < cube_faces; ++i) {
    const auto face = static_cast<std::size_t>(i);
    const int axis = i / 2;
    const double sign = i % 2 == 0 ? 1 : -1;
    const FaceRectangle& window = planned.windows[face];
    const double along = component(light, axis);
    const auto start = [&](int across, double slope) {
      const double from_eye = component(light, across % 3) - slope * along;
      return static_cast<T>(planned.cube.is_far ? from_eye : 0);
    };
    planned.cube.faces[face] = {
        static_cast<T>(sign * window.u_low), static_cast<T>(sign * window.v_low),
        start(axis + 1, sign * window.u_low), start(axis + 2, sign * window.v_low)};
    planned.views[face] = light_cube::view_of_face(i);
    planned.projections.emplace_back(planned.views[face]);
  }
  return planned;
}

}  // namespace raytracer
