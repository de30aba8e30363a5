// Lattices in frame coordinates, and what the plan has to know of them: how near, far and
// large they are.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/objects/lattice/lattice.h"
#include "engine/text/pluralised.h"

namespace raytracer {
namespace {

/// The distance from `place` to the nearest of the spheres near it, or to the box around all of
/// them where that is far.
double distance_to(const PackedLattice& l, const Vec3& place) {
  // The lattice's own axes: first, across, second.
  const Vec3 from_center = place - l.center;
  const Vec3 p{component(from_center, l.first_axis), component(from_center, l.across),
               component(from_center, l.second_axis)};
  const double r = l.radius;
  const double half = l.half_side();
  const Vec3 outside{std::max(std::abs(p.x) - half, 0.0), std::max(std::abs(p.y) - r, 0.0),
                     std::max(std::abs(p.z) - half, 0.0)};
  const double to_box = length(outside);
  if (to_box > 0) return to_box;
  // Between the spheres: the nearest is in the same cell or a neighbouring one.
  const auto nearest_center = [&](double at, int neighbour) {
    const double cell = std::floor(at / (2 * r)) + neighbour;
    return (2 * cell + 1) * r;
  };
  double nearest = infinity;
  for (const int i : {-1, 0, 1})
    for (const int k : {-1, 0, 1})
      nearest = std::min(
          nearest, length({p.x - nearest_center(p.x, i), p.y, p.z - nearest_center(p.z, k)}) - r);
  return nearest;
}

}  // namespace

void pack(const SphereSquare& s, Packing<PackedLattice>& to) {
  static constexpr std::array<std::array<int, 3>, 3> axes{{{0, 2, 1}, {0, 1, 2}, {1, 2, 0}}};
  const auto& [first, second, across] = axes[static_cast<std::size_t>(s.axes)];
  const double radius = to.frame.frame_from_scene(s.radius);
  to.add(
      {to.frame.frame_from_scene(s.center), radius, 2 * s.n, first, second, across, {to.object, 0}},
      Frame::carries(radius));
}

Box bounds(const PackedLattice& l) {
  Vec3 extent{l.half_side(), l.half_side(), l.half_side()};
  component(extent, l.across) = l.radius;
  return Box{l.center - extent, l.center + extent}.padded(0);
}

void add_statistics(const PackedLattice& l, const Viewpoint& from, GeometryStatistics& to) {
  const double r = l.radius;
  const double reach = length(l.center - from.place) + std::sqrt(2.0) * l.half_side() + r;
  to.note_surface(distance_to(l, from.place));
  to.note_place(l.center - from.scene_origin, r);
  to.farthest = std::max(to.farthest, reach);
  to.smallest = std::min(to.smallest, r);
  to.least_sine = std::min(to.least_sine, r / (reach - r));
  const double parts = std::pow(static_cast<double>(l.side), 2);
  to.parts += parts;
  if (2 * r < reach * from.pixel_angle) {  // none of its spheres is farther
    to.subpixel += parts;
    to.has_subpixel_lattice = true;
  }
}

std::string name_of(LatticeKind, std::size_t count, const GeometryStatistics& statistics) {
  if (count > 1)
    return fmt::format("{} squares of {:.4g} spheres in all", grouped(count), statistics.parts);
  return fmt::format("a square of {0} x {0} spheres",
                     grouped(static_cast<std::uint64_t>(std::lround(std::sqrt(statistics.parts)))));
}

NeighbourSearch explain_neighbours(LatticeKind, double lowest_light) {
  constexpr double degrees = 180 / std::numbers::pi;
  const double elevation = std::asin(lowest_light) * degrees;
  if (lowest_light < lowest_neighbour_slope)
    return {"cell walk", fmt::format("a light stands only {:.1f} degrees over it, where a list of "
                                     "the neighbours in its way would be long",
                                     elevation)};
  return {"neighbour list", fmt::format("only the same few neighbours can shadow each of its "
                                        "spheres; the lowest light stands {:.0f} degrees over it",
                                        elevation)};
}

double elevation_sine(const PackedLattice& l, const Vec3& towards) {
  return std::abs(component(towards, l.across));
}

double shadow_path(const PackedLattice& l, const Vec3& towards, const Box& all) {
  const double middle = component(l.center, l.across);
  const double height =
      std::max(component(all.high, l.across) - middle, middle - component(all.low, l.across));
  return (height + 2 * l.radius) / elevation_sine(l, towards);
}

}  // namespace raytracer
