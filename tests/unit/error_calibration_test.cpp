// What refinements tell of how far half buffers overstate errors.

#include "engine/sample/error_calibration.h"

#include <gtest/gtest.h>

#include <vector>

namespace raytracer::test {
namespace {

const std::vector<double> expected(1000, 2.0);  // as many errors as ten times the prior's

ErrorCalibration calibration() { return ErrorCalibration({.initial = 0.8, .least = 0.1}); }

TEST(ErrorCalibration, begins_with_what_is_given) {
  EXPECT_EQ(calibration().multiplier(true), 0.8);
  EXPECT_EQ(calibration().multiplier(false), 0.8);
  EXPECT_EQ(calibration().lasting_share(), 1);
}

TEST(ErrorCalibration, follows_what_a_refinement_changes_as_far_as_so_many_pixels_are_believed) {
  ErrorCalibration learned = calibration();
  learned.learn(expected, 2000, 0);
  EXPECT_DOUBLE_EQ(learned.multiplier(true), 0.8);
  learned.learn(expected, 1000, 0);
  EXPECT_DOUBLE_EQ(learned.multiplier(true), 0.8 * (0.5 * 1000 + 100) / 1100);
}

/// All of what is expected is in one pixel, beside whose errors the others' are none.
TEST(ErrorCalibration, believes_few_pixels_little) {
  ErrorCalibration learned = calibration();
  std::vector<double> few(1000, 0.0);
  few[7] = 2000;
  learned.learn(few, 1000, 0);
  EXPECT_DOUBLE_EQ(learned.multiplier(true), 0.8 * (0.5 + 100) / 101);
}

TEST(ErrorCalibration, keeps_within_what_is_believed) {
  ErrorCalibration learned = calibration();
  for (int i = 0; i < 9; ++i) learned.learn(expected, 0, 0);
  EXPECT_EQ(learned.multiplier(true), 0.1);
  for (int i = 0; i < 9; ++i) learned.learn(expected, 20000, 1);
  EXPECT_EQ(learned.multiplier(true), 4);
  EXPECT_EQ(learned.multiplier(false), 4);
}

TEST(ErrorCalibration, learns_nothing_of_nothing) {
  ErrorCalibration learned = calibration();
  learned.learn({}, 0, 1);
  learned.learn(std::vector<double>(10, 0.0), 5, 1);
  EXPECT_EQ(learned.multiplier(true), 0.8);
  EXPECT_EQ(learned.multiplier(false), 0.8);
}

TEST(ErrorCalibration, tells_the_luck_of_the_pixels_being_refined) {
  ErrorCalibration learned = calibration();
  learned.tell({.before = 3, .after = 2}, true);
  learned.tell({.before = 1, .after = 1}, true);
  EXPECT_DOUBLE_EQ(learned.lasting_share(), 0.75);
  learned.learn(expected, 2000, 10);
  EXPECT_EQ(learned.lasting_share(), 1) << "none is being refined";
  learned.tell({.before = 1, .after = 2}, true);
  EXPECT_EQ(learned.lasting_share(), 1) << "bad luck is no luck";
}

TEST(ErrorCalibration, gives_what_some_had_too_much_to_those_that_are_left) {
  ErrorCalibration learned = calibration();
  learned.tell({.before = 4, .after = 3}, true);
  learned.learn(expected, 2000, 10);
  EXPECT_DOUBLE_EQ(learned.multiplier(true), 0.8);
  EXPECT_DOUBLE_EQ(learned.multiplier(false), 0.8 * 1.1);
  learned.tell({.before = 2, .after = 1}, false);  // was not left
  learned.learn(expected, 2000, 5);
  EXPECT_DOUBLE_EQ(learned.multiplier(false), 0.8 * 1.2);
  learned.forget();
  learned.learn(expected, 2000, 5);
  EXPECT_DOUBLE_EQ(learned.multiplier(false), 0.8);
}

}  // namespace
}  // namespace raytracer::test
