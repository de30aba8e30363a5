// Which image format an answer has, and that all three are the same picture.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/golden/picture.h"
#include "tests/service/documents.h"
#include "tests/service/service.h"

namespace raytracer::test {
namespace {

class Format : public Service {
 protected:
  static std::string type_for(const std::string& accept) {
    const Answer answer = post("/render", small_scene, {{"Accept", accept}});
    EXPECT_EQ(answer.status, 200) << accept << ": " << answer.body;
    return answer.get_header_value("Content-Type");
  }
  static std::string bytes_as(std::string_view type, const std::string& query = "") {
    return post("/render" + query, small_scene, {{"Accept", std::string(type)}}).body;
  }
};

TEST_F(Format, all_three_have_the_same_pixels) {
  for (const char* const query : {"?samples=7", "?samples=7&transfer=srgb", "?width=1&height=1"}) {
    const Picture png = decode_png(bytes_as(png_type, query));
    EXPECT_EQ(decode_ppm(bytes_as(ppm_type, query)), png) << query;
    EXPECT_EQ(decode_pfm(bytes_as(pfm_type, query)), png) << query;
  }
}

TEST_F(Format, png_is_the_default) {
  EXPECT_EQ(post("/render", small_scene).get_header_value("Content-Type"), png_type);
  EXPECT_EQ(type_for(""), png_type);
}

TEST_F(Format, each_is_given_when_asked_for) {
  for (const std::string_view type : {png_type, ppm_type, pfm_type})
    EXPECT_EQ(type_for(std::string(type)), type);
  EXPECT_EQ(type_for("IMAGE/X-Portable-PixMap"), ppm_type);
}

TEST_F(Format, highest_weight_wins) {
  EXPECT_EQ(type_for("image/png;q=0.5, image/x-portable-pixmap"), ppm_type);
  EXPECT_EQ(type_for("image/png;q=0.5, image/x-portable-floatmap;q=0.501"), pfm_type);
  EXPECT_EQ(type_for("image/x-portable-pixmap ; Q=0.2 , image/png ; q=0.3"), png_type);
}

TEST_F(Format, weight_may_end_in_its_point) {
  EXPECT_EQ(type_for("image/png;q=1."), png_type);
  EXPECT_EQ(type_for("image/png;q=0.5, image/x-portable-pixmap;q=1."), ppm_type);
  EXPECT_EQ(type_for("image/png;q=0., image/x-portable-pixmap;q=0.1"), ppm_type);
  EXPECT_EQ(type_for("image/png;q=0., */*"), ppm_type);
  EXPECT_EQ(type_for("image/png;q=1.000"), png_type);
}

TEST_F(Format, wildcards_accept_png_first) {
  EXPECT_EQ(type_for("*/*"), png_type);
  EXPECT_EQ(type_for("image/*"), png_type);
  EXPECT_EQ(type_for("text/html, application/xhtml+xml, */*;q=0.8"), png_type);
  EXPECT_EQ(type_for("image/*;q=0.5, image/x-portable-pixmap"), ppm_type);
}

TEST_F(Format, specific_range_stands_over_a_wildcard) {
  EXPECT_EQ(type_for("image/png;q=0, */*"), ppm_type);
  EXPECT_EQ(type_for("image/png;q=0.1, image/x-portable-pixmap;q=0, image/*"), pfm_type);
}

TEST_F(Format, several_accept_fields_are_one_list) {
  const Answer answer = post("/render", small_scene,
                             {{"Accept", "text/html"}, {"Accept", "image/x-portable-floatmap"}});
  EXPECT_EQ(answer.get_header_value("Content-Type"), pfm_type);
}

TEST_F(Format, unacceptable_is_406_with_what_there_is) {
  for (const char* const accept :
       {"text/html", "image/webp, image/avif", "image/png;q=0", "*/*;q=0"}) {
    const Answer answer = post("/render", small_scene, {{"Accept", accept}});
    expect_problem(answer, 406, "image/x-portable-pixmap");
  }
}

TEST_F(Format, transparent_background_gives_a_png_of_four_channels) {
  for (const char* const query : {"", "?samples=16", "?transfer=srgb", "?target_rmse=0.01"})
    for (const char* const accept :
         {"*/*", "image/png", "image/x-portable-pixmap, image/png;q=0.1"}) {
      const Answer answer =
          post(std::string("/render") + query, transparent_scene, {{"Accept", accept}});
      ASSERT_EQ(answer.status, 200) << answer.body;
      EXPECT_EQ(answer.get_header_value("Content-Type"), png_type);
      const CoveredPicture picture = decode_covered_png(answer.body);
      ASSERT_EQ(picture.rgba.size(), 12U * 8 * 4);
      EXPECT_EQ(picture.rgba[3], 0) << "nothing is in the corner";
      const std::size_t middle = std::size_t{4} * (4 * 12 + 6);
      EXPECT_EQ(picture.rgba[middle + 3], 255);
      EXPECT_GT(picture.rgba[middle], picture.rgba[middle + 1]) << "the sphere is red";
    }
}

TEST_F(Format, transparent_background_in_three_channels_is_406_with_what_can_be_had) {
  const std::string job = post("/jobs", transparent_scene).get_header_value("Location") + "/image";
  for (const std::string_view type : {ppm_type, pfm_type}) {
    const Headers headers{{"Accept", std::string(type)}};
    for (const Answer& answer : {post("/render", transparent_scene, headers), get(job, headers)}) {
      expect_problem(answer, 406, "transparent background can be had as image/png:");
      EXPECT_EQ(answer.body.find("portable"), std::string::npos) << answer.body;
    }
  }
}

TEST_F(Format, transparent_job_has_the_picture_of_its_render) {
  const std::string path = post("/jobs?samples=16", transparent_scene).get_header_value("Location");
  const std::string expected = post("/render?samples=16", transparent_scene).body;
  for (;;) {  // until it is done
    const Answer answer = get(path + "/image");
    ASSERT_EQ(answer.status, 200) << answer.body;
    decode_covered_png(answer.body);  // what there is of it, too, has four channels
    if (!answer.has_header("ETag")) continue;
    EXPECT_TRUE(answer.body == expected);
    break;
  }
}

}  // namespace
}  // namespace raytracer::test
