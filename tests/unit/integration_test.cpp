// Which scenes' pixels are integrated along lines, and that the kernel can do those.
#include "engine/plan/integration.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <variant>

#include "engine/kernel/this_machine.h"
#include "engine/plan/plan.h"
#include "engine/render/tracer.h"

namespace raytracer::test {
namespace {

/// Two spheres over a square under two distant lights, with a target.
Scene plain_scene(bool has_square = true) {
  Scene scene;
  scene.camera = {.origin = {0, 4, -15}, .look_at = {}, .fov = 1, .width = 16, .height = 16};
  scene.lights = {{DistantLight{{0, -1, 1}}}, {DistantLight{{1, -1, 0}}}};
  scene.materials = {Material{}};
  scene.objects = {{Sphere{{-2, 0, 0}, 1}, 0}, {Sphere{{2, 0, 0}, 1}, 0}};
  if (has_square) scene.objects.push_back({SphereSquare{{0, -3, 0}, 0.5, 8, Axes::xz}, 0});
  scene.render.target_rmse = 0.01;
  return scene;
}

Choice<Integration> integration_of(const Scene& scene) {
  return make_plan(scene, this_machine(1)).integration;
}

void expect_samples(const Scene& scene, const std::string& why) {
  const Choice<Integration> choice = integration_of(scene);
  EXPECT_EQ(choice.value, Integration::samples) << why;
  EXPECT_NE(choice.reason().find(why), std::string::npos) << choice.reason();
}

/// What the kernel's lines take for granted.
void expect_kernel_can(const Scene& scene) {
  ASSERT_EQ(integration_of(scene).value, Integration::lines);
  WorkerPool pool(1);
  const Plan plan = make_plan(scene, this_machine(1));
  const Tracer tracer = make_tracer(plan, scene, pool);
  const auto* simd = std::get_if<SimdTracer<float>>(&tracer);
  ASSERT_NE(simd, nullptr);
  EXPECT_TRUE(simd->scene.is_plainly_lit);
  EXPECT_FALSE(simd->scene.reflects);
  EXPECT_EQ(simd->scene.has_sphere_bins, simd->scene.has_spheres);
}

TEST(Integration, IsAlongLinesOfSpheresUnderDistantLights) {
  Scene scene = plain_scene();
  expect_kernel_can(scene);
  scene.render.target_rmse.reset();
  scene.render.budget_ms = 10;
  expect_kernel_can(scene);
  scene.lights.clear();
  expect_kernel_can(scene);
  scene = plain_scene(false);
  expect_kernel_can(scene);
  for (const Shadows shadows : {Shadows::black, Shadows::ambient, Shadows::off}) {
    scene.shadows = shadows;
    expect_kernel_can(scene);
  }
  while (scene.objects.size() < 28) scene.objects.push_back({Sphere{{0, 3, 0}, 0.1}, 0});
  expect_kernel_can(scene);
}

TEST(Integration, IsByAGivenNumberOfSamples) {
  Scene scene = plain_scene();
  scene.render.target_rmse.reset();
  expect_samples(scene, "a number of samples is given");
  scene.render.samples = 16;
  expect_samples(scene, "a number of samples is given");
}

TEST(Integration, IsBySamplesOfWhatLinesDoNotFind) {
  Scene scene = plain_scene();
  scene.objects.push_back({Plane{{0, -9, 0}, {0, 1, 0}}, 0});
  expect_samples(scene, "planes or triangles");
  scene = plain_scene();
  scene.objects.push_back({Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, 0});
  expect_samples(scene, "planes or triangles");
  scene = plain_scene();
  scene.materials[0].reflectivity = 0.5;
  expect_samples(scene, "mirrors");
  scene = plain_scene();
  scene.lights.push_back({PointLight{{0, 9, 0}}});
  expect_samples(scene, "distant lights");
  scene = plain_scene();
  while (scene.lights.size() < 9) scene.lights.push_back({DistantLight{{0, -1, 0}}});
  expect_samples(scene, "distant lights");
  scene = plain_scene();
  scene.materials[0].shininess = 2.5;
  expect_samples(scene, "several exponents");
  scene = plain_scene();
  while (scene.objects.size() < 40) scene.objects.push_back({Sphere{{0, 3, 0}, 0.1}, 0});
  expect_samples(scene, "too many");
  scene = plain_scene();
  scene.camera.origin = {-2, 0.5, 0};
  expect_samples(scene, "plain kernel");
}

TEST(Integration, IsBySamplesUnderALowLight) {
  Scene scene = plain_scene();
  scene.lights.push_back({DistantLight{{1, -0.05, 0}}});
  expect_samples(scene, "too low");
  scene = plain_scene(false);
  scene.lights.push_back({DistantLight{{1, -0.05, 0}}});
  expect_kernel_can(scene);
}

}  // namespace
}  // namespace raytracer::test
