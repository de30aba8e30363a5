// What the client makes of files, in the browser: `open` shows one on the page, and an animated PNG
// plays.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <csignal>
#include <string>

#include "tests/browser/browser_page.h"
#include "tests/process/patience.h"
#include "tests/process/program.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

class FromFiles : public BrowserPage {
 protected:
  static std::filesystem::path sample(const std::string& name) {
    return std::filesystem::path(RAYTRACER_SOURCE_DIR) / "tests/formats/files" / name;
  }
};

TEST_F(FromFiles, open_command_shows_a_file_on_the_page_of_its_own_server) {
  Process open({RAYTRACER_CLIENT_PATH, {"open", sample("c60.pdb")}, "", {{"DISPLAY", ""}}});
  ASSERT_TRUE(eventually([&] { return open.out().ends_with("\n"); })) << open.err();
  const std::string said = open.out();
  open_in_new_tab(said.substr(0, said.find('\n')));
  await("done");
  EXPECT_EQ(value("document.getElementById('picture').naturalWidth"), 700);
  const auto scene = nlohmann::json::parse(text());
  EXPECT_EQ(scene.at("objects").at(0).at("centers").size(), 60U);
  EXPECT_EQ(value("document.getElementById('scene-select').selectedOptions[0].text"),
            "A scene of your own");
  keep_screenshot("opened_file");
  browser().open("about:blank");  // nothing asks a server that is gone
  open.signal(SIGINT);
  EXPECT_EQ(open.wait(10s), 130);
}

TEST_F(FromFiles, animated_png_plays) {
  const TemporaryFolder folder;
  const std::string file = folder / "turn.apng";
  const Outcome outcome = run({RAYTRACER_CLIENT_PATH,
                               {"animate", sample("c60.pdb"), "--turntable", "6", "--fps", "4",
                                "--samples", "1", "--width", "90", "--height", "60", "-o", file},
                               "",
                               {{"RAYTRACER_SERVER", server().url()}}});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  open_in_new_tab("file://" + file);
  EXPECT_EQ(value("document.images[0].naturalWidth"), 90);
  EXPECT_EQ(value("document.images[0].naturalHeight"), 60);
  const std::string first = browser().screenshot();
  EXPECT_TRUE(eventually([&] { return browser().screenshot() != first; }, 5s)) << "it stands still";
  EXPECT_TRUE(eventually([&] { return browser().screenshot() == first; }, 10s))
      << "it does not begin anew";
}

}  // namespace
}  // namespace raytracer::test
