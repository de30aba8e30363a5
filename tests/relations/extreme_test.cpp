// Random scenes over sixteen orders of magnitude: no value that is none, no surface in its own
// shadow.

#include <gtest/gtest.h>

#include <numbers>

#include "tests/relations/varied_scene.h"

namespace raytracer::test {
namespace {

class Extreme : public testing::TestWithParam<std::uint64_t> {
 protected:
  Random random_{GetParam()};

  Vec3 far_point() {
    const double x = random_.magnitude(-8, 8);
    const double y = random_.magnitude(-8, 8);
    return {x, y, random_.magnitude(-8, 8)};
  }
  double any_radius() { return std::abs(random_.magnitude(-4, 4)); }
};

void expect_values_in_range(const Image& image) {
  for (const float value : image.values) {
    ASSERT_GE(value, 0);  // also false for what is no number
    ASSERT_LE(value, 1);
  }
}

TEST_P(Extreme, scenes_have_no_value_out_of_range) {
  for (int round = 0; round < 6; ++round) {
    std::vector<json> objects;
    std::vector<json> lights;
    for (int i = 0; i < 8; ++i) {
      const json material = {{"reflectivity", random_.between(0, 1)},
                             {"shininess", std::abs(random_.magnitude(-3, 8))}};
      const Vec3 corner = far_point();
      objects.push_back(sphere_json(far_point(), any_radius(), material));
      objects.push_back(square_json(far_point(), any_radius(),
                                    1 + static_cast<int>(random_.below(20)), "xy", material));
      objects.push_back(
          mesh_json({corner, corner + far_point(), corner + far_point()}, {{0, 1, 2}}, material));
    }
    objects.push_back(plane_json(far_point(), far_point(), {{"reflectivity", 0.5}}));
    for (int i = 0; i < 3; ++i) {
      lights.push_back(point_json(far_point(), std::abs(random_.magnitude(-8, 20))));
      lights.push_back(distant_json(far_point(), std::abs(random_.magnitude(-3, 3))));
    }
    lights.push_back(point_json(vector_of(objects[0]["center"]), 1e300));
    for (const json& look_at : {objects[0]["center"], objects[1]["center"], objects[3]["center"]}) {
      const json text =
          document(camera_json(24, 18, random_.between(0.1, 3), far_point(), vector_of(look_at)),
                   objects, lights);
      expect_values_in_range(image_of(text));
    }
  }
}

TEST_P(Extreme, lone_sphere_lit_from_the_camera_has_no_shadow_on_its_disc) {
  for (int round = 0; round < 12; ++round) {
    const Vec3 center = far_point();
    const double radius = any_radius();
    // From where it fills a good part of the image.
    const double away = radius * (1 + std::abs(random_.magnitude(-3, 4)));
    const Vec3 eye = center + away * random_.direction();
    const double seen_radius = length(eye - center);
    if (!(std::abs(seen_radius - away) < 1e-9 * away))
      continue;  // lost in the coordinates' rounding
    // The disc's radius is that of the image over 1.2: 26.7 of 64 pixels.
    const double fov = 2 * std::atan(1.2 * std::tan(std::asin(radius / seen_radius)));
    json text = document(camera_json(64, 64, fov, eye, center),
                         {sphere_json(center, radius, constant_material({1, 1, 1}))});
    text["background"] = {1, 0, 1};
    text["ambient"] = 1;
    // What is seen of a sphere lies within the half that a distant light along the view reaches.
    for (const json& light : {point_json(eye, 1), distant_json(center - eye)}) {
      text["lights"] = json::array({light});
      const Image image = image_of(text);
      int black = 0;
      int white = 0;
      for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
          if (color_at(image, x, y) == Vec3{}) ++black;
          if (color_at(image, x, y) == Vec3{1, 1, 1}) ++white;
        }
      }
      EXPECT_EQ(black, 0) << "radius " << radius << " at " << away;
      EXPECT_NEAR(white, std::numbers::pi * 26.67 * 26.67, 60)
          << "radius " << radius << " at " << away;
    }
  }
}

TEST_P(Extreme, scenes_lit_from_the_camera_alone_have_no_visible_shadows) {
  for (int round = 0; round < 6; ++round) {
    // Sizes over eight orders of magnitude, at distances at which they can be seen.
    const Vec3 eye = far_point();
    const Vec3 ahead = random_.direction();
    std::vector<json> objects;
    for (int i = 0; i < 12; ++i) {
      const double away = std::abs(random_.magnitude(-3, 5));
      const Vec3 place = eye + away * unit(ahead + 0.6 * random_.point(-1, 1));
      objects.push_back(sphere_json(place, away * random_.between(0.02, 0.3), diffuse_material()));
      objects.push_back(mesh_json({place, place + away * 0.4 * random_.direction(),
                                   place + away * 0.4 * random_.direction()},
                                  {{0, 1, 2}}, diffuse_material()));
    }
    json text =
        document(camera_json(64, 48, 1.2, eye, eye + 1e3 * ahead), objects, {point_json(eye, 1e4)});
    const Image shadowed = image_of(text);
    text["shadows"] = "off";
    text["ambient"] = 0;
    const Image unshadowed = image_of(text);
    EXPECT_GT(count_lit(unshadowed), 500);
    // A ray back to the eye is rounded anew; past an edge it may, hardly ever, be stopped.
    EXPECT_LE(count_different(shadowed, unshadowed, 1e-6), 2);
  }
}

INSTANTIATE_TEST_SUITE_P(Seed, Extreme, testing::Values(101, 102, 103, 104, 105),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace raytracer::test
