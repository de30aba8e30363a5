#include "tests/measure/peers/peer.h"

#include "engine/math/transfer.h"

namespace raytracer::peers {

Scene scene_drawn(const Peer& peer, Scene scene) {
  if (peer.omits_ambient(scene)) scene.ambient = 0;
  return scene;
}

Image stored(Image linear, Transfer transfer) {
  for (float& channel : linear.values)
    channel = static_cast<float>(encode_channel(static_cast<double>(channel), transfer));
  return linear;
}

}  // namespace raytracer::peers
