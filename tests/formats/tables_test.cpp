// CSV and TSV: where their header stands, and what becomes of their columns.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/formats/particles_in_pictures.h"

namespace raytracer::test {
namespace {

using nlohmann::json;

TEST(Table, columns_have_names_and_colours_are_shares_or_bytes) {
  const json shares = document(".csv", "x,y,z,radius,r,g,b\n1,2,3,0.5,1,0,0\n4,5,6,0.5,0,1,0.5\n");
  EXPECT_EQ(shares.at("objects")[0].at("colors"), json({{1, 0, 0}, {0, 1, 0.214}}));
  const json rounded = document(".csv", "x,y,z,r,g,b\n1,2,3,1.0000001,0,0\n4,5,6,0,1,0\n");
  EXPECT_EQ(rounded.at("objects")[0].at("colors"), json({{1, 0, 0}, {0, 1, 0}}));
  const json bytes =
      document(".tsv", "z\ty\tx\tred\tgreen\tblue\n3\t2\t1\t255\t0\t0\n1\t1\t1\t0\t0\t0\n");
  EXPECT_EQ(bytes.at("objects")[0].at("colors"), json({{1, 0, 0}, {0, 0, 0}}));
  EXPECT_EQ(bytes.at("objects")[0].at("centers")[0], json({-1, 2, 3}));
}

TEST(Table, fields_may_be_quoted_and_lines_comments) {
  const json scene =
      document(".csv", "# made by hand\n\n\"x\",y,z,\"a, b\"\n1,2,3,\"p, \"\"q\"\"\"\n");
  EXPECT_EQ(centers_of(scene).size(), 1U);
}

TEST(Table, quoted_fields_may_go_over_lines_and_a_byte_order_mark_is_none_of_them) {
  const json scene = document(
      ".csv",
      "\xEF\xBB\xBF\"x\",\"y\",\"z\",note\r\n1,2,3,\"two\r\n\"\"lines\"\"\"\r\n4,5,6,\"\"\r\n");
  EXPECT_EQ(scene.at("objects")[0].at("centers"), json::parse("[[-1, 2, 3], [-4, 5, 6]]"));
}

/// Sodium is no number that is left out, and what was taken for one is not told.
TEST(Table, names_of_elements_are_groups) {
  const auto frames = read_text(*client::format_of(".csv"), "x,y,z,name\n0,0,0,Na\n1,0,0,Cl\n",
                                options_for("name"));
  EXPECT_EQ(frames[0].scene.objects.size(), 2U);
  EXPECT_TRUE(frames[0].omissions.empty());
  const auto late = read_text(*client::format_of(".csv"), "x,y,z,name\n0,0,0,None\n1,0,0,oak\n",
                              options_for("name"));
  EXPECT_EQ(late[0].scene.objects.size(), 2U);
  EXPECT_TRUE(late[0].omissions.empty());
}

TEST(Table, words_are_groups) {
  const json scene =
      document(".csv", "x;y;z;kind\n0;0;0;oak\n1;0;0;ash\n2;0;0;oak\n", options_for("kind"));
  EXPECT_EQ(scene.at("objects").size(), 2U);
}

TEST(Table, missing_numbers_are_gray_and_told_wherever_they_stand) {
  const auto frames =
      read_text(*client::format_of(".csv"), "x,y,z,heat\n0,0,0,\n1,0,0,7\n2,0,0,NaN\n3,0,0,9\n",
                options_for("heat"));
  ASSERT_TRUE(frames.at(0).errors.empty());
  const json scene = json::parse(client::model::to_document(frames[0].scene));
  EXPECT_EQ(scene.at("objects").size(), 3U);  // gray, 7 and 9
  EXPECT_EQ(scene.at("objects")[0].at("centers").size(), 2U);
  const json gray = scene.at("materials").at(scene.at("objects")[0].at("material")).at("color");
  EXPECT_EQ(gray[0], gray[2]);
  ASSERT_EQ(frames[0].omissions.size(), 1U);
  EXPECT_EQ(frames[0].omissions[0].count, 2U);
  // Where the others are words, no word is a group too.
  EXPECT_EQ(document(".csv", "x,y,z,kind\n0,0,0,\n1,0,0,a\n2,0,0,b\n3,0,0,a\n", options_for("kind"))
                .at("objects")
                .size(),
            3U);
}

TEST(Table, colour_of_fewer_than_three_columns_is_told) {
  const auto frames = read_text(*client::format_of(".csv"), "# radii\nx,y,z,r\n0,0,0,2\n1,0,0,3\n");
  ASSERT_EQ(frames.at(0).omissions.size(), 1U);
  EXPECT_EQ(frames[0].omissions[0].first_line, 2);
  EXPECT_NE(frames[0].omissions[0].one.find("a radius is called radius"), std::string::npos);
  EXPECT_TRUE(read_text(*client::format_of(".csv"), "x,y,z,r\n0,0,0,2\n1,0,0,3\n", options_for("r"))
                  .at(0)
                  .omissions.empty());
}

TEST(Table, atoms_of_no_known_element_are_told_if_it_is_drawn) {
  const auto told = [](const std::string& text, const client::ImportOptions& options = {}) {
    const auto frames = read_text(*client::format_of(".csv"), text, options);
    return frames.at(0).omissions.empty() ? 0 : frames[0].omissions[0].count;
  };
  EXPECT_EQ(told("x,y,z,element\n0,0,0,C\n1,0,0,Qq\n2,0,0,?\n"), 2);
  const std::string drawn_without =
      "x,y,z,element,radius,r,g,b\n0,0,0,C,1,1,1,1\n1,0,0,Qq,1,1,1,1\n";
  EXPECT_EQ(told(drawn_without), 0);
  client::ImportOptions sticks;
  sticks.style = client::AtomStyle::ball_and_stick;
  EXPECT_EQ(told(drawn_without, sticks), 1);
}

TEST(Xyz, what_frames_leave_out_is_told_with_the_first_that_does) {
  const std::string frame = "2\n\nC 0 0 0\nQq 1 0 0\n";
  const auto frames = read_text(*client::format_of(".xyz"), "1\n\nC 0 0 0\n" + frame + frame);
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_TRUE(frames[0].omissions.empty());
  EXPECT_FALSE(frames[1].omissions.empty());
  EXPECT_TRUE(frames[2].omissions.empty());
}

TEST(Table, comment_that_names_the_places_is_the_header) {
  const std::vector<std::pair<std::string, std::string>> table{
      {".csv", "# made by hand\n# x,y,z,Heat\n1,2,3,4\n4,5,6,7\n"},
      {".csv", "#x y z Heat\n1,2,3,4\n4,5,6,7\n"},
      {".csv", "# X y z Heat\n1.0e+00 2 3 4\n4 5 6 7\n"},
      {".csv", "# x;y;z;Heat\n1;2;3;4\n4;5;6;7\n"},
      {".tsv", "# \"x\"\ty\tz\tHeat\n1\t2\t3\t4\n# none\n4\t5\t6\t7\n"}};
  for (const auto& [ending, text] : table) {
    SCOPED_TRACE(text);
    const auto frames = read_text(*client::format_of(ending), text, options_for("Heat"));
    ASSERT_TRUE(frames.at(0).errors.empty()) << frames[0].errors[0].what;
    EXPECT_EQ(centers_of(json::parse(client::model::to_document(frames[0].scene))),
              (std::vector<json>{{-1, 2, 3}, {-4, 5, 6}}));
  }
}

TEST(Table, comment_that_only_speaks_of_places_is_none) {
  const auto error_of = [](const std::string& text) {
    return read_text(*client::format_of(".csv"), text).at(0).errors.at(0);
  };
  for (const char* const text : {"# x y z in metres\n1,2,3\n", "# x,y\n1,2,3\n"}) {
    EXPECT_EQ(error_of(text).line, 2);
    EXPECT_NE(error_of(text).what.find("a number stands in the first line"), std::string::npos);
  }
  // A header that is none is the better one.
  EXPECT_EQ(centers_of(document(".csv", "# x,y,z\nz,y,x\n1,2,3\n")),
            (std::vector<json>{{-3, 2, 1}}));
  EXPECT_EQ(error_of("# x,y,z\n1,2,3\n1,2,q\n").line, 3);
}

TEST(Table, column_of_colours_is_found_exactly_or_else_in_any_case) {
  EXPECT_EQ(
      document(".csv", "x,y,z,Heat\n0,0,0,1\n1,0,0,2\n", options_for("heat")).at("objects").size(),
      2U);
  EXPECT_EQ(document(".csv", "x,y,z,Heat,heat\n0,0,0,1,5\n1,0,0,2,5\n", options_for("heat"))
                .at("objects")
                .size(),
            1U);
}

/// As many words as numbers of types have the palette's colours from the first on.
TEST(Table, words_begin_with_the_first_colour_of_the_palette) {
  const auto materials = [](const std::string& rows) {
    return document(".csv", "x,y,z,type\n" + rows, options_for("type")).at("materials");
  };
  EXPECT_EQ(materials("0,0,0,oak\n1,0,0,ash\n"), materials("0,0,0,1\n1,0,0,2\n"));
  const auto kinds = document(".csv", "x,y,z,kind\n0,0,0,oak\n1,0,0,ash\n", options_for("kind"));
  EXPECT_EQ(kinds.at("materials"), materials("0,0,0,1\n1,0,0,2\n"));
}

}  // namespace
}  // namespace raytracer::test
