// Contracts keep their targets where soft lights make every pixel err, and where a single straight
// edge makes all of its pixels err alike: against pictures of many more samples.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "engine/engine.h"
#include "tests/support/rms_difference.h"
#include "tests/support/scenes.h"

namespace raytracer::test {
namespace {

/// A cloud of spheres, most of which see some of a light and not all.
json cloud(const json& light) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(-1, 1);
  std::vector<json> spheres;
  for (int i = 0; i < 1000; ++i) {
    const double x = 9 * share(random);
    const double y = 9 * share(random);
    const double z = 9 * share(random);
    spheres.push_back(sphere_json({x, y, z}, 0.4 + 0.2 * share(random)));
  }
  json text = document(camera_json(175, 125, 0.75, {21, 17, -29}, {0, 0, 0}), spheres, {light});
  text["shadows"] = "ambient";
  return text;
}

class SoftContract : public testing::TestWithParam<const char*> {};

TEST_P(SoftContract, keeps_its_target) {
  json text = cloud(json::parse(GetParam()));
  WorkerPool pool(2);
  const auto rendered = [&](const json& settings) {
    text["render"] = settings;
    RenderProgress progress;
    return render(scene_of(text), Limits{}, pool, progress);
  };
  const Image exact = rendered({{"samples", 256}}).image;
  for (const double target : {0.03, 0.02, 0.015}) {
    const Rendering rendering = rendered({{"target_rmse", target}});
    EXPECT_EQ(rendering.stop, Stop::target) << target;
    const double error = rms_difference(rendering.image, exact);
    EXPECT_LE(error, target);
    ASSERT_TRUE(rendering.estimated_error);
    EXPECT_GT(*rendering.estimated_error, error / 1.25) << target;
    EXPECT_LT(*rendering.estimated_error, 2.5 * error) << target;
  }
}

INSTANTIATE_TEST_SUITE_P(
    , SoftContract,
    testing::Values(R"({"type": "sky"})",
                    R"({"type": "distant", "direction": [-0.3, -1, 0.4], "angle": 0.5})",
                    R"({"type": "point", "position": [15, 25, -20], "radius": 6,
                        "falloff": "none"})"));

/// A floor under nothing: the horizon is all that there is to see, `slope` columns to a row.
json horizon(double slope, double height) {
  json text = document(camera_json(96, 72, 0.8, {0, 2, 0}, {0, 2 - height, 10}),
                       {{{"type", "plane"}, {"point", {0, 0, 0}}, {"normal", {0, 1, 0}}}},
                       {distant_json({0.2, -1, 0.3})});
  const double angle = std::atan(slope);
  text["camera"]["up"] = {std::sin(angle), std::cos(angle), 0};
  text["background"] = {0.9, 0.4, 0.3};
  return text;
}

TEST(EdgeContract, keeps_its_target_whatever_the_slope) {
  WorkerPool pool(2);
  int misses = 0;
  int count = 0;
  for (const double slope : {0.0, 1e-3, 0.5, 1.0, 1.7, 1e9})
    for (int i = 0; i < 12; ++i) {
      json text = horizon(slope, 0.0171 * i);
      const auto rendered = [&](const json& settings) {
        text["render"] = settings;
        RenderProgress progress;
        return render(scene_of(text), Limits{}, pool, progress);
      };
      const Image exact = rendered({{"samples", 400}}).image;
      for (const double target : {0.01, 0.003}) {
        const Rendering rendering = rendered({{"target_rmse", target}});
        const double error = rms_difference(rendering.image, exact);
        ++count;
        if (error > target) ++misses;
        EXPECT_LT(error, 1.5 * target) << slope << ' ' << i;
      }
    }
  EXPECT_LE(100 * misses, 2 * count) << "of " << count;
}

}  // namespace
}  // namespace raytracer::test
