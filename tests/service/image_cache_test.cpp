// Finished images are remembered: the same request is not rendered twice.
#include <gtest/gtest.h>

#include <string>

#include "tests/process/patience.h"
#include "tests/service/documents.h"
#include "tests/service/server_timing.h"
#include "tests/service/service.h"

namespace raytracer::test {
namespace {

const Headers as_floats{{"Accept", std::string(pfm_type)}};

class ImageMemory : public testing::Test {
 protected:
  Answer render(const std::string& document, const std::string& query = "",
                const Headers& headers = {}) const {
    Answer answer = post(server_, "/render" + query, document, headers);
    EXPECT_EQ(answer.status, 200) << answer.body;
    return answer;
  }

  const ServerProcess server_;
};

TEST_F(ImageMemory, repeated_request_is_answered_without_rendering) {
  const Answer first = render(square_scene(100, 4));
  EXPECT_EQ(cache_entry(first), "");
  EXPECT_GT(stage_ms(first, "trace"), 0);
  const Answer second = render(square_scene(100, 4));
  EXPECT_EQ(cache_entry(second), "hit");
  for (const char* const stage : {"queue", "plan", "build", "trace", "encode"})
    EXPECT_EQ(stage_ms(second, stage), 0) << stage << " took nothing of this request's time";
  EXPECT_EQ(second.body, first.body);
  for (const char* const field : {"ETag", "Vary", "Cache-Control", "Content-Type", "Render-Samples",
                                  "Render-Precision", "Render-Stop"})
    EXPECT_EQ(second.get_header_value(field), first.get_header_value(field)) << field;
}

TEST_F(ImageMemory, it_counts_what_the_picture_is_not_how_it_was_asked_for) {
  const Answer first = render(small_scene);
  EXPECT_EQ(cache_entry(render(small_scene + "\n")), "hit");
  EXPECT_EQ(cache_entry(render(small_scene, "?samples=1&width=12")), "hit");
  EXPECT_EQ(cache_entry(render(small_scene, "?samples=2")), "");
  EXPECT_EQ(cache_entry(render(small_scene, "", as_floats)), "") << "another format";
  EXPECT_EQ(render(small_scene).body, first.body);
}

TEST_F(ImageMemory, insisting_client_gets_it_rendered) {
  const Answer first = render(small_scene);
  const Answer anew = render(small_scene, "", without_cache);
  EXPECT_EQ(cache_entry(anew), "");
  EXPECT_GT(stage_ms(anew, "trace"), 0);
  EXPECT_EQ(anew.body, first.body);
}

TEST_F(ImageMemory, image_under_a_time_budget_is_made_each_time) {
  for (int i = 0; i < 2; ++i)
    EXPECT_EQ(cache_entry(render(small_scene, "?budget_ms=5")), "") << "request " << i;
}

TEST_F(ImageMemory, head_and_jobs_say_the_same_tag) {
  const std::string tag = render(small_scene).get_header_value("ETag");
  const std::string id = json_of(post(server_, "/scenes", small_scene)).at("id");
  EXPECT_EQ(request(server_, "HEAD", "/render?scene=" + id).get_header_value("ETag"), tag);
  const std::string job = post(server_, "/jobs", small_scene).get_header_value("Location");
  const std::string image = job + "/image";
  EXPECT_TRUE(eventually([&] { return get(server_, image).has_header("ETag"); }));
  for (const char* const method : {"HEAD", "GET"})
    EXPECT_EQ(request(server_, method, image).get_header_value("ETag"), tag) << method;
}

TEST(ImageMemoryBound, least_recently_used_image_goes) {
  // A picture of 64 x 64 floats takes 49,152 bytes: two of them fit, three do not.
  const ServerProcess server({"--max-cache", "120000"});
  const auto entry = [&](int number) {
    return cache_entry(
        post(server, "/render", as_another_picture(square_scene(64, 1), number), as_floats));
  };
  EXPECT_EQ(entry(1), "");
  EXPECT_EQ(entry(2), "");
  EXPECT_EQ(entry(1), "hit");
  EXPECT_EQ(entry(3), "");
  EXPECT_EQ(entry(1), "hit") << "it was used";
  EXPECT_EQ(entry(2), "") << "it was used less recently";
}

TEST(ImageMemoryBound, nothing_is_remembered_without_memory) {
  const ServerProcess server({"--max-cache", "0"});
  for (int i = 0; i < 2; ++i) {
    const Answer answer = post(server, "/render", small_scene);
    EXPECT_EQ(answer.status, 200);
    EXPECT_EQ(cache_entry(answer), "");
  }
}

}  // namespace
}  // namespace raytracer::test
