// The query parameters of /render: each once right, with the difference that it makes, and wrong.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/golden/picture.h"
#include "tests/service/documents.h"
#include "tests/service/service.h"

namespace raytracer::test {
namespace {

/// A mirror before a lit one, so that depth, camera and transfer all show.
const std::string mirrors = R"({
  "camera": {"origin": [0, 1, -6], "look_at": [0, 0, 0], "fov": 0.9, "width": 24, "height": 16},
  "background": [0.2, 0.3, 0.5],
  "lights": [{"type": "distant", "direction": [-1, -1, 2]}],
  "objects": [
    {"type": "sphere", "center": [-1, 0, 0], "radius": 1, "material": {"reflectivity": 0.8}},
    {"type": "sphere", "center": [1.2, 0, 0], "radius": 1, "material": {"reflectivity": 0.8}},
    {"type": "plane", "point": [0, -1, 0], "normal": [0, 1, 0]}],
  "render": {"samples": 2}
})";

class Query : public Service {
 protected:
  static Picture picture(const std::string& query, const std::string& document = mirrors) {
    const Answer answer = post("/render" + query, document, without_cache);
    EXPECT_EQ(answer.status, 200) << query << ": " << answer.body;
    return decode_png(answer.body);
  }
  /// `document` with the first `from` replaced.
  static std::string with(const std::string& from, const std::string& to) {
    std::string document = mirrors;
    document.replace(document.find(from), from.size(), to);
    return document;
  }
};

TEST_F(Query, each_parameter_equals_the_same_value_in_the_document) {
  EXPECT_EQ(picture("?width=30"), picture("", with("\"width\": 24", "\"width\": 30")));
  EXPECT_EQ(picture("?height=20"), picture("", with("\"height\": 16", "\"height\": 20")));
  EXPECT_EQ(picture("?samples=5"), picture("", with("\"samples\": 2", "\"samples\": 5")));
  EXPECT_EQ(picture("?transfer=srgb"),
            picture("", with("\"samples\": 2", "\"samples\": 2, \"transfer\": \"srgb\"")));
  EXPECT_EQ(picture("?max_depth=0"),
            picture("", with("\"samples\": 2", "\"samples\": 2, \"max_depth\": 0")));
  EXPECT_EQ(picture("?precision=double"),
            picture("", with("\"samples\": 2", "\"samples\": 2, \"precision\": \"double\"")));
}

TEST_F(Query, each_parameter_changes_the_picture) {
  const Picture plain = picture("");
  for (const char* const query :
       {"?width=25", "?height=17", "?samples=5", "?transfer=srgb", "?max_depth=0"})
    EXPECT_NE(picture(query), plain) << query;
}

TEST_F(Query, parameters_go_together) {
  const Picture both = picture("?width=9&height=7&samples=1");
  EXPECT_EQ(both.width, 9);
  EXPECT_EQ(both.height, 7);
}

TEST_F(Query, camera_of_a_named_scene_is_a_view) {
  const std::string small = "/render?scene=first-sphere&width=24&height=16&samples=1";
  const Answer plain = get(small);
  ASSERT_EQ(plain.status, 200) << plain.body;
  for (const char* const camera :
       {"&origin=0.2,0.1,-0.5", "&look_at=1,0,5", "&up=1,1,0", "&fov=1.2", "&fov=1e-1"}) {
    const Answer view = get(small + camera);
    EXPECT_EQ(view.status, 200) << camera << view.body;
    EXPECT_NE(view.get_header_value("ETag"), plain.get_header_value("ETag")) << camera;
  }
  EXPECT_NE(get(small + "&look_at=1,0,5").body, plain.body);
  // Percent signs and plus signs as forms write them.
  EXPECT_EQ(get(small + "&look_at=1%2C0%2c5").body, get(small + "&look_at=1,0,5").body);
}

TEST_F(Query, samples_replace_the_contract_of_the_document) {
  const std::string contract = with("\"samples\": 2", "\"target_rmse\": 0.3");
  EXPECT_EQ(post("/render?samples=3", contract).get_header_value("Render-Stop"), "samples");
  EXPECT_EQ(post("/render?target_rmse=0.4", mirrors).get_header_value("Render-Stop"), "target");
}

struct WrongQuery {
  const char* query;
  int status;
  const char* says;  ///< part of the detail or of an error's line
};

TEST_F(Query, wrong_values_are_refused_with_the_parameters_name) {
  const std::vector<WrongQuery> table{
      {"?width=0", 422, "/camera/width"},
      {"?width=-4", 422, "/camera/width"},
      {"?width=4.5", 400, "\"width\""},
      {"?width=", 400, "\"width\""},
      {"?width=1e3", 400, "\"width\""},
      {"?width=0x10", 400, "\"width\""},
      {"?width=99999999999999999999", 413, "/camera"},
      {"?height=0", 422, "/camera/height"},
      {"?height=ten", 400, "\"height\""},
      {"?samples=0", 422, "/render/samples"},
      {"?samples=many", 400, "\"samples\""},
      {"?target_rmse=0", 422, "/render/target_rmse"},
      {"?target_rmse=nan", 400, "\"target_rmse\""},
      {"?budget_ms=-1", 422, "/render/budget_ms"},
      {"?budget_ms=inf", 400, "\"budget_ms\""},
      {"?budget_ms=1e999", 400, "\"budget_ms\""},
      {"?precision=half", 400, "\"precision\""},
      {"?transfer=gamma", 400, "\"transfer\""},
      {"?max_depth=-1", 422, "/render/max_depth"},
      {"?max_depth=deep", 400, "\"max_depth\""},
      {"?samples=4&target_rmse=0.1", 400, "\"samples\""},
      {"?samples=4&budget_ms=100", 400, "\"budget_ms\""},
      {"?width=4&width=5", 400, "\"width\""},
      {"?width=4&width=4", 400, "\"width\" is given more than once"},
      {"?width=2=4", 400, "\"width=2=4\" has more than one"},
      {"?width=2;height=9", 400, "has more than one"},
      {"?widht=4", 400, "\"width\""},
      {"?width=%4", 400, "%"},
      {"?width=%zz", 400, "%"},
      {"?task=render", 400, "\"task\""},
      {"?fov=1", 400, "\"fov\""},
      {"?origin=0,0,0", 400, "\"origin\""},
      {"?look_at=0,0,0", 400, "\"look_at\""},
      {"?up=0,1,0", 400, "\"up\""},
  };
  for (const WrongQuery& row : table) {
    const Answer answer = post(std::string("/render") + row.query, mirrors);
    SCOPED_TRACE(row.query);
    expect_problem(answer, row.status, row.says);
  }
}

TEST_F(Query, wrong_camera_of_a_named_scene_is_refused) {
  const std::vector<WrongQuery> table{
      {"&origin=0,0", 400, "\"origin\""},
      {"&origin=0,0,0,0", 400, "\"origin\""},
      {"&origin=0,0,x", 400, "\"origin\""},
      {"&look_at=0,,0", 400, "\"look_at\""},
      {"&up=0,0,0", 422, "/camera/up"},
      {"&fov=0", 422, "/camera/fov"},
      {"&fov=wide", 400, "\"fov\""},
      {"&fov=3.141592653589793", 422, "/camera/fov"},
      {"&look_at=0,0,0", 422, "/camera/look_at"},  // the camera's origin
  };
  for (const WrongQuery& row : table) {
    SCOPED_TRACE(row.query);
    expect_problem(get(std::string("/render?scene=first-sphere") + row.query), row.status,
                   row.says);
  }
}

TEST_F(Query, unknown_scene_is_404_with_the_nearest_name) {
  expect_problem(get("/render?scene=first-spere"), 404, "\"first-sphere\"");
}

TEST_F(Query, render_without_a_scene_says_how_to_name_one) {
  expect_problem(get("/render"), 400, "?scene=");
}

}  // namespace
}  // namespace raytracer::test
