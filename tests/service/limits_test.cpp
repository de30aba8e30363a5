// Work beyond a limit: 413, naming the limit and the flag that would lift it.
#include <gtest/gtest.h>

#include <string>

#include "tests/service/documents.h"
#include "tests/service/service.h"

namespace raytracer::test {
namespace {

/// A server with one limit, and a document beyond it and one within.
void expect_limit(const std::string& flag, const std::string& value, const std::string& beyond,
                  const std::string& within) {
  const ServerProcess limited({flag, value});
  const Answer refused = post(limited, "/render", beyond);
  expect_problem(refused, 413, flag);
  EXPECT_NE(json_of(refused).value("detail", "").find(value), std::string::npos) << refused.body;
  EXPECT_EQ(post(limited, "/jobs", beyond).status, 413);
  EXPECT_EQ(post(limited, "/render", within).status, 200);
}

std::string with_spheres(int count) {
  std::string centers;
  for (int i = 0; i < count; ++i) centers += fmt::format("{}[{},0,0]", i == 0 ? "" : ",", i);
  std::string document = small_scene;
  document.insert(document.rfind(']'),
                  R"(, {"type": "spheres", "radius": 0.1, "centers": [)" + centers + "]}");
  return document;
}

TEST(Limit, pixels) {
  expect_limit("--max-pixels", "900", square_scene(31, 1), square_scene(30, 1));
}

TEST(Limit, samples) { expect_limit("--max-samples", "8", square_scene(4, 9), square_scene(4, 8)); }

TEST(Limit, lights) {
  std::string two = small_scene;
  const std::string light = R"({"type": "distant", "direction": [-1, -1, 2]})";
  two.replace(two.find(light), light.size(), light + "," + light);
  expect_limit("--max-lights", "1", two, small_scene);
}

TEST(Limit, work) { expect_limit("--max-work", "1600", square_scene(20, 5), square_scene(20, 4)); }

TEST(Limit, objects_count_each_sphere_of_a_set) {
  expect_limit("--max-objects", "100", with_spheres(100), with_spheres(99));
}

TEST(Limit, square_of_spheres_is_one_object) {
  const ServerProcess limited({"--max-objects", "1"});
  std::string square = small_scene;
  square.replace(
      square.rfind("[{\"type\""), std::string::npos,
      R"([{"type": "sphere_square", "center": [0, -1, 0], "radius": 0.1, "n": 1000000}]})");
  EXPECT_EQ(post(limited, "/render", square).status, 200);
}

TEST(Limit, all_that_are_exceeded_are_named) {
  const ServerProcess limited({"--max-pixels", "900", "--max-samples", "8"});
  const Answer refused = post(limited, "/render", square_scene(31, 9));
  EXPECT_EQ(refused.status, 413);
  EXPECT_NE(errors_of(refused).find("--max-pixels"), std::string::npos) << refused.body;
  EXPECT_NE(errors_of(refused).find("--max-samples"), std::string::npos) << refused.body;
}

TEST(Limit, applies_to_the_query) {
  const ServerProcess limited({"--max-pixels", "900"});
  expect_problem(post(limited, "/render?width=1000", small_scene), 413, "--max-pixels");
  expect_problem(get(limited, "/render?scene=demo"), 413, "--max-pixels");
}

}  // namespace
}  // namespace raytracer::test
