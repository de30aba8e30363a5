// The error model: every number by which the errors of sampling are estimated, refined and
// forecast. Those of rounding have theirs in plan/precision.cpp.
//
// Each is derived (by the formula or from the paper named), calibrated (on the scenes named) or
// chosen (for the reason named). What they were calibrated on:
//
//   135 contracts   `make tradeoff`: 27 scenes, 5 targets
//   648 contracts   the same scenes at 6 sizes and 4 targets: an earlier measurement
//   19 scenes       a still earlier measurement, of which only the numbers are left
//
// `make tradeoff` kept all of its targets at commit 08076b8. How many are kept on random scenes
// since, and how true the estimates are, is in tests/measure/contracts/README.md.
//
// Mitchell: "Consequences of Stratified Sampling in Graphics", SIGGRAPH 1996.
#pragma once

#include <cmath>
#include <cstddef>

namespace raytracer {

/// How large the squared error of n samples is.
struct SampleErrorModel {
  // It falls as n to the power of minus this. Derived: Mitchell.
  static constexpr double random_fall = 1;  ///< of independent samples
  static constexpr double edge_fall = 1.5;  ///< of stratified ones where edges cross pixels
  static constexpr double smooth_fall = 2;  ///< of stratified ones elsewhere

  /// Of the squared difference of half buffers A and B. Derived: (A + B) / 2 and (A - B) / 2 have
  /// the same variance if A and B are independent (as in Rousselle, Knaus, Zwicker: "Adaptive
  /// Rendering with Non-Local Means Filtering", SIGGRAPH Asia 2012).
  static constexpr double half_difference_share = 0.25;

  // The error multiplier corrects that: halves complete each other, refinements show how far.
  /// Calibrated: refinements of 19 scenes showed 0.4 to 2, those under lights of a size 0.1. Of
  /// random scenes (29 of seed 24900, 25 each of 24103, 24201 and 24950, but the slowest) 295 of
  /// 316 estimates are true within a factor of 2, and all targets kept. It was 0.4 before, and
  /// pixels that a refinement left were taken at 1: 281 and 313.
  static constexpr double least_multiplier = 0.1;
  /// Where objects are smaller than pixels. Calibrated on 648 contracts, when it could fall by 0.6
  /// at once at most: 0.5 missed one.
  static constexpr double least_subpixel_multiplier = 0.65;
  /// Chosen: twice what refinements ever showed; those left are taken at no more either.
  static constexpr double most_multiplier = 4;
  /// As many refined pixels count as much as the multiplier before them. Chosen: fewer say little.
  static constexpr double prior_pixels = 100;

  /// Added to a sum of squared errors, in standard deviations. Chosen: 97.7 % of a normal one.
  static constexpr double confidence_deviations = 2;

  /// As many pixels that err as edges do on average count beside those about a subtile. Chosen: an
  /// edge at 45 degrees passes all of its pixels alike, so that what their halves say is said once,
  /// and where it splits both evenly they say that nothing errs. Of smooth surfaces, where many
  /// pixels say so, it changes little.
  static constexpr float prior_edge_pixels = 2;

  // Where samples met detail there is more beside it that they missed. Calibrated on 19 scenes, of
  // 0 to 0.6 and 0 to 0.1: most targets kept, and few samples more.
  static constexpr float pixel_neighbour_share = 0.2F;  ///< of the greatest variance beside a pixel
  static constexpr float subtile_neighbour_share = 0.1F;  ///< of the mean error beside a subtile

  /// Of the squared difference d^2 of neighbouring pixels, for one sample. Derived: an edge errs by
  /// d^2 / 12 on average if its place is random; chosen: half as much again.
  static constexpr double edge_share = 1.0 / 8;
  /// Rows in which edges are looked for. Chosen: all take as long as to trace a simple picture.
  static constexpr int edge_rows = 16;
  /// Of the squared difference from blocks beside one of which a subtile was traced. Chosen: an
  /// edge between them is anywhere.
  static constexpr double block_neighbour_share = 0.5;

  /// Of what is missed from what is around it, squared, in a channel, as long as nothing else is
  /// known. Chosen: black or white.
  static constexpr double subpixel_contrast2 = 0.5;
  /// As many samples that met it would say as much. Chosen: a few.
  static constexpr double subpixel_prior = 4;
  /// n samples miss an area a of a pixel with the probability exp(-n a / 2). Derived: exp(-n a) if
  /// they lay anywhere; chosen: half, as a bound.
  static constexpr double subpixel_miss_rate = 0.5;
};

/// n^edge_fall: how much a squared error has fallen by n samples.
inline double error_power(double samples) { return samples * std::sqrt(samples); }

/// Which pixels get how many samples.
struct RefinementModel {
  /// Of the pilot pass. Derived: half buffers that are symmetric about the pixel's middle need 4.
  static constexpr int first_step = 4;
  /// The next number of samples, and that of the pilot pass where objects are smaller than pixels.
  /// Derived: it fills packets of any width.
  static constexpr int second_step = 16;
  /// From there on. Chosen: the next step has 1.33 to 1.5 times as many.
  static constexpr int steps_per_octave = 2;
  /// Pixels whose wanted samples differ by less are in one error class. Chosen: 4 %.
  static constexpr int classes_per_octave = 16;
  /// Derived: the memory of a sample pattern, 1 GiB.
  static constexpr int most_samples_log2 = 26;

  /// A pixel that is refined gets so many times its samples. Derived: at 2 all passes together take
  /// at most twice the last; chosen: at most 16, as an estimate asks for them.
  static constexpr int least_growth = 2;
  static constexpr int most_growth = 16;
  /// From so many samples on, errors are planned to fall as by smooth_fall. Calibrated on 648
  /// contracts: all kept, with 0.8 to 1 of the samples; from fewer on, 4 were not.
  static constexpr int smooth_fall_samples = 16;
  /// A pass is in vain if it leaves more than this share of the squared error, and so many in vain
  /// end a refinement: what all places on soft lights leave out, none mends. Chosen: one may have
  /// found what was missed before.
  static constexpr double least_fall = 0.9;
  static constexpr int most_passes_in_vain = 2;
  /// Of the squared error sought. Chosen: a target just missed costs one more pass.
  static constexpr double aim = 0.9;
  /// Of a target where a lattice of objects is smaller than pixels. Calibrated on 135 contracts:
  /// estimates came down to 0.77 of the error, and 1 misses one target.
  static constexpr double lattice_margin = 0.77;
  /// Of the squared error allowed, what all pixels together may keep that are not looked at.
  /// Chosen: 0.5 % of the error.
  static constexpr double negligible = 0.01;

  /// Of a budget, for samples. Chosen: the rest is for what comes after the last of them.
  static constexpr double budget_share = 0.98;
  /// Of a thread's task. Chosen: 1 ms or so, for which others, and the clock, wait.
  static constexpr double task_samples = 1 << 14;
  /// Measured on two scenes under soft lights: 256 took 1.3 times as long, as few pixels do not
  /// fill packets.
  static constexpr double tasks_per_pass = 64;
  static constexpr double least_task_samples = 1 << 10;
  /// How many times longer it takes to estimate errors from half buffers than from neighbours.
  /// Measured: 1.3e-5 to 1.6e-5 ms a pixel against 4e-6 ms, on an AMD EPYC; chosen: a little more.
  static constexpr double half_buffer_cost = 5;
};

/// What a render will take and give.
struct ForecastModel {
  // Chosen, and then measured: of 48 contracts (24 scenes at 350 x 250, targets 0.01 and 0.003) the
  // samples are within a factor 2 of the forecast in 90 %, the estimated error in all, the time in
  // 62 % to 71 %.
  /// Of the rehearsal's error: estimates are on the safe side.
  static constexpr double error_margin = 1.3;
  /// Of the samples that pixels need by Lagrange: nobody knows beforehand which.
  static constexpr double blind_factor = 3;
  /// Tiles rehearsed, and their side in pixels. Chosen: more but smaller ones vary less.
  static constexpr std::size_t most_tiles = 64;
  static constexpr int tile_side_px = 32;
  /// Of each of the rehearsal's two passes. Chosen: 50 ms are not felt.
  static constexpr double pass_limit_ms = 25;

  /// Of each measurement of the machine. Chosen: their median, or least, is stable.
  static constexpr int tries = 5;
  /// Chosen: twice as long as the pool's threads look out for work.
  static constexpr int threads_sleep_us = 100;
  /// Until threads have begun, which others may keep busy. Chosen.
  static constexpr double longest_start_ms = 5;
  /// Side of the image by which writing is measured. Derived: 12 MiB, beyond a core's caches.
  static constexpr int memory_side_px = 1024;
};

}  // namespace raytracer
