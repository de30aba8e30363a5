// Packets of rays through Embree, whole or one ray at a time, and through the planes beside it.
//
// Only embree_kernel.cpp may include this; it says why.
#pragma once

#include <embree3/rtcore.h>
#include <immintrin.h>

#include "tests/measure/peers/embree_kernel.h"
#include "tests/measure/peers/embree_lanes.h"

namespace raytracer::peers {

constexpr float far_away = 1e30F;

template <int width>
struct Packet;

template <>
struct Packet<4> {
  using RayHit = RTCRayHit4;
  using Ray = RTCRay4;
  static constexpr auto intersect = rtcIntersect4;
  static constexpr auto occluded = rtcOccluded4;
  static constexpr int columns = 2;
};

template <>
struct Packet<8> {
  using RayHit = RTCRayHit8;
  using Ray = RTCRay8;
  static constexpr auto intersect = rtcIntersect8;
  static constexpr auto occluded = rtcOccluded8;
  static constexpr int columns = 4;
};

template <>
struct Packet<16> {
  using RayHit = RTCRayHit16;
  using Ray = RTCRay16;
  static constexpr auto intersect = rtcIntersect16;
  static constexpr auto occluded = rtcOccluded16;
  static constexpr int columns = 4;
};

/// Every function takes `width` rays, a mask of those that matter, and how often they were
/// reflected before.
template <int width>
class RayCaster : Lanes<width> {
 public:
  using typename Lanes<width>::F;
  using typename Lanes<width>::M;
  using typename Lanes<width>::Vector;
  using RayHit = typename Packet<width>::RayHit;

  RayCaster(const EmbreeFrame& frame, EmbreeMode mode) : frame_(frame), mode_(mode) {
    rtcInitIntersectContext(&primary_);
    rtcInitIntersectContext(&secondary_);
    if (mode == EmbreeMode::coherent_packets || mode == EmbreeMode::narrow_packets)
      primary_.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    else
      primary_.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    secondary_.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  }

  /// What the rays meet: tfar, geomID (planes count on from the geometries) and Ng are filled in.
  RayHit intersect(const Vector& origin, const Vector& direction, M active, int depth) {
    RayHit hit;
    prepare(hit.ray, origin, direction, splat(far_away));
    for (int i = 0; i < width; ++i) {
      hit.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      hit.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    RTCIntersectContext& context = depth == 0 ? primary_ : secondary_;
    if (mode_ != EmbreeMode::single_rays) {
      alignas(64) int valid[width];
      memcpy(valid, &active, sizeof valid);
      Packet<width>::intersect(valid, frame_.scene, &context, &hit);
    } else {
      for (int i = 0; i < width; ++i)
        if (active[i]) intersect_one(hit, i, context);
    }
    for (int i = 0; i < frame_.plane_count; ++i) intersect_plane(hit, i, active);
    return hit;
  }

  /// Which of the rays meet anything nearer than `reach`.
  M occluded(const Vector& origin, const Vector& direction, F reach, M active, int depth) {
    Ray ray;
    prepare(ray, origin, direction, reach);
    M blocked{};
    for (int i = 0; i < frame_.plane_count; ++i) {
      const F t = distance(ray, frame_.planes[i]);
      blocked |= active & (t > 0.0F) & (t < reach);
    }
    active &= ~blocked;
    if (!any(active)) return blocked;

    RTCIntersectContext& context = depth == 0 ? primary_ : secondary_;
    if (mode_ != EmbreeMode::single_rays) {
      alignas(64) int valid[width];
      memcpy(valid, &active, sizeof valid);
      Packet<width>::occluded(valid, frame_.scene, &context, &ray);
    } else {
      for (int i = 0; i < width; ++i) {
        if (!active[i]) continue;
        RTCRay one = single_ray(ray, i);
        rtcOccluded1(frame_.scene, &context, &one);
        ray.tfar[i] = one.tfar;
      }
    }
    return blocked | (active & (load(ray.tfar) < 0.0F));
  }

 private:
  using Ray = typename Packet<width>::Ray;
  using Lanes<width>::any;
  using Lanes<width>::load;
  using Lanes<width>::splat;
  using Lanes<width>::store;

  static void prepare(Ray& ray, const Vector& origin, const Vector& direction, F reach) {
    store(ray.org_x, ray.org_y, ray.org_z, origin);
    store(ray.dir_x, ray.dir_y, ray.dir_z, direction);
    store(ray.tnear, F{});
    store(ray.tfar, reach);
    store(ray.time, F{});
    for (int i = 0; i < width; ++i) {
      ray.mask[i] = ~0U;
      ray.id[i] = 0;
      ray.flags[i] = 0;
    }
  }

  void intersect_one(RayHit& hit, int i, RTCIntersectContext& context) {
    RTCRayHit one;
    one.ray = single_ray(hit.ray, i);
    one.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    one.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(frame_.scene, &context, &one);
    hit.ray.tfar[i] = one.ray.tfar;
    hit.hit.geomID[i] = one.hit.geomID;
    hit.hit.Ng_x[i] = one.hit.Ng_x;
    hit.hit.Ng_y[i] = one.hit.Ng_y;
    hit.hit.Ng_z[i] = one.hit.Ng_z;
  }

  void intersect_plane(RayHit& hit, int index, M active) const {
    const EmbreePlane& plane = frame_.planes[index];
    const F t = distance(hit.ray, plane);
    const F t_before = load(hit.ray.tfar);
    const M nearer = active & (t > 0.0F) & (t < t_before);
    if (!any(nearer)) return;
    store(hit.ray.tfar, nearer ? t : t_before);
    for (int i = 0; i < width; ++i) {
      if (!nearer[i]) continue;
      hit.hit.geomID[i] = static_cast<unsigned>(frame_.geometry_count + index);
      hit.hit.Ng_x[i] = plane.normal[0];
      hit.hit.Ng_y[i] = plane.normal[1];
      hit.hit.Ng_z[i] = plane.normal[2];
    }
  }

  /// Four numbers at a time: Embree loads them so, right after, and would wait for smaller stores.
  static RTCRay single_ray(const Ray& ray, int i) {
    RTCRay one;
    _mm_store_ps(&one.org_x, _mm_setr_ps(ray.org_x[i], ray.org_y[i], ray.org_z[i], 0));
    _mm_store_ps(&one.dir_x, _mm_setr_ps(ray.dir_x[i], ray.dir_y[i], ray.dir_z[i], 0));
    one.tfar = ray.tfar[i];
    one.mask = ~0U;
    one.id = 0;
    one.flags = 0;
    return one;
  }

  static F distance(const Ray& ray, const EmbreePlane& plane) {
    const F height = load(ray.org_x) * plane.normal[0] + load(ray.org_y) * plane.normal[1] +
                     load(ray.org_z) * plane.normal[2] - plane.offset;
    const F slope = load(ray.dir_x) * plane.normal[0] + load(ray.dir_y) * plane.normal[1] +
                    load(ray.dir_z) * plane.normal[2];
    const F t = -height / slope;
    return slope == 0.0F ? splat(-1) : t;
  }

  const EmbreeFrame& frame_;
  EmbreeMode mode_;
  RTCIntersectContext primary_;    ///< for rays from the eye and the shadow rays where they end
  RTCIntersectContext secondary_;  ///< for what was reflected
};

}  // namespace raytracer::peers
