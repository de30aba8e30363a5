// Every extreme, smaller than in the table, is the exact picture within what the plan predicts.
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/kernel/this_machine.h"
#include "engine/plan/plan.h"
#include "tests/extremes/cases.h"
#include "tests/extremes/comparison.h"
#include "tests/support/scene_plan.h"

namespace raytracer::extremes {
namespace {

Scene smaller(Scene scene) {
  scene.camera.width = std::max(1, scene.camera.width / 3);
  scene.camera.height = std::max(1, scene.camera.height / 3);
  return scene;
}

class Extremes : public testing::TestWithParam<Extreme> {};

TEST_P(Extremes, are_the_exact_picture) {
  const Scene scene = smaller(GetParam().scene);
  WorkerPool pool(2);
  const Plan plan = make_plan(scene, this_machine(1));
  const ExactImage exact = exact_image(scene, pool);
  const Comparison chosen = compare(render_as(scene, Precision::automatic, pool), exact, scene);
  EXPECT_EQ(chosen.off, 0) << "farthest " << chosen.displacement_px << " px; "
                           << plan.precision.reason();
  EXPECT_EQ(chosen.nans, 0);
  EXPECT_LE(chosen.levels, plan.arithmetic_error.levels);
  EXPECT_LE(chosen.displacement_px, std::max(1e-6, plan.arithmetic_error.displacement_px));
}

INSTANTIATE_TEST_SUITE_P(Scenes, Extremes, testing::ValuesIn(all_extremes()),
                         [](const testing::TestParamInfo<Extreme>& extreme) {
                           std::string name = extreme.param.name;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(Extremes, some_of_them_are_wrong_in_single) {
  WorkerPool pool(2);
  int wrong = 0;
  for (const Extreme& extreme : all_extremes()) {
    if (extreme.name != "fov-1e-9" && extreme.name != "radius-1e-9-of-distance") continue;
    const Scene scene = smaller(extreme.scene);
    const Image single = render_as(scene, Precision::single_precision, pool);
    wrong += compare(single, exact_image(scene, pool), scene).off > 20 ? 1 : 0;
  }
  EXPECT_EQ(wrong, 2);
}

/// Of those that packets trace: the reference has no single.
TEST(Extremes, most_of_them_are_rendered_in_single) {
  std::size_t in_packets = 0;
  std::size_t in_single = 0;
  const std::vector<Extreme> extremes = all_extremes();
  for (const Extreme& extreme : extremes) {
    const Plan plan = make_plan(extreme.scene, this_machine(1));
    if (plan.kernel.value == Kernel::packets) ++in_packets;
    if (plan.precision.value == Precision::single_precision) ++in_single;
  }
  EXPECT_GE(extremes.size(), 30U);
  EXPECT_GE(3 * in_single, 2 * in_packets) << in_single << " of " << in_packets;
}

}  // namespace
}  // namespace raytracer::extremes
