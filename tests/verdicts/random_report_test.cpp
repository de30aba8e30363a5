// What is concluded from the figures of random scenes.
#include "tests/measure/contracts/random_report.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace raytracer::published {
namespace {

MeasuredScene scene(std::uint64_t seed, double rmse, std::optional<double> estimate) {
  return {.seed = seed,
          .summary = "one sphere",
          .exact_error = 0.001,
          .targets = {{.target = 0.01, .rmse = rmse, .estimated_error = estimate}}};
}

TEST(RandomReport, target_is_kept_by_an_error_that_is_no_larger) {
  const TargetTally sum = tally({scene(1, 0.01, 0.01), scene(2, 0.0101, 0.01)}, 0);
  EXPECT_EQ(sum.count, 2U);
  EXPECT_EQ(sum.kept_count, 1U);
}

TEST(RandomReport, estimates_are_judged_by_their_share_of_the_true_error) {
  const TargetTally sum = tally(
      {scene(1, 0.01, 0.0045), scene(2, 0.01, 0.021), scene(3, 0.01, 0.03), scene(4, 0.01, 0.01)},
      0);
  EXPECT_EQ(sum.judged_count, 4U);
  EXPECT_EQ(sum.within_2_count, 1U);
  EXPECT_EQ(sum.within_2_5_count, 3U);
  EXPECT_EQ(sum.below_half_count, 1U);
  EXPECT_DOUBLE_EQ(sum.least_ratio, 0.45);
  EXPECT_DOUBLE_EQ(sum.most_ratio, 3);
}

TEST(RandomReport, estimate_of_an_error_near_the_exact_pictures_is_not_judged) {
  EXPECT_EQ(tally({scene(1, 0.0019, 0.01), scene(2, 0.01, {})}, 0).judged_count, 0U);
}

TEST(RandomReport, estimate_of_no_error_to_speak_of_is_not_judged) {
  MeasuredScene flat = scene(1, 1e-8, 0);
  flat.exact_error = 0;
  EXPECT_EQ(tally({flat}, 0).judged_count, 0U);
}

TEST(RandomReport, target_that_the_exact_picture_cannot_tell_of_counts_apart) {
  MeasuredScene unknown = scene(19, 0, {});
  unknown.targets[0].is_known = false;
  EXPECT_EQ(tally({unknown}, 0).count, 0U);
  const std::string report = report_random({scene(17, 0.002, 0.002), unknown});
  EXPECT_NE(report.find("In all 1 of 1 renders of 2 scenes keep"), std::string::npos) << report;
  EXPECT_NE(report.find("1 more were not rendered"), std::string::npos) << report;
}

TEST(RandomReport, ninety_nine_in_a_hundred_are_enough) {
  EXPECT_TRUE(is_enough(99, 100));
  EXPECT_FALSE(is_enough(98, 100));
  EXPECT_TRUE(is_enough(298, 300));
  EXPECT_FALSE(is_enough(296, 300));
}

TEST(RandomReport, names_the_scene_of_every_miss) {
  const std::string report = report_random({scene(17, 0.02, 0.01), scene(18, 0.002, 0.001)});
  EXPECT_NE(report.find("| 17 | one sphere | 0.01 | 0.02 | 0.01 |"), std::string::npos) << report;
  EXPECT_EQ(report.find("| 18 |"), std::string::npos) << report;
  EXPECT_NE(report.find("In all 1 of 2 renders of 2 scenes keep"), std::string::npos) << report;
}

}  // namespace
}  // namespace raytracer::published
