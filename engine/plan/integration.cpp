#include "engine/plan/integration.h"

#include <string>

#include "engine/plan/sampling.h"

namespace raytracer {
namespace {

/// Why samples, or nothing.
const char* obstacle(const Scene& scene, const Features& features, Kernel kernel,
                     const Structures& structures) {
  if (sampling_of(scene.render) == Sampling::fixed) return "a number of samples is given";
  if (kernel != Kernel::simd) return "the plain kernel traces single rays";
  if (features.planes > 0 || features.triangles > 0)
    return "lines find the silhouettes of spheres, and there are planes or triangles";
  if (features.reflects) return "lines do not find what mirrors show";
  if (features.point_lights > 0 || features.distant_lights > most_lights_of_lines)
    return "lines find the shadows of at most 8 distant lights";
  if (features.has_specular && features.uniform_shininess < 0)
    return "highlights have several exponents";
  if (structures.light_grids || structures.sphere_tree)
    return "lines try each sphere for its shadow, and there are too many";
  // A little more: what the kernel is to find at just that slope is a matter of rounding.
  if (features.squares > 0 && lowest_light_slope(scene) < 1.001 * lowest_stencil_slope)
    return "a light is too low over a square for a list of neighbours";
  return nullptr;
}

}  // namespace

Choice<Integration> choose_integration(const Scene& scene, const Features& features, Kernel kernel,
                                       const Structures& structures) {
  const char* const why = obstacle(scene, features, kernel, structures);
  if (why != nullptr) return {Integration::samples, because("{}", std::string(why))};
  return {Integration::lines,
          because("spheres under distant lights: a line's crossings with silhouettes are a "
                  "quadratic's roots, and between them and the edges of shadows it is smooth")};
}

}  // namespace raytracer
