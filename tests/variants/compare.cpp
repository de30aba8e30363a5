#include "tests/variants/compare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/reference/radiance.h"
#include "engine/reference/single_ray_finder.h"
#include "tests/support/scene_plan.h"
#include "tests/variants/image_by.h"

namespace raytracer::test {

Image reference_image(const Scene& scene) {
  WorkerPool pool(1);
  const PackedScene packed = pack_scene(scene, &pool);
  const SingleRayFinder finder(packed, all_by(Finder::tree), pool);
  Image image(scene.camera.width, scene.camera.height);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Rgb seen =
          see(packed, finder, packed.view.direction(x + 0.5, image.height - y - 0.5)).radiance;
      image.pixel(x, y)[0] = static_cast<float>(std::clamp(seen.x, 0.0, 1.0));
      image.pixel(x, y)[1] = static_cast<float>(std::clamp(seen.y, 0.0, 1.0));
      image.pixel(x, y)[2] = static_cast<float>(std::clamp(seen.z, 0.0, 1.0));
    }
  }
  return image;
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
