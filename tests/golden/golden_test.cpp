// Every shipped scene, small, against the committed picture of it: NAME.png in this folder.
//
// A change that is meant is taken over with
//   RAYTRACER_UPDATE_GOLDEN=1 ctest --test-dir build -R golden
// and the new pictures are looked at before they are committed.
//
// The bytes are the same on every run and for every number of threads; on another machine the C
// library's tan() and pow() may differ in their last bit, which moves a channel across a rounding
// border here and there, and the estimates of 1 / x of other instructions in all of theirs. So one
// level in one pixel of a thousand is let pass; where lights are soft, what one of their places
// more or less comes to; and no more.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/engine.h"
#include "tests/golden/picture.h"
#include "tests/process/temporary_folder.h"
#include "tests/support/scene_plan.h"

namespace raytracer::test {
namespace {

namespace fs = std::filesystem;

const fs::path source_dir = RAYTRACER_SOURCE_DIR;
constexpr int golden_width_px = 96;

std::vector<std::string> shipped_scenes() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(source_dir / "server/scenes"))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// By how many levels a pixel may differ.
int allowed_levels(const std::string& document) {
  const Scene scene = read_scene(document, Limits{}).value();
  const bool is_soft = find_features(scene).soft_lights > 0;
  constexpr int places = 64;  // of each light, at least
  return is_soft ? (255 + places - 1) / places : 1;
}

std::string render_small(const std::string& document) {
  const auto camera = nlohmann::json::parse(document).at("camera");
  const double ratio = camera.at("height").get<double>() / camera.at("width").get<double>();
  Overrides overrides;
  overrides.width = golden_width_px;
  overrides.height = static_cast<int>(std::lround(golden_width_px * ratio));
  overrides.samples = 1;
  const Result<Scene> scene = read_scene(document, Limits{}, overrides);
  WorkerPool pool(2);
  RenderProgress progress;
  return encode(render(without_mixing(scene.value()), Limits{}, pool, progress).image,
                ImageFormat::png, pool);
}

class Golden : public testing::TestWithParam<std::string> {};

TEST_P(Golden, scene_looks_as_committed) {
  const fs::path golden = source_dir / "tests/golden" / (GetParam() + ".png");
  const std::string document = read_file(source_dir / "server/scenes" / (GetParam() + ".json"));
  const std::string png = render_small(document);
  if (std::getenv("RAYTRACER_UPDATE_GOLDEN") != nullptr)
    std::ofstream(golden, std::ios::binary) << png;
  ASSERT_TRUE(fs::exists(golden)) << golden << " is missing; RAYTRACER_UPDATE_GOLDEN=1 makes it";
  const Picture rendered = decode_png(png);
  const Difference difference = compare(rendered, decode_png(read_file(golden)));
  EXPECT_LE(difference.most_levels, allowed_levels(document));
  EXPECT_LE(difference.different_count, rendered.width * rendered.height / 1000);
}

INSTANTIATE_TEST_SUITE_P(Shipped, Golden, testing::ValuesIn(shipped_scenes()),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(GoldenFolder, has_no_picture_without_its_scene) {
  const std::vector<std::string> scenes = shipped_scenes();
  for (const auto& entry : fs::directory_iterator(source_dir / "tests/golden")) {
    if (entry.path().extension() != ".png") continue;
    EXPECT_EQ(std::count(scenes.begin(), scenes.end(), entry.path().stem().string()), 1)
        << entry.path() << " belongs to no scene in server/scenes";
  }
}

TEST(GoldenFolder, has_the_scenes_of_the_specification) {
  const std::vector<std::string> scenes = shipped_scenes();
  EXPECT_GE(scenes.size(), 10U);
  for (const char* const name : {"demo", "first-sphere", "square-500"})
    EXPECT_EQ(std::count(scenes.begin(), scenes.end(), name), 1) << name;
}

}  // namespace
}  // namespace raytracer::test
