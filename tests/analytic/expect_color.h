// Images of one colour that is known by hand, in double precision and in the engine's own choice.
#pragma once

#include <gtest/gtest.h>

#include <utility>

#include "tests/support/scenes.h"

namespace raytracer::test {

/// How far a channel may be from its exact value: in double by the rounding to an image's floats,
/// and where the engine may choose single by a 400th of an 8-bit level.
inline constexpr std::pair<const char*, double> tolerances[]{{"double", 1e-7}, {"auto", 1e-5}};

inline void expect_everywhere(const Image& image, const Vec3& expected, double tolerance) {
  ASSERT_FALSE(image.values.empty());
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Vec3 color = color_at(image, x, y);
      ASSERT_LE(distance(color, expected), tolerance)
          << "pixel " << x << ' ' << y << ": " << color.x << ' ' << color.y << ' ' << color.z
          << " is not " << expected.x << ' ' << expected.y << ' ' << expected.z;
    }
  }
}

/// Renders the document in both precisions and expects every pixel to be `expected`.
inline void expect_color(json text, const Vec3& expected) {
  for (const auto& [precision, tolerance] : tolerances) {
    SCOPED_TRACE(precision);
    text["render"]["precision"] = precision;
    expect_everywhere(image_of(text), expected, tolerance);
  }
}

/// The same without any tolerance.
inline void expect_exact_color(json text, const Vec3& expected) {
  for (const auto& [precision, unused] : tolerances) {
    SCOPED_TRACE(precision);
    text["render"]["precision"] = precision;
    expect_everywhere(image_of(text), expected, 0);
  }
}

inline void expect_gray(const json& text, double expected) {
  expect_color(text, {expected, expected, expected});
}

}  // namespace raytracer::test
