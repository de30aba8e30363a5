#include "engine/plan/finders.h"

namespace raytracer {
namespace {

// Random spheres under two lights, each tried one ray at a time, over a tree's time: 0.90 to 0.94
// with 2 to 6 spheres, 1.04 with 8, 1.15 with 12, 1.9 with 32.
constexpr std::size_t few_for_single_rays = 7;

// Random spheres under a sky, sweeps against grids, in processor time: 1.1 with 1,000, 0.65 with
// 7,381 and 0.53 with 100,000.
constexpr std::size_t few_for_sweeps = 2000;

/// The entries that screen bins of so many primitives may have: of 12 bytes, so that they take no
/// more memory than the primitives themselves.
double most_blocks(std::size_t primitives) { return 1e6 + 8 * static_cast<double>(primitives); }

template <class Kind>
bool can_be_swept(std::size_t count) {
  return Kind::has_light_sweep && count > few_for_sweeps;
}

/// Of a bounded kind.
template <class Kind>
FinderRow choose_structures(std::size_t count, double blocks, const SoftLightSearch& search,
                            double pixels) {
  const bool are_few = count <= Kind::few.to_lights;
  FinderRow row;
  const auto set = [&](RayKind rays, Finder finder) {
    row[static_cast<std::size_t>(rays)] = finder;
  };
  set(RayKind::from_eye, blocks <= most_blocks(count) ? Finder::screen_bins : Finder::tree);
  set(RayKind::to_distant_light, are_few ? Finder::one_by_one : Finder::light_grid);
  const double listed = static_cast<double>(count) * static_cast<double>(search.directions);
  set(RayKind::to_soft_light, are_few                                      ? Finder::one_by_one
                              : search.sweeps && can_be_swept<Kind>(count) ? Finder::light_sweep
                              : listed <= search.most_entries              ? Finder::light_grid
                                                                           : Finder::tree);
  set(RayKind::to_point_light, are_few                                      ? Finder::one_by_one
                               : is_sought_from_points<Kind>(count, pixels) ? Finder::tree
                                                                            : Finder::point_grid);
  set(RayKind::followed, count <= Kind::few.followed ? Finder::one_by_one : Finder::tree);
  return row;
}

/// Whether the scene has such rays.
bool has_rays(RayKind rays, const Features& features) {
  switch (rays) {
    case RayKind::from_eye:
      return true;
    case RayKind::to_distant_light:
      return features.casts_shadows &&
             features.light_count(LightRays::parallel) > features.shared_lights;
    case RayKind::to_soft_light:
      return features.casts_shadows && features.shared_lights > 0;
    case RayKind::to_point_light:
      return features.casts_shadows && features.light_count(LightRays::converging) > 0;
    case RayKind::followed:
      break;
  }
  return features.reflects || features.transmits ||
         (features.casts_shadows && features.light_count(LightRays::neither) > 0);
}

FinderRow with_each(Finder finder) {
  FinderRow row;
  row.fill(finder);
  return row;
}

}  // namespace

Choice<Kernel> choose_kernel(const SceneStatistics& statistics) {
  if (statistics.nearest > 0)
    return {Kernel::packets,
            because("the eye is outside of everything, so neighbouring rays go together")};
  return {Kernel::single_rays,
          because("the eye is on or inside a surface, which only the reference models: one ray at "
                  "a time, in double, several times slower")};
}

bool has_enough_for_sweeps(const Features& features) {
  bool has_enough = false;
  for_each_kind([&]<class Kind>(std::type_identity<Kind>) {
    if constexpr (Kind::search == Search::bounded)
      has_enough = has_enough || can_be_swept<Kind>(features.primitives[kind_index<Kind>]);
  });
  return has_enough;
}

FinderTable choose_finders(const Features& features, const SceneStatistics& statistics,
                           Kernel kernel, const SoftLightSearch& search) {
  FinderTable table{};
  std::size_t bounded = 0;
  for_each_kind([&]<class Kind>(std::type_identity<Kind>) {
    if (Kind::search == Search::bounded) bounded += features.primitives[kind_index<Kind>];
  });
  for_each_kind([&]<class Kind>(std::type_identity<Kind>) {
    const std::size_t count = features.primitives[kind_index<Kind>];
    if (count == 0) return;
    FinderRow row = with_each(Finder::one_by_one);
    if constexpr (Kind::search == Search::own) row = with_each(Finder::lattice_walk);
    if constexpr (Kind::search == Search::bounded) {
      if (kernel == Kernel::packets)
        row = choose_structures<Kind>(count, statistics.kinds[kind_index<Kind>].blocks, search,
                                      statistics.pixels);
      else if (bounded > few_for_single_rays)
        row = with_each(Finder::tree);
    }
    for (std::size_t i = 0; i < ray_kind_count; ++i)
      if (!has_rays(static_cast<RayKind>(i), features)) row[i] = Finder::none;
    table[kind_index<Kind>] = row;
  });
  return table;
}

}  // namespace raytracer
