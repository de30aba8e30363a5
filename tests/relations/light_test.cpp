// Light adds up, and doubles where it is doubled.

#include <gtest/gtest.h>

#include "tests/relations/varied_scene.h"

namespace raytracer::test {
namespace {

/// The varied scene, so dim that nothing is clamped, on black.
json dim_scene() {
  json text = varied_scene();
  text["background"] = {0, 0, 0};
  text["ambient"] = 0.0625;
  for (json& light : text["lights"]) light["intensity"] = light["intensity"].get<double>() / 8;
  text["render"]["samples"] = 4;
  return text;
}

json with_lights(json text, const json& lights) {
  text["lights"] = lights;
  return text;
}

TEST(Light, of_twice_the_intensity_is_twice_as_bright) {
  for (const char* shadows : {"black", "ambient", "off"}) {
    json text = dim_scene();
    text["shadows"] = shadows;
    text["ambient"] = 0;
    const Image once = image_of(text);
    for (json& light : text["lights"]) light["intensity"] = light["intensity"].get<double>() * 2;
    const Image twice = image_of(text);
    float brightest = 0;
    for (std::size_t i = 0; i < once.values.size(); ++i) {
      ASSERT_EQ(twice.values[i], 2 * once.values[i]) << i;
      brightest = std::max(brightest, twice.values[i]);
    }
    EXPECT_GT(brightest, 0.1F);
    EXPECT_LT(brightest, 1.0F);
  }
}

TEST(Light, of_several_is_the_sum_of_the_images_under_each) {
  const json text = dim_scene();
  const Image together = image_of(text);
  std::vector<double> sum(together.values.size());
  for (const json& light : text["lights"]) {
    const Image alone = image_of(with_lights(text, json::array({light})));
    EXPECT_GT(count_lit(alone), 500);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += static_cast<double>(alone.values[i]);
  }
  for (std::size_t i = 0; i < sum.size(); ++i)
    ASSERT_NEAR(static_cast<double>(together.values[i]), sum[i], 1e-6) << i;
}

TEST(Light, of_two_halved_is_the_mean_of_the_images_under_each) {
  json text = dim_scene();
  text["lights"].erase(2);
  const Image first = image_of(with_lights(text, json::array({text["lights"][0]})));
  const Image second = image_of(with_lights(text, json::array({text["lights"][1]})));
  json halved = text;
  for (json& light : halved["lights"]) light["intensity"] = light["intensity"].get<double>() / 2;
  halved["ambient"] = text["ambient"].get<double>() / 2;
  const Image mean = image_of(halved);
  for (std::size_t i = 0; i < mean.values.size(); ++i)
    ASSERT_NEAR(static_cast<double>(mean.values[i]),
                (static_cast<double>(first.values[i]) + static_cast<double>(second.values[i])) / 2,
                1e-6);
}

TEST(Light, does_not_depend_on_the_order_of_lights) {
  json text = dim_scene();
  const Image image = image_of(text);
  std::reverse(text["lights"].begin(), text["lights"].end());
  EXPECT_LE(distance(image, image_of(text)), 1e-7);
}

TEST(Light, of_intensity_zero_leaves_its_ambient_part) {
  json text = dim_scene();
  for (json& light : text["lights"]) light["intensity"] = 0;
  const Image image = image_of(text);
  EXPECT_GT(count_lit(image), 1000);
  for (json& light : text["lights"]) light["color"] = {0, 0, 0};
  EXPECT_EQ(distance(image, image_of(text)), 0);
}

/// A room, of which a slit in the ceiling lets in light of the sky, seen from inside.
json room_with_slit() {
  const std::vector<Vec3> vertices{{-1, 0, -1},    {1, 0, -1},    {1, 0, 1},    {-1, 0, 1},
                                   {-1, 1, -1},    {1, 1, -1},    {1, 1, 1},    {-1, 1, 1},
                                   {-0.01, 1, -1}, {0.01, 1, -1}, {0.01, 1, 1}, {-0.01, 1, 1}};
  const std::vector<std::array<int, 3>> triangles{
      {0, 1, 2}, {0, 2, 3}, {0, 1, 5}, {0, 5, 4},  {1, 2, 6},  {1, 6, 5}, {2, 3, 7},
      {2, 7, 6}, {3, 0, 4}, {3, 4, 7}, {4, 8, 11}, {4, 11, 7}, {9, 5, 6}, {9, 6, 10}};
  json text = document(camera_json(16, 16, 0.8, {0.5, 0.9, 0}, {0, 0, 0}),
                       {mesh_json(vertices, triangles)}, {json{{"type", "sky"}, {"intensity", 1}}});
  text["ambient"] = 0.5;
  return text;
}

TEST(Light, that_is_seen_through_a_slit_is_found_by_many_samples) {
  json text = room_with_slit();
  const auto mean = [&](int samples) {
    text["render"] = {{"samples", samples}, {"transfer", "linear"}};
    const Image image = image_of(text);
    double sum = 0;
    for (const float value : image.values) sum += static_cast<double>(value);
    return sum / static_cast<double>(image.values.size());
  };
  // All of the floor sees some of it, so that it has all of the ambient part in the end.
  const double by_few = mean(16);
  const double by_many = mean(1024);
  EXPECT_GT(by_few, 0.1);
  EXPECT_GT(by_many, 1.2 * by_few);
  EXPECT_LT(by_many, 0.6);
}

}  // namespace
}  // namespace raytracer::test
