// 250,002 spheres, each written out: read, built and rendered in seconds.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <iterator>
#include <string>

#include "tests/golden/picture.h"
#include "tests/process/patience.h"
#include "tests/service/documents.h"
#include "tests/service/service.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

/// Two spheres above a square of 500 x 500, as explicit objects.
std::string explicit_square() {
  constexpr int n = 250;
  constexpr double radius = 0.5;
  std::string text = R"({"camera": {"origin": [0, 40, -180], "look_at": [0, -4, 0], "fov": 1.2,
                                    "width": 700, "height": 500},
    "background": [0.5, 0.8, 0.9],
    "lights": [{"type": "distant", "direction": [-0.6, -1, 0.7], "intensity": 0.9}],
    "objects": [{"type": "sphere", "center": [-30, 30, 0], "radius": 25},
                {"type": "sphere", "center": [30, 25, 10], "radius": 20})";
  for (int i = 0; i < 2 * n; ++i)
    for (int k = 0; k < 2 * n; ++k)
      fmt::format_to(std::back_inserter(text),
                     R"(,{{"type":"sphere","center":[{},{},{}],"radius":{}}})",
                     (2 * i + 1 - 2 * n) * radius, -4, (2 * k + 1 - 2 * n) * radius, radius);
  return text + "]}";
}

/// The same picture said in one object.
std::string square_as_one_object() {
  const std::string text = explicit_square();
  const std::size_t first = text.find(R"(,{"type":"sphere","center")");
  return text.substr(0, first) +
         R"(,{"type":"sphere_square","center":[0,-4,0],"radius":0.5,"n":250}]})";
}

TEST(LargeScene, quarter_of_a_million_spheres_take_under_five_seconds) {
  const ServerProcess server;
  const std::string document = explicit_square();
  const auto begin = std::chrono::steady_clock::now();
  const Answer answer = post(server, "/render?precision=double", document);
  const auto took = std::chrono::steady_clock::now() - begin;
  ASSERT_EQ(answer.status, 200) << answer.body.substr(0, 500);
  EXPECT_LT(took, patience(5s));
  const Answer one_object = post(server, "/render?precision=double", square_as_one_object());
  ASSERT_EQ(one_object.status, 200) << one_object.body;
  // In double, because single precision moves silhouettes by more than the two formulas do: the one
  // for all spheres of a square rounds otherwise than each sphere's own.
  const Picture picture = decode_png(answer.body);
  const Difference difference = compare(picture, decode_png(one_object.body));
  EXPECT_LT(difference.different_count, picture.width * picture.height / 1000);
}

}  // namespace
}  // namespace raytracer::test
