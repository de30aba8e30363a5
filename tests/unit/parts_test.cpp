// What lines leave of a rectangle's parts.
#include "engine/math/parts.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace raytracer {
namespace {

double at(const Line& line, double x, double y) {
  return line.at_origin + line.per_x * x + line.per_y * y;
}

/// A rectangle and lines, some of which cross it.
struct Drawn {
  double x;
  double y;
  double width;
  double height;
  std::array<Line, 3> lines;
};

Drawn draw(std::mt19937_64& generator, double scale) {
  std::uniform_real_distribution<double> one(-1, 1);
  Drawn drawn{one(generator) * scale,
              one(generator) * scale,
              (1.5 + one(generator)) * scale,
              (1.5 + one(generator)) * scale,
              {}};
  for (Line& line : drawn.lines) {
    const double strength = std::pow(10, 20 * one(generator));
    line = {0, one(generator) * strength, one(generator) * strength};
    line.at_origin = -at(line, drawn.x + drawn.width * (0.5 + one(generator)),
                         drawn.y + drawn.height * (0.5 + one(generator)));
  }
  return drawn;
}

/// The least of the lines, in their own lengths, at the point of a part that is farthest inside of
/// each.
double least_of_part(const Drawn& drawn, int column, int row) {
  double least = INFINITY;
  for (const Line& line : drawn.lines) {
    const double x = drawn.x + drawn.width * (column + (line.per_x > 0 ? 1 : 0)) / parts_across;
    const double y = drawn.y + drawn.height * (row + (line.per_y > 0 ? 1 : 0)) / parts_across;
    const double step =
        (std::abs(line.per_x) * drawn.width + std::abs(line.per_y) * drawn.height) / parts_across;
    least = std::min(least, at(line, x, y) / step);
  }
  return least;
}

TEST(Parts, are_reached_where_a_corner_is_inside_of_every_line) {
  std::mt19937_64 generator(11);
  int reached = 0;
  int missed = 0;
  for (const double scale : {1e-100, 1e-3, 1.0, 1e5, 1e100})
    for (int i = 0; i < 2000; ++i) {
      const Drawn drawn = draw(generator, scale);
      const PartOutline outline(drawn.lines, drawn.width, drawn.height, 0);
      const Parts parts = outline.parts_reached(drawn.x, drawn.y);
      for (int row = 0; row < parts_across; ++row)
        for (int column = 0; column < parts_across; ++column) {
          const double least = least_of_part(drawn, column, row);
          const bool is_reached = (parts >> (parts_across * row + column) & 1) != 0;
          ++(is_reached ? reached : missed);
          if (least >= 0) {
            EXPECT_TRUE(is_reached) << scale << " " << i << " " << column << " " << row;
          } else if (least < -1e-4) {
            EXPECT_FALSE(is_reached) << scale << " " << i << " " << column << " " << row;
          }
        }
    }
  EXPECT_GT(reached, 10'000);
  EXPECT_GT(missed, 10'000);
}

TEST(Parts, are_reached_a_margin_beyond_a_line) {
  const std::array<Line, 1> right_of_two{{{-2, 1, 0}}};
  // Columns end at 1, 2, 3 and 4.
  const auto columns = [&](double margin) {
    return PartOutline(right_of_two, 4, 4, margin).parts_reached(0, 0) & 0xf;
  };
  EXPECT_EQ(columns(-0.01), 0b1100);
  EXPECT_EQ(columns(0.99), 0b1110);
  EXPECT_EQ(columns(1.01), 0b1111);
}

TEST(Parts, are_all_reached_by_no_direction_and_none_by_what_is_outside) {
  const std::array<Line, 2> everywhere{};
  EXPECT_EQ(PartOutline(everywhere, 1, 1, 0).parts_reached(1e30, -1e30), 0xffff);
  const std::array<Line, 1> nowhere{{{-INFINITY, 0, 0}}};
  EXPECT_EQ(PartOutline(nowhere, 1, 1, 0).parts_reached(0, 0), 0);
}

}  // namespace
}  // namespace raytracer
