#include "engine/sample/pixel_errors.h"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/parallel/chunks.h"

namespace raytracer {
namespace {

using Model = SampleErrorModel;

constexpr double no_guess = -1;

}  // namespace

PixelErrors::PixelErrors(int width, int height, const ErrorMultiplier& multiplier,
                         const ShownError& shown, WorkerPool& pool)
    : pool_(pool),
      shown_(shown),
      width_(width),
      height_(height),
      columns_(blocks_along(width)),
      rows_(blocks_along(height)),
      stride_(subtiles_across * columns_ + 2),
      calibration_(multiplier),
      spreads_(width, height),
      samples_(spreads_.error2.size()),
      is_refined_(samples_.size()),
      variances_(samples_.size()),
      seen_(samples_.size()),
      subtiles_(subtiles_in_block * columns_ * rows_),
      guesses_(subtiles_.size(), no_guess),
      rates_(subtiles_.size()),
      sums_(stride_ * (subtiles_across * rows_ + 2)) {
  for (std::size_t row = 0; row < rows_; ++row)
    for_each_subtile(row, [this](std::size_t, std::size_t place, std::size_t first) {
      sums_[place].pixels = static_cast<float>(std::min(subtile_side, width_ - x_of(first)) *
                                               std::min(subtile_side, height_ - y_of(first)));
    });
}

void PixelErrors::set_all(int samples) {
  for (int y = 0; y < height_; ++y) std::fill_n(&samples_[index(0, y)], width_, samples);
  sample_count_ = std::int64_t{samples} * width_ * height_;
  std::fill(guesses_.begin(), guesses_.end(), no_guess);
  std::fill(is_refined_.begin(), is_refined_.end(), char{});
  refining_.clear();
  calibration_.forget();
}

void PixelErrors::set(std::size_t pixel, int samples, const PixelSpread& spread) {
  sample_count_ += samples - samples_[pixel];
  samples_[pixel] = samples;
  spreads_.set(pixel, spread);
}

void PixelErrors::refine(std::size_t pixel, int samples, const PixelSpread& spread) {
  refining_.push_back({.pixel = static_cast<std::uint32_t>(pixel),
                       .is_first = is_refined_[pixel] == 0,
                       .samples = samples_[pixel]});
  set(pixel, samples, spread);
}

float PixelErrors::told(const Refining& refining, int samples) const {
  if (!(rates_[subtile_of(refining.pixel)].of_variance > 0)) return 0;
  // The variance of samples is less than that of all by what their mean errs.
  const double rate = refining.rate;
  const double of_mean = calibration_.multiplier(true) * rate / error_power(samples);
  const double variance = variances_[refining.pixel];
  return static_cast<float>(rate / error_power(refining.samples) * variance * (1 + of_mean));
}

void PixelErrors::set_guess(std::size_t subtile, double error2) {
  guesses_[subtile] = error2 > 0 ? error2 : 0;
}

void PixelErrors::forget_guesses(std::size_t block) {
  std::fill_n(&guesses_[subtiles_in_block * block], subtiles_in_block, no_guess);
}

void PixelErrors::use_guesses() {
  for (std::size_t subtile = 0; subtile < subtiles_.size(); ++subtile)
    if (guesses_[subtile] >= 0) subtiles_[subtile] = guesses_[subtile];
}

void PixelErrors::set_subpixel(SubpixelObjects objects, int samples) {
  subpixel_ = std::move(objects);
  subpixel_->learn_contrast(spreads_, samples);
  sum_subtiles();
}

int PixelErrors::x_of(std::size_t pixel) const {
  return static_cast<int>(pixel % static_cast<std::size_t>(spreads_.stride));
}

int PixelErrors::y_of(std::size_t pixel) const {
  return static_cast<int>(pixel / static_cast<std::size_t>(spreads_.stride));
}

std::size_t PixelErrors::block_of(std::size_t pixel) const {
  return block_index(x_of(pixel), y_of(pixel), columns_);
}

Tile PixelErrors::tile_of(std::size_t block) const {
  const int x = static_cast<int>(block % columns_) * block_side;
  const int y = static_cast<int>(block / columns_) * block_side;
  return {x, y, std::min(x + block_side, width_), std::min(y + block_side, height_)};
}

std::size_t PixelErrors::subtile_of(std::size_t pixel) const {
  const int in_block = subtile_index(x_of(pixel) % block_side, y_of(pixel) % block_side);
  return subtiles_in_block * block_of(pixel) + static_cast<std::size_t>(in_block);
}

template <typename Visit>
void PixelErrors::for_each_row(const Visit& visit) const {
  pool_.run(rows_, visit);
}

std::vector<char> PixelErrors::find_variances(std::size_t row) const {
  const auto width = static_cast<std::size_t>(spreads_.stride);
  const std::size_t y_begin = std::max(block_side * row, std::size_t{1}) - 1;
  const std::size_t y_end =
      std::min(block_side * (row + 1) + 1, static_cast<std::size_t>(spreads_.rows()));
  std::vector<float> greatest(width, 0.0F);
  for (std::size_t y = y_begin; y < y_end; ++y) {
    const float* const variance = &spreads_.variance[y * width];
    for (std::size_t x = 0; x < width; ++x) greatest[x] = std::max(greatest[x], variance[x]);
  }
  std::vector<char> has_variance(columns_ + 2, 0);  // with a rim
  for (std::size_t x = 0; x < width; ++x)
    if (greatest[x] > 0)
      has_variance[(x + block_side - 1) / block_side] =
          has_variance[(x + block_side + 1) / block_side] = 1;
  return has_variance;
}

void PixelErrors::spread_variances(std::size_t column, std::size_t row) {
  const auto width = static_cast<std::size_t>(spreads_.stride);
  const auto rows = static_cast<std::size_t>(spreads_.rows());
  const std::size_t x_begin = block_side * column;
  const std::size_t x_end = std::min(x_begin + block_side, width);
  const std::size_t x_last = std::min(x_end + 1, width);
  for (std::size_t y = block_side * row; y < std::min(block_side * (row + 1), rows); ++y) {
    const float* const here = &spreads_.variance[y * width];
    const float* const above = y > 0 ? here - width : here;
    const float* const below = y + 1 < rows ? here + width : here;
    std::array<float, block_side + 2> highest{};  // of three rows, with a rim
    for (std::size_t x = std::max(x_begin, std::size_t{1}) - 1; x < x_last; ++x)
      highest[x + 1 - x_begin] = std::max(std::max(above[x], below[x]), here[x]);
    float* const to = &variances_[y * width];
    for (std::size_t x = x_begin; x < x_end; ++x) {
      const float* const near = &highest[x - x_begin];
      to[x] = std::max(
          here[x], Model::pixel_neighbour_share * std::max(std::max(near[0], near[1]), near[2]));
    }
  }
}

void PixelErrors::sum_up(std::size_t first, InversePower& inverse_power, SubtileSums& sums) const {
  // Column by column, which do not wait for each other.
  std::array<float, subtile_side> error2{};
  std::array<float, subtile_side> variance{};
  std::array<float, subtile_side> variance2{};
  const int samples = samples_[first];
  bool are_alike = true;
  for (int y = 0; y < subtile_side; ++y)
    for (std::size_t x = 0; x < subtile_side; ++x) {
      const std::size_t pixel = first + index(0, y) + x;
      error2[x] += spreads_.error2[pixel];
      variance[x] += variances_[pixel];
      variance2[x] += variances_[pixel] * variances_[pixel];
      are_alike &= samples_[pixel] == samples;
    }
  sums.error2 = (error2[0] + error2[1]) + (error2[2] + error2[3]);
  sums.variance = (variance[0] + variance[1]) + (variance[2] + variance[3]);
  const float share = inverse_power(samples);
  sums.of_means = sums.variance * share;
  sums.of_means2 = ((variance2[0] + variance2[1]) + (variance2[2] + variance2[3])) * share * share;
  if (are_alike) return;
  sums.variance = sums.of_means = sums.of_means2 = 0;
  for (int y = 0; y < subtile_side; ++y)
    for (int x = 0; x < subtile_side; ++x) {
      const std::size_t pixel = first + index(x, y);
      if (samples_[pixel] == 0) continue;
      const float of_mean = variances_[pixel] * inverse_power(samples_[pixel]);
      sums.of_means += of_mean;
      sums.of_means2 += of_mean * of_mean;
      sums.variance += variances_[pixel];
    }
}

float PixelErrors::rate_at(std::size_t place) const {
  float error2 = 0;
  float of_means = 0;
  float of_means2 = 0;
  for (const std::size_t row : {place - stride_, place, place + stride_})
    for (const std::size_t at : {row - 1, row, row + 1}) {
      error2 += sums_[at].error2;
      of_means += sums_[at].of_means;
      of_means2 += sums_[at].of_means2;
    }
  if (!(of_means > 0)) return 0;
  const float expected = Model::prior_edge_pixels * of_means2 / of_means;
  return std::max(error2 / of_means, (error2 + expected) / (of_means + expected));
}

float PixelErrors::least_at(std::size_t place) const {
  float coefficient = 0;
  float pixels = 0;
  for (const std::size_t row : {place - stride_, place, place + stride_})
    for (const std::size_t at : {row - 1, row, row + 1}) {
      if (at == place) continue;
      coefficient += sums_[at].coefficient;
      pixels += sums_[at].pixels;
    }
  return pixels > 0 ? Model::subtile_neighbour_share * coefficient / pixels : 0;
}

void PixelErrors::find_rates() {
  for_each_row([this](std::size_t row) {
    const std::vector<char> has_variance = find_variances(row);
    for (std::size_t column = 0; column < columns_; ++column)
      if (has_variance[column + 1] != 0) spread_variances(column, row);
    InversePower inverse_power;
    for_each_subtile(row, [&](std::size_t subtile, std::size_t place, std::size_t first) {
      if (has_variance[subtile / subtiles_in_block - columns_ * row + 1] != 0)
        sum_up(first, inverse_power, sums_[place]);
      else
        sums_[place] = {.pixels = sums_[place].pixels};
    });
  });
  for_each_row([this](std::size_t row) {
    for_each_subtile(row, [this](std::size_t subtile, std::size_t place, std::size_t) {
      rates_[subtile].of_variance = sums_[place].variance > 0 ? rate_at(place) : 0;
      sums_[place].coefficient = rates_[subtile].of_variance * sums_[place].variance;
    });
  });
  for_each_row([this](std::size_t row) {
    for_each_subtile(row, [this](std::size_t subtile, std::size_t place, std::size_t) {
      rates_[subtile].least = least_at(place);
    });
  });
}

void PixelErrors::estimate() {
  find_rates();
  sum_subtiles();
}

void PixelErrors::learn(double change2) {
  for_each_range(refining_.size(), pool_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      refining_[i].rate = rates_[subtile_of(refining_[i].pixel)].of_variance;
      refining_[i].before = told(refining_[i], refining_[i].samples);
    }
  });
  find_rates();
  calibrate(change2);
  sum_subtiles();
}

void PixelErrors::sum_subtiles() {
  for_each_row([this](std::size_t row) {
    InversePower inverse_power;
    for_each_subtile(row, [&](std::size_t subtile, std::size_t, std::size_t first) {
      double sum = 0;
      for_each_pixel(first, [&](std::size_t pixel, int x, int y) {
        seen_[pixel] =
            may_err(subtile)
                ? static_cast<float>(shown(unscaled(subtile, pixel, inverse_power), pixel, x, y))
                : 0;
        sum += of_pixel(pixel);
      });
      subtiles_[subtile] = sum;
    });
  });
  use_guesses();
}

void PixelErrors::calibrate(double change2) {
  // All by one multiplier, as that is what the change corrects.
  const double of_left = calibration_.multiplier(true) / calibration_.multiplier(false);
  std::vector<double> before(refining_.size());
  std::vector<double> after(refining_.size());
  for_each_range(refining_.size(), pool_, [&](std::size_t begin, std::size_t end) {
    InversePower inverse_power;
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t pixel = refining_[i].pixel;
      refining_[i].after = told(refining_[i], samples_[pixel]);
      before[i] = (refining_[i].is_first ? of_left : 1) * static_cast<double>(seen_[pixel]);
      is_refined_[pixel] = 1;
      after[i] =
          shown(unscaled(subtile_of(pixel), pixel, inverse_power), pixel, x_of(pixel), y_of(pixel));
    }
  });
  for (const Refining& refining : refining_)
    calibration_.tell({.before = refining.before, .after = refining.after}, refining.is_first);
  refining_ = {};
  calibration_.learn(before, after, change2, unscaled_left());
}

double PixelErrors::unscaled_left() const {
  std::vector<double> sums(rows_);
  for_each_row([&](std::size_t row) {
    InversePower inverse_power;
    double sum = 0;
    for_each_subtile(row, [&](std::size_t subtile, std::size_t, std::size_t first) {
      if (!may_err(subtile)) return;
      for_each_pixel(first, [&](std::size_t pixel, int, int) {
        if (is_refined_[pixel] == 0)
          sum += static_cast<double>(unscaled(subtile, pixel, inverse_power));
      });
    });
    sums[row] = sum;
  });
  return sum_of(sums);
}

float PixelErrors::unscaled(std::size_t subtile, std::size_t pixel,
                            InversePower& inverse_power) const {
  const Rate& rate = rates_[subtile];
  return std::max(rate.of_variance * variances_[pixel], rate.least) *
         inverse_power(samples_[pixel]);
}

double PixelErrors::of_pixel(std::size_t pixel) const {
  const auto seen = static_cast<double>(seen_[pixel]);
  if (!subpixel_ || samples_[pixel] < 1) return seen;
  const double missed = subpixel_->error2(pixel, samples_[pixel]);
  return std::max(seen, shown_(missed, x_of(pixel), y_of(pixel)));
}

}  // namespace raytracer
