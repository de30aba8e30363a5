// Every kernel stores the same picture in bytes as in floats.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "engine/engine.h"
#include "engine/kernel/this_machine.h"
#include "engine/plan/plan.h"
#include "tests/support/scene_plan.h"
#include "tests/support/scenes.h"
#include "tests/variants/image_by.h"

namespace raytracer::test {
namespace {

/// Balls in 16 rows, the channels of each just under, on and just above a bound between levels:
/// (k + 1/2) / 255 for k from 0 on. Of a width and a height that no packet divides.
Scene critical_balls() {
  json balls = json::array();
  for (int level = 0; level < 255; ++level) {
    const auto bound = static_cast<float>((level + 0.5) / 255);
    const int column = level % 16;
    const int row = level / 16;
    const double x = column - 7.5;
    const double y = row - 7.5;
    balls.push_back(sphere_json(
        {x, y, 0}, 0.5,
        constant_material({std::nextafter(bound, 0.0F), bound, std::nextafter(bound, 1.0F)})));
  }
  json text = document(camera_json(131, 93, 1, {0, 0, -20}, {}), balls, {});
  text["ambient"] = 1;
  text["shadows"] = "off";
  return scene_of(text);
}

TEST(Bytes, are_the_floats_levels) {
  Scene scene = critical_balls();
  for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
    scene.render.precision = precision;
    for (const InstructionSet& set : supported_instruction_sets()) {
      SCOPED_TRACE(set.name);
      const Plan plan = make_plan(scene, {set});
      ASSERT_EQ(plan.kernel.value, Kernel::packets);
      const Image floats = image_by(plan, scene);
      const ByteImage bytes = image_by<unsigned char>(plan, scene);
      const std::set<float> shown(floats.values.begin(), floats.values.end());
      EXPECT_GE(shown.size(), 3U * 255);
      for (std::size_t i = 0; i < floats.values.size(); ++i)
        ASSERT_EQ(bytes.values[i], to_byte(floats.values[i])) << i << ": " << floats.values[i];
    }
  }
}

}  // namespace
}  // namespace raytracer::test
