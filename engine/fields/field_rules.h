// What the value of a documented field may be: plain descriptions, by which the reader checks
// values and from which the JSON Schema is written.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "engine/math/vec.h"

namespace raytracer {

/// An interval of doubles, with the words for it.
struct ValueRange {
  double least = -infinity;
  double most = infinity;
  bool least_excluded = false;
  bool most_excluded = false;

  bool contains(double value) const {
    return (least_excluded ? value > least : value >= least) &&
           (most_excluded ? value < most : value <= most);
  }
  std::string describe() const;
};

inline constexpr ValueRange any_number{};
inline constexpr ValueRange not_negative{.least = 0};
inline constexpr ValueRange positive{.least = 0, .least_excluded = true};
inline constexpr ValueRange unit_interval{.least = 0, .most = 1};

/// What to say of a value that must be what is `wanted`.
std::string out_of_range(double value, std::string_view wanted);

// A rule's complaint(value) says what is wrong with a value; nothing if it is right.

/// A double.
struct NumberRule {
  ValueRange range = any_number;

  std::string complaint(double value) const {
    return range.contains(value) ? "" : out_of_range(value, range.describe());
  }
};

/// A number that is not negative, and not 0 where the one under another key is.
struct NotBothZeroRule {
  std::string_view other;

  std::string complaint(double value, double other_value) const;
};

/// A number without a fraction, 3 and 3.0 alike.
struct IntegerRule {
  std::int64_t least;
  std::int64_t most;

  std::string complaint(double value) const;
};

/// A number of things: any integer from `least` on; the largest int stands for what is more.
struct CountRule {
  int least;

  std::string complaint(double value) const;
};

struct FlagRule {};

/// An angle in radians that modulo 2 pi is strictly between 0 and pi. The double nearest to pi (or
/// to a multiple of it) stands for that multiple, although it is a hair off.
struct FieldOfViewRule {
  static std::string complaint(double angle);
};

/// Three numbers.
struct PointRule {
  static std::string complaint(const Vec3& point);
};
/// A point that differs from the one under another key, and why.
struct OtherPointRule {
  std::string_view other;
  std::string_view reason;

  std::string complaint(const Vec3& point, const Vec3& other_point) const;
};
/// Three numbers, not all of them 0.
struct DirectionRule {
  static std::string complaint(const Vec3& direction);
};
/// Three numbers in [0, 1], or "#rrggbb".
struct ColorRule {};
/// A colour, or "transparent", which is none.
struct BackgroundRule {};

/// One of some words, in the order of an enumeration.
template <std::size_t count>
struct ChoiceRule {
  std::array<std::string_view, count> words;
};
template <typename... Word>
ChoiceRule(Word...) -> ChoiceRule<sizeof...(Word)>;

/// A list of points.
struct PointsRule {};

/// A list of points, as many as the list under another key has, each differing from that one's.
struct OtherPointPerItemRule {
  std::string_view items;
};
/// One direction for each item of the list under another key.
struct DirectionPerItemRule {
  std::string_view items;
};
/// One number for all, or one for each item of the list under another key.
struct NumberPerItemRule {
  ValueRange range;
  std::string_view items;
};
/// The same of items, whose other numbers are under another key.
struct NotBothZeroPerItemRule {
  std::string_view items;
  std::string_view other;
};
/// One colour for each item of the list under another key.
struct ColorPerItemRule {
  std::string_view items;
};
/// Triples of indices into the list under another key.
struct TriplesRule {
  std::string_view items;
};

}  // namespace raytracer
