// The error of an image whose samples do not tell it: by how much neighbouring pixels differ.
//
// An edge that moves a pixel's value by d shows in the pixel's difference from those beside it, and
// errs by SampleErrorModel::edge_share of d^2 with one sample per pixel.
//
// Limits: slopes count as edges; what is smaller than a pixel may not show.
#pragma once

#include "engine/image/image.h"
#include "engine/image/tile.h"

namespace raytracer {

/// The squared error of a tile's values, of one sample per pixel, their sum.
double neighbour_error2(const Image& image, const Tile& tile);

/// The rms error of an image of so many samples per pixel, from some of its rows.
double neighbour_error(const Image& image, int samples);
double neighbour_error(const ByteImage& image, int samples);

}  // namespace raytracer
