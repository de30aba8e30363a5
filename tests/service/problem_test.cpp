// problem+json (RFC 9457): one form for everything that goes wrong.
#include <gtest/gtest.h>

#include <string>

#include "tests/service/documents.h"
#include "tests/service/service.h"

namespace raytracer::test {
namespace {

class ProblemAnswer : public Service {};

TEST_F(ProblemAnswer, every_status_has_the_same_form) {
  expect_problem(post("/render", "{"), 400, "line 1");
  expect_problem(get("/nothing"), 404, "/nothing");
  expect_problem(request("DELETE", "/scenes"), 405, "/scenes");
  expect_problem(post("/render", small_scene, {{"Accept", "text/html"}}), 406, "image/png");
  expect_problem(post("/render?width=100000&height=100000", small_scene), 413, "--max-pixels");
  expect_problem(get("/" + std::string(5000, 'a')), 414, "");
  expect_problem(post("/render", small_scene, {{"Content-Type", "text/xml"}}), 415, "json");
  expect_problem(post("/render", "{}"), 422, "camera");
}

TEST_F(ProblemAnswer, is_never_stored) {
  EXPECT_EQ(get("/nothing").get_header_value("Cache-Control"), "no-store");
  EXPECT_EQ(post("/render", "{").get_header_value("Cache-Control"), "no-store");
}

TEST_F(ProblemAnswer, leaks_nothing_of_the_program) {
  for (const Answer& answer : {post("/render", "{"), get("/nothing"), post("/render", "[]")}) {
    EXPECT_FALSE(answer.has_header("EXCEPTION_WHAT"));
    EXPECT_EQ(answer.body.find("nlohmann"), std::string::npos) << answer.body;
    EXPECT_EQ(answer.body.find("exception"), std::string::npos) << answer.body;
  }
}

TEST_F(ProblemAnswer, bytes_that_are_not_utf8_come_back_as_json) {
  expect_problem(get("/%ff%fe%80"), 404, "");
  expect_problem(post("/render", "{\"camera\": \"\xff\xfe\"}"), 400, "");
  expect_problem(get("/render?scene=%ff%80"), 404, "");
  expect_problem(get("/render?%c3%28=1"), 400, "");
}

}  // namespace
}  // namespace raytracer::test
