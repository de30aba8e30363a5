#include "engine/sample/pixel_errors.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <numeric>
#include <utility>

#include "engine/math/block.h"

namespace raytracer {
namespace {

/// Where samples met detail there is more beside it that they have missed: a pixel's variance
/// counts as at least this share of its neighbours' greatest, ...
constexpr float pixels_share = 0.2F;
/// ... and a pixel's error as at least this share of the mean of those in the parts beside. Of 0 to
/// 0.6 and 0 to 0.1 those that kept most targets on 19 scenes, and took few samples more.
constexpr float parts_share = 0.1F;

constexpr double no_guess = -1;

}  // namespace

PixelErrors::PixelErrors(int width, int height, const ErrorScale& scale, WorkerPool& pool)
    : pool_(pool),
      width_(width),
      height_(height),
      columns_(static_cast<std::size_t>((width + block_side - 1) / block_side)),
      rows_(static_cast<std::size_t>((height + block_side - 1) / block_side)),
      stride_(parts_across * columns_ + 2),
      scale_(scale.first),
      least_scale_(scale.least),
      spreads_(width, height),
      samples_(spreads_.error2.size()),
      variances_(samples_.size()),
      parts_(parts_in_block * columns_ * rows_),
      guesses_(parts_.size(), no_guess),
      rates_(parts_.size()),
      sums_(stride_ * (parts_across * rows_ + 2)),
      details_(sums_.size()),
      counts_(sums_.size()),
      has_detail_(columns_ * rows_),
      may_err_(columns_ * rows_) {
  const int part_columns = spreads_.stride / part_side;
  const int part_rows = spreads_.rows() / part_side;
  for (int y = 0; y < part_rows; ++y) {
    float* const row = &counts_[static_cast<std::size_t>(y + 1) * stride_ + 1];
    const int pixel_rows = std::min(part_side, height_ - part_side * y);
    std::fill_n(row, part_columns, static_cast<float>(part_side * pixel_rows));
    const int last_columns = width_ - part_side * (part_columns - 1);
    row[part_columns - 1] = static_cast<float>(last_columns * pixel_rows);
  }
}

void PixelErrors::set_all(int samples) {
  for (int y = 0; y < height_; ++y) std::fill_n(&samples_[index(0, y)], width_, samples);
  sample_count_ = std::int64_t{samples} * width_ * height_;
  std::fill(guesses_.begin(), guesses_.end(), no_guess);
}

void PixelErrors::set(std::size_t pixel, int samples, const PixelSpread& spread) {
  sample_count_ += samples - samples_[pixel];
  samples_[pixel] = samples;
  spreads_.set(pixel, spread);
}

void PixelErrors::set_guess(std::size_t part, double error2) {
  guesses_[part] = error2 > 0 ? error2 : 0;
}

void PixelErrors::forget_guesses(std::size_t block) {
  std::fill_n(&guesses_[parts_in_block * block], parts_in_block, no_guess);
}

void PixelErrors::expect_guesses() {
  for (std::size_t part = 0; part < parts_.size(); ++part)
    if (guesses_[part] >= 0) parts_[part] = guesses_[part];
}

void PixelErrors::set_missable(MissableSpheres spheres) {
  missable_ = std::move(spheres);
  std::fill(may_err_.begin(), may_err_.end(), 1);
  expect_parts();
}

int PixelErrors::x_of(std::size_t pixel) const {
  return static_cast<int>(pixel % static_cast<std::size_t>(spreads_.stride));
}

int PixelErrors::y_of(std::size_t pixel) const {
  return static_cast<int>(pixel / static_cast<std::size_t>(spreads_.stride));
}

std::size_t PixelErrors::block_of(std::size_t pixel) const {
  const auto column = static_cast<std::size_t>(x_of(pixel) / block_side);
  const auto row = static_cast<std::size_t>(y_of(pixel) / block_side);
  return row * columns_ + column;
}

Tile PixelErrors::tile_of(std::size_t block) const {
  const int x = static_cast<int>(block % columns_) * block_side;
  const int y = static_cast<int>(block / columns_) * block_side;
  return {x, y, std::min(x + block_side, width_), std::min(y + block_side, height_)};
}

std::size_t PixelErrors::part_of(std::size_t pixel) const {
  const auto x = static_cast<std::size_t>(x_of(pixel));
  const auto y = static_cast<std::size_t>(y_of(pixel));
  return parts_in_block * block_of(pixel) + y % block_side / part_side * parts_across +
         x % block_side / part_side;
}

template <typename Visit>
void PixelErrors::for_each_row(const Visit& visit) const {
  // To wake the others takes longer than to look at few.
  constexpr std::size_t few_parts = 4096;
  if (parts_.size() < few_parts) {
    for (std::size_t row = 0; row < rows_; ++row) visit(row);
    return;
  }
  const std::atomic<bool> never{false};
  pool_.run(rows_, visit, never);
}

void PixelErrors::find_details(std::size_t row) {
  const auto stride = static_cast<std::size_t>(spreads_.stride);
  const auto rows = static_cast<std::size_t>(spreads_.rows());
  std::vector<std::uint32_t> bits(stride);  // of all rows: a number is 0 if none is set
  for (std::size_t y = block_side * row; y < std::min(block_side * (row + 1), rows); ++y) {
    const float* const error2 = &spreads_.error2[y * stride];
    const float* const variance = &spreads_.variance[y * stride];
    for (std::size_t x = 0; x < stride; ++x)
      bits[x] |=
          std::bit_cast<std::uint32_t>(error2[x]) | std::bit_cast<std::uint32_t>(variance[x]);
  }
  std::fill_n(&has_detail_[columns_ * row], columns_, 0);
  for (std::size_t x = 0; x < stride; ++x)
    if (bits[x] != 0) has_detail_[columns_ * row + x / block_side] = 1;
}

void PixelErrors::choose_blocks(std::size_t row) {
  const std::size_t row_begin = row > 0 ? row - 1 : row;
  const std::size_t row_end = std::min(row + 2, rows_);
  for (std::size_t column = 0; column < columns_; ++column) {
    const std::size_t begin = column > 0 ? column - 1 : column;
    const std::size_t end = std::min(column + 2, columns_);
    bool may_err = missable_.has_value();
    for (std::size_t y = row_begin; y < row_end; ++y)
      for (std::size_t x = begin; x < end; ++x) may_err |= has_detail_[columns_ * y + x] != 0;
    char& known = may_err_[columns_ * row + column];
    const bool might_err = known != 0;
    known = static_cast<char>(may_err);
    if (may_err || !might_err) continue;
    for_each_part_of(column, row, [this](std::size_t part, std::size_t place, std::size_t) {
      rates_[part].of_variance = rates_[part].least = 0;
      sums_[place] = {};
      details_[place] = 0;
    });
  }
}

void PixelErrors::spread_variances(std::size_t row) {
  const char* const may_err = &may_err_[columns_ * row];
  for (std::size_t begin = 0; begin < columns_; ++begin) {
    if (may_err[begin] == 0) continue;
    std::size_t end = begin + 1;
    while (end < columns_ && may_err[end] != 0) ++end;
    spread_variances(row, begin, end);
    begin = end;
  }
}

void PixelErrors::spread_variances(std::size_t row, std::size_t column_begin,
                                   std::size_t column_end) {
  const auto stride = static_cast<std::size_t>(spreads_.stride);
  const auto rows = static_cast<std::size_t>(spreads_.rows());
  const std::size_t x_begin = block_side * column_begin;
  const std::size_t width = std::min(block_side * column_end, stride) - x_begin;
  // What is beside these blocks has no variance: blocks beside one that has may err, too.
  std::vector<float> highest(width + 2, 0.0F);  // of three rows, with a rim
  for (std::size_t y = block_side * row; y < std::min(block_side * (row + 1), rows); ++y) {
    const float* const here = &spreads_.variance[y * stride + x_begin];
    const float* const above = y > 0 ? here - stride : here;
    const float* const below = y + 1 < rows ? here + stride : here;
    for (std::size_t x = 0; x < width; ++x)
      highest[x + 1] = std::max(std::max(above[x], below[x]), here[x]);
    float* const to = &variances_[y * stride + x_begin];
    for (std::size_t x = 0; x < width; ++x)
      to[x] = std::max(
          here[x], pixels_share * std::max(std::max(highest[x], highest[x + 1]), highest[x + 2]));
  }
}

PixelErrors::Sums PixelErrors::sums_of(std::size_t first, InversePower& inverse_power) const {
  // Column by column, which do not wait for each other.
  std::array<float, part_side> error2{};
  std::array<float, part_side> detail{};
  const int samples = samples_[first];
  bool are_alike = true;
  for (int y = 0; y < part_side; ++y)
    for (std::size_t x = 0; x < part_side; ++x) {
      const std::size_t pixel = first + index(0, y) + x;
      error2[x] += spreads_.error2[pixel];
      detail[x] += variances_[pixel];
      are_alike &= samples_[pixel] == samples;
    }
  Sums sums{.error2 = (error2[0] + error2[1]) + (error2[2] + error2[3]),
            .detail = (detail[0] + detail[1]) + (detail[2] + detail[3])};
  if (are_alike) {
    sums.variance = sums.detail * inverse_power(samples);
    return sums;
  }
  sums.detail = 0;
  for (int y = 0; y < part_side; ++y)
    for (int x = 0; x < part_side; ++x) {
      const std::size_t pixel = first + index(x, y);
      if (samples_[pixel] == 0) continue;
      sums.variance += variances_[pixel] * inverse_power(samples_[pixel]);
      sums.detail += variances_[pixel];
    }
  return sums;
}

float PixelErrors::rate_at(std::size_t place) const {
  float error2 = 0;
  float variance = 0;
  for (const std::size_t row : {place - stride_, place, place + stride_})
    for (const std::size_t at : {row - 1, row, row + 1}) {
      error2 += sums_[at].error2;
      variance += sums_[at].variance;
    }
  return variance > 0 ? error2 / variance : 0;
}

float PixelErrors::least_at(std::size_t place) const {
  float detail = 0;
  float count = 0;
  for (const std::size_t at :
       {place - stride_ - 1, place - stride_, place - stride_ + 1, place - 1, place + 1,
        place + stride_ - 1, place + stride_, place + stride_ + 1}) {
    detail += details_[at];
    count += counts_[at];
  }
  return count > 0 ? parts_share * detail / count : 0;
}

void PixelErrors::expect() {
  if (!missable_) for_each_row([this](std::size_t row) { find_details(row); });
  for_each_row([this](std::size_t row) {
    choose_blocks(row);
    spread_variances(row);
    InversePower inverse_power;
    for_each_part_in(row, [&](std::size_t, std::size_t place, std::size_t first) {
      sums_[place] = sums_of(first, inverse_power);
    });
  });
  for_each_row([this](std::size_t row) {
    for_each_part_in(row, [this](std::size_t part, std::size_t place, std::size_t) {
      rates_[part].of_variance = rate_at(place);
      details_[place] = rates_[part].of_variance * sums_[place].detail;
    });
  });
  for_each_row([this](std::size_t row) {
    for_each_part_in(row, [this](std::size_t part, std::size_t place, std::size_t) {
      rates_[part].least = least_at(place);
    });
  });
  expect_parts();
}

void PixelErrors::expect_parts() {
  for_each_row([this](std::size_t row) {
    const std::size_t parts_in_row = parts_in_block * columns_;
    std::fill_n(&parts_[parts_in_row * row], parts_in_row, 0.0);
    for_each_error_in(
        row, [this](std::size_t part, std::size_t, double error2) { parts_[part] += error2; });
  });
  expect_guesses();
}

void PixelErrors::calibrate(std::span<const std::uint32_t> pixels, std::span<const float> before,
                            double change2) {
  // Pixels refined where halves happened to differ seem to change less than they expected: no
  // sudden fall is believed.
  constexpr double pixels_of_doubt = 100;  // a refinement of fewer says little
  constexpr double most = 4;
  constexpr double least_fall = 0.6;
  const std::vector<float> after = unscaled(pixels);
  double sum = 0;
  double squares = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const double expected = static_cast<double>(before[i]) + static_cast<double>(after[i]);
    sum += expected;
    squares += expected * expected;
  }
  if (!(squares > 0)) return;
  const double weight = sum * sum / squares;  // as many pixels of equal errors would say as much
  const double seen =
      (change2 * weight / sum + scale_ * pixels_of_doubt) / (weight + pixels_of_doubt);
  const double before_it = scale_;
  scale_ = std::clamp(std::max(seen, least_fall * scale_), least_scale_, most);
  if (missable_) {
    expect_parts();
    return;
  }
  for (double& error2 : parts_) error2 *= scale_ / before_it;
  expect_guesses();
}

std::vector<float> PixelErrors::unscaled(std::span<const std::uint32_t> pixels) const {
  std::vector<float> errors2;
  errors2.reserve(pixels.size());
  InversePower inverse_power;
  for (const std::uint32_t pixel : pixels) errors2.push_back(unscaled(pixel, inverse_power));
  return errors2;
}

float PixelErrors::unscaled(std::size_t pixel, InversePower& inverse_power) const {
  const Rate& rate = rates_[part_of(pixel)];
  return std::max(rate.of_variance * variances_[pixel], rate.least) *
         inverse_power(samples_[pixel]);
}

double PixelErrors::of_pixel(std::size_t pixel) const {
  InversePower inverse_power;
  return scaled(unscaled(pixel, inverse_power), pixel, samples_[pixel]);
}

double PixelErrors::scaled(float unscaled, std::size_t pixel, int samples) const {
  const double seen = scale_ * static_cast<double>(unscaled);
  if (!missable_ || samples < 1) return seen;
  return std::max(seen, missable_->error2(pixel, samples));
}

double PixelErrors::expected_error2() const {
  return std::accumulate(parts_.begin(), parts_.end(), 0.0);
}

}  // namespace raytracer
