// Where the pixels of tiles go.
#pragma once

#include "engine/image/image.h"
#include "engine/image/subtile_errors.h"
#include "engine/math/transfer.h"

namespace raytracer {

/// What is made of the pixels' means, and what they tell of their errors.
struct TileOutput {
  Transfer transfer;    ///< of the means, as they are stored
  Canvas canvas;        ///< where
  TileErrors errors{};  ///< told if the samples have half buffers
};

}  // namespace raytracer
