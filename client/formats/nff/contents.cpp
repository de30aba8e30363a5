#include "client/formats/nff/contents.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace raytracer::client {

using model::Triple;

namespace {

/// From all of the others.
bool points_away(const Triple& normal, const std::vector<Triple>& others) {
  return !others.empty() && std::all_of(others.begin(), others.end(), [&](const Triple& other) {
    return normal[0] * other[0] + normal[1] * other[1] + normal[2] * other[2] < 0;
  });
}

}  // namespace

void NffContents::add_light(const Triple& position, const std::optional<Triple>& color) {
  lights_.push_back({position, color});
}

void NffContents::set_fill(const model::Material& fill) {
  std::vector<model::Material>& materials = reading_.scene.materials;
  const auto [known, is_new] = fills_.try_emplace(fill, materials.size());
  if (is_new) materials.push_back(fill);
  fill_ = known->second;
}

NffContents::Group& NffContents::group(int line) {
  if (!fill_)
    omit(line, "object before the first fill, in the default material",
         "objects before the first fill, in the default material");
  return groups_[fill_];
}

void NffContents::add_sphere(int line, const NffBall& ball) {
  if (ball.radius == 0)
    return omit(line, "sphere without radius left out", "spheres without radius left out");
  if (ball.radius < 0)
    omit(line, "sphere that is seen from inside only, seen from both sides",
         "spheres that are seen from inside only, seen from both sides");
  model::Spheres& spheres = group(line).spheres;
  spheres.centers.push_back(ball.center);
  spheres.radii.push_back(std::abs(ball.radius));
}

void NffContents::add_cone(int line, NffBall base, NffBall apex) {
  if (base.center == apex.center || (base.radius == 0 && apex.radius == 0))
    return omit(line, "cone without length or radius left out",
                "cones without length or radius left out");
  if (base.radius < 0 || apex.radius < 0)
    omit(line, "cone that is seen from inside only, seen from both sides",
         "cones that are seen from inside only, seen from both sides");
  base.radius = std::abs(base.radius);
  apex.radius = std::abs(apex.radius);
  Group& same = group(line);
  if (base.radius == apex.radius) {
    same.cylinders.from.push_back(base.center);
    same.cylinders.to.push_back(apex.center);
    same.cylinders.radii.push_back(base.radius);
  } else {
    same.cones.from.push_back(base.center);
    same.cones.to.push_back(apex.center);
    same.cones.radii_from.push_back(base.radius);
    same.cones.radii_to.push_back(apex.radius);
  }
}

void NffContents::add_polygon(int line, const std::vector<Triple>& corners,
                              std::vector<Triple> normals) {
  Triangulation polygon = triangulate(corners);
  if (polygon.triangles.empty())
    return omit(line, "polygon without area left out", "polygons without area left out");
  if (polygon.crosses_itself)
    omit(line, "polygon whose sides cross, filled roughly",
         "polygons whose sides cross, filled roughly");
  for (Triple& normal : normals) {
    if (normal != Triple{0, 0, 0}) continue;
    omit(line, "normal without length, replaced by the polygon's",
         "normals without length, replaced by the polygon's");
    normal = polygon.normal;
  }
  if (points_away(polygon.normal, normals)) {
    omit(line, "patch against its normals turned round",
         "patches against their normals turned round");
    for (auto& triangle : polygon.triangles) std::swap(triangle[0], triangle[2]);
  }
  Group& same = group(line);
  (normals.empty() ? same.polygons : same.patches).add(polygon, corners, normals);
}

void NffContents::add_lights_to_scene() {
  model::Scene& scene = reading_.scene;
  const double share = 1 / std::sqrt(static_cast<double>(lights_.size()));
  for (const Light& light : lights_) {
    if (!light.color) {
      scene.lights.emplace_back(model::Lamp{light.position, {1, 1, 1}, share});
      continue;
    }
    // A scene's colours end at 1, intensities do not.
    Triple color = *light.color;
    const double intensity = std::max(1.0, *std::max_element(color.begin(), color.end()));
    for (double& channel : color) channel /= intensity;
    scene.lights.emplace_back(model::Lamp{light.position, color, intensity});
  }
}

void NffContents::add_objects_to_scene() {
  for (auto& [material, group] : groups_) {
    const auto add = [&, material = material](auto shape, std::size_t count) {
      if (count > 0) reading_.scene.objects.push_back({std::move(shape), material});
    };
    const auto add_mesh = [&](MeshBuilder& polygons) {
      model::Mesh mesh = std::move(polygons).take();
      const std::size_t count = mesh.triangles.size();
      add(std::move(mesh), count);
    };
    add(group.spheres, group.spheres.radii.size());
    add(group.cylinders, group.cylinders.radii.size());
    add(group.cones, group.cones.radii_from.size());
    add_mesh(group.polygons);
    add_mesh(group.patches);
  }
}

Reading NffContents::take() && {
  add_lights_to_scene();
  add_objects_to_scene();
  return std::move(reading_);
}

}  // namespace raytracer::client
