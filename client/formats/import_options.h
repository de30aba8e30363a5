// What may be asked of the picture of a file that does not say how it is to look.
#pragma once

#include <optional>
#include <string>

#include "client/formats/scene_model.h"

namespace raytracer::client {

enum class AtomStyle { spacefill, ball_and_stick, sticks };

struct ImportOptions {
  AtomStyle style = AtomStyle::spacefill;
  std::string color;  ///< element, chain, residue or a column; empty: the best that there is
  /// For numbers; none: types are no numbers, and all others are on viridis.
  std::optional<std::string> color_map;
  bool with_water = false;

  std::optional<model::Triple> view;  ///< from where, as a direction; none: the best
  double zoom = 1;
  bool is_turned = false;  ///< everything is to stay in view while the eye goes round
  model::Background background = model::Triple{1, 1, 1};
  int width_px = 700;
  int height_px = 500;
};

}  // namespace raytracer::client
