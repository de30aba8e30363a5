// The picture can be taken away as a file.
#include <gtest/gtest.h>

#include "tests/browser/browser_page.h"
#include "tests/golden/picture.h"

namespace raytracer::test {
namespace {

class Download : public BrowserPage {};

TEST_F(Download, is_a_png_named_after_its_scene) {
  open();
  EXPECT_EQ(value("document.getElementById('download').download"), "demo.png");
  browser().click("#download");
  const Picture picture = decode_png(downloaded("demo.png"));
  EXPECT_EQ(picture.width, 700);
  EXPECT_EQ(picture, decode_png(server().client().Get("/render?scene=demo")->body));
}

}  // namespace
}  // namespace raytracer::test
