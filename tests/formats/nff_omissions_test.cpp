// What an NFF file has and a scene cannot say is counted, each kind once.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/formats/nff_document.h"

namespace raytracer::test {
namespace {

/// Of a text with a viewpoint, a light and a fill before, in eight lines.
std::vector<client::Omission> omissions_of(const std::string& elements) {
  const client::Reading reading = client::read_nff(nff_view + "l 0 0 9\n" + nff_fill + elements);
  EXPECT_TRUE(reading.errors.empty()) << reading.errors.front().what;
  return reading.omissions;
}

void expect_one(const std::vector<client::Omission>& omissions, int count, int line,
                const std::string& says) {
  ASSERT_EQ(omissions.size(), 1U);
  EXPECT_EQ(omissions[0].count, count);
  EXPECT_EQ(omissions[0].first_line, line);
  const std::string& words = count == 1 ? omissions[0].one : omissions[0].many;
  EXPECT_NE(words.find(says), std::string::npos) << words;
}

TEST(NffOmissions, file_that_a_scene_can_say_has_none) {
  EXPECT_TRUE(omissions_of("s 0 0 0 1\nc 0 0 0 1 0 0 1 0\np 3 0 0 0 1 0 0 0 1 0\n").empty());
}

TEST(NffOmissions, plane_before_which_nothing_is_seen_is_one) {
  const client::Reading reading = client::read_nff(
      "v from 1 0 0 at 0 0 0 up 0 0 1 angle 45 hither 0.5 resolution 9 9\nl 0 0 1");
  expect_one(reading.omissions, 1, 1, "hither plane left out");
}

TEST(NffOmissions, surfaces_that_are_seen_from_inside_only_are_kept) {
  expect_one(omissions_of("s 0 0 0 -1\ns 0 0 0 -2\n"), 2, 9, "seen from inside only");
  expect_one(omissions_of("c 0 0 0 -1 0 0 1 -0.5\n"), 1, 9, "seen from inside only");
  expect_one(omissions_of("c 0 0 0 -1 0 0 1 0\n"), 1, 9, "seen from inside only");
  EXPECT_EQ(nff_objects("s 0 0 0 -2")[0].at("radius"), 2);
  EXPECT_EQ(nff_objects("c 0 0 0 -1 0 0 1 -1")[0].at("radius"), 1);
}

TEST(NffOmissions, objects_without_a_surface_are_left_out) {
  expect_one(omissions_of("s 0 0 0 1\ns 0 0 0 0\n"), 1, 10, "without radius left out");
  expect_one(omissions_of("c 1 2 3 1 1 2 3 0\nc 0 0 0 0 1 0 0 0"), 2, 9, "left out");
  expect_one(omissions_of("p 3 0 0 0 1 1 1 2 2 2\np 4 1 1 1 1 1 1 1 1 1 1 1 1"), 2, 9,
             "without area left out");
  EXPECT_TRUE(nff_objects("s 0 0 0 0\np 3 0 0 0 1 1 1 2 2 2").empty());
}

TEST(NffOmissions, polygon_whose_sides_cross_is_told) {
  expect_one(omissions_of("p 5 0 3 0 2 -3 0 -3 1 0 3 1 0 -2 -3 0"), 1, 9, "sides cross");
}

TEST(NffOmissions, normal_without_length_becomes_that_of_the_polygon) {
  const std::string patch = "pp 3 0 0 0 0 0 0 1 0 0 1 0 1 0 1 0 0 0 1";
  expect_one(omissions_of(patch), 1, 9, "without length");
  EXPECT_EQ(nff_objects(patch)[0].at("normals")[0][0], 0);
  EXPECT_GT(nff_objects(patch)[0].at("normals")[0][2], 0);
}

TEST(NffOmissions, patch_is_turned_to_where_its_normals_point) {
  const std::string clockwise = "pp 3 0 0 0 0 0 1 0 1 0 0 0 1 1 0 0 0 0 1";
  expect_one(omissions_of(clockwise), 1, 9, "turned round");
  const auto mesh = nff_objects(clockwise)[0];
  const auto corner = [&](std::size_t i) {
    return mesh.at("vertices")[mesh.at("triangles")[0][i].get<std::size_t>()];
  };
  const auto side = [&](std::size_t i, std::size_t axis) {
    return corner(i)[axis].get<double>() - corner(0)[axis].get<double>();
  };
  EXPECT_GT(side(1, 0) * side(2, 1) - side(1, 1) * side(2, 0), 0);
}

TEST(NffOmissions, shares_above_1_are_1) {
  expect_one(omissions_of("f 1 1 1 1.5 2 10 0 0\n"), 2, 9, "taken as 1");
}

TEST(NffOmissions, index_below_that_of_the_outside_bends_nothing) {
  expect_one(omissions_of("f 1 1 1 0 0 0 1 0.5\n"), 1, 9, "below 1");
  EXPECT_TRUE(omissions_of("f 1 1 1 0 0 0 0 0\n").empty()) << "what is opaque needs none";
}

TEST(NffOmissions, objects_before_the_first_fill_have_the_default_material) {
  const std::string text = nff_view + "l 0 0 9\ns 0 0 0 1\ns 3 0 0 1\n" + nff_fill + "s 6 0 0 1";
  const client::Reading reading = client::read_nff(text);
  expect_one(reading.omissions, 2, 8, "before the first fill");
  const auto objects = nff_document(text).at("objects");
  ASSERT_EQ(objects.size(), 2U);
  EXPECT_FALSE(objects[0].contains("material"));
  EXPECT_EQ(objects[1].at("material"), "fill1");
}

}  // namespace
}  // namespace raytracer::test
