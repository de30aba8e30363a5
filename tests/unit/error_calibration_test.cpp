// What refinements tell of how far half buffers overstate errors.

#include "engine/sample/error_calibration.h"

#include <gtest/gtest.h>

#include <vector>

namespace raytracer::test {
namespace {

/// By the multiplier that there is a thousand pixels, ten times as many as the prior, err by 1
/// before a refinement and by 1 after it.
const std::vector<double> errors(1000, 1.0);
constexpr double sum = 2000;

class ErrorCalibrationTest : public testing::Test {
 protected:
  void expect(double refined, double left) const {
    EXPECT_DOUBLE_EQ(calibration_.multiplier(true), refined);
    EXPECT_DOUBLE_EQ(calibration_.multiplier(false), left);
  }

  ErrorCalibration calibration_{{.initial = 0.8, .least = 0.1}};
};

TEST_F(ErrorCalibrationTest, begins_with_what_is_given) { expect(0.8, 0.8); }

TEST_F(ErrorCalibrationTest, follows_what_changes_as_far_as_so_many_pixels_are_believed) {
  calibration_.learn(errors, errors, sum, 0);
  expect(0.8, 0.8);
  calibration_.learn(errors, errors, sum / 2, 0);
  expect(0.8 * 600 / 1100, 0.8 * 600 / 1100);
}

/// All of what is expected is in one pixel, beside whose errors the others' are none.
TEST_F(ErrorCalibrationTest, believes_few_pixels_little) {
  std::vector<double> few(1000, 0.0);
  few[7] = sum / 2;
  calibration_.learn(few, few, sum / 2, 0);
  expect(0.8 * 100.5 / 101, 0.8 * 100.5 / 101);
}

/// A glint that four samples saw and sixteen did not: what was expected of it was all luck.
TEST_F(ErrorCalibrationTest, learns_next_to_nothing_of_what_was_luck) {
  calibration_.tell({.before = 0.05, .after = 0}, true);
  const std::vector<double> before{0.05};
  const std::vector<double> after{1e-6};
  calibration_.learn(before, after, 0.06, 0);
  EXPECT_NEAR(calibration_.multiplier(true), 0.8, 1e-4);
}

TEST_F(ErrorCalibrationTest, keeps_within_what_is_believed) {
  for (int i = 0; i < 9; ++i) calibration_.learn(errors, errors, 0, 0);
  expect(0.1, 0.1);
  for (int i = 0; i < 9; ++i) calibration_.learn(errors, errors, 10 * sum, 1);
  expect(4, 4);
}

TEST_F(ErrorCalibrationTest, learns_nothing_of_nothing) {
  calibration_.learn({}, {}, 0, 1);
  const std::vector<double> none(10, 0.0);
  calibration_.learn(none, none, 5, 1);
  expect(0.8, 0.8);
}

TEST_F(ErrorCalibrationTest, expects_no_change_of_luck) {
  calibration_.tell({.before = 3, .after = 1}, false);
  calibration_.tell({.before = 1, .after = 1}, false);
  calibration_.learn(errors, errors, 0.75 * sum, 0);
  expect(0.8, 0.8);
  calibration_.learn(errors, errors, sum, 0);  // none of it was of these
  expect(0.8, 0.8);
  calibration_.tell({.before = 1, .after = 2}, false);
  calibration_.learn(errors, errors, sum, 0);  // bad luck is no luck
  expect(0.8, 0.8);
}

TEST_F(ErrorCalibrationTest, gives_what_some_had_too_much_to_those_that_are_left) {
  const double half = sum / 2 + sum / 4;  // of the errors before it was no luck
  calibration_.tell({.before = 2, .after = 1}, true);
  calibration_.learn(errors, errors, half, 10);
  expect(0.8, 0.8 * 1.1);
  calibration_.tell({.before = 2, .after = 1}, false);  // was not left
  calibration_.learn(errors, errors, half, 5);
  expect(0.8, 0.8 * 1.2);
  calibration_.learn(errors, errors, sum, 1e-9);
  expect(0.8, 4);
}

TEST_F(ErrorCalibrationTest, forgets_luck_and_keeps_what_halves_are) {
  calibration_.learn(errors, errors, sum / 2, 1);
  calibration_.tell({.before = 2, .after = 1}, true);
  calibration_.forget();
  const double refined = 0.8 * 600 / 1100;
  expect(refined, refined);
  calibration_.learn(errors, errors, sum, 1);
  expect(refined, refined);
}

}  // namespace
}  // namespace raytracer::test
