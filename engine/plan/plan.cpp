#include "engine/plan/plan.h"

#include <fmt/format.h>

namespace raytracer {
namespace {

// Random spheres under two lights, brute force's time over the tree's: 0.90 to 0.94 with 2 to 6
// spheres, 1.04 with 8, 1.15 with 12, 1.9 with 32.
constexpr std::size_t few_for_one_ray = 7;

// Random spheres under two lights, packets of 16: trying each sphere against a grid for each light
// 0.45 ms to 0.46 with 24 spheres, 0.51 to 0.49 with 32, 0.76 to 0.60 with 64.
constexpr std::size_t few_for_shadows = 28;
// The same as mirrors: trying each against a tree 3.18 ms to 3.31 with 128 spheres.
constexpr std::size_t few_for_reflections = 128;

/// The entries that screen bins of triangles may have: of 12 bytes, so that they take no more
/// memory than the triangles themselves.
double most_blocks(std::size_t triangles) { return 1e6 + 8 * static_cast<double>(triangles); }

Choice<Kernel> choose_kernel(const Census& census) {
  const std::size_t bounded = census.spheres + census.triangles;
  if (census.nearest > 0)
    return {Kernel::simd,
            fmt::format("{} spheres, {} squares, {} planes and {} triangles, all "
                        "seen from outside: packets of rays",
                        census.spheres, census.squares, census.planes, census.triangles)};
  const std::string inside = "the eye is on or inside a surface: one ray at a time";
  return {bounded <= few_for_one_ray ? Kernel::brute_force : Kernel::bvh, inside};
}

Structures choose_structures(const Census& census, bool has_shadows) {
  const bool has_triangles = census.triangles > 0;
  const bool needs_directions = census.reflects || (census.has_point_lights && has_shadows);
  Structures structures;
  structures.light_grids = has_shadows && census.spheres > few_for_shadows;
  structures.sphere_tree = census.spheres > few_for_reflections && census.reflects;
  structures.triangle_bins =
      has_triangles && census.triangle_blocks <= most_blocks(census.triangles);
  structures.triangle_grids = has_triangles && has_shadows;
  structures.triangle_tree = has_triangles && (needs_directions || !structures.triangle_bins);
  return structures;
}

}  // namespace

Plan make_plan(const Scene& scene, const Machine& machine) {
  Plan plan;
  plan.frame = make_frame(scene);
  plan.census = take_census(scene, plan.frame);
  plan.kernel = choose_kernel(plan.census);
  plan.precision = plan.kernel.value == Kernel::simd
                       ? choose_precision(scene.render.precision, plan.census)
                       : Choice<Precision>{Precision::double_precision,
                                           "the kernel that this scene needs has no other"};
  plan.structures = choose_structures(plan.census, scene.shadows != Shadows::off);
  plan.instruction_set = machine.instruction_set;
  return plan;
}

}  // namespace raytracer
