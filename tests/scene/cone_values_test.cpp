// What a document says of cones, right and wrong.
#include <gtest/gtest.h>

#include "engine/scene/canonical.h"
#include "tests/scene/full_document.h"
#include "tests/support/scenes.h"

namespace raytracer::test {
namespace {

constexpr std::size_t the_cone = 7;
constexpr std::size_t the_cones = 8;

/// Of the full document with one value of an object changed.
json with_value(std::size_t object, const char* key, const json& value) {
  json text = full_document();
  text["objects"][object][key] = value;
  return text;
}

void expect_error(std::size_t object, const char* key, const json& value,
                  const std::string& pointer, const std::string& words) {
  const std::vector<Error> errors = errors_of(with_value(object, key, value));
  ASSERT_EQ(errors.size(), 1U) << describe(errors);
  EXPECT_EQ(errors[0].pointer, "/objects/" + std::to_string(object) + pointer);
  EXPECT_NE(errors[0].detail.find(words), std::string::npos) << errors[0].detail;
}

TEST(ConeValues, are_taken_over) {
  const Scene scene = scene_of(full_document());
  const auto& cone = std::get<Cone>(scene.objects[the_cone].shape);
  EXPECT_EQ(cone.to, (Vec3{0, 3, 0}));
  EXPECT_EQ(cone.radius_from, 0.5);
  EXPECT_EQ(cone.radius_to, 0);
  EXPECT_TRUE(cone.caps);
  const auto& cones = std::get<Cones>(scene.objects[the_cones].shape);
  EXPECT_EQ(cones.from, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}}));
  EXPECT_EQ(cones.radius_from(0), 0);
  EXPECT_EQ(cones.radius_from(1), 0.2);
  EXPECT_EQ(cones.radius_to(0), 0.3);
  EXPECT_EQ(cones.radius_to(1), 0.3);
  EXPECT_FALSE(cones.caps);
  EXPECT_EQ(cones.colors.size(), 2U);
}

TEST(ConeValues, may_be_a_tip_at_either_end_or_none) {
  EXPECT_TRUE(errors_of(with_value(the_cone, "radius_to", 0.5)).empty());
  json turned = with_value(the_cone, "radius_to", 1e300);
  turned["objects"][the_cone]["radius_from"] = 0;
  EXPECT_TRUE(errors_of(turned).empty());
  EXPECT_TRUE(errors_of(with_value(the_cones, "radius_to", {1, 0})).empty());
  EXPECT_TRUE(errors_of(with_value(the_cones, "radius_from", 0)).empty());
}

TEST(ConeValues, that_are_wrong_are_told) {
  expect_error(the_cone, "radius_from", -1, "/radius_from", "at least 0");
  expect_error(the_cone, "radius_from", 0, "/radius_to", "must not be 0 where radius_from is");
  expect_error(the_cone, "radius_to", -0.5, "/radius_to", "at least 0");
  expect_error(the_cone, "radius_to", "1", "/radius_to", "must be a number");
  expect_error(the_cone, "to", {0, 0, 0}, "/to", "must differ from from");
  expect_error(the_cone, "radius", 1, "/radius", "unknown key");
  expect_error(the_cones, "radius_to", 0, "/radius_to", "must not be 0 where radius_from is");
  expect_error(the_cones, "radius_to", {0, 1}, "/radius_to/0", "must not be 0");
  expect_error(the_cones, "radius_to", {1, -1}, "/radius_to/1", "at least 0");
  expect_error(the_cones, "radius_to", {1, 1, 1}, "/radius_to", "3 numbers for 2 from");
  expect_error(the_cones, "colors", {"#102030"}, "/colors", "1 color for 2 from");
}

TEST(ConeValues, change_the_canonical_bytes) {
  const std::string bytes = canonical_content(scene_of(full_document()));
  const auto expect_other = [&](std::size_t object, const char* key, const json& value) {
    EXPECT_NE(canonical_content(scene_of(with_value(object, key, value))), bytes) << key;
  };
  expect_other(the_cone, "from", {0, 1, 0});
  expect_other(the_cone, "radius_from", 0.25);
  expect_other(the_cone, "radius_to", 0.25);
  expect_other(the_cone, "caps", false);
  expect_other(the_cones, "radius_from", {0, 0.25});
  expect_other(the_cones, "radius_to", {0.3, 0.25});
  expect_other(the_cones, "caps", true);
  EXPECT_EQ(canonical_content(scene_of(with_value(the_cones, "radius_to", {0.3, 0.3}))), bytes);
}

}  // namespace
}  // namespace raytracer::test
