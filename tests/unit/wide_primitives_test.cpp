// Which primitives a grid sets aside.
#include "engine/finders/wide_primitives.h"

#include <gtest/gtest.h>

#include <cmath>

namespace raytracer::test {
namespace {

/// Of squares: cells as wide as they are on average.
struct Squares {
  std::size_t primitive_count = 0;
  double areas = 0;

  void include(const Squares& other) {
    primitive_count += other.primitive_count;
    areas += other.areas;
  }
  double mean_width() const { return std::sqrt(areas / static_cast<double>(primitive_count)); }
};

class WidePrimitives : public testing::Test {
 protected:
  void add(std::size_t count, double width) {
    squares_.spreads[SpreadsByWidth<Squares>::index_of(width)].include(
        {count, static_cast<double>(count) * width * width});
  }
  SpreadWithoutWide<Squares> chosen() const {
    return without_wide(squares_, [](const Squares& squares) { return squares.mean_width(); });
  }

 private:
  SpreadsByWidth<Squares> squares_;
};

TEST_F(WidePrimitives, are_none_among_equals) {
  add(1000, 0.01);
  EXPECT_FALSE(chosen().has_wide());
  EXPECT_EQ(chosen().spread.primitive_count, 1000U);
}

TEST_F(WidePrimitives, are_the_ground_under_pebbles_and_its_walls) {
  add(1000, 0.01);
  add(1, 2);
  add(4, 1);
  EXPECT_TRUE(chosen().is_wide(2));
  EXPECT_TRUE(chosen().is_wide(1));
  EXPECT_FALSE(chosen().is_wide(0.01));
  EXPECT_NEAR(chosen().spread.mean_width(), 0.01, 1e-9);
}

TEST_F(WidePrimitives, are_not_so_many_that_all_would_be_tried_one_by_one) {
  add(1000, 0.01);
  add(100, 1);
  EXPECT_FALSE(chosen().has_wide());
}

TEST_F(WidePrimitives, are_fewer_than_the_others) {
  add(3, 0.01);
  add(4, 1);
  EXPECT_FALSE(chosen().has_wide());
}

/// As a sphereflake has them: as much of each size.
TEST_F(WidePrimitives, are_few_where_sizes_go_on_evenly) {
  for (int level = 0; level < 6; ++level)
    add(static_cast<std::size_t>(std::pow(9, level)), std::pow(3, -level));
  EXPECT_LE(66430U - chosen().spread.primitive_count, 1U);
}

TEST_F(WidePrimitives, have_widths_of_any_size) {
  add(1000, 1e-300);
  add(1000, 0);
  add(1, infinity);
  EXPECT_TRUE(chosen().is_wide(infinity));
  EXPECT_EQ(chosen().spread.primitive_count, 2000U);
}

}  // namespace
}  // namespace raytracer::test
