// A picture has the same bytes wherever it is rendered, and says the same about itself.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/cluster/cluster_test.h"
#include "tests/service/documents.h"

namespace raytracer::test {
namespace {

struct Picture {
  std::string query;
  std::string_view type = png_type;
  std::string document{};  ///< empty: a shipped scene
};

/// Sizes that come to several tasks: by time, or because a task's values have to fit into a
/// message.
const std::vector<Picture>& pictures() {
  static const std::vector<Picture> all{
      {"?scene=first-sphere&samples=1&width=1000&height=700", pfm_type},
      {"?scene=demo&samples=1&width=1203&height=801"},
      {"?scene=mirrors&samples=4&width=333&height=217&transfer=srgb"},
      {"?scene=earth-and-pebble&samples=4&width=701&height=503", pfm_type},
      {"?scene=glints&samples=16&width=150&height=101", pfm_type},
      {"?scene=square-500&samples=16&width=160&height=90"},
      {"?scene=evening&samples=4&width=240&height=170"},
      {"?scene=spheres&samples=4&width=200&height=150&origin=1,2,-9&look_at=0,0,0&fov=0.7"},
      {"?scene=first-sphere&target_rmse=0.004&width=120&height=90"},
      {"?samples=3&width=900&height=600", ppm_type, small_scene},
      {"?samples=4&width=600&height=450", png_type, transparent_scene},
      {"?target_rmse=0.004&width=60&height=45&transfer=srgb", png_type, transparent_scene},
      {"?precision=double&transfer=srgb", png_type, square_scene(250, 16)}};
  return all;
}

Answer render(const ServerProcess& server, const Picture& picture) {
  const Headers headers{{"Accept", std::string(picture.type)}, {"Cache-Control", "no-cache"}};
  const std::string target = "/render" + picture.query;
  return picture.document.empty() ? get(server, target, headers)
                                  : post(server, target, picture.document, headers);
}

/// The headers that speak of the picture.
std::string said(const Answer& answer) {
  std::string text;
  for (const char* const name : {"Render-Samples", "Render-Light-Samples", "Render-Error",
                                 "Render-Precision", "Render-Stop", "ETag"})
    text += std::string(name) + ": " + answer.get_header_value(name) + "\n";
  return text;
}

class SameBytes : public ClusterTest {};

TEST_F(SameBytes, one_two_and_three_workers_render_what_one_server_renders) {
  const ServerProcess lone;
  std::vector<Answer> expected;
  for (const Picture& picture : pictures()) {
    expected.push_back(render(lone, picture));
    ASSERT_EQ(expected.back().status, 200) << picture.query << expected.back().body;
  }
  const ServerProcess& front = start_front();
  const Picture large{"", png_type, long_scene(40)};
  const std::string expected_large = render(lone, large).body;
  for (std::size_t count = 1; count <= 3; ++count) {
    start_worker();
    ASSERT_TRUE(has_workers(front, count));
    int cut = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const Picture& picture = pictures()[i];
      const Answer answer = render(front, picture);
      ASSERT_EQ(answer.status, 200) << picture.query << answer.body;
      EXPECT_TRUE(answer.body == expected[i].body) << picture.query << " with " << count;
      EXPECT_EQ(said(answer), said(expected[i])) << picture.query << " with " << count;
      const int tasks = std::stoi(answer.get_header_value("Render-Tasks"));
      EXPECT_GE(tasks, 1) << picture.query;
      if (tasks > 1) ++cut;
    }
    EXPECT_GE(cut, 3) << "too few pictures of several tasks";
    // Who takes a task is chance: until each had a part in it.
    EXPECT_TRUE(eventually([&] {
      const Answer answer = render(front, large);
      EXPECT_TRUE(answer.body == expected_large) << count;
      return answer.get_header_value("Render-Workers") == std::to_string(count);
    })) << "no picture was made by "
        << count;
  }
}

TEST_F(SameBytes, job_is_the_picture_of_one_server) {
  const ServerProcess lone;
  const ServerProcess& front = start({});  // one that works
  start_worker();
  ASSERT_TRUE(has_workers(front, 2));
  for (const Picture& picture : pictures()) {
    const std::string job = post_job(front, picture.query, picture.document);
    ASSERT_TRUE(ends_done(front, job)) << picture.query;
    const Headers headers{{"Accept", std::string(picture.type)}};
    const Answer image = get(front, job + "/image", headers);
    const std::string alone = post_job(lone, picture.query, picture.document);
    ASSERT_TRUE(ends_done(lone, alone));
    const Answer expected = get(lone, alone + "/image", headers);
    ASSERT_EQ(image.status, 200) << image.body;
    EXPECT_TRUE(image.body == expected.body) << picture.query;
    EXPECT_EQ(said(image), said(expected)) << picture.query;
  }
}

TEST_F(SameBytes, short_render_stays_where_it_arrived) {
  const ServerProcess& front = start_front({"--share-from", "200"});
  const Answer answer = get(front, "/render?scene=first-sphere&samples=1&width=96&height=72");
  EXPECT_EQ(answer.status, 200) << answer.body;
  EXPECT_FALSE(answer.has_header("Render-Tasks"));
  ASSERT_TRUE(eventually([&] { return cluster_of(front).is_object(); }));
  EXPECT_EQ(task_count(front), 0U);
}

}  // namespace
}  // namespace raytracer::test
