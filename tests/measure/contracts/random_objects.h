// One random object of each kind: a new kind is one function more in object_kinds().
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "tests/measure/scenes/dice.h"

namespace raytracer::published {

using measure::Dice;

struct RandomObject {
  nlohmann::json object;  ///< as in a scene document, without its material
  std::string words;      ///< what it is, for people; lengths in halves of the cube's side
};

struct ObjectKind {
  const char* name;  ///< in `words` as well
  /// Within the cube from -half to half, or not much beyond.
  RandomObject (*draw)(Dice& dice, double half);
};

std::span<const ObjectKind> object_kinds();

/// As documents have it, with six digits after the point at most.
nlohmann::json json_of(double number);
nlohmann::json json_of(const Vec3& point);

}  // namespace raytracer::published
