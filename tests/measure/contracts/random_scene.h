// One ordinary scene from a seed: every kind of object, light and surface, nothing extreme.
#pragma once

#include <cstdint>
#include <string>

namespace raytracer::published {

struct RandomScene {
  std::string document;  ///< valid, without samples or a contract
  std::string summary;   ///< in a line
};

/// The same for the same seed. Its picture is 32 to 320 pixels wide.
RandomScene random_scene(std::uint64_t seed);

}  // namespace raytracer::published
