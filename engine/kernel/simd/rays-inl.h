// What a block of rays meets first, and whether light reaches it.

#if defined(RAYTRACER_KERNEL_SIMD_RAYS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_RAYS_INL_H_
#undef RAYTRACER_KERNEL_SIMD_RAYS_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_RAYS_INL_H_
#endif

#include <limits>
#include <span>

#include "engine/kernel/simd/packet-inl.h"
#include "engine/kernel/simd/render_block.h"
#include "engine/kernel/simd/square-inl.h"
#include "engine/kernel/simd/tree-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// Where the lanes of a packet start, and which surface they leave (-1: none).
/// For a sphere of a square also its cell.
template <class V>
struct Start {
  V3<V> point;
  V3<V> normal;  ///< of the surface that is left
  V id;          ///< numbers of primitives are kept as T: they are small
  V first;
  V second;
};

/// The nearest primitive so far. `id` -1: none.
template <class V>
struct Nearest {
  V t;
  V id;
  V first;  ///< a square's cell
  V second;
};

/// How far from a plane a point may be for its distance to be rounding alone.
template <typename T>
inline constexpr T plane_noise = 16 * std::numeric_limits<T>::epsilon();

template <class V, class M>
HWY_INLINE void take(Nearest<V>& nearest, M nearer, V t, V id) {
  nearest.t = hn::IfThenElse(nearer, t, nearest.t);
  nearest.id = hn::IfThenElse(nearer, id, nearest.id);
}

/// Whether a hit at t of primitive `id` counts: nearer, or as near and earlier in the document.
template <class V, class M>
HWY_INLINE M is_nearer(const Nearest<V>& nearest, V t, V id, M hit) {
  const M sooner = hn::Lt(t, nearest.t);
  const M first_of_equals = hn::And(hn::Eq(t, nearest.t), hn::Lt(id, nearest.id));
  return hn::And(hit, hn::Or(sooner, first_of_equals));
}

/// The farthest that any lane of `active` sees as yet.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
HWY_INLINE float farthest(D d, const Nearest<V>& nearest, M active) {
  return static_cast<float>(hn::GetLane(hn::MaxOfLanes(d, hn::IfThenElseZero(active, nearest.t))));
}

/// Rays from the eye, in one of the 4 x 4 parts of a block, against the block's spheres: near to
/// far, until the next one is farther than all that is seen already.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE void show_spheres_to_eye(D d, const SimdScene<T>& scene,
                                    std::span<const ScreenEntry> entries, int part,
                                    const V3<V>& direction, M active, Nearest<V>& nearest) {
  const V zero = hn::Zero(d);
  float t_max = farthest(d, nearest, active);
  for (const ScreenEntry& entry : entries) {
    if (entry.nearest > t_max) return;
    if ((entry.parts >> part & 1) == 0) continue;
    const SimdSphere<T>& sphere = scene.spheres[entry.sphere];
    const V3<V> center = broadcast(d, sphere.center);
    const V b = dot(center, direction);
    const V3<V> l{hn::MulSub(direction.x, b, center.x), hn::MulSub(direction.y, b, center.y),
                  hn::MulSub(direction.z, b, center.z)};
    const V discriminant = hn::Sub(hn::Set(d, sphere.radius2), dot(l, l));
    const M hit = hn::And(hn::Ge(discriminant, zero), hn::Gt(b, zero));
    if (hn::AllFalse(d, hit)) continue;
    const V t =
        hn::Div(hn::Set(d, sphere.eye_c), hn::Add(b, hn::Sqrt(hn::Max(discriminant, zero))));
    const V id = hn::Set(d, static_cast<T>(sphere.id));
    take(nearest, is_nearer(nearest, t, id, hit), t, id);
    t_max = farthest(d, nearest, active);
  }
}

/// Lanes of `lit` from which a sphere of the grid stands before its distant light.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M occluded_in_grid(D d, const DistantGrid<T>& grid, const Start<V>& from, M lit) {
  constexpr std::size_t most_lanes = hn::MaxLanes(D());
  alignas(64) T u[most_lanes];
  alignas(64) T v[most_lanes];
  alignas(64) T w[most_lanes];
  alignas(64) T id[most_lanes];
  alignas(64) T dark[most_lanes] = {};
  const auto along = [&](const Vec3& axis) HWY_ATTR {
    return dot(from.point, broadcast(d, Triple<T>{static_cast<T>(axis.x), static_cast<T>(axis.y),
                                                  static_cast<T>(axis.z)}));
  };
  hn::Store(along(grid.axes[0]), d, u);
  hn::Store(along(grid.axes[1]), d, v);
  hn::Store(along(grid.axes[2]), d, w);
  hn::Store(from.id, d, id);
  alignas(64) T is_lit[most_lanes];
  hn::Store(hn::IfThenElseZero(lit, hn::Set(d, T(1))), d, is_lit);
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    if (is_lit[lane] == T(0)) continue;
    const T column_place = (u[lane] - grid.u_low) * grid.cells_per_unit;
    const T row_place = (v[lane] - grid.v_low) * grid.cells_per_unit;
    // Off the grid nothing stands before the light.
    if (!(column_place >= 0 && column_place < static_cast<T>(grid.columns) && row_place >= 0 &&
          row_place < static_cast<T>(grid.rows)))
      continue;
    const std::size_t cell =
        static_cast<std::size_t>(row_place) * static_cast<std::size_t>(grid.columns) +
        static_cast<std::size_t>(column_place);
    const V point_u = hn::Set(d, u[lane]);
    const V point_v = hn::Set(d, v[lane]);
    const V point_w = hn::Set(d, w[lane]);
    const V own = hn::Set(d, id[lane]);
    const std::size_t end = grid.begins[cell + 1];
    for (std::size_t i = grid.begins[cell]; i < end; i += lanes) {
      if (grid.w[i] <= w[lane]) break;  // this one and all behind it are farther from the light
      const V du = hn::Sub(hn::LoadU(d, &grid.u[i]), point_u);
      const V dv = hn::Sub(hn::LoadU(d, &grid.v[i]), point_v);
      const V distance2 = hn::MulAdd(du, du, hn::Mul(dv, dv));
      const M before = hn::And(hn::Gt(hn::LoadU(d, &grid.w[i]), point_w),
                               hn::Ne(hn::LoadU(d, &grid.id[i]), own));
      const M meets =
          hn::And(hn::Le(distance2, hn::LoadU(d, &grid.radius2[i])), hn::FirstN(d, end - i));
      if (!hn::AllFalse(d, hn::And(before, meets))) {
        dark[lane] = T(1);
        break;
      }
    }
  }
  return hn::Gt(hn::Load(d, dark), hn::Zero(d));
}

/// Distances to a sphere from anywhere outside of it; lanes that leave it do not meet it.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M meets_sphere(D d, const SimdSphere<T>& sphere, const Start<V>& from,
                          const V3<V>& direction, V& b, V& discriminant, V& c) {
  const V zero = hn::Zero(d);
  const V3<V> f = sub(from.point, broadcast(d, sphere.center));
  b = hn::Neg(dot(f, direction));
  const V3<V> l = mul_add(direction, b, f);
  const V radius2 = hn::Set(d, sphere.radius2);
  discriminant = hn::Sub(radius2, dot(l, l));
  c = hn::Max(hn::Sub(dot(f, f), radius2), zero);
  const M other = hn::Ne(from.id, hn::Set(d, static_cast<T>(sphere.id)));
  return hn::And(other, hn::And(hn::Ge(discriminant, zero), hn::Gt(b, zero)));
}

/// The packet against one sphere.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE void show_sphere(D d, const SimdSphere<T>& sphere, const Start<V>& from,
                            const V3<V>& direction, M active, Nearest<V>& nearest) {
  V b;
  V discriminant;
  V c;
  const M hit = hn::And(active, meets_sphere(d, sphere, from, direction, b, discriminant, c));
  if (hn::AllFalse(d, hit)) return;
  const V t = hn::Div(c, hn::Add(b, hn::Sqrt(hn::Max(discriminant, hn::Zero(d)))));
  const V id = hn::Set(d, static_cast<T>(sphere.id));
  take(nearest, is_nearer(nearest, t, id, hit), t, id);
}

template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M meets_plane(D d, const SimdPlane<T>& plane, const Start<V>& from,
                         const V3<V>& direction, V& t) {
  const V3<V> normal = broadcast(d, plane.normal);
  const V height = hn::Set(d, plane.height);
  const V rest = hn::Sub(height, dot(normal, from.point));
  const V noise =
      hn::Mul(hn::Set(d, plane_noise<T>), hn::Add(hn::Abs(height), hn::Abs(hn::Sub(height, rest))));
  t = hn::Div(rest, dot(normal, direction));
  const M other = hn::Ne(from.id, hn::Set(d, static_cast<T>(plane.id)));
  const M apart = hn::Gt(hn::Abs(rest), noise);
  const M ahead =
      hn::And(hn::Gt(t, hn::Zero(d)), hn::Lt(t, hn::Set(d, std::numeric_limits<T>::max())));
  return hn::And(hn::And(other, apart), ahead);
}

/// Distances to a triangle. What lies wholly on or under the tangent plane that a ray leaves
/// cannot be met by it: that settles the triangle itself and its coplanar neighbours by their
/// exact corners, not by the rounded point.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M meets_triangle(D d, const SimdTriangle<T>& triangle, const Start<V>& from,
                            const V3<V>& direction, const AcrossPacket<V>& plane, M active, V& t) {
  M hit = hn::And(active, passes_through(d, triangle, from.point, plane));
  t = hn::Zero(d);
  if (hn::AllFalse(d, hit)) return hit;
  hit = hn::And(hit, meets_plane(d, triangle.plane, from, direction, t));
  const V reach =
      hn::Add(hn::Max(hn::Abs(from.point.x), hn::Abs(from.point.y)), hn::Abs(from.point.z));
  M above = hn::Lt(from.id, hn::Zero(d));  // nothing is under the eye
  for (const Triple<T>* corner : {&triangle.a, &triangle.b, &triangle.c}) {
    const V3<V> to_corner = sub(broadcast(d, *corner), from.point);
    const V size = hn::Set(d, (corner->x < 0 ? -corner->x : corner->x) +
                                  (corner->y < 0 ? -corner->y : corner->y) +
                                  (corner->z < 0 ? -corner->z : corner->z));
    const V noise = hn::Mul(hn::Set(d, plane_noise<T>), hn::Add(size, reach));
    above = hn::Or(above, hn::Gt(dot(from.normal, to_corner), noise));
  }
  return hn::And(hit, above);
}

/// The packet against the tree's triangles, and its spheres too unless those are found otherwise.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE void show_tree(D d, const SimdScene<T>& scene, const Start<V>& from,
                          const V3<V>& direction, M active, bool with_spheres,
                          Nearest<V>& nearest) {
  const auto sphere_count = static_cast<std::uint32_t>(scene.spheres.size());
  const AcrossPacket<V> plane = across_packet(d, direction);
  walk_tree(
      d, scene.tree, from.point, direction, active, nearest.t,
      [&](std::uint32_t begin, std::uint32_t end) HWY_ATTR {
        for (std::uint32_t i = begin; i < end; ++i) {
          const std::uint32_t primitive = scene.tree.order[i];
          if (primitive >= sphere_count) {
            const SimdTriangle<T>& triangle = scene.triangles[primitive - sphere_count];
            V t;
            const M hit = meets_triangle(d, triangle, from, direction, plane, active, t);
            const V id = hn::Set(d, static_cast<T>(triangle.plane.id));
            take(nearest, is_nearer(nearest, t, id, hit), t, id);
          } else if (with_spheres) {
            show_sphere(d, scene.spheres[primitive], from, direction, active, nearest);
          }
        }
      },
      []() HWY_ATTR { return false; });
}

/// The packet against everything but spheres on their own.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE void show_squares_and_planes(D d, const SimdScene<T>& scene, const Start<V>& from,
                                        const V3<V>& direction, M active, Nearest<V>& nearest) {
  for (const SimdPlane<T>& plane : scene.planes) {
    V t;
    const M hit = hn::And(active, meets_plane(d, plane, from, direction, t));
    const V id = hn::Set(d, static_cast<T>(plane.id));
    take(nearest, is_nearer(nearest, t, id, hit), t, id);
  }
  for (const SimdSquare<T>& square : scene.squares) {
    const V to_cells = hn::Set(d, square.cells_per_unit);
    const V3<V> origin =
        mul_add(along_square(square, from.point), to_cells, broadcast(d, square.eye));
    const V id = hn::Set(d, static_cast<T>(square.id));
    const M leaves = hn::Eq(from.id, id);
    const V nowhere = hn::Set(d, std::numeric_limits<T>::max());
    const CellHit<V, M> found = walk_square(
        d, square, origin, along_square(square, direction), hn::Mul(nearest.t, to_cells), active,
        hn::IfThenElse(leaves, from.first, nowhere), hn::IfThenElse(leaves, from.second, nowhere));
    const V t = hn::Mul(found.t, hn::Set(d, square.unit_per_cell));
    const M nearer = is_nearer(nearest, t, id, found.hit);
    take(nearest, nearer, t, id);
    nearest.first = hn::IfThenElse(nearer, found.first, nearest.first);
    nearest.second = hn::IfThenElse(nearer, found.second, nearest.second);
  }
}

/// Lanes of `lit` from which the sphere stands before the light.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M occluded_by(D d, const SimdSphere<T>& sphere, const SimdLight<T>& light,
                         const Start<V>& from, const V3<V>& towards, V distance, M lit) {
  V b;
  V discriminant;
  V c;
  const M hit = hn::And(lit, meets_sphere(d, sphere, from, towards, b, discriminant, c));
  if (light.is_distant || hn::AllFalse(d, hit)) return hit;
  const V t = hn::Div(c, hn::Add(b, hn::Sqrt(hn::Max(discriminant, hn::Zero(d)))));
  return hn::And(hit, hn::Lt(t, distance));
}

/// Lanes of `lit` from which something in the tree stands before the light.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M occluded_in_tree(D d, const SimdScene<T>& scene, const SimdLight<T>& light,
                              const Start<V>& from, const V3<V>& towards, V distance, M lit) {
  const auto sphere_count = static_cast<std::uint32_t>(scene.spheres.size());
  const bool with_spheres = !scene.has_light_grids;
  M dark = hn::Lt(distance, hn::Zero(d));
  const AcrossPacket<V> plane = across_packet(d, towards);
  walk_tree(
      d, scene.tree, from.point, towards, lit, distance,
      [&](std::uint32_t begin, std::uint32_t end) HWY_ATTR {
        for (std::uint32_t i = begin; i < end; ++i) {
          const std::uint32_t primitive = scene.tree.order[i];
          if (primitive >= sphere_count) {
            V t;
            const M hit = meets_triangle(d, scene.triangles[primitive - sphere_count], from,
                                         towards, plane, lit, t);
            dark = hn::Or(dark, hn::And(hit, hn::Lt(t, distance)));
          } else if (with_spheres) {
            dark = hn::Or(dark, occluded_by(d, scene.spheres[primitive], light, from, towards,
                                            distance, lit));
          }
        }
      },
      [&]() HWY_ATTR { return hn::AllTrue(d, hn::Or(dark, hn::Not(lit))); });
  return dark;
}

/// Lanes of `lit` from which something stands before the light, nearer than `distance`.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M occluded(D d, const SimdScene<T>& scene, const SimdLight<T>& light,
                      const Start<V>& from, const V3<V>& towards, V distance, M lit) {
  M dark = hn::Lt(hn::Zero(d), hn::Zero(d));
  if (scene.has_light_grids) dark = occluded_in_grid(d, light.grid, from, lit);
  const bool has_tree = !scene.tree.nodes.empty();
  if (has_tree && (!scene.triangles.empty() || !scene.has_light_grids)) {
    dark = hn::Or(
        dark, occluded_in_tree(d, scene, light, from, towards, distance, hn::AndNot(dark, lit)));
  } else if (!has_tree && !scene.has_light_grids) {
    for (const SimdSphere<T>& sphere : scene.spheres)
      dark = hn::Or(dark, occluded_by(d, sphere, light, from, towards, distance, lit));
  }
  for (const SimdPlane<T>& plane : scene.planes) {
    V t;
    const M hit = meets_plane(d, plane, from, towards, t);
    dark = hn::Or(dark, hn::And(hn::And(lit, hit), hn::Lt(t, distance)));
  }
  for (std::size_t i = 0; i < scene.squares.size(); ++i) {
    const SimdSquare<T>& square = scene.squares[i];
    const Stencil<T>& stencil = light.stencils[i];
    const V3<V> along = along_square(square, towards);
    const M leaves = hn::Eq(from.id, hn::Set(d, static_cast<T>(square.id)));
    M rest = hn::AndNot(dark, lit);
    if (stencil.suffices) {
      const M neighbours = hn::And(rest, leaves);
      if (!hn::AllFalse(d, neighbours))
        dark = hn::Or(dark,
                      shadowed_by_neighbours(d, square, stencil, from.first, from.second,
                                             along_square(square, from.normal), along, neighbours));
      rest = hn::AndNot(leaves, rest);
    }
    if (hn::AllFalse(d, rest)) continue;
    const V to_cells = hn::Set(d, square.cells_per_unit);
    const V3<V> origin =
        mul_add(along_square(square, from.point), to_cells, broadcast(d, square.eye));
    const V nowhere = hn::Set(d, std::numeric_limits<T>::max());
    const CellHit<V, M> found = walk_square(d, square, origin, along, hn::Mul(distance, to_cells),
                                            rest, hn::IfThenElse(leaves, from.first, nowhere),
                                            hn::IfThenElse(leaves, from.second, nowhere));
    const M before = hn::Lt(found.t, hn::Mul(distance, to_cells));
    dark = hn::Or(dark, hn::And(found.hit, before));
  }
  return dark;
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
