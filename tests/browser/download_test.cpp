// The picture can be taken away as a file.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/browser/browser_page.h"
#include "tests/golden/picture.h"
#include "tests/process/patience.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

class Download : public BrowserPage {};

TEST_F(Download, is_a_png_named_after_its_scene) {
  open();
  EXPECT_EQ(value("document.getElementById('download').download"), "demo.png");
  browser().click("#download");
  const std::filesystem::path file = downloads() / "demo.png";
  ASSERT_TRUE(eventually([&] { return std::filesystem::exists(file); }, 10s));
  const Picture downloaded = decode_png(read_file(file));
  EXPECT_EQ(downloaded.width, 700);
  EXPECT_EQ(downloaded, decode_png(server().client().Get("/render?scene=demo")->body));
}

}  // namespace
}  // namespace raytracer::test
