// The plane across a distant light's direction, cut into cells.
//
// All rays to the light are parallel: what may stand before a point is what covers its place on
// this plane. Every primitive is entered into the cells that its rectangle touches, or set aside
// where it is far wider than the others.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "engine/finders/binning.h"
#include "engine/finders/wide_primitives.h"
#include "engine/math/parts.h"
#include "engine/math/triple.h"
#include "engine/parallel/sum.h"

namespace raytracer {

/// What outlines are generous by, as a share of a cell: far more than what they are rounded by.
inline constexpr double outline_noise = 1e-3;

/// The rectangle that a primitive covers as a distant light sees it.
struct ShadowExtent {
  double u_low;  ///< along the first axis across the light's direction
  double v_low;  ///< along the second
  double u_high;
  double v_high;
  double top;  ///< how far it reaches towards the light

  double width() const { return std::max(u_high - u_low, v_high - v_low); }
};

/// Two axes across the light's direction, and the direction towards it.
using LightAxes = std::array<Vec3, 3>;

inline LightAxes light_axes(const Vec3& towards) {
  const OrthonormalBasis plane = orthonormal_basis(towards);
  return {plane.u, plane.v, towards};
}

/// Of what is nowhere farther than `radius` from the line along `axis` (unit) through `point`, as
/// the light sees it.
inline std::array<Line, 2> strip_outline(const LightAxes& axes, const Vec3& point, const Vec3& axis,
                                         double radius) {
  const Vec3 across = cross(axes[2], axis);
  const double size = length(across);
  if (!(size > 1e-6)) return {};  // seen from its end: the line has no direction
  const Vec3 k = across / size;
  constexpr double turned = 8 * std::numeric_limits<double>::epsilon();
  radius += turned / size * length(point);
  const double place = dot(point, k);
  const double u = dot(k, axes[0]);
  const double v = dot(k, axes[1]);
  return {{{radius - place, u, v}, {radius + place, -u, -v}}};
}

template <typename T>
std::array<Triple<T>, 3> in_precision(const LightAxes& axes) {
  return {narrowed<T>(axes[0]), narrowed<T>(axes[1]), narrowed<T>(axes[2])};
}

/// Cells, in the precision in which points look for theirs.
template <typename T>
struct LightPlane {
  std::array<Triple<T>, 3> axes{};  ///< as LightAxes
  T u_low{};
  T v_low{};
  T cells_per_unit{};
  T noise{};  ///< what a place may be off by, as far as it is across the light's direction
  int columns = 0;
  int rows = 0;
};

/// How wide cells are, against what is entered into them.
struct CellWidths {
  double per_primitive;  ///< of the root of the area that there is for each primitive
  double of_area;        ///< of the root of the mean area that one covers
  double of_side;        ///< of the mean of half its circumference
  double most_across;    ///< so many cells at most
};

/// What primitives together cover.
struct ShadowSpread {
  ShadowExtent all{infinity, infinity, -infinity, -infinity, 0};
  double areas = 0;    ///< of the rectangles, in sum
  double sides = 0;    ///< half their circumferences, in sum
  double highest = 0;  ///< of the tops, in size
  std::size_t primitive_count = 0;

  void include(const ShadowExtent& e) {
    include({e, (e.u_high - e.u_low) * (e.v_high - e.v_low),
             (e.u_high - e.u_low) + (e.v_high - e.v_low), std::abs(e.top), 1});
  }
  void include(const ShadowSpread& other) {
    all = {std::min(all.u_low, other.all.u_low), std::min(all.v_low, other.all.v_low),
           std::max(all.u_high, other.all.u_high), std::max(all.v_high, other.all.v_high), 0};
    areas += other.areas;
    sides += other.sides;
    highest = std::max(highest, other.highest);
    primitive_count += other.primitive_count;
  }

  /// The largest coordinate across the light's direction, in size.
  double across() const {
    return std::max(
        {std::abs(all.u_low), std::abs(all.v_low), std::abs(all.u_high), std::abs(all.v_high)});
  }
};

/// Where a plane's cells begin and how wide they are, in double.
template <typename T>
struct PlannedPlane {
  LightPlane<T> plane;
  SpreadWithoutWide<ShadowSpread> entered;
  LightAxes axes;
  double u_low;
  double v_low;
  double cell;
  double cells_per_unit;
  double margin;  ///< by which extents are enlarged: a point finds its cell in T

  /// The plane's rows and, if something is set aside, one more, of which that has the first.
  BinGrid bins() const { return {plane.columns, plane.rows + (entered.has_wide() ? 1 : 0), 0}; }
  WideEntries wide_entries(const std::vector<std::uint32_t>& begins) const {
    return entries_behind(begins, BinGrid{plane.columns, plane.rows, 0}.bin_count());
  }

  /// The cells that an extent touches, or of cells cut into `across` x `across` parts the parts.
  CellRectangle cells(const ShadowExtent& e, int across = 1) const {
    if (entered.is_wide(e.width())) return {0, across * plane.rows, 1, across * plane.rows + 1};
    const double width = cell / across;
    const auto index = [&](double offset, int most) {
      return static_cast<int>(
          std::min(std::max(0.0, offset * cells_per_unit * across), static_cast<double>(most)));
    };
    const int columns = across * plane.columns;
    const int rows = across * plane.rows;
    return {index(e.u_low - margin - u_low, columns - 1), index(e.v_low - margin - v_low, rows - 1),
            index(e.u_high + margin - u_low + width, columns),
            index(e.v_high + margin - v_low + width, rows)};
  }

  /// An outline on the plane against its cells.
  template <std::size_t count>
  PartOutline<count> against_cells(const std::array<Line, count>& outline) const {
    return {outline, cell, cell, outline_noise * cell + margin};
  }
  double u_begin(int column) const { return u_low + column * cell; }
  double v_begin(int row) const { return v_low + row * cell; }
};

/// Cells that suit the primitives, at least one of which there is; shadow_extent() is called from
/// several threads.
template <typename T, typename Primitive>
PlannedPlane<T> plan_light_plane(const Vec3& towards, std::span<const Primitive> primitives,
                                 const CellWidths& widths, WorkerPool& pool) {
  const LightAxes axes = light_axes(towards);
  using ByWidth = SpreadsByWidth<ShadowSpread>;
  const auto by_width = sum_in_parts<ByWidth>(
      primitives.size(), &pool, [&](std::size_t begin, std::size_t end, ByWidth& sum) {
        for (const Primitive& primitive : primitives.subspan(begin, end - begin)) {
          const ShadowExtent extent = shadow_extent(primitive, axes);
          sum.spreads[ByWidth::index_of(extent.width())].include(extent);
        }
      });

  constexpr auto epsilon = static_cast<double>(std::numeric_limits<T>::epsilon());
  constexpr double not_zero = 1e-30;
  const auto margin_of = [](const ShadowSpread& spread) {
    return 64 * epsilon * std::max(spread.across(), spread.highest);
  };
  const auto cell_width = [&](const ShadowSpread& spread) {
    const auto count = static_cast<double>(spread.primitive_count);
    const double width = spread.all.u_high - spread.all.u_low;
    const double height = spread.all.v_high - spread.all.v_low;
    return std::max({widths.per_primitive * std::sqrt(width * height / count),
                     widths.of_area * std::sqrt(spread.areas / count),
                     widths.of_side * spread.sides / count, width / widths.most_across,
                     height / widths.most_across, 4 * margin_of(spread), not_zero});
  };
  const auto entered = without_wide(by_width, cell_width);
  const ShadowExtent& all = entered.spread.all;
  const double cell = cell_width(entered.spread);
  return {{in_precision<T>(axes), static_cast<T>(all.u_low), static_cast<T>(all.v_low),
           static_cast<T>(1 / cell), static_cast<T>(8 * epsilon * entered.spread.across()),
           static_cast<int>((all.u_high - all.u_low) / cell) + 1,
           static_cast<int>((all.v_high - all.v_low) / cell) + 1},
          entered,
          axes,
          all.u_low,
          all.v_low,
          cell,
          1 / cell,
          margin_of(entered.spread)};
}

}  // namespace raytracer
