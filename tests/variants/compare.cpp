#include "tests/variants/compare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/reference_plan.h"
#include "tests/support/scene_plan.h"
#include "tests/variants/image_by.h"

namespace raytracer::test {

Image reference_image(const Scene& scene) {
  return image_by(reference_plan(make_plan(scene, this_machine()), Finder::tree), scene);
}

Image image_on(const InstructionSet& set, Precision precision, Scene scene) {
  scene.render.precision = precision;
  const Plan plan = make_plan(scene, {set});
  EXPECT_EQ(plan.kernel.value, Kernel::packets) << plan.kernel.reason();
  EXPECT_EQ(plan.precision.value, precision);
  return image_by(plan, scene);
}

int count_wrong(const Image& image, const Image& expected) {
  int wrong = 0;
  for (std::size_t i = 0; i < image.values.size(); i += 3) {
    bool is_wrong = false;
    for (std::size_t c = i; c < i + 3; ++c)
      is_wrong = is_wrong || !(std::abs(image.values[c] - expected.values[c]) <= 1.0F / 255);
    wrong += is_wrong ? 1 : 0;
  }
  return wrong;
}

}  // namespace raytracer::test
