#include "engine/sample/refinement.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

#include "engine/plan/sampling.h"
#include "engine/sample/error_rules.h"
#include "engine/scene/work.h"

namespace raytracer {
namespace {

/// Numbers of samples as they are wanted, by their logarithm in units of a class.
constexpr int log_count =
    (RefinementModel::most_samples_log2 + 1) * RefinementModel::classes_per_octave;

int log_of(int samples) {
  return static_cast<int>(std::floor(RefinementModel::classes_per_octave * std::log2(samples)));
}

/// The same of the samples that an error coefficient asks for, plus what all have in common: of its
/// power 2/5 = 1 / (1 + edge_fall). A float's bits are its logarithm, straight between powers of
/// two, which is off by a twelfth of an octave at most.
int log_of_coefficient(float coefficient) {
  static_assert(1 + SampleErrorModel::edge_fall == 5.0 / 2);
  constexpr int float_mantissa = std::numeric_limits<float>::digits - 1;
  constexpr int dropped =
      float_mantissa - std::countr_zero(unsigned{RefinementModel::classes_per_octave});
  return (std::bit_cast<std::int32_t>(coefficient) >> dropped) * 2 / 5;
}
constexpr int most_log_of_coefficient =
    2 * std::numeric_limits<float>::max_exponent * RefinementModel::classes_per_octave * 2 / 5;

/// What every number of samples that can be wanted comes to: a step of 4, 16, 32, 48, 64, 96 ...
class SampleLadder {
 public:
  std::array<int, log_count> samples{};     ///< of the highest step of at most as many
  std::array<double, log_count> factors{};  ///< of an error coefficient: the squared error

  explicit SampleLadder(int most_samples) {
    const int highest = most_samples - most_samples % RefinementModel::first_step;
    int count = std::min(RefinementModel::first_step, highest);
    for (int at = 0, i = 0; at < log_count; ++i) {
      const int next = count < highest ? std::min(samples_of(i + 1), highest) : highest;
      const int end = count < highest ? log_of(next) : log_count;
      for (; at < end; ++at) {
        samples[static_cast<std::size_t>(at)] = count;
        factors[static_cast<std::size_t>(at)] = 1 / error_power(count);
      }
      count = next;
    }
  }

 private:
  static constexpr int samples_of(int step) {
    static_assert(RefinementModel::steps_per_octave == 2);
    if (step < 2) return step == 0 ? RefinementModel::first_step : RefinementModel::second_step;
    return (step % 2 == 0 ? 2 : 3) * RefinementModel::second_step << (step - 2) / 2;
  }
};

/// Pixels that have as many samples, and whose error coefficients ask for as many more.
struct ErrorClass {
  int samples = 0;
  int log = 0;  ///< of their coefficients
  double count = 0;
  double error2 = 0;       ///< their sum
  double coefficient = 0;  ///< likewise
  int next = 0;            ///< the samples that they get
};

/// The error classes of an image's pixels, in a table with a row for each number of samples.
class ErrorClasses {
 public:
  explicit ErrorClasses(std::span<const PixelError> pixels) {
    class_of_.reserve(pixels.size());
    InversePower inverse_power;
    std::size_t row = 0;
    for (const PixelError& pixel : pixels) {
      if (rows_.empty() || rows_[row] != pixel.samples) row = row_of(pixel.samples);
      const float coefficient = pixel.error2 / inverse_power(pixel.samples);
      const int log = log_of_coefficient(coefficient);
      std::uint32_t& place = table_[row * most_log_of_coefficient + static_cast<std::size_t>(log)];
      if (place == none) {
        place = static_cast<std::uint32_t>(classes_.size());
        classes_.push_back({.samples = pixel.samples, .log = log});
      }
      ErrorClass& its = classes_[place];
      its.count += 1;
      its.error2 += static_cast<double>(pixel.error2);
      its.coefficient += static_cast<double>(coefficient);
      class_of_.push_back(place);
    }
  }

  std::vector<ErrorClass>& all() { return classes_; }
  /// That of the pixel so many places from the first.
  const ErrorClass& of(std::size_t place) const { return classes_[class_of_[place]]; }

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  std::size_t row_of(int samples) {
    const auto row = std::find(rows_.begin(), rows_.end(), samples) - rows_.begin();
    if (row == std::ssize(rows_)) {
      rows_.push_back(samples);
      table_.resize(rows_.size() * most_log_of_coefficient, none);
    }
    return static_cast<std::size_t>(row);
  }

  std::vector<ErrorClass> classes_;
  std::vector<std::uint32_t> class_of_;  ///< each pixel's place among them
  std::vector<int> rows_;                ///< their samples
  std::vector<std::uint32_t> table_;
};

/// What a factor common to all pixels' samples, given by its logarithm, comes to.
class Allocation {
 public:
  Allocation(std::span<const ErrorClass> classes, const RefinementGoal& goal)
      : classes_(classes), goal_(goal), ladder_(goal.most_samples) {}

  /// The samples that the pixels of a class get next, or 0.
  int samples_at(int log_factor, const ErrorClass& of) const {
    const int samples = std::min(ladder_.samples[place_of(log_factor, of)],
                                 RefinementModel::most_growth * of.samples);
    return samples >= RefinementModel::least_growth * of.samples ? samples : 0;
  }

  /// Whether it would bring the sum to the goal, however many times the samples grow.
  bool is_enough(int log_factor) const {
    double sum = 0;
    for (const ErrorClass& each : classes_) {
      const std::size_t at = place_of(log_factor, each);
      const bool is_refined = ladder_.samples[at] >= RefinementModel::least_growth * each.samples;
      sum += is_refined ? error2_at(at, each) : each.error2;
    }
    return sum <= goal_.error2;
  }

  bool is_affordable(int log_factor) const {
    double samples = 0;
    for (const ErrorClass& each : classes_) samples += each.count * samples_at(log_factor, each);
    return samples <= goal_.samples;
  }

 private:
  static std::size_t place_of(int log_factor, const ErrorClass& of) {
    return static_cast<std::size_t>(std::clamp(of.log + log_factor, 0, log_count - 1));
  }

  double error2_at(std::size_t place, const ErrorClass& of) const {
    const double error2 = of.coefficient * ladder_.factors[place];
    if (of.samples < RefinementModel::smooth_fall_samples) return error2;
    static_assert(SampleErrorModel::smooth_fall - SampleErrorModel::edge_fall == 0.5);
    return error2 * std::sqrt(static_cast<double>(of.samples) / ladder_.samples[place]);
  }

  std::span<const ErrorClass> classes_;
  RefinementGoal goal_;
  SampleLadder ladder_;
};

}  // namespace

int most_samples(const Scene& scene, const Limits& limits) {
  constexpr double share_of_last = 1 - 1.0 / RefinementModel::least_growth;
  const double by_work = share_of_last * static_cast<double>(limits.work) / work_of(scene, 1);
  return static_cast<int>(std::clamp(std::min(by_work, static_cast<double>(limits.samples)), 1.0,
                                     static_cast<double>(1 << RefinementModel::most_samples_log2)));
}

int choose_pilot_samples(const SceneStatistics& statistics, int most_samples) {
  if (most_samples < RefinementModel::first_step) return 1;
  const int pilot = pilot_samples(statistics);
  return pilot <= most_samples ? pilot : RefinementModel::first_step;
}

std::vector<PixelSamples> choose_samples(std::span<const PixelError> pixels,
                                         const RefinementGoal& goal) {
  ErrorClasses classes(pixels);
  const Allocation allocation(classes.all(), goal);
  // What is enough stays so as the factor grows, and what is affordable as it falls.
  constexpr int lowest = -most_log_of_coefficient;
  std::array<int, log_count - lowest + 1> logs;
  std::iota(logs.begin(), logs.end(), lowest);
  const auto enough = std::partition_point(logs.begin(), logs.end() - 1,
                                           [&](int log) { return !allocation.is_enough(log); });
  const auto too_dear = std::partition_point(
      logs.begin(), enough + 1, [&](int log) { return allocation.is_affordable(log); });
  const int log_factor = std::min(*enough, lowest - 1 + static_cast<int>(too_dear - logs.begin()));
  for (ErrorClass& each : classes.all()) each.next = allocation.samples_at(log_factor, each);
  std::vector<PixelSamples> refined;
  for (std::size_t i = 0; i < pixels.size(); ++i)
    if (const int samples = classes.of(i).next; samples > 0)
      refined.push_back({pixels[i].pixel, samples});
  return refined;
}

}  // namespace raytracer
