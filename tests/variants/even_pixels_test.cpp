// Pixels that get a single line, as no edge is in them and their colours hardly bend.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/engine.h"
#include "engine/kernel/simd/instruction_sets.h"
#include "engine/plan/plan.h"
#include "engine/tradeoff/difference.h"
#include "tests/support/scenes.h"
#include "tests/variants/integrated.h"

namespace raytracer::test {
namespace {

/// The error with single lines where pixels are even, in shares of that with three lines each.
double error_ratio(const json& text, double negligible_error) {
  const Scene scene = with_target(text, "single");
  const Plan plan = make_plan(scene, this_machine(1));
  EXPECT_EQ(plan.integration.value, Integration::lines);
  const Image exact = reference_of(text);
  const auto error = [&](double negligible) {
    return difference(Integrated(plan, scene, 3, negligible).image, exact).rmse;
  };
  return error(negligible_error) / error(0);
}

/// A ball that is larger than the image, under small ones.
json small_shadows() {
  std::vector<json> objects{sphere_json({0, -6, 0}, 6, diffuse_material())};
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 6; ++column) {
      const double x = 0.47 * column - 1.2 + 0.13 * row;
      const double z = 0.51 * row - 1.4;
      const double surface = std::sqrt(36 - x * x - z * z) - 6;
      objects.push_back(sphere_json({x, surface + 0.15, z}, 0.05, diffuse_material()));
    }
  return document(camera_json(160, 100, 0.45, {0, 3, -7}, {0, 0, -0.3}), objects,
                  {distant_json({-0.2, -0.9, 0.53}, 0.9)});
}

/// Most of a large ball is even but for its highlight, or where its colours begin to be clamped:
/// there a single line must tell the mean colour, and nowhere may it miss an edge.
TEST(EvenPixels, AreAsWithSeveralLines) {
  for (const double brightness : {0.4, 1.5}) {
    const json finish{{"ks", 0.5}, {"shininess", 1000}};
    const json text = document(
        camera_json(128, 96, 0.8, {0, 0, -8}, {}),
        {sphere_json({0, 0, 0}, 3, finish), sphere_json({-1, 2.5, -3}, 0.3, finish)},
        {distant_json({0.5, -1, 1}, brightness), distant_json({-1, 0.1, 0.3}, 0.8 * brightness)});
    const Scene scene = with_target(text, "single");
    for (const InstructionSet& set : supported_instruction_sets()) {
      const Plan plan = make_plan(scene, {set});
      ASSERT_EQ(plan.integration.value, Integration::lines);
      const Integrated all(plan, scene, 3);
      EXPECT_EQ(all.beyond.clamped > 0, brightness > 1);
      for (const double negligible : {0.01, 0.001}) {
        const Integrated few(plan, scene, 3, negligible);
        const Difference between = difference(few.image, all.image);
        EXPECT_GT(between.max_error, 0) << set.name;  // or none was even
        EXPECT_LT(between.max_error, negligible) << set.name;
        EXPECT_LT(between.rmse, negligible / 10) << set.name;
        EXPECT_NEAR(told_error(few), told_error(all), told_error(all) / 10) << set.name;
      }
    }
  }
}

/// A rim may be where the incidence is less than what the ray misses the occluder by, or the
/// occluder right before the middle: no difference at the middle tells of it.
TEST(EvenPixels, HaveNoRimsOfSmallShadows) {
  for (const double negligible : {0.01, 0.001})
    EXPECT_LT(error_ratio(small_shadows(), negligible), 1.01) << negligible;
}

/// Neither of those that the spheres of a square throw on each other.
TEST(EvenPixels, HaveNoRimsOfNeighboursShadows) {
  const json text =
      document(camera_json(160, 100, 0.5, {0, 4, -7}, {0, 0, 0}),
               {square_json({0, 0, 0}, 0.9, 2, "xz", diffuse_material())},
               {distant_json({-0.8, -0.5, 0.5}, 0.5), distant_json({0.3, -0.4, 0.9}, 0.4)});
  for (const double negligible : {0.01, 0.001})
    EXPECT_LT(error_ratio(text, negligible), 1.05) << negligible;
}

/// One may lie between a pixel's middle and its corner.
TEST(EvenPixels, HaveNoSmallHighlights) {
  json text = document(camera_json(14, 14, 0.2, {0, 0, -8}, {}),
                       {sphere_json({0, 0, 0}, 1, {{"kd", 0.4}, {"ks", 0.6}, {"shininess", 4000}})},
                       {distant_json({-0.0595, -0.2142, 1})});
  text["shadows"] = "off";
  EXPECT_LT(error_ratio(text, 0.003), 1.1);
}

}  // namespace
}  // namespace raytracer::test
