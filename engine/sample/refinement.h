// Which parts of an image get more samples.
//
// A part's error is estimated from what its last samples changed; refined, it has `growth` times
// the samples and about growth^-3/2 of its squared error. The sum of squared errors is brought to a
// bound by the fewest samples if the parts' errors per sample are made equal (Lagrange): those
// above a common level are refined, and the level is the highest that leads to the bound.
//
// Limits: a thing that neither the earlier nor the later samples met is in no estimate.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/image/image.h"
#include "engine/image/tile.h"
#include "engine/plan/census.h"
#include "engine/scene/limits.h"
#include "engine/scene/scene.h"

namespace raytracer {

/// How many times the samples of a part that is refined grow.
inline constexpr int growth = 4;

/// 4 x 4 pixels, those of them that the image has.
struct ImagePart {
  int samples = 1;    ///< per pixel
  double error2 = 0;  ///< estimated: the sum of its values' squared errors
};

/// The most samples per pixel that the limits grant a contract on this scene, the fewer ones before
/// them included; at least 1.
int most_samples(const Scene& scene, const Limits& limits);

/// The samples per pixel that all parts get before any is chosen: they tell where more are needed,
/// but four tell little of what is smaller than a pixel.
int probing_samples(const Census& census);

/// The sum of squared errors of `finer`, which took `growth` times the samples of `coarser`, over
/// the values of one part. The two have no samples in common, so their squared errors add up in
/// the difference; of these the finer one's share is 1 / (growth + 1) if samples err like random
/// ones, and less where they do better. It is taken as 1 / growth, for small images, and as a half
/// after the first sample, which is at the centre.
double estimate_error2(const Image& coarser, const Image& finer, const Tile& part,
                       int finer_samples);

/// The same where no other samples are there to compare with: of an image of one sample per pixel,
/// by how much each pixel differs from those to its right and below. An edge that moves a pixel's
/// value by d errs by d^2 / 12 in the mean, and shows in one such difference; it is taken as
/// d^2 / 8. Gradients, too, count as edges.
double estimate_first_error2(const Image& image, const Tile& part);

/// The parts with the errors that they probably have: where samples met detail there is more beside
/// it that they have missed. A part counts at least as a share of its neighbours' mean does, at its
/// own number of samples. Blocks of 4 x 4 parts, row by row, `columns` in a row.
std::vector<ImagePart> expected_errors(std::span<const ImagePart> parts, int columns);

/// The indices of the parts to refine next, so that repeated refinement brings the sum of squared
/// errors to at most `bound` (0: every part that has an error). Parts of more than
/// `most_samples` / growth samples stay as they are. None if the bound is kept.
std::vector<std::size_t> parts_to_refine(std::span<const ImagePart> parts, double bound,
                                         int most_samples);

}  // namespace raytracer
