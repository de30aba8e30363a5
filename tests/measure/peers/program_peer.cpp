#include "tests/measure/peers/program_peer.h"

#include "tests/measure/peers/scene_features.h"

namespace raytracer::peers {

std::optional<std::string> ProgramPeer::refusal(const Scene& scene) const {
  const SceneFeatures features = features_of(scene);
  if (auto type = first_unknown(
          features.objects,
          {"sphere", "spheres", "sphere_square", "plane", "mesh", "cylinder", "cylinders"},
          "objects"))
    return type;
  if (auto type = first_unknown(features.lights, {"distant", "point"}, "lights")) return type;
  return first_reason({{features.has_item_colors, "sets with a colour for each item"}});
}

bool ProgramPeer::omits_ambient(const Scene& scene) const {
  return scene.shadows == Shadows::black && features_of(scene).has_ambient_part;
}

std::vector<std::string> ProgramPeer::differences(const Scene& scene) const {
  if (omits_ambient(scene)) return {"drawn without ambient light"};
  return {};
}

}  // namespace raytracer::peers
