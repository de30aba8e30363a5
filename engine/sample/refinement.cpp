#include "engine/sample/refinement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "engine/math/block.h"
#include "engine/plan/sampling.h"
#include "engine/scene/overrides.h"

namespace raytracer {
namespace {

constexpr int least_growth = 2;
constexpr int most_growth = 16;

/// Of errors' fall: of random samples, and where edges cross pixels.
constexpr double slowest = 1;
constexpr double fastest = 1.5;

/// Numbers of samples: 4, 8, 12, 16, 24 ... From 8 on two in an octave, so that parts of a block
/// often have the same and are traced together, and all in fours (sample_pattern()).
constexpr int rung_count = 48;

constexpr int samples_of_rung(int rung) {
  if (rung == 0) return 4;
  return rung % 2 == 1 ? 8 << (rung - 1) / 2 : 12 << (rung - 2) / 2;
}

/// Squared errors fall as this power of a number of samples, -3/2, and details grow.
double power(int samples) { return samples * std::sqrt(samples); }

/// power() of parts one after another, most of which have the samples of the one before.
class PowerOfParts {
 public:
  double operator()(int samples) {
    if (samples != samples_) {
      samples_ = samples;
      power_ = power(samples);
    }
    return power_;
  }

 private:
  int samples_ = 0;
  double power_ = 0;
};

/// Numbers of samples as they are wanted, by steps of their logarithm.
constexpr int steps_per_octave = 16;
constexpr int step_count = 30 * steps_per_octave;

int step_of(double samples) {
  return static_cast<int>(std::floor(steps_per_octave * std::log2(samples)));
}

/// What every number of samples that can be wanted comes to.
struct Ladder {
  std::array<int, step_count> samples{};     ///< of the highest rung of at most as many
  std::array<double, step_count> factors{};  ///< of one sample's squared error

  explicit Ladder(int most_samples) {
    int rung = 0;
    for (int step = 0; step < step_count; ++step) {
      const auto at = static_cast<std::size_t>(step);
      while (rung + 1 < rung_count && samples_of_rung(rung + 1) <= most_samples &&
             step_of(samples_of_rung(rung + 1)) <= step)
        ++rung;
      const int highest = most_samples - most_samples % 4;
      samples[at] = step >= step_of(highest) ? highest : samples_of_rung(rung);
      factors[at] = 1 / power(samples[at]);
    }
  }
};

/// A part that more samples would do good.
struct Candidate {
  std::size_t part;
  int least_samples;
  int most_samples;  ///< at once
  int step;          ///< of the samples that its detail needs, plus a level that all have in common
  double error2;
  double detail;  ///< the squared error of one sample
};

std::vector<Candidate> candidates_of(std::span<const ImagePart> parts) {
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const ImagePart& part = parts[i];
    if (part.error2 <= 0) continue;
    const double detail = part.error2 * power(part.samples);
    candidates.push_back({.part = i,
                          .least_samples = least_growth * part.samples,
                          .most_samples = most_growth * part.samples,
                          .step = step_of(detail) * 2 / 5,
                          .error2 = part.error2,
                          .detail = detail});
  }
  return candidates;
}

/// Of a level common to all: whether it is enough for the goal, and affordable.
class Levels {
 public:
  Levels(std::span<const Candidate> candidates, const RefinementGoal& goal)
      : candidates_(candidates), goal_(goal), ladder_(goal.most_samples) {}

  /// The samples that a part gets next, or 0.
  int samples_at(int level, const Candidate& candidate) const {
    const int samples =
        std::min(ladder_.samples[rung_at(level, candidate)], candidate.most_samples);
    return samples >= candidate.least_samples ? samples : 0;
  }

  /// Whether it would bring the sum to the goal, however many times the samples grow.
  bool is_enough(int level) const {
    double sum = 0;
    for (const Candidate& candidate : candidates_) {
      const std::size_t at = rung_at(level, candidate);
      const bool is_refined = ladder_.samples[at] >= candidate.least_samples;
      sum += is_refined ? candidate.detail * ladder_.factors[at] : candidate.error2;
    }
    return sum <= goal_.error2;
  }

  bool is_affordable(int level) const {
    double samples = 0;
    for (const Candidate& candidate : candidates_) samples += samples_at(level, candidate);
    return samples <= goal_.samples;
  }

 private:
  static std::size_t rung_at(int level, const Candidate& candidate) {
    return static_cast<std::size_t>(std::clamp(candidate.step + level, 0, step_count - 1));
  }

  std::span<const Candidate> candidates_;
  RefinementGoal goal_;
  Ladder ladder_;
};

/// The first in [begin, end) of which `is_true`, which all after it are, too; `end` if none is.
template <typename Condition>
int first_true(int begin, int end, const Condition& is_true) {
  while (begin < end) {
    const int middle = begin + (end - begin) / 2;
    if (is_true(middle))
      end = middle;
    else
      begin = middle + 1;
  }
  return end;
}

}  // namespace

int most_samples(const Scene& scene, const Limits& limits) {
  constexpr double share_of_last = 0.5;
  const double by_work = share_of_last * static_cast<double>(limits.work) / count_rays(scene, 1);
  return static_cast<int>(std::clamp(std::min(by_work, static_cast<double>(limits.samples)), 1.0,
                                     static_cast<double>(1 << 26)));
}

int first_compared_samples(const Census& census, int most_samples) {
  constexpr int fewest_in_halves = 4;
  if (most_samples < fewest_in_halves) return 1;
  const int probing = probing_samples(census);
  return probing <= most_samples ? probing : fewest_in_halves;
}

ErrorFall::ErrorFall(const Census& census)
    : guess_(census.small_spheres > 0 ? slowest : (slowest + fastest) / 2) {}

void ErrorFall::include(std::span<const ImagePart> before, std::span<const ImagePart> after) {
  double slow = 0;
  double fast = 0;
  double real = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (before[i].samples == 0 || after[i].samples <= before[i].samples) continue;
    const double growth = static_cast<double>(after[i].samples) / before[i].samples;
    slow += before[i].error2 * std::pow(growth, -slowest);
    fast += before[i].error2 * std::pow(growth, -fastest);
    real += after[i].error2;
  }
  if (fast <= 0 || real <= 0) return;
  log_fall_ += std::log(slow / real);
  log_range_ += std::log(slow / fast);
}

double ErrorFall::exponent() const {
  constexpr double least_range = 0.7;  // less is noise
  if (log_range_ < least_range) return guess_;
  return std::clamp(slowest + (fastest - slowest) * log_fall_ / log_range_, slowest, fastest);
}

double ErrorFall::halves_excess() const { return std::exp2(exponent()) - 1; }

std::vector<ImagePart> expected_errors(std::span<const ImagePart> parts, int width, int height,
                                       double halves_excess) {
  constexpr double share = 0.1;
  const int block_columns = (width + block_side - 1) / block_side;
  const int columns = (width + part_side - 1) / part_side;
  const int rows = (height + part_side - 1) / part_side;
  const auto index = [&](int x, int y) {
    return parts_in_block *
               static_cast<std::size_t>(y / parts_across * block_columns + x / parts_across) +
           static_cast<std::size_t>(y % parts_across * parts_across + x % parts_across);
  };
  // What errors have in common at all numbers of samples, with a rim of nothing.
  const std::size_t stride = static_cast<std::size_t>(columns) + 2;
  std::vector<double> detail(stride * (static_cast<std::size_t>(rows) + 2), 0.0);
  const auto place = [&](int x, int y) {
    return static_cast<std::size_t>(y + 1) * stride + static_cast<std::size_t>(x + 1);
  };
  PowerOfParts power_of;
  const double excess_share = 1 / halves_excess;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const ImagePart& part = parts[index(x, y)];
      detail[place(x, y)] = part.error2 * excess_share * power_of(part.samples);
    }
  std::vector<ImagePart> expected(parts.size());
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const std::size_t i = index(x, y);
      expected[i] = parts[i];
      if (parts[i].samples == 0) continue;
      const std::size_t at = place(x, y);
      double sum = -detail[at];
      for (const std::size_t row : {at - stride, at, at + stride})
        sum += detail[row - 1] + detail[row] + detail[row + 1];
      expected[i].error2 =
          std::max(parts[i].error2 * excess_share, share * sum / 8 / power_of(parts[i].samples));
    }
  return expected;
}

double conservative_sum(std::span<const ImagePart> parts) {
  double sum = 0;
  double squares = 0;
  for (const ImagePart& part : parts) {
    sum += part.error2;
    squares += part.error2 * part.error2;
  }
  return sum + 2 * std::sqrt(2 * squares);
}

std::vector<int> next_samples(std::span<const ImagePart> parts, const RefinementGoal& goal) {
  std::vector<int> samples(parts.size(), 0);
  const std::vector<Candidate> candidates = candidates_of(parts);
  if (candidates.empty()) return samples;
  const auto [least, most] =
      std::minmax_element(candidates.begin(), candidates.end(),
                          [](const Candidate& a, const Candidate& b) { return a.step < b.step; });
  const int lowest = -most->step;
  const int highest = step_count - least->step;
  const Levels levels(candidates, goal);
  const int enough =
      first_true(lowest, highest, [&](int level) { return levels.is_enough(level); });
  const int too_dear =
      first_true(lowest, enough + 1, [&](int level) { return !levels.is_affordable(level); });
  const int level = std::min(enough, too_dear - 1);
  for (const Candidate& candidate : candidates)
    samples[candidate.part] = levels.samples_at(level, candidate);
  return samples;
}

}  // namespace raytracer
