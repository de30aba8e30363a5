// What kinds of object have in common that are surfaces of revolution between the two ends of an
// axis: closed by a disc at each end, or open. A kind tells what its side is: by functions that are
// found by what they are given, those of the concepts below.
//
//   axial.h            what a document says of them, and what plans ask of them
//   axial_reference.h  where a ray meets one
//   axial_packets.h    how they lie in memory
//   axial-inl.h        packets of rays: what kinds' own code begins with; what it has to bring is
//                      in axial_kinds-inl.h and axial_surfaces-inl.h, which do the rest with it
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>

#include "engine/math/axis.h"
#include "engine/objects/kind.h"

namespace raytracer {

/// In frame coordinates: what kinds' primitives begin with.
struct AxialSolid : AxisSegment {
  double eye_power;  ///< of the eye, across the axis: positive outside the endless side
  bool has_caps;
  PrimitiveId id;

  Vec3 middle() const { return 0.5 * (end(false) + end(true)); }
};

/// distance_to_surface() is negative inside a closed one, smallest_squared_length() the least
/// length whose square single has to hold.
template <class Solid>
concept AxialPrimitive = std::derived_from<Solid, AxialSolid> &&
    requires(const Solid& c, const Vec3& place, bool is_to) {
  { end_radius(c, is_to) } -> std::same_as<double>;
  { distance_to_surface(c, place) } -> std::same_as<double>;
  { smallest_squared_length(c) } -> std::same_as<double>;
};

/// Traits that such kinds begin with.
struct AxialTraits {
  static constexpr Search search = Search::bounded;
  // Random ones under two lights, packets of 16.
  static constexpr FewPrimitives few{.to_lights = 12, .followed = 24};
  static constexpr double pixels_for_cells = 12;
  static constexpr bool has_exact_shadows = false;
  static constexpr bool has_light_sweep = false;
  static constexpr double tolerance_px = 1.0 / 64;
};

template <class Kind>
concept AxialKind = AxialPrimitive<typename Kind::Primitive>;

/// A document's structure for one of them.
template <class Document>
concept OneAxial = requires(const Document& c, bool is_to, const PrimitiveId& id,
                            const Frame& frame) {
  { end_radius(c, is_to) } -> std::same_as<double>;
  { c.from } -> std::convertible_to<Vec3>;
  { packed(c, id, frame) } -> std::derived_from<AxialSolid>;
};

/// For many of them, in order.
template <class Document>
concept ManyAxial = requires(const Document& c, std::size_t i) {
  { c[i] } -> OneAxial;
  c.from.size();
};

template <OneAxial Document>
std::size_t item_count(const Document&) {
  return 1;
}
template <ManyAxial Document>
std::size_t item_count(const Document& c) {
  return c.from.size();
}

template <OneAxial Document, typename Include>
void for_each_extent(const Document& c, const Include& include) {
  include(c.from, end_radius(c, false));
  include(c.to, end_radius(c, true));
}
template <ManyAxial Document, typename Include>
void for_each_extent(const Document& c, const Include& include) {
  for (std::size_t i = 0; i < c.from.size(); ++i) for_each_extent(c[i], include);
}

/// For the frame.
template <AxialPrimitive Solid>
bool is_too_small(const Solid& c) {
  return !Frame::carries(c.high - c.low) || !Frame::carries(smallest_squared_length(c));
}

template <OneAxial Document, AxialPrimitive Solid>
void pack(const Document& c, Packing<Solid>& to) {
  const Solid solid = packed(c, {to.object, 0}, to.frame);
  to.add(solid, !is_too_small(solid));
}
template <ManyAxial Document, AxialPrimitive Solid>
void pack(const Document& c, Packing<Solid>& to) {
  const auto make = [&](std::size_t i) { return packed(c[i], {to.object, i}, to.frame); };
  to.add_all(c.from.size(), make, is_too_small<Solid>, is_too_small<Solid>);
}

template <AxialPrimitive Solid>
double largest_radius(const Solid& c) {
  return std::max(end_radius(c, false), end_radius(c, true));
}

template <AxialPrimitive Solid>
Box bounds(const Solid& c) {
  const Vec3 reach = reach_of_disc(c.axis);
  Box box;
  for (const bool is_to : {false, true}) {
    const Vec3 center = c.end(is_to);
    const Vec3 own = end_radius(c, is_to) * reach;
    box.include(Box{center - own, center + own});
  }
  return box;
}

template <AxialPrimitive Solid>
PixelRectangle footprint(const Projection& projection, const Solid& c) {
  return projection.of_discs(c.end(false), end_radius(c, false), c.end(true), end_radius(c, true),
                             c.axis);
}

template <AxialPrimitive Solid>
double nearest_distance(const Solid& c) {
  return distance_to_surface(c, {});
}

template <AxialPrimitive Solid>
void add_statistics(const Solid& c, const Viewpoint& from, GeometryStatistics& to) {
  const double radius = largest_radius(c);
  double farthest = 0;
  for (const bool is_to : {false, true}) {
    farthest = std::max(farthest, length(c.end(is_to) - from.place));
    to.note_place(c.end(is_to) - from.scene_origin, radius);
  }
  double distance = distance_to_surface(c, from.place);
  if (from.place == Vec3{} && c.eye_power == 0 && c.low < 0 && c.high > 0) distance = 0;
  to.note_surface(distance);
  to.farthest = std::max(to.farthest, farthest + radius);
  to.smallest = std::min(to.smallest, smallest_squared_length(c));
  // Of a tip what is thinner than an eighth of a pixel is not looked at.
  const double thinnest = std::min(radius, farthest * from.pixel_angle / 8);
  const double least = std::max(std::min(end_radius(c, false), end_radius(c, true)), thinnest);
  to.least_sine = std::min(to.least_sine, least / farthest);
  const double width = end_radius(c, false) + end_radius(c, true);
  if (width < farthest * from.pixel_angle) to.subpixel += 1;
  const double reach = 0.5 * (c.high - c.low) + radius;
  const double in_front = length(c.middle() - from.place) - reach;
  to.note_blocks(from.blocks(in_front > 0 ? reach / in_front : 1e300), distance);
}

/// A tip magnifies without end, but what a mirror shows near it is small: by its mean radius.
template <AxialPrimitive Solid>
void add_mirror(const Solid& c, CurvedMirrors& mirrors) {
  mirrors.include(c.middle(), 0.5 * (end_radius(c, false) + end_radius(c, true)), 1,
                  0.5 * (c.high - c.low) + largest_radius(c));
}

/// Calls visit(rectangle, share) for pieces of it along the axis where it may be seen thinner than
/// a pixel: what of the image a piece may cover, and the share that it does.
template <AxialPrimitive Solid, typename Visit>
void for_each_subpixel_piece(const Solid& c, const Projection& projection, const Visit& visit) {
  const PixelRectangle whole = footprint(projection, c);
  const double width = whole.x_end - whole.x_begin;
  const double height = whole.y_end - whole.y_begin;
  constexpr double most_pieces = 4096;  // of one: more than an image is wide
  if (!(width > 0 && height > 0 && std::max(width, height) < most_pieces)) return;
  const int pieces = 1 + static_cast<int>(std::max(width, height));
  const auto between = [](double from, double to, double share) {
    return from + (to - from) * share;
  };
  for (int i = 0; i < pieces; ++i) {
    const auto center = [&](double at) {
      return c.foot + between(c.low, c.high, at / pieces) * c.axis;
    };
    const auto radius = [&](double at) {
      return between(end_radius(c, false), end_radius(c, true), at / pieces);
    };
    const PixelRectangle seen =
        projection.of_discs(center(i), radius(i), center(i + 1), radius(i + 1), c.axis);
    const PixelRectangle across = projection.of_sphere(center(i + 0.5), radius(i + 0.5));
    const double piece_width = seen.x_end - seen.x_begin;
    const double piece_height = seen.y_end - seen.y_begin;
    const double thickness = std::min(across.x_end - across.x_begin, across.y_end - across.y_begin);
    if (!(piece_width > 0 && piece_height > 0 && thickness > 0 && thickness < 1)) continue;
    const double area = thickness * std::hypot(piece_width, piece_height);
    visit(seen, std::min(area / (piece_width * piece_height), 1.0));
  }
}

}  // namespace raytracer
