// A document's errors come together, and their list is bounded.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/scene/full_document.h"

namespace raytracer::test {
namespace {

std::vector<std::string> sorted_pointers(const std::vector<Error>& errors) {
  std::vector<std::string> pointers;
  pointers.reserve(errors.size());
  for (const Error& error : errors) pointers.push_back(error.pointer);
  std::sort(pointers.begin(), pointers.end());
  return pointers;
}

TEST(Validation, reports_all_errors_of_a_document_together) {
  json wrong = full_document();
  wrong["camera"]["fvo"] = 1;
  wrong["objects"][0]["radius"] = -2;
  wrong["objects"][1]["material"] = "rde";
  wrong["lights"][1].erase("position");
  wrong["render"]["samples"] = 0;
  const std::vector<Error> errors = errors_of(wrong);
  EXPECT_EQ(sorted_pointers(errors),
            (std::vector<std::string>{"/camera/fvo", "/lights/1/position", "/objects/0/radius",
                                      "/objects/1/material", "/render/samples"}))
      << describe(errors);
  for (const Error& error : errors)
    EXPECT_EQ(error.is_about_key, error.pointer == "/camera/fvo") << error.pointer;
}

TEST(Validation, an_unknown_type_hides_no_error_in_what_all_types_have) {
  json wrong = full_document();
  wrong["objects"][0]["type"] = "cube";
  wrong["objects"][0]["material"] = "rde";
  wrong["lights"][1].erase("type");
  wrong["lights"][1]["color"] = "x";
  wrong["lights"][1]["intensity"] = -1;
  wrong["lights"][1]["angle"] = 1;
  const std::vector<Error> errors = errors_of(wrong);
  EXPECT_EQ(sorted_pointers(errors),
            (std::vector<std::string>{"/lights/1/color", "/lights/1/intensity", "/lights/1/type",
                                      "/objects/0/material", "/objects/0/type"}))
      << describe(errors);
}

TEST(Validation, refuses_a_document_that_is_no_object) {
  for (const char* text : {"5", "null", "[]", "\"scene\"", "true"}) {
    const std::vector<Error> errors = errors_of_text(text);
    ASSERT_EQ(errors.size(), 1U) << text << '\n' << describe(errors);
    EXPECT_EQ(errors[0].pointer, "") << text;
    EXPECT_EQ(errors[0].kind, ErrorKind::invalid) << text;
    EXPECT_NE(errors[0].detail.find("must be an object"), std::string::npos) << text;
  }
}

TEST(Validation, lists_a_thousand_errors_and_counts_the_rest) {
  json wrong = full_document();
  wrong["objects"] = json::array();
  for (int i = 0; i < 1500; ++i) wrong["objects"].push_back(sphere_json({}, -1));
  const std::vector<Error> errors = errors_of(wrong);
  ASSERT_EQ(errors.size(), 1001U);
  EXPECT_EQ(errors[999].pointer, "/objects/999/radius");
  EXPECT_NE(errors[1000].detail.find("500 more"), std::string::npos) << errors[1000].detail;
}

TEST(Validation, lists_exactly_a_thousand_errors_without_a_remark) {
  json wrong = full_document();
  wrong["objects"] = json::array();
  for (int i = 0; i < 1000; ++i) wrong["objects"].push_back(sphere_json({}, -1));
  EXPECT_EQ(errors_of(wrong).size(), 1000U);
}

TEST(Validation, bounds_the_answer_to_a_long_key_with_many_errors_under_it) {
  json wrong = full_document();
  const std::string long_key(100'000, 'k');
  for (int i = 0; i < 1000; ++i) wrong["materials"][long_key]["x" + std::to_string(i)] = 1;
  std::size_t size = 0;
  for (const Error& error : errors_of(wrong)) size += error.pointer.size() + error.detail.size();
  EXPECT_LT(size, 20U * wrong.dump().size());
}

}  // namespace
}  // namespace raytracer::test
