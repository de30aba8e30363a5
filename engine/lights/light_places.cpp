#include "engine/lights/light_places.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "engine/math/r2_sequence.h"

namespace raytracer {
namespace {

constexpr int digits = 32;
constexpr std::uint32_t first_digit = std::uint32_t{1} << (digits - 1);

/// The binary digits of a number as those of a fraction, in the opposite order (J. van der Corput,
/// 1935).
std::uint32_t radical_inverse(std::uint32_t number) {
  std::uint32_t fraction = 0;
  for (std::uint32_t digit = first_digit; number != 0; number >>= 1U, digit >>= 1U)
    if ((number & 1U) != 0) fraction |= digit;
  return fraction;
}

/// The second dimension of I. Sobol's sequence (1967), whose direction numbers are rows of Pascal's
/// triangle modulo 2.
std::uint32_t sobol_fraction(std::uint32_t number) {
  std::uint32_t fraction = 0;
  for (std::uint32_t direction = first_digit; number != 0; number >>= 1U) {
    if ((number & 1U) != 0) fraction ^= direction;
    direction ^= direction >> 1U;
  }
  return fraction;
}

/// Bits without any order (G. Steele, D. Lea, C. Flood: Fast splittable pseudorandom number
/// generators, 2014).
std::uint64_t mixed(std::uint64_t bits) {
  bits = (bits ^ bits >> 30U) * 0xBF58476D1CE4E5B9U;
  bits = (bits ^ bits >> 27U) * 0x94D049BB133111EBU;
  return bits ^ bits >> 31U;
}

/// Each digit turned over or not, by chance for all fractions that begin alike (A. Owen, Randomly
/// permuted (t, m, s)-nets and (t, s)-sequences, 1995): the parts stay as even as they were, and
/// what they err is no longer in step.
double scrambled(std::uint32_t fraction, std::uint64_t seed) {
  std::uint32_t result = 0;
  for (int digit = 0; digit < digits; ++digit) {
    const std::uint64_t before = std::uint64_t{fraction} >> (digits - digit);
    const std::uint64_t place = static_cast<std::uint64_t>(digit) + 1;
    const auto turn = static_cast<std::uint32_t>(mixed(before + (place << 32U) + seed) & 1U);
    result = result << 1U | ((fraction >> (digits - 1 - digit) & 1U) ^ turn);
  }
  return (result + 0.5) / 0x1p32;
}

/// A place in the unit square.
struct SquarePlace {
  double u;
  double v;
};

/// The nth of a sequence of which every aligned run of 2^k is spread evenly: one is in each of 2^k
/// equal rectangles, of any shape whose sides are powers of two.
SquarePlace place_of_sequence(std::size_t nth) {
  const auto number = static_cast<std::uint32_t>(nth);
  return {scrambled(radical_inverse(number), std::uint64_t{1} << 40U),
          scrambled(sobol_fraction(number), std::uint64_t{2} << 40U)};
}

double fraction(double x) { return x - std::floor(x); }

/// The nth of `count` of a set: Fibonacci's lattice, the most even that a set by itself can be (J.
/// Hannay, J. Nye, Fibonacci numerical integration on a sphere, 2004), each set shifted along R2.
/// Measured before straight edges: 64 of them err by 0.013, of the sequence by 0.016; four sets of
/// 16 of either by 0.016, 16 sets by 0.0064, of the sequence by 0.0054.
SquarePlace place_of_lattice(std::size_t nth, std::size_t count, std::size_t set) {
  const auto i = static_cast<double>(nth);
  const auto shift = static_cast<double>(set);
  return {(i + fraction(0.5 + shift / plastic_number)) / static_cast<double>(count),
          fraction(i / std::numbers::phi + shift / (plastic_number * plastic_number))};
}

/// Places of equal areas to places of equal areas.
Vec3 in_unit_disc(const SquarePlace& place) {
  const double radius = std::sqrt(place.u);
  const double angle = 2 * std::numbers::pi * place.v;
  return {radius * std::cos(angle), radius * std::sin(angle), 0};
}

Vec3 on_unit_hemisphere(const SquarePlace& place) {
  const double z = 1 - place.u;
  const double radius = std::sqrt(1 - z * z);
  const double angle = 2 * std::numbers::pi * place.v;
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

}  // namespace

SoftLight place_samples(const PackedLight& light, const LightSampling& sampling) {
  const bool is_sky = light.shape == LightShape::sky;
  SoftLight soft{light,
                 {.sets = static_cast<std::size_t>(sampling.sets),
                  .per_set = static_cast<std::size_t>(sampling.per_set),
                  .on_rim = is_sky ? 0 : static_cast<std::size_t>(sampling.on_rim)},
                 {}};
  const OrthonormalBasis around = orthonormal_basis(light.place);
  const auto add = [&](const SquarePlace& place) {
    if (is_sky) return soft.places.push_back(on_unit_hemisphere(place));
    const Vec3 disc = in_unit_disc(place);
    if (light.rays != LightRays::parallel) return soft.places.push_back(disc);
    soft.places.push_back(unit(light.place + light.size * (disc.x * around.u + disc.y * around.v)));
  };
  const PlaceNumbers& numbers = soft.numbers;
  soft.places.reserve(numbers.count());
  for (std::size_t i = 0; i < numbers.sets * numbers.per_set; ++i)
    add(sampling.is_alone
            ? place_of_lattice(i % numbers.per_set, numbers.per_set, numbers.set_of(i))
            : place_of_sequence(i));
  for (std::size_t i = 0; i < numbers.on_rim; ++i)
    add({1, radical_inverse(static_cast<std::uint32_t>(i)) / 0x1p32});
  return soft;
}

int light_set_of_sample(std::size_t nth, std::size_t half_a_count, int sets) {
  const auto all = static_cast<std::size_t>(sets);
  if (half_a_count == 0 || sets == 1) return static_cast<int>(nth % all);
  const std::size_t of_half = all / 2;
  const std::size_t first = 2 * half_a_count;
  const bool is_in_a = nth < half_a_count;
  const std::size_t begin = is_in_a ? 0 : std::min(half_a_count, of_half);
  const std::size_t nth_of_half = is_in_a ? nth : nth - half_a_count;
  return static_cast<int>((first + begin + nth_of_half % of_half) % all);
}

int light_set_of(int x, int y, int of_sample, int sets) {
  // Ordered dithering (B. Bayer, 1973).
  constexpr int order[2][2] = {{0, 2}, {3, 1}};
  return (order[y % 2][x % 2] * sets / 4 + of_sample) % sets;
}

}  // namespace raytracer
