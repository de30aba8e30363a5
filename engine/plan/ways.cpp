// The words for what choose_structures decided.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/plan/counted.h"
#include "engine/plan/structures.h"

namespace raytracer {
namespace {

/// The sine of the lowest distant light's elevation over any square; 1 without such lights.
double lowest_slope(const Scene& scene) {
  double lowest = 1;
  const std::vector<Light> lights = lights_in_use(scene);
  for (const Object& object : scene.objects) {
    const auto* square = std::get_if<SphereSquare>(&object.shape);
    if (square == nullptr) continue;
    for (const Light& light : lights)
      if (const auto* distant = std::get_if<DistantLight>(&light.source))
        lowest = std::min(lowest, std::abs(dot(unit(distant->direction), axis_across(*square))));
  }
  return lowest;
}

constexpr const char* one_point =
    "all these rays begin at one point, so a list for each block of 16 x 16 pixels, nearest first, "
    "holds all that they can meet";
constexpr const char* parallel =
    "all rays to a distant light are parallel, so one look-up finds the few that can be in the way";
constexpr const char* one_end =
    "all rays to a point light end there, so one look-up in a grid on a cube around it finds the "
    "few that can be in the way";
constexpr const char* either =
    "all rays to a distant light are parallel, all to a point light end there, so one look-up "
    "finds the few that can be in the way";
constexpr const char* of_any_direction = "reflected rays share neither an origin nor a direction";

class Explainer {
 public:
  Explainer(const Scene& scene, const Features& features, const Structures& structures)
      : scene_(scene), features_(features), structures_(structures) {}

  std::vector<Way> ways() && {
    if (features_.spheres > 0) add_spheres();
    if (features_.squares > 0) add_squares();
    if (features_.planes > 0)
      add(counted(features_.planes, "plane"), every_ray(), "one by one",
          "a plane is everywhere and costs one division");
    if (features_.triangles > 0) add_triangles();
    return std::move(ways_);
  }

 private:
  void add(std::string objects, std::string rays, std::string structure, std::string reason) {
    ways_.push_back({std::move(objects), std::move(rays), std::move(structure), std::move(reason)});
  }

  std::string every_ray() const {
    std::string rays = "from the eye";
    if (features_.casts_shadows) rays += ", to the lights";
    if (features_.reflects) rays += ", reflected";
    return rays;
  }

  void add_spheres() {
    const std::string spheres = counted(features_.spheres, "sphere");
    if (structures_.sphere_bins)
      add(spheres, "from the eye", "screen bins", one_point);
    else
      add(spheres, "from the eye", "tree of boxes",
          "they are so large on the screen that bins would take more memory than they do");
    if (features_.casts_shadows) {
      if (structures_.light_grids)
        add(spheres, "to the lights", "light grids",
            features_.point_lights == 0     ? parallel
            : features_.distant_lights == 0 ? one_end
                                            : either);
      else
        add(spheres, "to the lights", "one by one",
            fmt::format("trying {} is cheaper than looking any up",
                        features_.spheres == 1 ? "the one sphere" : "all " + spheres));
    }
    if (features_.reflects) {
      if (structures_.sphere_tree)
        add(spheres, "reflected", "tree of boxes", of_any_direction);
      else
        add(spheres, "reflected", "one by one",
            fmt::format("trying {} is cheaper than walking a tree",
                        features_.spheres == 1 ? "the one sphere" : "all " + spheres));
    }
  }

  void add_triangles() {
    const std::string triangles = counted(features_.triangles, "triangle");
    constexpr const char* few_of_them = "a ray then tries a few of them and not all";
    if (structures_.triangle_bins)
      add(triangles, "from the eye", "screen bins", one_point);
    else
      add(triangles, "from the eye", "tree of boxes",
          "they are so large on the screen that bins would take more memory than they do");
    if (features_.casts_shadows && features_.distant_lights > 0)
      add(triangles, "to the distant lights",
          structures_.triangle_grids ? "light grids" : "tree of boxes",
          structures_.triangle_grids ? parallel : few_of_them);
    if (features_.casts_shadows && features_.point_lights > 0)
      add(triangles, "to the point lights", "tree of boxes", few_of_them);
    if (features_.reflects) add(triangles, "reflected", "tree of boxes", of_any_direction);
  }

  /// "a square of 28 x 28 spheres", "3 squares of 1,284 spheres"
  std::string squares() const {
    double spheres = 0;
    std::int64_t n = 0;
    for (const Object& object : scene_.objects) {
      const auto* square = std::get_if<SphereSquare>(&object.shape);
      if (square == nullptr) continue;
      n = square->n;
      spheres += 4 * static_cast<double>(n) * static_cast<double>(n);
    }
    const std::string side = grouped(2 * static_cast<std::uint64_t>(n));
    if (features_.squares == 1) return fmt::format("a square of {0} x {0} spheres", side);
    return fmt::format("{} squares of {:.4g} spheres in all", grouped(features_.squares), spheres);
  }

  void add_squares() {
    const std::string name = squares();
    add(name, features_.reflects ? "from the eye, reflected" : "from the eye", "cell walk",
        "its spheres are where arithmetic puts them, so they take no memory, and a ray tries only "
        "those whose cells it crosses");
    if (!features_.casts_shadows) return;
    const double lowest = lowest_slope(scene_);
    constexpr double degrees = 180 / std::numbers::pi;
    if (features_.distant_lights > 0) {
      if (lowest >= lowest_stencil_slope)
        add(name, "from its own spheres to the distant lights", "neighbour list",
            fmt::format("only the same few neighbours can shadow each of its spheres; the lowest "
                        "light stands {:.0f} degrees over it",
                        std::asin(lowest) * degrees));
      else
        add(name, "from its own spheres to the distant lights", "cell walk",
            fmt::format("a light stands only {:.1f} degrees over it, where a list of the "
                        "neighbours in its way would be long",
                        std::asin(lowest) * degrees));
    }
    add(name,
        features_.point_lights > 0 ? "to the point lights, and from other objects to all"
                                   : "from other objects to the lights",
        "cell walk", "any of its spheres may be in the way");
  }

  const Scene& scene_;
  const Features& features_;
  const Structures& structures_;
  std::vector<Way> ways_;
};

}  // namespace

std::vector<Way> explain_ways(const Scene& scene, const Features& features, Kernel kernel,
                              const Structures& structures) {
  if (kernel == Kernel::simd) return Explainer(scene, features, structures).ways();
  std::string objects;
  const auto add = [&](std::size_t count, std::string_view name) {
    if (count > 0) objects += (objects.empty() ? "" : ", ") + counted(count, name);
  };
  add(features.spheres, "sphere");
  add(features.squares, "square");
  add(features.planes, "plane");
  add(features.triangles, "triangle");
  if (kernel == Kernel::bvh)
    return {{objects, "every ray", "tree of boxes", "one ray at a time, from wherever it begins"}};
  return {{objects, "every ray", "one by one", "trying so few is cheaper than walking a tree"}};
}

}  // namespace raytracer
