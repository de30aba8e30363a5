// Soft light at the limits of arithmetic: pictures against the oracle's, which has places of its
// own on each light, many times as many.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/extremes/cases.h"
#include "tests/extremes/comparison.h"

namespace raytracer::extremes {
namespace {

double rmse(const Image& image, const ExactImage& exact) {
  double sum = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const float* pixel = image.pixel(x, y);
      const Vec3& right =
          exact[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                static_cast<std::size_t>(x)];
      const Vec3 difference = Vec3{pixel[0], pixel[1], pixel[2]} - right;
      sum += dot(difference, difference);
    }
  }
  return std::sqrt(sum / (3.0 * image.width * image.height));
}

/// With the centres of its discs alone, and no sky.
Scene hardened(Scene scene) {
  std::vector<Light> lights;
  for (Light light : scene.lights) {
    if (std::holds_alternative<SkyLight>(light.source)) continue;
    if (auto* distant = std::get_if<DistantLight>(&light.source)) distant->angle = 0;
    if (auto* point = std::get_if<PointLight>(&light.source)) point->radius = 0;
    lights.push_back(light);
  }
  scene.lights = std::move(lights);
  return scene;
}

class SoftExtremes : public testing::TestWithParam<Extreme> {};

TEST_P(SoftExtremes, are_near_the_exact_picture) {
  constexpr double allowed = 0.016;   // what 64 places of a light leave out
  constexpr double different = 0.03;  // at the least, of hard light
  const Scene& scene = GetParam().scene;
  WorkerPool pool(2);
  const ExactImage exact = exact_image(scene, pool);
  for (const Precision precision :
       {Precision::automatic, Precision::single_precision, Precision::double_precision})
    EXPECT_LE(rmse(render_as(scene, precision, pool), exact), allowed)
        << static_cast<int>(precision);
  const double hard = rmse(render_as(hardened(scene), Precision::automatic, pool), exact);
  if (GetParam().name == "sun-1e-9")
    EXPECT_LE(hard, 1e-4);
  else
    EXPECT_GE(hard, different);
}

INSTANTIATE_TEST_SUITE_P(Scenes, SoftExtremes, testing::ValuesIn(soft_extremes()),
                         [](const testing::TestParamInfo<Extreme>& extreme) {
                           std::string name = extreme.param.name;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace raytracer::extremes
