#include "engine/plan/shadow_reach.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/parallel/sum.h"
#include "engine/plan/precision.h"
#include "engine/plan/scene_statistics.h"

namespace raytracer {
namespace {

/// How far from the eye a box reaches.
double farthest_of(const Box& box) {
  return length({std::max(std::abs(box.low.x), std::abs(box.high.x)),
                 std::max(std::abs(box.low.y), std::abs(box.high.y)),
                 std::max(std::abs(box.low.z), std::abs(box.high.z))});
}

/// From which distances an occluder's place is rounded, at most: the eye's or, of a light that is
/// not far from what it shines on, that as well.
double rounded_path(double from_eye, const PackedLight& light, double farthest) {
  const bool is_near = light.has_place() && !is_far_light(light.place, farthest);
  return is_near ? from_eye + length(light.place) : from_eye;
}

/// ShadowReach::growth under one light, each occluder's path being its own; none is farther than
/// `farthest`.
template <class Occluders>
double growth_under(const PackedLight& light, const Occluders& occluders, double farthest,
                    double nearest, WorkerPool* pool) {
  return largest_of(occluders, pool, [&](const auto& primitive, double largest) {
    const double from_eye = std::min(farthest, farthest_of(bounds(primitive)));
    const double path = rounded_path(from_eye, light, farthest);
    if (path <= largest * nearest) return largest;
    return path / std::max(shadow_edge_distance(primitive, light), nearest);
  });
}

/// The occluders of a kind whose shadows single may displace by more than is tolerated.
template <class Kind>
struct FarOccluders {
  static constexpr std::size_t most = 1000;   ///< Chosen: far more than a scene has wide ones.
  std::vector<typename Kind::Primitive> all;  ///< rather some more than `most` than all of them
  double farthest_other = 0;                  ///< from the eye

  void include(const FarOccluders& other) {
    if (all.size() <= most) all.insert(all.end(), other.all.begin(), other.all.end());
    farthest_other = std::max(farthest_other, other.farthest_other);
  }
  bool are_few() const { return all.size() <= most; }
};

/// Those that are farther away than `tolerated`.
template <class Kind>
FarOccluders<Kind> far_occluders(const PackedScene& packed, double farthest, double tolerated,
                                 WorkerPool* pool) {
  const auto& primitives = of_kind<Kind>(packed.primitives);
  const auto add = [&](std::size_t begin, std::size_t end, FarOccluders<Kind>& far) {
    for (std::size_t i = begin; i < end && far.are_few(); ++i) {
      const double distance = std::min(farthest, farthest_of(bounds(primitives[i])));
      if (distance > tolerated)
        far.all.push_back(primitives[i]);
      else
        far.farthest_other = std::max(far.farthest_other, distance);
    }
  };
  return sum_in_parts<FarOccluders<Kind>>(primitives.size(), pool, add);
}

/// Under a soft light whose rays share directions: the mean of what each of them gives, as each
/// brings as small a part of the light. A sky's N directions are so far from each other that no two
/// of their edges meet: each being wrong by an N-th of the light, their squared error is an N-th of
/// that of a light's edge that is displaced by the mean.
template <class Occluders>
double growth_under(const SoftLight& soft, const Occluders& occluders, double farthest,
                    double nearest) {
  constexpr std::size_t most_places = 16;  // Chosen: edges near the eye are those of several.
  const bool is_sky = soft.light.shape == LightShape::sky;
  const std::size_t places = std::min(soft.places.size(), most_places);
  PackedLight light = soft.light;
  light.shape = LightShape::point;
  double sum = 0;
  for (std::size_t i = 0; i < places; ++i)
    for (const double end : {1.0, -1.0}) {
      light.place = end * soft.places[i];
      if (is_sky || end > 0) sum += growth_under(light, occluders, farthest, nearest, nullptr);
    }
  const auto count = static_cast<double>(places);
  return is_sky ? sum / (2 * count) / static_cast<double>(soft.numbers.per_set) : sum / count;
}

/// Under all lights whose rays from many points are looked for together.
template <class Kind>
double growth_in_view_of_lights(const PackedScene& packed, double farthest,
                                const SceneStatistics& statistics, WorkerPool* pool) {
  const double nearest = statistics.nearest_edge();
  double growth = 0;
  for (const PackedLight& light : packed.lights)
    growth = std::max(
        growth, growth_under(light, of_kind<Kind>(packed.primitives), farthest, nearest, pool));
  const bool has_shared =
      std::any_of(packed.soft_lights.begin(), packed.soft_lights.end(),
                  [](const SoftLight& soft) { return soft.light.rays == LightRays::parallel; });
  if (!has_shared) return growth;
  const double tolerated = Kind::tolerance_px / direction_error_in_single(statistics) - 1;
  const auto far = far_occluders<Kind>(packed, farthest, tolerated * nearest, pool);
  if (!far.are_few()) return farthest / nearest;
  growth = std::max(growth, far.farthest_other / nearest);
  for (const SoftLight& soft : packed.soft_lights)
    if (soft.light.rays == LightRays::parallel)
      growth = std::max(growth, growth_under(soft, far.all, farthest, nearest));
  return growth;
}

/// Of a kind that others find. Shadows of soft lights are exact of nothing. What rays meet that are
/// looked for one by one is displaced also where no edge is; mirrors show it no nearer than it is
/// to the eye, and what they magnify is the affair of SceneStatistics::magnification.
template <class Kind>
ShadowReach found_shadow_reach(const PackedScene& packed, const Features& features,
                               const SceneStatistics& statistics, WorkerPool* pool) {
  const bool from_points =
      is_sought_from_points<Kind>(of_kind<Kind>(packed.primitives).size(), statistics.pixels);
  if (Kind::has_exact_shadows && packed.soft_lights.empty() && !from_points) return {};
  const GeometryStatistics& own = statistics.kinds[kind_index<Kind>];
  const double nearest = statistics.nearest_edge();
  if constexpr (HasShadowEdges<Kind>) {
    double growth = growth_in_view_of_lights<Kind>(packed, own.farthest, statistics, pool);
    if (features.reflects || features.transmits || features.light_count(LightRays::neither) > 0)
      growth = std::max(growth, own.meeting_distance() / nearest);
    return {own.farthest, growth};
  }
  return {own.farthest, own.farthest / nearest};
}

/// Of a kind that finds its own parts.
template <class Kind>
ShadowReach own_shadow_reach(const PackedScene& packed, const SceneStatistics& statistics) {
  double longest = 0;
  if (of_kind<Kind>(packed.primitives).empty()) return {};
  Box box;
  for_each_kind([&]<class Other>(std::type_identity<Other>) {
    for (const auto& other : of_kind<Other>(packed.primitives)) box.include(bounds(other));
  });
  if (!packed.soft_lights.empty()) longest = 2 * statistics.farthest;
  for (const auto& primitive : of_kind<Kind>(packed.primitives))
    for (const PackedLight& light : packed.lights) {
      double path = infinity;
      if (light.rays == LightRays::parallel) path = shadow_path(primitive, light.place, box);
      longest = std::max(longest, std::min(path, 2 * statistics.farthest));
    }
  return {longest, longest / statistics.nearest_edge()};
}

}  // namespace

std::array<ShadowReach, ObjectKinds::count> shadow_reaches(const PackedScene& packed,
                                                           const Features& features,
                                                           const SceneStatistics& statistics,
                                                           WorkerPool* pool) {
  std::array<ShadowReach, ObjectKinds::count> reaches;
  for_each_kind([&]<class Kind>(std::type_identity<Kind>) {
    ShadowReach& reach = reaches[kind_index<Kind>];
    if constexpr (Kind::search == Search::own)
      reach = own_shadow_reach<Kind>(packed, statistics);
    else
      reach = found_shadow_reach<Kind>(packed, features, statistics, pool);
  });
  return reaches;
}

}  // namespace raytracer
