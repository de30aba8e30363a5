#include "engine/scene/features.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <variant>

#include "engine/objects/corner_values.h"
#include "engine/scene/scene.h"

namespace raytracer {
namespace {

bool emits(const Light& light) { return max_abs(light.color * light.intensity) > 0; }

/// The colours that an object has in place of its material's; null: none.
const std::vector<Rgb>* own_colors(const Object& object) {
  const std::vector<Rgb>* colors = nullptr;
  std::visit(
      [&]<typename Document>(const Document& shape) {
        if constexpr (HasItemColors<Document>) colors = &shape.colors;
        if constexpr (HasCornerValues<Document>) colors = &corner_colors(shape);
      },
      object.shape);
  return colors == nullptr || colors->empty() ? nullptr : colors;
}

/// How some primitive shows a material.
struct MaterialUse {
  bool is_plain = false;    ///< in its own colour
  bool is_colored = false;  ///< in others, of which one at least is not black
  bool is_black = false;    ///< in others, which all are

  bool is_any() const { return is_plain || is_colored || is_black; }
};

std::vector<MaterialUse> material_uses(const Scene& scene) {
  std::vector<MaterialUse> uses(scene.materials.size());
  for (const Object& object : scene.objects) {
    if (primitive_count(object) == 0) continue;
    MaterialUse& use = uses[object.material];
    const std::vector<Rgb>* const colors = own_colors(object);
    if (colors == nullptr)
      use.is_plain = true;
    else if (std::any_of(colors->begin(), colors->end(),
                         [](const Rgb& color) { return max_abs(color) > 0; }))
      use.is_colored = true;
    else
      use.is_black = true;
  }
  return uses;
}

/// The materials of some primitive; where objects bring colours of their own, with such a one.
std::vector<Material> materials_in_use(const Scene& scene, const std::vector<MaterialUse>& uses) {
  std::vector<Material> used;
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const auto add_in = [&](const Rgb& color) {
      used.push_back(scene.materials[i]);
      used.back().color = color;
    };
    if (uses[i].is_plain) used.push_back(scene.materials[i]);
    if (uses[i].is_colored) add_in({1, 1, 1});
    if (uses[i].is_black) add_in({});
  }
  return used;
}

bool shows_ambient(const Scene& scene, const std::vector<Material>& used) {
  return scene.ambient > 0 && std::any_of(used.begin(), used.end(), [](const Material& m) {
           return m.ka > 0 && max_abs(m.color) > 0;
         });
}

std::vector<Light> lights_on(const std::vector<Material>& used, const Scene& scene) {
  std::vector<Light> lights;
  if (used.empty()) return lights;
  const bool bring_ambient = scene.shadows == Shadows::black && shows_ambient(scene, used);
  std::copy_if(scene.lights.begin(), scene.lights.end(), std::back_inserter(lights),
               [&](const Light& light) { return bring_ambient || emits(light); });
  return lights;
}

void count_primitives(const Scene& scene, Features& features) {
  for (const Object& object : scene.objects) {
    const std::size_t kind = kind_of(object.shape);
    features.primitives[kind] += primitive_count(object);
    if (primitive_count(object) > 0 && scene.materials[object.material].transparency > 0)
      features.transmitting[kind] = true;
    std::visit(
        [&]<typename Document>(const Document& shape) {
          if constexpr (HasCornerValues<Document>) {
            features.has_corner_normals = features.has_corner_normals || has_corner_normals(shape);
            features.has_corner_colors =
                features.has_corner_colors || !corner_colors(shape).empty();
          }
        },
        object.shape);
  }
}

void find_followed_rays(const Scene& scene, const std::vector<Material>& used, Features& features) {
  for (const Material& material : used) {
    features.transparency = std::max(features.transparency, material.transparency);
    if (material.transparency > 0) features.ior = std::max(features.ior, material.ior);
  }
  features.transmits = features.transparency > 0;
  if (scene.render.max_depth == 0) return;
  for (const Material& material : used)
    features.reflectivity = std::max(features.reflectivity, material.reflectivity);
  features.reflects = features.reflectivity > 0;
  if (features.reflects || features.transmits) features.max_depth = scene.render.max_depth;
}

}  // namespace

std::size_t Features::primitive_count() const {
  return std::accumulate(primitives.begin(), primitives.end(), std::size_t{0});
}

std::size_t Features::light_count() const {
  return std::accumulate(lights.begin(), lights.end(), std::size_t{0});
}

std::size_t Features::light_count(LightRays rays) const {
  return lights_by_rays[static_cast<std::size_t>(rays)];
}

std::vector<Light> lights_in_use(const Scene& scene) {
  return lights_on(materials_in_use(scene, material_uses(scene)), scene);
}

Features find_features(const Scene& scene) {
  Features features;
  count_primitives(scene, features);
  const std::vector<MaterialUse> uses = material_uses(scene);
  const std::vector<Material> used = materials_in_use(scene, uses);
  features.materials = static_cast<std::size_t>(
      std::count_if(uses.begin(), uses.end(), [](const MaterialUse& use) { return use.is_any(); }));

  bool is_lit = false;
  for (const Light& light : lights_on(used, scene)) {
    is_lit = is_lit || emits(light);
    ++features.lights[light.source.index()];
    ++features.lights_by_rays[static_cast<std::size_t>(rays_of(light))];
    if (!is_soft(light)) continue;
    ++features.soft_lights;
    features.shared_lights += rays_of(light) == LightRays::parallel ? 1 : 0;
  }
  const bool ambient_needs_light = scene.shadows == Shadows::black;
  features.has_ambient =
      shows_ambient(scene, used) && (!ambient_needs_light || features.light_count() > 0);
  features.casts_shadows = features.light_count() > 0 && scene.shadows != Shadows::off;

  std::vector<double> exponents;
  for (const Material& material : used) {
    if (!is_lit || max_abs(material.color) == 0) continue;
    features.has_diffuse = features.has_diffuse || material.kd > 0;
    if (material.ks > 0) exponents.push_back(material.shininess);
  }
  features.has_specular = !exponents.empty();
  for (const double exponent : exponents)
    features.shininess = std::max(features.shininess, exponent);
  features.integer_shininess = find_integer_exponents(exponents);
  find_followed_rays(scene, used, features);
  return features;
}

}  // namespace raytracer
