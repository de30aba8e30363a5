// What is wrong with an NFF file is said with its line, what it is, and what to write.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/formats/nff_document.h"

namespace raytracer::test {
namespace {

std::vector<client::LineError> errors_of(const std::string& text) {
  return client::read_nff(text).errors;
}

struct Mistake {
  std::string text;  ///< after the viewpoint, which has six lines
  int line;
  std::string says;
};

TEST(NffErrors, each_has_its_line_and_says_what_to_write) {
  const std::vector<Mistake> table{
      {"s 1 2 3", 7, "the file ends where a number is missing; write s X Y Z RADIUS"},
      {"s 1 2\n3 x4", 8, "'x4' stands where a number is missing; write s X Y Z RADIUS"},
      {"s 1 2 3 4 5", 7, "'5' is one number too many; write s X Y Z RADIUS"},
      {"s 1 2 3 1e999", 7, "'1e999' stands"},
      {"s 1 2 3 nan", 7, "'nan' stands"},
      {"s 1 2 3 inf", 7, "'inf' stands"},
      {"s 1 2 3 +-4", 7, "'+-4' stands"},
      {"\nq 1 2", 8, "'q' is no element of NFF; write v, b, l, f, c, s, p or pp"},
      {"b 0 0 1.5", 7, "the background has 1.5, and takes numbers from 0 to 1; write b R G B"},
      {"b 0 0 1\nb 0 0 1", 8, "this is a second background"},
      {"b 0 1", 7, "write b R G B"},
      {"l 1 2", 7, "write l X Y Z or l X Y Z R G B"},
      {"l 1 2 3 1 1\n", 7, "write l X Y Z or l X Y Z R G B"},
      {"l 1 2 3 1 -1 1", 7, "the light's colour is -1, and must not be negative"},
      {"f 1 1 1 0.5 0.5 10 0", 7, "write f R G B Kd Ks Shine T INDEX"},
      {"f 255 0 0 1 1 1 0 0", 7, "the fill's colour has 255, and takes numbers from 0 to 1"},
      {"f 1 1 1 -0.5 0.5 10 0 1", 7, "Kd is -0.5, and must not be negative"},
      {"f 1 1 1 0.5 0.5 -10 0 1", 7, "Shine is -10, and must not be negative"},
      {"f 1 1 1 0.5 0.5 10 -1 1", 7, "T is -1, and must not be negative"},
      {"f 1 1 1 0.5 0.5 10 1 -1", 7, "the index of refraction is -1, and must not be negative"},
      {"c\n0 0 0 1\n1 0 0 -1", 7, "one radius is negative and the other is not"},
      {"c\n0 0 0 1\n1 0 0\ns 0 0 0 1", 10, "write c X Y Z RADIUS X Y Z RADIUS"},
      {"p 2\n0 0 0\n1 0 0", 7, "the number of corners is 2, and must be an integer from 3"},
      {"p 3.5\n0 0 0", 7, "the number of corners is 3.5, and must be an integer from 3"},
      {"p 1000000000\n0 0 0", 8, "the file ends where a number is missing"},
      {"p 3\n0 0 0\n1 0 0\n", 9, "write p N and then X Y Z of N corners"},
      {"pp 3\n0 0 0 0 0 1\n1 0 0 0 0\n0 1 0 0 0 1\n", 10,
       "write pp N and then X Y Z NX NY NZ of N corners, from line 7 on"},
      {nff_view, 7, "this is a second viewpoint"},
  };
  for (const auto& [text, line, says] : table) {
    SCOPED_TRACE(text);
    const auto errors = errors_of(nff_view + text);
    ASSERT_EQ(errors.size(), 1U);
    EXPECT_EQ(errors[0].line, line);
    EXPECT_NE(errors[0].what.find(says), std::string::npos) << errors[0].what;
    EXPECT_NE(errors[0].what.find("write "), std::string::npos) << errors[0].what;
  }
}

TEST(NffErrors, viewpoint_that_shows_nothing_is_refused) {
  const std::vector<Mistake> table{
      {"v at 0 0 0 up 0 0 1 angle 45 resolution 9 9", 1, "the viewpoint lacks a part"},
      {"\nv from 1 0 0 up 0 0 1 angle 45 resolution 9 9", 2, "the viewpoint lacks a part"},
      {"v from 1 0 0 at 0 0 0 angle 45 resolution 9 9", 1, "the viewpoint lacks a part"},
      {"v from 1 0 0 at 0 0 0 up 0 0 1 resolution 9 9", 1, "the viewpoint lacks a part"},
      {"v from 1 0 0 at 0 0 0 up 0 0 1 angle 45", 1, "the viewpoint lacks a part"},
      {"v from 1 0 0 at 1 0 0 up 0 0 1 angle 45 resolution 9 9", 1, "looks at itself"},
      {"v from 1 0 0 at 0 0 0 up 0 0 0 angle 45 resolution 9 9", 1, "no direction is up"},
      {"v from 1 0 0 at 0 0 0 up 0 0 1 angle 180 resolution 9 9", 1, "between 0 and 180"},
      {"v from 1 0 0 at 0 0 0 up 0 0 1 angle 0 resolution 9 9", 1, "between 0 and 180"},
      {"v from 1 0 0 at 0 0 0 up 0 0 1 angle 45\nresolution 9 0", 2, "must be an integer from 1"},
      {"v from 1 0 0 at 0 0 0 up 0 0 1 angle 45\nresolution 9 9.5", 2, "must be an integer from 1"},
      {"v from 1 0 0 at 0 0 0 up 0 0 1 angle wide resolution 9 9", 1, "'wide' stands"},
      {"b 0 0 0\n", 1, "the file has no viewpoint and nothing to look at; write v from X Y Z"},
      {"", 1, "the file has no viewpoint"},
      {"s 0 0 0 1\nc 0 0 0 1\n1 0 0 1e101\n", 3, "'1e101' is beyond 1e100"},
  };
  for (const auto& [text, line, says] : table) {
    SCOPED_TRACE(text);
    const auto errors = errors_of(text);
    ASSERT_EQ(errors.size(), 1U);
    EXPECT_EQ(errors[0].line, line);
    EXPECT_NE(errors[0].what.find(says), std::string::npos) << errors[0].what;
  }
}

TEST(NffErrors, all_are_said_up_to_twenty) {
  const auto errors = errors_of("v\ns 1 2 3\nl 1 2 3\nb 2 0 0\n");
  ASSERT_EQ(errors.size(), 3U);
  EXPECT_EQ(errors[0].line, 1);
  EXPECT_EQ(errors[1].line, 3);
  EXPECT_EQ(errors[2].line, 4);
  std::string many;
  for (int i = 0; i < 1000; ++i) many += "b 2 2 2\n";
  EXPECT_EQ(errors_of(many).size(), 20U);
}

TEST(NffErrors, words_are_cut_and_made_printable) {
  const auto errors = errors_of("\033[2J" + std::string(1000, 'x'));
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_EQ(errors[0].what.find('\033'), std::string::npos);
  EXPECT_LT(errors[0].what.size(), 150U);
}

TEST(NffErrors, other_format_of_that_ending_is_recognised) {
  const auto errors = errors_of("nff\nversion 2.00\n");
  ASSERT_FALSE(errors.empty());
  EXPECT_NE(errors[0].what.find("Sense8"), std::string::npos);
}

}  // namespace
}  // namespace raytracer::test
