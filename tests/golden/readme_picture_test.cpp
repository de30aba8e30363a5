// The pictures that README.md shows are what its scenes and commands render: NAME.png is the scene
// NAME, whole, or what the command with `-o NAME.png` makes.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>

#include "engine/engine.h"
#include "tests/golden/picture.h"
#include "tests/process/program.h"
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

TEST(ReadmePicture, is_what_its_command_renders) {
  const fs::path source_dir = RAYTRACER_SOURCE_DIR;
  const std::string readme = read_file(source_dir / "README.md");
  static const std::regex command(R"(build/raytracer render (\S+) --color (\w+) -o (\w+\.png))");
  std::smatch part;
  ASSERT_TRUE(std::regex_search(readme, part, command));
  const TemporaryFolder folder;
  const std::string picture = folder / part.str(3);
  const Outcome outcome =
      run({RAYTRACER_CLIENT_PATH,
           {"render", source_dir / part.str(1), "--color", part.str(2), "-o", picture}});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Picture rendered = decode_png(read_file(picture));
  const Picture shown = decode_png(read_file(source_dir / "client" / part.str(3)));
  // In single precision edges differ a little from one set of instructions to the next.
  EXPECT_LE(compare(rendered, shown).different_count, rendered.width * rendered.height / 100);
}

}  // namespace
}  // namespace raytracer::test
