// What a ray meets, in numbers of 113 bits and by brute force: the objects of the oracle.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "engine/engine.h"
#include "tests/extremes/quad.h"
#include "tests/extremes/rough_ray.h"

namespace raytracer::extremes {

/// Relative: what differs by less is the same.
inline constexpr double same = 1e-24;

inline QuadVec relative(const Vec3& point, const Vec3& eye) {
  return QuadVec(point) - QuadVec(eye);
}

inline Quad& component(QuadVec& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }
inline Quad component(const QuadVec& v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/// Where a ray leaves from, or what it has met.
struct OraclePlace {
  enum class Kind { none, sphere_outside, sphere_inside, flat };

  Kind kind = Kind::none;
  std::size_t object = 0;
  std::size_t part = 0;
  QuadVec point;    ///< relative to the eye
  QuadVec normal;   ///< unit, towards where the ray came from
  QuadVec shading;  ///< likewise, as it shades; zero: the same
  QuadVec tint;     ///< the colour that corners tell
  bool is_tinted = false;
  bool is_inside = false;  ///< met from the inside, or from behind
  bool has_inside = true;
  Quad radius = 0;
  Quad t = 0;

  const QuadVec& shading_normal() const { return dot(shading, shading) > 0 ? shading : normal; }

  /// The same, left to its other side.
  OraclePlace other_side() const {
    OraclePlace other = *this;
    if (kind == Kind::sphere_outside) other.kind = Kind::sphere_inside;
    if (kind == Kind::sphere_inside) other.kind = Kind::sphere_outside;
    other.normal = normal * Quad(-1);
    other.is_inside = !is_inside;
    return other;
  }
};

/// One ray through all objects, for the nearest that it meets.
class OracleSearch {
 public:
  OracleSearch(const Scene& scene, const OraclePlace& from, const QuadVec& direction)
      : scene_(scene),
        from_(from),
        direction_(direction),
        least_t_(same * length(from.point)),
        rough_(scene.camera.origin, from.point, direction) {}

  /// The nearest at t > 0; of kind none if nothing is met.
  OraclePlace nearest() {
    for (object_ = 0; object_ < scene_.objects.size(); ++object_)
      std::visit([this](const auto& shape) { show(shape); }, scene_.objects[object_].shape);
    return best_;
  }

 private:
  bool leaves(std::size_t part) const {
    return from_.kind != OraclePlace::Kind::none && from_.object == object_ && from_.part == part;
  }

  /// Farther than what rounding makes of 0, and nearer than the best by more than it.
  bool counts(Quad t) const {
    if (!(t > least_t_)) return false;
    return best_.kind == OraclePlace::Kind::none || t < best_.t * (1 - same);
  }

  void take(OraclePlace::Kind kind, std::size_t part, Quad t, const QuadVec& normal, Quad radius) {
    best_ = {kind,
             object_,
             part,
             from_.point + direction_ * t,
             normal,
             {},
             {},
             false,
             kind == OraclePlace::Kind::sphere_inside,
             true,
             radius,
             t};
    ++best_count_;
  }

  void intersect_sphere(const QuadVec& center, Quad radius, std::size_t part) {
    const QuadVec f = from_.point - center;
    const Quad b = -dot(f, direction_);
    if (leaves(part)) {
      // A sphere does not hide itself; from inside its other side is met.
      if (from_.kind == OraclePlace::Kind::sphere_outside) return;
      take_sphere(center, radius, part, 2 * b, true);
      return;
    }
    const QuadVec across = f + direction_ * b;
    const Quad room = radius * radius - dot(across, across);
    if (room < 0) return;
    const Quad half = square_root(room);
    const Quad c = dot(f, f) - radius * radius;
    if (c > 0) {
      if (b > 0) take_sphere(center, radius, part, c / (b + half), false);
      return;
    }
    const Quad t = b >= 0 ? b + half : c / (b - half);
    take_sphere(center, radius, part, t, true);
  }

  void take_sphere(const QuadVec& center, Quad radius, std::size_t part, Quad t, bool inside) {
    if (!counts(t)) return;
    const QuadVec outward = unit(from_.point + direction_ * t - center);
    take(inside ? OraclePlace::Kind::sphere_inside : OraclePlace::Kind::sphere_outside, part, t,
         inside ? outward * Quad(-1) : outward, radius);
  }

  void intersect_plane(const QuadVec& point, const QuadVec& normal, std::size_t part) {
    if (leaves(part)) return;
    const Quad slope = dot(normal, direction_);
    if (slope == 0) return;
    const Quad t = dot(normal, point - from_.point) / slope;
    if (!counts(t)) return;
    take(OraclePlace::Kind::flat, part, t, slope > 0 ? normal * Quad(-1) : normal, 0);
    best_.is_inside = slope > 0;
  }

  void show(const Sphere& s) { show_sphere(s.center, s.radius, 0); }

  void show(const Spheres& s) {
    for (std::size_t i = 0; i < s.centers.size(); ++i) show_sphere(s.centers[i], s.radius(i), i);
  }

  void show_sphere(const Vec3& center, double radius, std::size_t part) {
    if (!rough_.passes_by(center, radius)) intersect_sphere(relative(center, eye()), radius, part);
  }

  void show(const Plane& p) {
    const bool has_met = best_.kind != OraclePlace::Kind::none;
    if (leaves(0) || rough_.does_not_reach(p, has_met ? std::optional(best_.t) : std::nullopt))
      return;
    intersect_plane(relative(p.point, eye()), unit(QuadVec(p.normal)), 0);
  }

  void show(const Mesh& m) {
    for (std::size_t i = 0; i < m.triangles.size(); ++i) {
      const Vec3& first = m.vertices[m.triangles[i][0]];
      const RoughVec second(first, m.vertices[m.triangles[i][1]]);
      const RoughVec third(first, m.vertices[m.triangles[i][2]]);
      if (rough_.passes_by(first, std::sqrt(std::max(dot(second, second), dot(third, third)))))
        continue;
      std::array<QuadVec, 3> corners;
      for (std::size_t k = 0; k < 3; ++k)
        corners[k] = relative(m.vertices[m.triangles[i][k]], eye());
      const std::size_t before = best_count_;
      intersect_triangle(corners, i);
      if (best_count_ > before) take_corner_values(m, corners, i);
    }
  }

  /// What the corners of the nearest, triangle i of a mesh, tell where it is met.
  void take_corner_values(const Mesh& m, const std::array<QuadVec, 3>& corners, std::size_t i) {
    const QuadVec across = cross(corners[1] - corners[0], corners[2] - corners[0]);
    const Quad area = dot(across, across);
    QuadVec normal;
    QuadVec tint;
    for (std::size_t k = 0; k < 3; ++k) {
      const QuadVec side = corners[(k + 2) % 3] - corners[(k + 1) % 3];
      const Quad weight = dot(across, cross(side, best_.point - corners[(k + 1) % 3])) / area;
      const std::size_t corner = m.triangles[i][k];
      if (!m.normals.empty()) normal = normal + QuadVec(m.normals[corner]) * weight;
      if (!m.vertex_colors.empty()) tint = tint + QuadVec(m.vertex_colors[corner]) * weight;
    }
    best_.shading = unit(normal) * (dot(across, best_.normal) < 0 ? -1 : 1);
    best_.tint = tint;
    best_.is_tinted = !m.vertex_colors.empty();
  }

  void intersect_triangle(const std::array<QuadVec, 3>& corners, std::size_t part) {
    const QuadVec normal = unit(cross(corners[1] - corners[0], corners[2] - corners[0]));
    if (dot(normal, normal) == 0) return;
    bool left = true;
    bool right = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const QuadVec a = corners[k] - from_.point;
      const QuadVec b = corners[(k + 1) % 3] - from_.point;
      const Quad side = dot(cross(a, b), direction_);
      const Quad noise = same * length(a) * length(b);
      left = left && side >= -noise;
      right = right && side <= noise;
    }
    if (left || right) intersect_plane(corners[0], normal, part);
  }

  void show(const Cylinder& c) { intersect_cone({c.from, c.to, c.radius, c.radius, c.caps}, 0); }

  void show(const Cylinders& c) {
    for (std::size_t i = 0; i < c.from.size(); ++i)
      intersect_cone({c.from[i], c.to[i], c.radius(i), c.radius(i), c.caps}, i);
  }

  void show(const Cone& c) { intersect_cone(c, 0); }

  void show(const Cones& c) {
    for (std::size_t i = 0; i < c.from.size(); ++i)
      intersect_cone({c.from[i], c.to[i], c.radius_from(i), c.radius_to(i), c.caps}, i);
  }

  /// Side and caps, each root on its own; what leaves the outside does not meet it again.
  void intersect_cone(const Cone& cone, std::size_t part) {
    if (leaves(part) && from_.kind != OraclePlace::Kind::sphere_inside) return;
    const RoughVec from_end_to_end(cone.from, cone.to);
    const double widest = std::max(cone.radius_from, cone.radius_to);
    if (rough_.passes_by(cone.from, std::sqrt(dot(from_end_to_end, from_end_to_end)) + widest))
      return;
    const QuadVec along = QuadVec(cone.to) - QuadVec(cone.from);
    const Quad size = length(along);
    const QuadVec axis = unit(along);
    const Quad widening = (Quad(cone.radius_to) - Quad(cone.radius_from)) / size;
    const QuadVec f = from_.point - relative(cone.from, eye());
    const Quad f_along = dot(f, axis);
    const Quad d_along = dot(direction_, axis);
    const QuadVec across = f - axis * f_along;
    const QuadVec slope = direction_ - axis * d_along;
    const Quad radius = cone.radius_from + widening * f_along;
    const Quad growth = widening * d_along;
    const Quad a = dot(slope, slope) - growth * growth;
    const Quad b = radius * growth - dot(across, slope);
    const Quad c = dot(across, across) - radius * radius;
    const Quad room = b * b - a * c;
    const Quad s = square_root(room);
    const Quad q = b >= 0 ? b + s : b - s;
    if (room >= 0 && q != 0) {
      const std::array<Quad, 2> roots{c / q, a != 0 ? q / a : c / q};
      for (const Quad t : roots) {
        const Quad place = f_along + t * d_along;
        if (!(place >= 0 && place <= size) || !counts(t)) continue;
        const QuadVec outward = unit(unit(across + slope * t) - axis * widening);
        const bool inside = dot(outward, direction_) > 0;
        take(inside ? OraclePlace::Kind::sphere_inside : OraclePlace::Kind::sphere_outside, part, t,
             inside ? outward * Quad(-1) : outward, 0);
        best_.has_inside = cone.caps;
      }
    }
    if (!cone.caps || d_along == 0) return;
    for (const bool is_to : {false, true}) {
      const Quad t = ((is_to ? size : Quad(0)) - f_along) / d_along;
      const QuadVec at = across + slope * t;
      const Quad rim = is_to ? cone.radius_to : cone.radius_from;
      if (!(dot(at, at) < rim * rim) || !counts(t)) continue;
      const bool inside = is_to == (d_along > 0);
      take(inside ? OraclePlace::Kind::sphere_inside : OraclePlace::Kind::sphere_outside, part, t,
           d_along > 0 ? axis * Quad(-1) : axis, 0);
    }
  }

  void show(const SphereSquare& s) {
    constexpr std::array<std::array<int, 3>, 3> axes{{{0, 2, 1}, {0, 1, 2}, {1, 2, 0}}};
    // No structured binding: clang before 16 lets no lambda capture one.
    const std::array<int, 3>& order = axes[static_cast<std::size_t>(s.axes)];
    const int first = order[0];
    const int second = order[1];
    const int across = order[2];
    const QuadVec middle = relative(s.center, eye());
    const Quad r = s.radius;
    const std::int64_t side = 2 * s.n;
    const auto show_cell = [&](std::int64_t i, std::int64_t k) {
      QuadVec center = middle;
      component(center, first) += r * static_cast<Quad>(2 * i + 1 - side);
      component(center, second) += r * static_cast<Quad>(2 * k + 1 - side);
      intersect_sphere(center, r, static_cast<std::size_t>(i * side + k));
    };
    if (side <= 8) {
      for (std::int64_t i = 0; i < side; ++i)
        for (std::int64_t k = 0; k < side; ++k) show_cell(i, k);
      return;
    }
    walk_cells(middle, r, side, {first, second, across}, show_cell);
  }

  /// Shows the cells that the ray is above or below, in its order, until it has met something
  /// nearer than the next.
  template <typename ShowCell>
  void walk_cells(const QuadVec& middle, Quad r, std::int64_t side, const std::array<int, 3>& axes,
                  const ShowCell& show_cell) {
    const QuadVec from = from_.point - middle;
    const Quad half = r * static_cast<Quad>(side);
    Quad begin = 0;
    Quad end = best_.kind == OraclePlace::Kind::none ? Quad(1e300) * Quad(1e300) : best_.t;
    for (const int axis : axes) {
      const Quad reach = (axis == axes[2] ? r : half) * (1 + Quad(same));
      const Quad slope = component(direction_, axis);
      const Quad place = component(from, axis);
      if (slope == 0) {
        if (absolute(place) > reach) return;
        continue;
      }
      const Quad t1 = (-reach - place) / slope;
      const Quad t2 = (reach - place) / slope;
      begin = std::max(begin, std::min(t1, t2));
      end = std::min(end, std::max(t1, t2));
    }
    if (begin > end) return;

    std::array<std::int64_t, 2> cell{};
    for (std::size_t k = 0; k < 2; ++k) {
      const Quad at = component(from, axes[k]) + begin * component(direction_, axes[k]);
      const auto index = static_cast<std::int64_t>((at + half) / (2 * r));
      cell[k] = std::clamp<std::int64_t>(index, 0, side - 1);
    }
    for (;;) {
      show_cell(cell[0], cell[1]);
      std::size_t nearer = 0;
      std::array<Quad, 2> leave{};
      for (std::size_t k = 0; k < 2; ++k) {
        const Quad slope = component(direction_, axes[k]);
        const Quad border = 2 * r * static_cast<Quad>(cell[k] + (slope > 0 ? 1 : 0)) - half;
        leave[k] = slope == 0 ? 2 * end + 1 : (border - component(from, axes[k])) / slope;
      }
      if (leave[1] < leave[0]) nearer = 1;
      if (leave[nearer] > end) return;
      if (best_.kind != OraclePlace::Kind::none && best_.object == object_) return;
      cell[nearer] += component(direction_, axes[nearer]) > 0 ? 1 : -1;
      if (cell[nearer] < 0 || cell[nearer] >= side) return;
    }
  }

  const Vec3& eye() const { return scene_.camera.origin; }

  const Scene& scene_;
  const OraclePlace& from_;
  const QuadVec direction_;
  const Quad least_t_;  ///< what rounding makes of 0
  const RoughRay rough_;
  std::size_t object_ = 0;
  OraclePlace best_;
  std::size_t best_count_ = 0;  ///< how often it has changed
};

}  // namespace raytracer::extremes
