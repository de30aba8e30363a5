// The picture that all others are compared with, and how far off it is itself.
//
// Images of 15, 60, 240 ... samples per pixel in double precision, until the last one's error is
// below what is asked for or the allowance ends; the last may have only two or three times as many
// as the one before. All are multiples of five, which no other picture's samples are (trials.cpp):
// a pixel of the reference's own samples would seem to be without an error.
//
// The error of one is estimated from its difference to the one before: errors fall at least as the
// root of the number of samples, so that of a fourth of the samples is at least twice as large, and
// their difference is no less than the later one's error. At edges they fall faster, and the
// estimate is some three times the error.
//
// Limits: a thing that neither image has met is in no difference. Errors of the shading in double
// precision are beyond every figure that is printed.
#pragma once

#include <optional>

#include "engine/image/image.h"
#include "engine/tradeoff/curve.h"
#include "engine/tradeoff/trials.h"

namespace raytracer {

struct Reference {
  Image image;
  CurveReference description;
};

/// Renders until the estimated error is at most `wanted_error` or a share of the allowance is
/// used, as steps of the progress up to `progress_end`. Nothing if it was stopped.
std::optional<Reference> render_reference(Trials& trials, double wanted_error, double progress_end);

}  // namespace raytracer
