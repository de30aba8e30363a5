// The words for what choose_finders() decided.
#include <fmt/format.h>

#include <string_view>

#include "engine/plan/finders.h"
#include "engine/text/pluralised.h"

namespace raytracer {
namespace {

constexpr std::array<std::string_view, ray_kind_count> names_of_rays{
    "from the eye", "to the distant lights", "to directions of soft lights", "to the point lights",
    "followed"};

std::string_view name_of(Finder finder) {
  switch (finder) {
    case Finder::one_by_one:
      return "one by one";
    case Finder::screen_bins:
      return "screen bins";
    case Finder::light_grid:
      return "light grids";
    case Finder::light_sweep:
      return "sweeps";
    case Finder::point_grid:
      return "point grids";
    case Finder::tree:
      return "tree of boxes";
    case Finder::lattice_walk:
      return "cell walk";
    case Finder::none:
      break;
  }
  return "none";
}

/// Why these rays find objects so, which are "1,000 spheres".
std::string reason_for(Finder finder, RayKind rays, Search search, std::string_view objects) {
  switch (finder) {
    case Finder::one_by_one:
      if (search == Search::unbounded) return "they are everywhere and cost one division each";
      return fmt::format("trying {} is cheaper than looking any up", objects);
    case Finder::screen_bins:
      return "all these rays begin at one point, so a list for each block of 16 x 16 pixels, "
             "nearest first, holds all that they can meet";
    case Finder::light_grid:
      return "all rays to a distant light are parallel, so one look-up finds the few that can be "
             "in the way";
    case Finder::light_sweep:
      return "all points of the picture look along the same directions, so they are sorted into a "
             "grid across each of them, over which all objects pass once";
    case Finder::point_grid:
      return "all rays to a point light end there, so one look-up in a grid on a cube around it "
             "finds the few that can be in the way";
    case Finder::tree:
      if (rays == RayKind::from_eye)
        return "they are so large on the screen that bins would take more memory than they do";
      return rays == RayKind::followed ? "followed rays share neither an origin nor a direction"
                                       : "a ray then tries a few of them and not all";
    case Finder::lattice_walk:
    case Finder::none:
      break;
  }
  return "they are where arithmetic puts them, so they take no memory, and a ray tries only those "
         "whose cells it crosses";
}

/// One kind's row: an explanation for each finder that it has.
template <class Kind>
void explain_row(const std::string& objects, const FinderRow& row,
                 std::vector<FinderExplanation>& to) {
  for (std::size_t i = 0; i < ray_kind_count; ++i) {
    if (row[i] == Finder::none) continue;
    const auto rays = static_cast<RayKind>(i);
    const std::string reason = reason_for(row[i], rays, Kind::search, objects);
    if (!to.empty() && to.back().objects == objects && to.back().reason == reason)
      to.back().rays.append(", ").append(names_of_rays[i]);
    else
      to.push_back({objects, std::string(names_of_rays[i]), std::string(name_of(row[i])), reason});
  }
}

template <class Kind>
std::string name_of_objects(std::size_t count, const GeometryStatistics& statistics) {
  if constexpr (HasNameInPlans<Kind>)
    return name_of(Kind(), count, statistics);
  else
    return pluralised(count, Kind::noun);
}

}  // namespace

std::vector<FinderExplanation> explain_finders(const Features& features,
                                               const SceneStatistics& statistics, Kernel kernel,
                                               const FinderTable& table) {
  std::vector<FinderExplanation> explanations;
  for_each_kind([&]<class Kind>(std::type_identity<Kind>) {
    const std::size_t count = features.primitives[kind_index<Kind>];
    if (count == 0) return;
    const std::string objects = name_of_objects<Kind>(count, statistics.kinds[kind_index<Kind>]);
    explain_row<Kind>(objects, table[kind_index<Kind>], explanations);
    if constexpr (HasNeighbourSearch<Kind>) {
      const FinderRow& row = table[kind_index<Kind>];
      if (kernel != Kernel::packets || (finder_of(row, RayKind::to_distant_light) == Finder::none &&
                                        finder_of(row, RayKind::to_soft_light) == Finder::none))
        return;
      const auto own = explain_neighbours(Kind(), statistics.lowest_light);
      explanations.push_back(
          {objects, "from itself to the distant lights", own.finder, own.reason});
    }
  });
  return explanations;
}

}  // namespace raytracer
