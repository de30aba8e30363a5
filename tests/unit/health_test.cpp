// What strains a scene is said, and nothing of a scene that is well.
#include "engine/plan/health.h"

#include <gtest/gtest.h>

#include "tests/support/scene_plan.h"

namespace raytracer::test {
namespace {

const Machine any_machine{{1, "AVX2"}, 2};

Scene scene_to_check(std::vector<Object> objects) {
  Scene scene;
  scene.camera = {.origin = {0, 2, -10}, .look_at = {}, .fov = 1, .width = 640, .height = 480};
  scene.lights = {{DistantLight{{0, -1, 1}}}};
  scene.materials = {Material{}};
  scene.objects = std::move(objects);
  return scene;
}

/// All that is said, in one string.
std::string strains_of(const Scene& scene) {
  std::string text;
  for (const std::string& strain : find_strains(scene, make_plan(scene, any_machine)))
    text += strain + '\n';
  return text;
}

bool says(const Scene& scene, const std::string& words) {
  return strains_of(scene).find(words) != std::string::npos;
}

TEST(Health, says_nothing_of_an_ordinary_scene) {
  EXPECT_EQ(strains_of(scene_to_check({{Sphere{{}, 1}, 0}, {Plane{{0, -1, 0}, {0, 1, 0}}, 0}})),
            "");
  EXPECT_EQ(strains_of(scene_to_check({})), "");
}

TEST(Health, says_that_the_eye_is_inside) {
  EXPECT_TRUE(says(scene_to_check({{Sphere{{}, 100}, 0}}), "on or inside a surface"));
}

TEST(Health, says_what_is_too_small_for_the_extent) {
  std::vector<Object> objects{{Sphere{{}, 1}, 0}, {Sphere{{}, 1e-160}, 0}};
  EXPECT_TRUE(
      says(scene_to_check(objects), "An object is smaller than 1e-144 of the scene's extent"));
  objects.push_back({SphereSquare{{}, 1e-160, 5, Axes::xz}, 0});
  EXPECT_TRUE(says(scene_to_check(objects), "2 objects are smaller"));
}

TEST(Health, says_that_a_surface_is_almost_at_the_eye) {
  EXPECT_TRUE(says(scene_to_check({{Sphere{{0, 2, -9}, 1 - 1e-11}, 0}}), "before the eye"));
}

TEST(Health, says_that_coordinates_are_too_large_for_their_radius) {
  Scene scene = scene_to_check({{Sphere{{1e15, 0, 0}, 1}, 0}});
  scene.camera.origin = {1e15, 0, -10};
  scene.camera.look_at = {1e15, 0, 0};
  EXPECT_TRUE(says(scene, "towards the coordinates' origin"));
}

TEST(Health, says_that_a_light_shines_along_a_plane) {
  Scene scene = scene_to_check({{Sphere{{}, 1}, 0}, {Plane{{0, -1, 0}, {0, 3, 0}}, 0}});
  scene.lights = {{DistantLight{{0, -1, 1}}}, {PointLight{{2, -1, 3}}}};
  EXPECT_TRUE(says(scene, "Light 1 shines along the plane that is object 1"));
  scene.lights = {{PointLight{{2, -0.99, 3}}}, {DistantLight{{1, 0, 1}}}};
  EXPECT_EQ(strains_of(scene), "") << "products with zeros are exact";
  scene.objects = {{Plane{{}, {1, 2, 2}}, 0}};
  scene.lights = {{DistantLight{{2, -2, 1}}}};
  EXPECT_TRUE(says(scene, "Light 0 shines along"));
}

TEST(Health, says_that_surfaces_coincide) {
  EXPECT_TRUE(says(scene_to_check({{Sphere{{}, 1}, 0}, {Sphere{{}, 1 + 1e-14}, 0}}),
                   "Two surfaces are only"));
  EXPECT_TRUE(says(scene_to_check({{Plane{{0, -1, 0}, {0, 1, 0}}, 0},
                                   {Plane{{0, -1 - 1e-14, 0}, {0, -1, 0}}, 0}}),
                   "Two surfaces are only"));
  EXPECT_EQ(strains_of(scene_to_check({{Sphere{{}, 1}, 0}, {Sphere{{}, 1}, 0}})), "");
}

TEST(Health, says_that_spheres_are_smaller_than_a_pixel) {
  Scene scene = scene_to_check({{Spheres{{{}, {1, 0, 0}}, {1e-4}, {}}, 0}});
  EXPECT_TRUE(says(scene, "Up to 2 objects may be seen smaller than a pixel"));
  scene.render.samples = 64;
  EXPECT_EQ(strains_of(scene), "");
}

TEST(Health, says_that_single_is_too_little) {
  Scene scene = scene_to_check({{Sphere{{}, 1}, 0}});
  scene.camera.fov = 1e-4;
  scene.render.precision = Precision::single_precision;
  EXPECT_TRUE(says(scene, "ask for precision \"auto\""));
  scene.render.precision = Precision::automatic;
  EXPECT_EQ(strains_of(scene), "");
}

}  // namespace
}  // namespace raytracer::test
