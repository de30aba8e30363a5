#include "engine/sample/refinement.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>

#include "engine/plan/sampling.h"
#include "engine/sample/error_rules.h"
#include "engine/scene/overrides.h"

namespace raytracer {
namespace {

constexpr int least_growth = 2;
constexpr int most_growth = 16;

/// Where so many samples told of an error, it is taken to fall as n^-2: what is smooth falls faster
/// than edges, and estimates come down the more is known. Of 648 contracts (27 scenes, 6 sizes, 4
/// targets) all were kept with 0.8 to 1 of the samples; where fewer samples are believed, too, 4
/// were not.
constexpr int telling_samples = 16;

/// Numbers of samples: 4, 16, 32, 48, 64, 96 ...: from 16 on they fill packets of any width, from
/// 32 on two in an octave.
constexpr int rung_count = 46;

constexpr int samples_of_rung(int rung) {
  if (rung < 2) return rung == 0 ? 4 : 16;
  return rung % 2 == 0 ? 32 << (rung - 2) / 2 : 48 << (rung - 3) / 2;
}

/// Numbers of samples as they are wanted, by steps of their logarithm.
constexpr int steps_per_octave = 16;
constexpr int step_count = 30 * steps_per_octave;

int step_of(int samples) {
  return static_cast<int>(std::floor(steps_per_octave * std::log2(samples)));
}

/// The step of the samples that a detail asks for, its power 2/5, plus a level that all have in
/// common. Its logarithm is that of a float's bits, straight between powers of two, which is off by
/// a twelfth of an octave at most.
int step_of_detail(float detail) {
  constexpr int bits_per_octave = 23;
  constexpr int bits_per_step = bits_per_octave - 4;  // 2^4 steps
  static_assert(steps_per_octave == 1 << (bits_per_octave - bits_per_step));
  return (std::bit_cast<std::int32_t>(detail) >> bits_per_step) * 2 / 5;
}

/// What every number of samples that can be wanted comes to.
class Ladder {
 public:
  std::array<int, step_count> samples{};     ///< of the highest rung of at most as many
  std::array<double, step_count> factors{};  ///< of one sample's squared error

  explicit Ladder(int most_samples) {
    const int highest = most_samples - most_samples % 4;
    int step = 0;
    for (int rung = 0; rung < rung_count && samples_of_rung(rung) < highest; ++rung) {
      const bool is_last = rung + 1 == rung_count || samples_of_rung(rung + 1) > highest;
      const int end = step_of(is_last ? highest : samples_of_rung(rung + 1));
      fill(step, end, samples_of_rung(rung));
      step = end;
    }
    fill(step, step_count, highest);
  }

 private:
  void fill(int begin, int end, int count) {
    const double factor = 1 / error_power(count);
    for (auto at = static_cast<std::size_t>(begin); at < static_cast<std::size_t>(end); ++at) {
      samples[at] = count;
      factors[at] = factor;
    }
  }
};

/// Pixels that have as many samples, and whose details ask for as many more.
struct Kind {
  int samples = 0;
  int step = 0;
  double count = 0;
  double error2 = 0;  ///< their sum
  double detail = 0;
  int next = 0;  ///< the samples that they get
};

/// The kinds of an image's pixels, found by a table with a row for each number of samples.
class Kinds {
 public:
  explicit Kinds(std::span<const RoughPixel> pixels) {
    const std::vector<Wish> wishes = wishes_of(pixels);
    const auto width = static_cast<std::size_t>(step_end_ - step_begin_);
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> table(rows_.size() * width, none);
    kind_of_.reserve(pixels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const Wish& wish = wishes[i];
      std::uint32_t& place =
          table[wish.row * width + static_cast<std::size_t>(wish.step - step_begin_)];
      if (place == none) {
        place = static_cast<std::uint32_t>(kinds_.size());
        kinds_.push_back({.samples = pixels[i].samples, .step = wish.step});
      }
      Kind& kind = kinds_[place];
      kind.count += 1;
      kind.error2 += static_cast<double>(pixels[i].error2);
      kind.detail += static_cast<double>(wish.detail);
      kind_of_.push_back(place);
    }
  }

  std::vector<Kind>& all() { return kinds_; }
  /// That of the pixel so many places from the first.
  const Kind& of(std::size_t place) const { return kinds_[kind_of_[place]]; }
  int step_begin() const { return step_begin_; }
  int step_end() const { return step_end_; }

 private:
  /// What tells a pixel's kind.
  struct Wish {
    float detail;
    int step;
    std::uint32_t row;
  };

  std::vector<Wish> wishes_of(std::span<const RoughPixel> pixels) {
    std::vector<Wish> wishes;
    wishes.reserve(pixels.size());
    InversePower inverse_power;
    step_begin_ = std::numeric_limits<int>::max();
    std::uint32_t row = 0;
    for (const RoughPixel& pixel : pixels) {
      const float detail = pixel.error2 / inverse_power(pixel.samples);
      const int step = step_of_detail(detail);
      step_begin_ = std::min(step_begin_, step);
      step_end_ = std::max(step_end_, step + 1);
      if (row == rows_.size() || rows_[row] != pixel.samples) row = row_of(pixel.samples);
      wishes.push_back({detail, step, row});
    }
    return wishes;
  }

  std::uint32_t row_of(int samples) {
    const auto row = std::find(rows_.begin(), rows_.end(), samples) - rows_.begin();
    if (row == std::ssize(rows_)) rows_.push_back(samples);
    return static_cast<std::uint32_t>(row);
  }

  std::vector<Kind> kinds_;
  std::vector<std::uint32_t> kind_of_;  ///< each pixel's place among them
  std::vector<int> rows_;               ///< their samples
  int step_begin_ = 0;
  int step_end_ = 0;
};

/// Of a level common to all: whether it is enough for the goal, and affordable.
class Levels {
 public:
  Levels(std::span<const Kind> kinds, const RefinementGoal& goal)
      : kinds_(kinds), goal_(goal), ladder_(goal.most_samples) {}

  /// The samples that a kind's pixels get next, or 0.
  int samples_at(int level, const Kind& kind) const {
    const int samples = std::min(ladder_.samples[rung_at(level, kind)], most_growth * kind.samples);
    return samples >= least_growth * kind.samples ? samples : 0;
  }

  /// Whether it would bring the sum to the goal, however many times the samples grow.
  bool is_enough(int level) const {
    double sum = 0;
    for (const Kind& kind : kinds_) {
      const std::size_t at = rung_at(level, kind);
      const bool is_refined = ladder_.samples[at] >= least_growth * kind.samples;
      sum += is_refined ? error2_at(at, kind) : kind.error2;
    }
    return sum <= goal_.error2;
  }

  bool is_affordable(int level) const {
    double samples = 0;
    for (const Kind& kind : kinds_) samples += kind.count * samples_at(level, kind);
    return samples <= goal_.samples;
  }

 private:
  static std::size_t rung_at(int level, const Kind& kind) {
    return static_cast<std::size_t>(std::clamp(kind.step + level, 0, step_count - 1));
  }

  /// What a kind's errors come to by the samples of a step.
  double error2_at(std::size_t step, const Kind& kind) const {
    const double error2 = kind.detail * ladder_.factors[step];
    if (kind.samples < telling_samples) return error2;
    return error2 * std::sqrt(static_cast<double>(kind.samples) / ladder_.samples[step]);
  }

  std::span<const Kind> kinds_;
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

std::vector<PixelSamples> next_samples(std::span<const RoughPixel> pixels,
                                       const RefinementGoal& goal) {
  std::vector<PixelSamples> refined;
  if (pixels.empty()) return refined;
  Kinds kinds(pixels);
  const int lowest = -kinds.step_end();
  const int highest = step_count - kinds.step_begin();
  const Levels levels(kinds.all(), goal);
  const int enough =
      first_true(lowest, highest, [&](int level) { return levels.is_enough(level); });
  const int too_dear =
      first_true(lowest, enough + 1, [&](int level) { return !levels.is_affordable(level); });
  const int level = std::min(enough, too_dear - 1);
  for (Kind& kind : kinds.all()) kind.next = levels.samples_at(level, kind);
  for (std::size_t i = 0; i < pixels.size(); ++i)
    if (const int samples = kinds.of(i).next; samples > 0)
      refined.push_back({pixels[i].pixel, samples});
  return refined;
}

}  // namespace raytracer
