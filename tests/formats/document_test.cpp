// A scene's document: long lists, which several threads write.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "client/formats/scene_model.h"

namespace raytracer::test {
namespace {

using nlohmann::json;

TEST(Document, long_lists_have_all_items_in_order) {
  // One piece, one and a bit, as many as a round has or a bit more, and several rounds.
  for (const std::size_t count : {1U, 2U, 32'768U, 32'769U, 65'536U, 65'537U, 300'001U}) {
    SCOPED_TRACE(count);
    client::model::Spheres spheres;
    for (std::size_t i = 0; i < count; ++i) {
      const auto number = static_cast<double>(i);
      spheres.centers.push_back({-number, 2 * number, 0.5});
      spheres.radii.push_back(1 + number);
    }
    client::model::Scene scene;
    scene.objects.push_back({spheres, std::nullopt});
    const json object = json::parse(client::model::to_document(scene)).at("objects").at(0);
    if (count == 1) {
      EXPECT_EQ(object.at("center"), json({0, 0, 0.5}));
      continue;
    }
    ASSERT_EQ(object.at("centers").size(), count);
    ASSERT_EQ(object.at("radius").size(), count);
    for (std::size_t i = 0; i < count; ++i) {
      ASSERT_EQ(object.at("centers")[i], json({i, 2 * i, 0.5})) << i;
      ASSERT_EQ(object.at("radius")[i], i + 1) << i;
    }
  }
}

}  // namespace
}  // namespace raytracer::test
