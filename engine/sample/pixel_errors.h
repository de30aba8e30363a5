// The errors that an image's pixels probably have, from what their samples tell.
//
// A pixel's squared error is taken to fall as n^-3/2 with its n samples, as where edges cross
// pixels, and to grow with their variance. What a variance comes to is told by the halves of the
// samples (PixelSpread): for each part by those of the parts about it, because one pixel's halves
// agree or differ by chance.
//
// How much the halves overstate, nobody knows beforehand: if squared errors fall as n^-e, by 2^e
// - 1. But a refinement shows it: what it changes is what the pixels before it and after it erred.
//
// Limits: what no sample met is in no difference; spheres smaller than pixels are counted
// (MissableSpheres).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/image/pixel_spreads.h"
#include "engine/image/tile.h"
#include "engine/math/block.h"
#include "engine/parallel/worker_pool.h"
#include "engine/sample/error_rules.h"
#include "engine/sample/missable_spheres.h"

namespace raytracer {

/// Pixels are numbered as those of PixelSpreads, parts as those of PartErrors; those beyond the
/// image's rim have no error.
class PixelErrors {
 public:
  /// Of an image so many pixels wide and high, none of which has samples yet.
  PixelErrors(int width, int height, const ErrorScale& scale, WorkerPool& pool);

  /// For whoever gives all pixels as many samples, and says so by set_all().
  PixelSpreads& spreads() { return spreads_; }
  void set_all(int samples);
  /// A pixel has so many samples, at least 1, which tell this.
  void set(std::size_t pixel, int samples, const PixelSpread& spread);
  /// The pixels of a part have one sample each, or one for all, and together probably this squared
  /// error. So it stays until forget_guesses() or set_all().
  void set_guess(std::size_t part, double error2);
  void forget_guesses(std::size_t block);
  /// Takes guesses in, if there is nothing else yet.
  void expect_guesses();
  /// These spheres may be missed. expect() was called before.
  void set_missable(MissableSpheres spheres);

  /// Takes all in. To be called before anything is asked.
  void expect();

  /// Takes in what a refinement of these pixels has changed: the sum of the squared differences of
  /// their values. `before` are their unscaled() errors before it; expect() was called after it.
  void calibrate(std::span<const std::uint32_t> pixels, std::span<const float> before,
                 double change2);

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

  /// The squared errors of these pixels, the sums of their channels', without what calibrate() and
  /// spheres add.
  std::vector<float> unscaled(std::span<const std::uint32_t> pixels) const;
  /// That of one, with them.
  double of_pixel(std::size_t pixel) const;
  double of_part(std::size_t part) const { return parts_[part]; }
  /// That of the image, the sum over its values.
  double expected_error2() const;
  /// With its uncertainty.
  double error2() const { return conservative_sum(parts_); }

  /// Calls visit(pixel, error2) for the pixels that have an error, part by part.
  template <typename Visit>
  void for_each_rough(const Visit& visit) const {
    for (std::size_t row = 0; row < rows_; ++row)
      for_each_error_in(row, [&](std::size_t, std::size_t pixel, double error2) {
        if (error2 > 0) visit(pixel, error2);
      });
  }

 private:
  /// What the pixels of a part come to, those in the image.
  struct Sums {
    float error2 = 0;    ///< by halves
    float variance = 0;  ///< over error_power()
    float detail = 0;    ///< the variance alone
  };

  /// What makes a part's pixels err.
  struct Rate {
    float of_variance = 0;
    float least = 0;  ///< squared error of one sample
  };

  std::size_t part_of(std::size_t pixel) const;
  /// Where in a row of blocks samples differ.
  void find_details(std::size_t row);
  /// Which blocks of a row may err; forgets what was known of the others.
  void choose_blocks(std::size_t row);
  /// Sets `variances_` of those that may.
  void spread_variances(std::size_t row);
  /// Of these side by side.
  void spread_variances(std::size_t row, std::size_t column_begin, std::size_t column_end);
  float unscaled(std::size_t pixel, InversePower& inverse_power) const;
  double scaled(float unscaled, std::size_t pixel, int samples) const;

  /// Calls visit(row) for all rows of blocks, on the pool's threads.
  template <typename Visit>
  void for_each_row(const Visit& visit) const;
  /// Calls visit(part, place, first pixel) for the parts of the block with their places among
  /// `sums_`.
  template <typename Visit>
  void for_each_part_of(std::size_t column, std::size_t row, const Visit& visit) const {
    const std::size_t first_part = parts_in_block * (columns_ * row + column);
    for (std::size_t i = 0; i < parts_in_block; ++i) {
      const std::size_t x = parts_across * column + i % parts_across;
      const std::size_t y = parts_across * row + i / parts_across;
      const int first_x = static_cast<int>(part_side * x);
      const int first_y = static_cast<int>(part_side * y);
      if (first_x < width_ && first_y < height_)
        visit(first_part + i, (y + 1) * stride_ + x + 1, index(first_x, first_y));
    }
  }
  /// The same for the parts of a row of blocks, of those that may err.
  template <typename Visit>
  void for_each_part_in(std::size_t row, const Visit& visit) const {
    for (std::size_t column = 0; column < columns_; ++column)
      if (may_err_[columns_ * row + column] != 0) for_each_part_of(column, row, visit);
  }
  /// Calls visit(part, pixel, error2) for the pixels of those parts of a row of blocks that have an
  /// error.
  template <typename Visit>
  void for_each_error_in(std::size_t row, const Visit& visit) const {
    InversePower inverse_power;
    for_each_part_in(row, [&](std::size_t part, std::size_t, std::size_t first) {
      const Rate& rate = rates_[part];
      if (!(rate.of_variance > 0) && !(rate.least > 0) && !missable_) return;
      for (int y = 0; y < part_side; ++y)
        for (int x = 0; x < part_side; ++x) {
          const std::size_t pixel = first + index(x, y);
          const float detail = std::max(rate.of_variance * variances_[pixel], rate.least);
          const int samples = samples_[pixel];
          visit(part, pixel, scaled(detail * inverse_power(samples), pixel, samples));
        }
    });
  }

  /// Of the part that begins at this pixel.
  Sums sums_of(std::size_t first, InversePower& inverse_power) const;
  /// From the sums of the parts around a place.
  float rate_at(std::size_t place) const;
  float least_at(std::size_t place) const;
  void expect_parts();

  WorkerPool& pool_;
  int width_;
  int height_;
  std::size_t columns_;  ///< of blocks
  std::size_t rows_;
  std::size_t stride_;  ///< of a row of `sums_`
  double scale_;
  double least_scale_;
  PixelSpreads spreads_;
  std::vector<int> samples_;
  std::int64_t sample_count_ = 0;  ///< of all pixels
  std::vector<float> variances_;   ///< those that count, in blocks that may err
  std::vector<double> parts_;      ///< their squared errors
  std::vector<double> guesses_;    ///< likewise; negative where there is none
  std::vector<Rate> rates_;
  std::vector<Sums> sums_;        ///< of the parts, row by row, with a rim of nothing
  std::vector<float> details_;    ///< likewise: the squared error of one sample
  std::vector<float> counts_;     ///< likewise: the pixels, those in the image
  std::vector<char> has_detail_;  ///< of the blocks: whether samples differ in it
  std::vector<char>
      may_err_;  ///< likewise: or in one beside it, which is as far as they count, ...
                 ///< ... or spheres may be missed anywhere; guesses apart
  std::optional<MissableSpheres> missable_{};
};

}  // namespace raytracer
