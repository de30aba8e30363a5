#include "tests/measure/peers/scene_features.h"

#include <algorithm>
#include <type_traits>

namespace raytracer::peers {
namespace {

std::string_view kind_of(const DistantLight& light) {
  return light.angle > 0 ? "distant with an angle" : "distant";
}
std::string_view kind_of(const PointLight& light) {
  return light.radius > 0 ? "point with a radius" : "point";
}
std::string_view kind_of(const SkyLight& light) {
  return light.reach < infinity ? "sky with a reach" : "sky";
}

}  // namespace

SceneFeatures features_of(const Scene& scene) {
  SceneFeatures features;
  features.samples = scene.render.samples.value_or(1);
  features.has_transparent_background = !scene.background;
  for (const Object& object : scene.objects) {
    std::visit(
        [&](const auto& shape) {
          features.objects.insert(std::decay_t<decltype(shape)>::type);
          if constexpr (requires { shape.colors.empty(); })
            features.has_item_colors |= !shape.colors.empty();
          if constexpr (requires { shape.caps; }) features.has_caps |= shape.caps;
          if constexpr (requires { shape.vertex_colors.empty(); }) {
            features.has_vertex_colors |= !shape.vertex_colors.empty();
            features.has_smooth_meshes |= !shape.normals.empty();
          }
        },
        object.shape);
  }
  for (const Light& light : scene.lights) {
    std::visit([&](const auto& kind) { features.lights.insert(kind_of(kind)); }, light.source);
    if (const auto* point = std::get_if<PointLight>(&light.source))
      features.has_fading_points |= point->falloff == Falloff::inverse_square;
    const double first = scene.lights[0].color.x * scene.lights[0].intensity;
    const Rgb emission = light.color * light.intensity;
    features.has_uneven_lights |= max_abs(emission - Rgb{first, first, first}) > 0;
  }
  for (const Material& material : scene.materials) {
    const Rgb& color = material.color;
    const bool has_highlight = material.ks > 0 && max_abs(color) > 0;
    features.has_highlights |= has_highlight;
    features.has_flat_highlights |= has_highlight && material.shininess == 0;
    features.has_colored_highlights |= has_highlight && !is_grey(color);
    features.has_mirrors |= material.reflectivity > 0;
    features.has_glass |= material.transparency > 0;
    features.has_fresnel |= material.transparency > 0 && material.fresnel;
    features.has_ambient_part |= scene.ambient * material.ka * max_abs(color) > 0;
  }
  return features;
}

bool is_grey(const Rgb& color) { return color.x == color.y && color.y == color.z; }

std::optional<std::string> first_unknown(const std::set<std::string_view>& present,
                                         std::initializer_list<std::string_view> known,
                                         std::string_view what) {
  for (const std::string_view type : present)
    if (std::find(known.begin(), known.end(), type) == known.end())
      return std::string(what) + " of type " + std::string(type);
  return {};
}

std::optional<std::string> first_reason(
    std::initializer_list<std::pair<bool, std::string_view>> reasons) {
  for (const auto& [holds, reason] : reasons)
    if (holds) return std::string(reason);
  return {};
}

}  // namespace raytracer::peers
