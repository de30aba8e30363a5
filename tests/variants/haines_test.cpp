// Haines' scenes, which the whole field measures with: what is measured is right.
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "engine/kernel/this_machine.h"
#include "engine/plan/plan.h"
#include "tests/measure/scenes/haines_scenes.h"
#include "tests/support/scene_plan.h"
#include "tests/variants/compare.h"
#include "tests/variants/image_by.h"
#include "tests/variants/scenes.h"

namespace raytracer::test {
namespace {

struct Haines {
  const char* name;
  std::string (*document)();
};

class HainesScene : public testing::TestWithParam<Haines> {
 protected:
  HainesScene() : scene_(prepared(GetParam().document())), expected_(reference_image(scene_)) {}

  Scene scene_;
  Image expected_;
};

TEST_P(HainesScene, in_double_is_the_reference_on_every_instruction_set) {
  for (const InstructionSet& set : supported_instruction_sets())
    EXPECT_EQ(count_wrong(image_on(set, Precision::double_precision, scene_), expected_), 0)
        << set.name;
}

TEST_P(HainesScene, as_planned_is_near_the_reference) {
  EXPECT_LE(count_wrong(image_by(make_plan(scene_, this_machine()), scene_), expected_),
            scene_.camera.width * scene_.camera.height / 2000);
}

INSTANTIATE_TEST_SUITE_P(All, HainesScene,
                         testing::Values(Haines{"balls", &measure::haines_balls},
                                         Haines{"mount", &measure::haines_mount},
                                         Haines{"rings", &measure::haines_rings},
                                         Haines{"tree", &measure::haines_tree},
                                         Haines{"goblet", &measure::haines_goblet},
                                         Haines{"gears", &measure::haines_gears},
                                         Haines{"tetra", &measure::haines_tetra},
                                         Haines{"shells", &measure::haines_shells}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace raytracer::test
