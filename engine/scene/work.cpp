#include "engine/scene/work.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/math/ray.h"

namespace raytracer {
namespace {

/// The most rays that a sample may take: each may be followed by one, or by two where a surface
/// both mirrors and lets through. All of one depth have a weight together, of which each has the
/// least at least, or it is left out.
double most_rays(const Scene& scene) {
  constexpr double most_of_one = 1 / least_ray_weight;
  bool is_followed = false;
  bool branches = false;
  double weight = 0;
  for (const Material& m : scene.materials) {
    is_followed = is_followed || m.reflectivity > 0 || m.transparency > 0;
    branches = branches || (m.transparency > 0 && (m.reflectivity > 0 || m.fresnel));
    weight = std::max(weight, m.reflectivity + m.transparency);
  }
  if (!is_followed) return 1;
  if (!branches) return 1.0 + scene.render.max_depth;
  double rays = 1;
  double branched = 1;  // of one depth, were none left out
  double together = 1;
  for (int depth = 0; depth < scene.render.max_depth && std::isfinite(rays); ++depth) {
    branched *= 2;
    together *= weight;
    if (branched <= most_of_one * together) {
      rays += branched;
      continue;
    }
    const double rest = scene.render.max_depth - depth;
    const double sum = weight == 1 ? rest : (std::pow(weight, rest) - 1) / (weight - 1);
    return rays + most_of_one * together * sum;
  }
  return rays;
}

/// The rays of a sample; those that surfaces split count by their weight together, which grows
/// only where a surface gives back more than it receives.
double weighted_rays(const Scene& scene) {
  double weight = 0;
  for (const Material& m : scene.materials)
    weight = std::max(weight, m.reflectivity + m.transparency);
  if (weight == 0) return 1;
  const double rays = 1.0 + scene.render.max_depth;
  return weight <= 1 ? rays : (std::pow(weight, rays) - 1) / (weight - 1);
}

}  // namespace

double work_of(const Scene& scene, int samples) {
  return scene.camera.pixel_count() * samples * weighted_rays(scene);
}

double count_rays(const Scene& scene, int samples) {
  return scene.camera.pixel_count() * samples * most_rays(scene);
}

void demand_at_most(double count, std::int64_t Limits::*limit, const Limits& limits,
                    const Path& path, ErrorList& errors) {
  const LimitRow& row = row_of(limit);
  if (count <= static_cast<double>(limits.*limit)) return;
  errors.add(ErrorKind::limit, path,
             fmt::format("asks for {} {}, but this service accepts {} ({})", count, row.meaning,
                         limits.*limit, row.flag));
}

}  // namespace raytracer
