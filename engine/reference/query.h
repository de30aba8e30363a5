// The two questions a ray asks: what does it hit first, and is anything on its way.
//
// A query is handed primitives one by one, in any order, by a finder that decides which of them are
// worth it; the answer does not depend on the order.
#pragma once

#include "engine/math/ray.h"
#include "engine/objects/objects.h"

namespace raytracer {

/// The nearest hit, at equal distances that which comes first in the document.
class NearestHit {
 public:
  explicit NearestHit(const Ray& ray) : ray_(ray) {}
  explicit NearestHit(Ray&&) = delete;  // it is referred to

  template <typename Primitive>
  void add(const Primitive& primitive) {
    const auto hit = intersect(ray_, primitive);
    if (!hit) return;
    const bool is_first_of_equals = hit->t == t_ && found() && hit->point.id < point_.id;
    if (!(hit->t < t_) && !is_first_of_equals) return;
    t_ = hit->t;
    point_ = hit->point;
  }

  const Ray& ray() const { return ray_; }
  /// Beyond this distance nothing matters any more.
  const double& t_max() const { return t_; }
  bool is_settled() const { return false; }

  bool found() const { return t_ < infinity; }
  /// The point that was hit, its normal turned towards the ray's origin.
  const SurfacePoint& point() const { return point_; }

 private:
  const Ray& ray_;
  double t_ = infinity;
  SurfacePoint point_;
};

/// Whether anything is hit nearer than t_max.
class AnyHit {
 public:
  AnyHit(const Ray& ray, double t_max) : ray_(ray), t_max_(t_max) {}
  AnyHit(Ray&&, double) = delete;  // it is referred to

  template <typename Primitive>
  void add(const Primitive& primitive) {
    const auto hit = intersect(ray_, primitive);
    found_ = found_ || (hit && hit->t < t_max_);
  }

  const Ray& ray() const { return ray_; }
  const double& t_max() const { return t_max_; }
  bool is_settled() const { return found_; }

  bool found() const { return found_; }

 private:
  const Ray& ray_;
  double t_max_;
  bool found_ = false;
};

/// What comes through everything nearer than t_max: the product of the transparencies of the
/// surfaces on the way, as transparency_of(id) tells them.
template <typename TransparencyOf>
class Transmission {
 public:
  Transmission(const Ray& ray, double t_max, const TransparencyOf& transparency_of)
      : ray_(ray), t_max_(t_max), transparency_of_(transparency_of) {}

  /// Of each primitive alone: where two coincide, both count.
  template <typename Primitive>
  void add(const Primitive& primitive) {
    Ray ray = ray_;
    double t = 0;
    while (share_ > 0) {
      const auto hit = intersect(ray, primitive);
      if (!hit) return;
      t += hit->t;
      if (!(t < t_max_)) return;
      share_ *= transparency_of_(hit->point.id);
      ray.origin = other_side(hit->point);
    }
  }

  const Ray& ray() const { return ray_; }
  const double& t_max() const { return t_max_; }
  bool is_settled() const { return share_ == 0; }

  double share() const { return share_; }

 private:
  const Ray& ray_;
  double t_max_;
  const TransparencyOf& transparency_of_;
  double share_ = 1;
};

}  // namespace raytracer
