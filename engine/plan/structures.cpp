#include "engine/plan/structures.h"

namespace raytracer {
namespace {

// Random spheres under two lights, packets of 16: trying each sphere against a grid for each light
// 0.45 ms to 0.46 with 24 spheres, 0.51 to 0.49 with 32, 0.76 to 0.60 with 64.
constexpr std::size_t few_for_shadows = 28;
// The same as mirrors: trying each against a tree 3.18 ms to 3.31 with 128 spheres.
constexpr std::size_t few_for_reflections = 128;

/// The entries that screen bins of so many primitives may have: of 12 bytes, so that they take no
/// more memory than the primitives themselves.
double most_blocks(std::size_t primitives) { return 1e6 + 8 * static_cast<double>(primitives); }

}  // namespace

Structures choose_structures(const Features& features, const Census& census) {
  const bool has_triangles = features.triangles > 0;
  const bool needs_directions =
      features.reflects || (features.point_lights > 0 && features.casts_shadows);
  Structures structures;
  structures.light_grids = features.casts_shadows && features.spheres > few_for_shadows;
  structures.sphere_bins =
      features.spheres > 0 && census.sphere_blocks <= most_blocks(features.spheres);
  structures.sphere_tree = (features.spheres > few_for_reflections && features.reflects) ||
                           (features.spheres > 0 && !structures.sphere_bins);
  structures.each_sphere =
      !structures.sphere_tree &&
      (features.reflects || (features.casts_shadows && !structures.light_grids));
  structures.triangle_bins =
      has_triangles && census.triangle_blocks <= most_blocks(features.triangles);
  structures.triangle_grids = has_triangles && features.casts_shadows;
  structures.triangle_tree = has_triangles && (needs_directions || !structures.triangle_bins);
  return structures;
}

}  // namespace raytracer
