// The pictures that README.md shows are what its scenes render: NAME.png is the scene NAME, whole.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>

#include "engine/engine.h"
#include "tests/golden/picture.h"
#include "tests/process/temporary_folder.h"
#include "tests/support/scene_plan.h"

namespace raytracer::test {
namespace {

namespace fs = std::filesystem;

TEST(ReadmePicture, is_what_its_scene_renders) {
  const fs::path source_dir = RAYTRACER_SOURCE_DIR;
  const std::string readme = read_file(source_dir / "README.md");
  static const std::regex shown(R"re((?:!\[[^\]]*\]\(|<img[^>]*src=")([^)"\s]+\.png))re");
  WorkerPool pool(2);
  int count = 0;
  for (std::sregex_iterator match(readme.begin(), readme.end(), shown), end; match != end;
       ++match) {
    const fs::path picture = source_dir / match->str(1);
    const fs::path scene_file =
        source_dir / "server/scenes" / picture.stem().replace_extension(".json");
    ASSERT_TRUE(fs::exists(picture)) << "README.md shows " << picture;
    if (!fs::exists(scene_file)) continue;  // a screenshot, say
    const Result<Scene> scene = read_scene(read_file(scene_file), Limits{});
    RenderProgress progress;
    const std::string png =
        encode(render(without_mixing(scene.value()), Limits{}, pool, progress).image,
               ImageFormat::png, pool);
    const Picture rendered = decode_png(png);
    const Difference difference = compare(rendered, decode_png(read_file(picture)));
    EXPECT_LE(difference.most_levels, 1) << picture;
    EXPECT_LE(difference.different_count, rendered.width * rendered.height / 1000) << picture;
    ++count;
  }
  EXPECT_GE(count, 1) << "README.md shows no scene's picture";
}

}  // namespace
}  // namespace raytracer::test
