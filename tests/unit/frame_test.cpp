// The frame: scale and place of a scene do not matter.

#include <gtest/gtest.h>

#include "engine/pack/packed_scene.h"
#include "tests/support/edit.h"
#include "tests/support/rays.h"

namespace raytracer::test {
namespace {

Scene scene_with(const Vec3& eye, const Vec3& center, double radius) {
  Scene scene;
  scene.camera.origin = eye;
  scene.objects = {{Sphere{center, radius}, 0}};
  return scene;
}

TEST(Frame, has_the_eye_at_its_origin) {
  const Scene scene = scene_with({5, 6, 7}, {1, 2, 3}, 1);
  EXPECT_EQ(make_frame(scene).frame_from_scene(Vec3{5, 6, 7}), Vec3{});
}

TEST(Frame, is_the_same_for_a_scene_scaled_by_a_power_of_two) {
  const Vec3 center{0.3, -7, 12.1};
  const Frame plain = make_frame(scene_with({}, center, 2.5));
  for (int exponent = -900; exponent <= 900; exponent += 37) {
    const Frame frame =
        make_frame(scene_with({}, scaled(center, exponent), std::ldexp(2.5, exponent)));
    EXPECT_EQ(frame.exponent(), plain.exponent() + exponent);
    EXPECT_EQ(frame.frame_from_scene(scaled(center, exponent)), plain.frame_from_scene(center));
    EXPECT_EQ(frame.frame_from_scene(std::ldexp(2.5, exponent)), plain.frame_from_scene(2.5));
  }
}

TEST(Frame, is_the_same_for_a_moved_scene) {
  const Vec3 shift{1024, -4096, 8192};  // with these coordinates every sum is exact
  const Vec3 eye{0.25, 0.5, -3};
  const Vec3 center{2.5, -7, 12.125};
  const Frame plain = make_frame(scene_with(eye, center, 2.5));
  const Frame moved = make_frame(scene_with(eye + shift, center + shift, 2.5));
  EXPECT_EQ(moved.exponent(), plain.exponent());
  EXPECT_EQ(moved.frame_from_scene(center + shift), plain.frame_from_scene(center));
}

TEST(Frame, keeps_every_extent_near_one) {
  Random random(30);
  for (int i = 0; i < 500; ++i) {
    const auto coordinate = [&] { return random.magnitude(-300, 307.9); };
    const Vec3 eye{coordinate(), coordinate(), coordinate()};
    const Vec3 center{coordinate(), coordinate(), coordinate()};
    const double radius = std::abs(coordinate());
    const Frame frame = make_frame(scene_with(eye, center, radius));
    const double extent =
        std::max(max_abs(frame.frame_from_scene(center)), frame.frame_from_scene(radius));
    EXPECT_GE(extent, 0.2);
    EXPECT_LE(extent, 4);
  }
}

TEST(Frame, holds_lights_planes_squares_and_meshes) {
  Scene scene;
  append(scene.objects, {Plane{{0, -1e10, 0}, {0, 1, 0}}, 0});
  EXPECT_NEAR(make_frame(scene).exponent(), 33, 2);
  append(scene.lights, {PointLight{{0, 1e20, 0}}, {1, 1, 1}, 1});
  EXPECT_NEAR(make_frame(scene).exponent(), 66, 2);
  append(scene.objects, {SphereSquare{{}, 1e21, 1'000'000'000, Axes::xz}, 0});
  EXPECT_NEAR(make_frame(scene).exponent(), 101, 3);
  append(scene.objects, {Mesh{{{1e40, 0, 0}}, {}, {}, {}}, 0});
  EXPECT_NEAR(make_frame(scene).exponent(), 133, 2);
  append(scene.objects, {Spheres{{{0, 0, 0}, {0, 0, 1e50}}, {1}, {}}, 0});
  EXPECT_NEAR(make_frame(scene).exponent(), 166, 2);
}

TEST(Frame, of_an_empty_scene_is_the_scene_itself) {
  const Frame frame = make_frame(Scene{});
  EXPECT_EQ(frame.exponent(), 0);
  EXPECT_EQ(frame.frame_from_scene(Vec3{1, 2, 3}), (Vec3{1, 2, 3}));
}

}  // namespace
}  // namespace raytracer::test
