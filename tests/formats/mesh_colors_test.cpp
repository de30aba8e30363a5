// Colours of a mesh's vertices, as files of several kinds write them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>

#include "tests/formats/read_text.h"

namespace raytracer::test {
namespace {

using nlohmann::json;

/// The header of a PLY of a triangle whose vertices have a colour, told by such properties.
std::string header_with_colors(const std::string& body, const std::string& type,
                               const std::string& prefix = "") {
  std::string text = "ply\nformat " + body + " 1.0\nelement vertex 3\n";
  for (const char* const name : {"x", "y", "z"}) text += fmt::format("property float {}\n", name);
  for (const char* const name : {"red", "green", "blue"})
    text += fmt::format("property {} {}{}\n", type, prefix, name);
  return text + "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
}

/// Whose vertices are red.
json colors_of_ply(const std::string& type, const std::string& red,
                   const std::string& prefix = "") {
  std::string text = header_with_colors("ascii", type, prefix);
  for (const char* const place : {"0 0 0", "1 0 0", "0 1 0"})
    text += fmt::format("{} {} 0 0\n", place, red);
  return document(".ply", text + "3 0 1 2\n").at("objects")[0].at("colors");
}

TEST(MeshColors, of_a_ply_as_text_are_of_any_type) {
  const json red = json::parse("[[1, 0, 0], [1, 0, 0], [1, 0, 0]]");
  for (const char* const type : {"char", "uchar", "short", "int", "uint32"})
    EXPECT_EQ(colors_of_ply(type, "255"), red) << type;
  EXPECT_EQ(colors_of_ply("ushort", "65535"), red);
  EXPECT_EQ(colors_of_ply("float", "1"), red);
  EXPECT_EQ(colors_of_ply("double", "1"), red);
}

TEST(MeshColors, of_a_ply_may_be_named_diffuse) {
  const json red = json::parse("[[1, 0, 0], [1, 0, 0], [1, 0, 0]]");
  EXPECT_EQ(colors_of_ply("uchar", "255", "diffuse_"), red);
  EXPECT_EQ(colors_of_ply("int", "255", "diffuse_"), red);
}

/// In bytes the type says where numbers end, and of an int nobody knows what is white.
TEST(MeshColors, of_a_ply_in_bytes_without_a_scale_are_left_out_and_told) {
  const auto in_bytes = [](const std::string& type, int bytes, const std::string& prefix) {
    std::string text = header_with_colors("binary_little_endian", type, prefix);
    const auto add = [&](std::uint32_t value, int size) {
      for (int i = 0; i < size; ++i) text += static_cast<char>(value >> 8 * i);
    };
    constexpr std::uint32_t one = 0x3F800000;  // as a float
    for (const auto& place : {std::array{0U, 0U}, std::array{one, 0U}, std::array{0U, one}}) {
      for (const std::uint32_t number : {place[0], place[1], 0U}) add(number, 4);
      for (const std::uint32_t number : {255U, 0U, 0U}) add(number, bytes);
    }
    add(3, 1);
    for (const std::uint32_t corner : {0U, 1U, 2U}) add(corner, 4);
    return text;
  };
  for (const char* const prefix : {"", "diffuse_"}) {
    const client::Reading ints =
        read_text(*client::format_of(".ply"), in_bytes("int", 4, prefix)).at(0);
    ASSERT_EQ(ints.omissions.size(), 1U);
    EXPECT_EQ(ints.omissions[0].one,
              "colour of a vertex left out, which is neither uchar, ushort nor float");
    EXPECT_EQ(ints.omissions[0].count, 3);
    EXPECT_EQ(ints.omissions[0].first_line, 7);
    const json object = document(".ply", in_bytes("int", 4, prefix)).at("objects")[0];
    EXPECT_FALSE(object.contains("colors"));
    EXPECT_EQ(object.at("triangles").size(), 1U);
    EXPECT_EQ(document(".ply", in_bytes("uchar", 1, prefix)).at("objects")[0].at("colors")[2],
              json::parse("[1, 0, 0]"));
  }
}

TEST(MeshColors, of_an_obj_are_white_where_there_is_none) {
  const json mesh =
      document(".obj", "v 0 0 0 1 0 0\nv 1 0 0\nv 0 2 0 2\nv 1 1 0 0 1 0\nf 1 2 4 3\n")
          .at("objects")[0];
  EXPECT_EQ(mesh.at("colors"), json::parse("[[1, 0, 0], [1, 1, 1], [0, 1, 0], [1, 1, 1]]"));
  EXPECT_EQ(mesh.at("vertices")[3], json::parse("[0, 1, 0]"));
}

}  // namespace
}  // namespace raytracer::test
