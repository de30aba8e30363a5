// The two questions a ray asks: what does it meet first, and is anything on its way.
//
// A query is shown primitives one by one, in any order, by a structure that decides which of them
// are worth showing; the answer does not depend on the order.
#pragma once

#include <limits>

#include "engine/math/ray.h"
#include "engine/pack/packed_scene.h"

namespace raytracer {

/// The nearest hit, at equal distances that which comes first in the document.
class NearestHit {
 public:
  explicit NearestHit(const Ray& ray) : ray_(ray) {}
  explicit NearestHit(Ray&&) = delete;  // it is referred to

  void show(const PackedSphere& sphere);
  void show(const PackedSquare& square);
  void show(const PackedPlane& plane);
  void show(const PackedTriangle& triangle);

  const Ray& ray() const { return ray_; }
  /// Beyond this distance nothing matters any more.
  double t_max() const { return t_; }
  bool is_settled() const { return false; }

  bool found() const { return t_ < std::numeric_limits<double>::infinity(); }
  /// The point that was hit, its normal turned towards the ray's origin.
  const Departure& surface() const { return surface_; }

 private:
  bool is_nearer(double t, const PrimitiveId& id) const {
    return t < t_ || (t == t_ && found() && id < surface_.id);
  }
  void take_sphere(double t, const PrimitiveId& id, const Vec3& center, double radius,
                   const Vec3& outward, bool inside);
  void take_flat(double t, const PrimitiveId& id, const Vec3& plane_point, const Vec3& normal);

  const Ray& ray_;
  double t_ = std::numeric_limits<double>::infinity();
  Departure surface_;
};

/// Whether anything is met nearer than t_max.
class AnyHit {
 public:
  AnyHit(const Ray& ray, double t_max) : ray_(ray), t_max_(t_max) {}
  AnyHit(Ray&&, double) = delete;  // it is referred to

  void show(const PackedSphere& sphere);
  void show(const PackedSquare& square);
  void show(const PackedPlane& plane);
  void show(const PackedTriangle& triangle);

  const Ray& ray() const { return ray_; }
  double t_max() const { return t_max_; }
  bool is_settled() const { return found_; }

  bool found() const { return found_; }

 private:
  const Ray& ray_;
  double t_max_;
  bool found_ = false;
};

}  // namespace raytracer
