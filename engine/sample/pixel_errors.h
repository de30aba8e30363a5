// The errors that an image's pixels probably have, from what their samples tell:
//
//   error2 = multiplier x (subtiles' mean of (A - B)^2 / 4, by a pixel's variance) / error_power(n)
//
// in linear light, taken through the transfer (ShownError), or, if that is more, what subpixel
// objects cost that all samples may have missed. The sum over an image is what is told of it;
// contracts are held to two standard deviations more (conservative_sum()).
//
// A pixel's squared error is its error coefficient, that of one sample, over error_power() of its
// samples. The coefficient grows with the variance of the samples; what a variance comes to is told
// by half buffers (PixelSpread): for each subtile by those of the subtiles about it, because one
// pixel's halves agree or differ by chance, and a few that err as edges do, because where an edge
// passes many pixels alike, all of them agree or differ together.
//
// The multiplier, and that of pixels that refinements leave, are learned from what refinements
// change (ErrorCalibration).
//
// Limits: what no sample met is in no difference; objects smaller than pixels are counted
// (SubpixelObjects).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/image/pixel_spreads.h"
#include "engine/image/tile.h"
#include "engine/math/block.h"
#include "engine/parallel/worker_pool.h"
#include "engine/sample/error_calibration.h"
#include "engine/sample/error_rules.h"
#include "engine/sample/shown_error.h"
#include "engine/sample/subpixel_objects.h"

namespace raytracer {

/// Pixels are numbered as those of PixelSpreads, subtiles as those of SubtileErrors; those beyond
/// the image's rim have no error.
class PixelErrors {
 public:
  /// Of an image so many pixels wide and high, none of which has samples yet; `shown` is asked for
  /// pixels that have.
  PixelErrors(int width, int height, const ErrorMultiplier& multiplier, const ShownError& shown,
              WorkerPool& pool);

  /// For whoever gives all pixels as many samples, and says so by set_all(): none is a refined one.
  PixelSpreads& spreads() { return spreads_; }
  void set_all(int samples);
  /// A pixel has so many samples, at least 1, which tell this.
  void set(std::size_t pixel, int samples, const PixelSpread& spread);
  /// The same of one that had fewer, and was chosen for what they told, of which luck may be a
  /// part: once before learn().
  void refine(std::size_t pixel, int samples, const PixelSpread& spread);
  /// The pixels of a subtile have one sample each, or one for all, and together probably this
  /// squared error. So it stays until forget_guesses() or set_all().
  void set_guess(std::size_t subtile, double error2);
  void forget_guesses(std::size_t block);
  /// Takes guesses in, if there is nothing else yet.
  void use_guesses();
  /// These objects may be missed. All pixels have so many samples, and estimate() was called.
  void set_subpixel(SubpixelObjects objects, int samples);

  /// Takes all in. To be called before anything is asked.
  void estimate();
  /// The same after a refinement, and learns from it: what the values of all pixels that were
  /// refined have changed by, squared, sums up to `change2`.
  void learn(double change2);

  std::size_t index(int x, int y) const { return spreads_.index(x, y); }
  int x_of(std::size_t pixel) const;
  int y_of(std::size_t pixel) const;
  /// The blocks are numbered row by row.
  std::size_t block_of(std::size_t pixel) const;
  std::size_t block_count() const { return columns_ * rows_; }
  Tile tile_of(std::size_t block) const;

  /// 0 beyond the image's rim.
  int samples(std::size_t pixel) const { return samples_[pixel]; }
  /// Of all pixels.
  std::int64_t sample_count() const { return sample_count_; }

  /// The squared error of a pixel, the sum of its channels'.
  double of_pixel(std::size_t pixel) const;
  double of_subtile(std::size_t subtile) const { return subtiles_[subtile]; }
  /// That of the image, the sum over its values.
  double expected_error2() const { return sum_of(subtiles_); }
  /// With its uncertainty.
  double error2() const { return conservative_sum(subtiles_); }

  /// Calls visit(pixel, error2) for the pixels that have an error, subtile by subtile.
  template <typename Visit>
  void for_each_error(const Visit& visit) const {
    for (std::size_t row = 0; row < rows_; ++row)
      for_each_subtile(row, [&](std::size_t subtile, std::size_t, std::size_t first) {
        if (!may_err(subtile)) return;
        for_each_pixel(first, [&](std::size_t pixel, int, int) {
          if (const double error2 = of_pixel(pixel); error2 > 0) visit(pixel, error2);
        });
      });
  }

 private:
  /// What the pixels of a subtile come to, those in the image.
  struct SubtileSums {
    float pixels = 0;       ///< how many
    float variance = 0;     ///< of their samples
    float of_means = 0;     ///< the variance over error_power()
    float of_means2 = 0;    ///< the squares of these
    float error2 = 0;       ///< by half buffers
    float coefficient = 0;  ///< the squared error of one sample
  };

  /// What makes a subtile's pixels err, in linear light.
  struct Rate {
    float of_variance = 0;  ///< the error coefficient
    float least = 0;        ///< likewise, without any variance
  };

  /// A pixel that is being refined.
  struct Refining {
    std::uint32_t pixel;
    bool is_first;     ///< was never refined before
    int samples;       ///< before
    float rate = 0;    ///< likewise
    float before = 0;  ///< the squared error in linear light that its variance told, and
    float after = 0;   ///< what that of more samples tells of the same
  };

  std::size_t subtile_of(std::size_t pixel) const;
  /// What its variance, of so many samples, tells of the squared error that it had.
  float told(const Refining& refining, int samples) const;
  /// Which blocks of a row have a variance in or beside them, with a rim.
  std::vector<char> find_variances(std::size_t row) const;
  /// Sets `variances_` in a block.
  void spread_variances(std::size_t column, std::size_t row);
  /// The squared error of linear light without the multiplier.
  float unscaled(std::size_t subtile, std::size_t pixel, InversePower& inverse_power) const;
  /// What that comes to where it is shown, with the multiplier.
  double shown(float unscaled, std::size_t pixel, int x, int y) const {
    const double multiplier = calibration_.multiplier(is_refined_[pixel] != 0);
    return shown_(multiplier * static_cast<double>(unscaled), x, y);
  }
  bool may_err(std::size_t subtile) const {
    return rates_[subtile].of_variance > 0 || rates_[subtile].least > 0 || subpixel_;
  }
  /// Of the subtile that begins at this pixel.
  void sum_up(std::size_t first, InversePower& inverse_power, SubtileSums& sums) const;
  /// From the sums of the subtiles around a place.
  float rate_at(std::size_t place) const;
  float least_at(std::size_t place) const;
  /// The sum of unscaled() over all pixels that were never refined.
  double unscaled_left() const;
  /// Sets `rates_`, and what is needed for it.
  void find_rates();
  /// Corrects the multipliers by what was refined, and `seen_` of before.
  void calibrate(double change2);
  /// Sets `seen_` and `subtiles_`, from `rates_`.
  void sum_subtiles();

  /// Calls visit(row) for all rows of blocks, on the pool's threads.
  template <typename Visit>
  void for_each_row(const Visit& visit) const;
  /// Calls visit(subtile, place, first pixel) for the subtiles of a row of blocks, block by block,
  /// with their places among `sums_`.
  template <typename Visit>
  void for_each_subtile(std::size_t row, const Visit& visit) const {
    const std::size_t count = subtiles_in_block * columns_;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t x = subtiles_across * (i / subtiles_in_block) + i % subtiles_across;
      const std::size_t y = subtiles_across * row + i % subtiles_in_block / subtiles_across;
      const int first_x = static_cast<int>(subtile_side * x);
      const int first_y = static_cast<int>(subtile_side * y);
      if (first_x < width_ && first_y < height_)
        visit(count * row + i, (y + 1) * stride_ + x + 1, index(first_x, first_y));
    }
  }
  /// Calls visit(pixel, x, y) for the pixels of the subtile that begins at this one.
  template <typename Visit>
  void for_each_pixel(std::size_t first, const Visit& visit) const {
    const int x_begin = x_of(first);
    const int y_begin = y_of(first);
    for (int y = 0; y < subtile_side; ++y)
      for (int x = 0; x < subtile_side; ++x) visit(first + index(x, y), x_begin + x, y_begin + y);
  }

  WorkerPool& pool_;
  ShownError shown_;
  int width_;
  int height_;
  std::size_t columns_;  ///< of blocks
  std::size_t rows_;
  std::size_t stride_;  ///< of a row of `sums_`
  ErrorCalibration calibration_;
  PixelSpreads spreads_;
  std::vector<int> samples_;
  std::vector<char> is_refined_;
  std::vector<Refining> refining_{};
  std::int64_t sample_count_ = 0;  ///< of all pixels
  std::vector<float> variances_;   ///< those that count
  std::vector<float> seen_;        ///< squared errors at the last estimate(), without what
                                   ///< subpixel objects add
  std::vector<double> subtiles_;   ///< with that, the subtiles'
  std::vector<double> guesses_;    ///< likewise; negative where there is none
  std::vector<Rate> rates_;        ///< of the subtiles
  std::vector<SubtileSums> sums_;  ///< of the subtiles, row by row, with a rim of nothing
  std::optional<SubpixelObjects> subpixel_{};
};

}  // namespace raytracer
