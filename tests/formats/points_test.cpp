// Clouds of points: PLYs without faces.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>

#include "tests/formats/read_text.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {
namespace {

using nlohmann::json;

std::string header_with_radii(const std::string& body, const std::string& type) {
  std::string text = "ply\nformat " + body + " 1.0\nelement vertex 2\n";
  for (const char* const name : {"x", "y", "z"}) text += fmt::format("property float {}\n", name);
  return text + "property " + type + " radius\nproperty uchar quality\nend_header\n";
}

/// Two points, as bytes of which the last comes first if asked for.
std::string points_in_bytes(bool is_big_endian, const std::string& type, int size,
                            const std::array<std::uint64_t, 2>& radii) {
  std::string text =
      header_with_radii(is_big_endian ? "binary_big_endian" : "binary_little_endian", type);
  const auto add = [&](std::uint64_t value, int bytes) {
    std::string number;
    for (int i = 0; i < bytes; ++i) number += static_cast<char>(value >> 8 * i);
    if (is_big_endian) std::reverse(number.begin(), number.end());
    text += number;
  };
  for (std::size_t i = 0; i < radii.size(); ++i) {
    for (const float place : {static_cast<float>(i) * 3, 0.0F, 0.0F})
      add(std::bit_cast<std::uint32_t>(place), 4);
    add(radii[i], size);
    add(7, 1);
  }
  return text;
}

json radii_of(const std::string& ply) {
  return document(".ply", ply).at("objects")[0].at("radius");
}

TEST(Points, are_spheres_with_a_radius_by_their_distances) {
  const json points =
      document(".ply", read_file(RAYTRACER_SOURCE_DIR "/tests/formats/files/cloud.ply"))
          .at("objects")[0];
  EXPECT_EQ(points.at("type"), "spheres");
  EXPECT_EQ(points.at("centers").size(), 96U);
  EXPECT_EQ(points.at("colors").size(), 96U);
}

TEST(Points, have_the_radii_that_their_file_says) {
  const json expected = json::parse("[0.5, 2.0]");
  EXPECT_EQ(radii_of(header_with_radii("ascii", "float") + "0 0 0 0.5 7\n\n3 0 0 2 7\n"), expected);
  for (const bool is_big_endian : {false, true}) {
    const std::uint64_t half = 0x3F000000;
    const std::uint64_t two = 0x40000000;
    EXPECT_EQ(radii_of(points_in_bytes(is_big_endian, "float", 4, {half, two})), expected);
    EXPECT_EQ(
        radii_of(points_in_bytes(is_big_endian, "double", 8,
                                 {std::bit_cast<std::uint64_t>(0.5), std::uint64_t{1} << 62})),
        expected);
    EXPECT_EQ(radii_of(points_in_bytes(is_big_endian, "ushort", 2, {300, 2})),
              json::parse("[300.0, 2.0]"));
  }
}

TEST(Points, other_properties_are_told) {
  const client::Reading reading =
      read_text(*client::format_of(".ply"),
                header_with_radii("ascii", "float") + "0 0 0 0.5 7\n3 0 0 2 7\n")
          .at(0);
  ASSERT_EQ(reading.omissions.size(), 1U);
  EXPECT_EQ(reading.omissions[0].one, "property of the vertices left out");
  EXPECT_EQ(reading.omissions[0].first_line, 8);
}

TEST(Points, radius_that_is_none_is_an_error_with_its_line) {
  for (const char* const radius : {"0", "-1", "nan", "1e300"}) {
    const std::string text = header_with_radii("ascii", "double") + "0 0 0 1 7\n3 0 0 ";
    const client::Reading reading =
        read_text(*client::format_of(".ply"), text + radius + " 7\n").at(0);
    ASSERT_EQ(reading.errors.size(), 1U) << radius;
    EXPECT_EQ(reading.errors[0].line, 11);
    EXPECT_NE(reading.errors[0].what.find("vertex 1"), std::string::npos);
  }
  const client::Reading reading =
      read_text(*client::format_of(".ply"), points_in_bytes(true, "int", 4, {1, 0xFFFFFFFF})).at(0);
  ASSERT_EQ(reading.errors.size(), 1U);
  EXPECT_NE(reading.errors[0].what.find("-1"), std::string::npos);
}

}  // namespace
}  // namespace raytracer::test
