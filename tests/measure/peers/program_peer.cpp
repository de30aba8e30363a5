#include "tests/measure/peers/program_peer.h"

#include "tests/measure/peers/scene_features.h"

namespace raytracer::peers {

bool ProgramPeer::omits_ambient(const Scene& scene) const {
  return scene.shadows == Shadows::black && features_of(scene).has_ambient_part;
}

std::vector<std::string> ProgramPeer::differences(const Scene& scene) const {
  if (omits_ambient(scene)) return {"drawn without ambient light"};
  return {};
}

}  // namespace raytracer::peers
