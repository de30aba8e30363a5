// The page fits its window, wide and narrow, light and dark.
#include <gtest/gtest.h>

#include <string>

#include "tests/browser/browser_page.h"

namespace raytracer::test {
namespace {

class Layout : public BrowserPage {
 protected:
  void TearDown() override { browser().restore_size(); }
};

TEST_F(Layout, no_window_has_to_be_scrolled_sideways) {
  open();
  for (const int width : {1600, 1024, 768, 360}) {
    browser().resize(width, 800);
    EXPECT_LE(value("document.documentElement.scrollWidth"), width) << width;
    const double picture_width =
        value("document.getElementById('picture').getBoundingClientRect().width");
    EXPECT_GT(picture_width, 200) << width;
    EXPECT_LE(picture_width, width);
    keep_screenshot("page_" + std::to_string(width));
    browser().prefer_dark(true);
    keep_screenshot("page_" + std::to_string(width) + "_dark");
    browser().prefer_dark(false);
  }
}

TEST_F(Layout, tabs_and_the_way_to_render_do_not_overlap) {
  open();
  for (const int width : {1600, 1024, 768, 480, 360, 320}) {
    browser().resize(width, 800);
    EXPECT_EQ(
        value("(() => { const box = (id) => document.getElementById(id).getBoundingClientRect();"
              " const [tab, render] = [box('tab-curve'), box('render')];"
              " return tab.right <= render.left || tab.bottom <= render.top; })()"),
        true)
        << width;
    EXPECT_LE(value("document.getElementById('tab-curve').getBoundingClientRect().right"), width);
  }
}

TEST_F(Layout, picture_keeps_its_proportions) {
  open();
  for (const int width : {1280, 360}) {
    browser().resize(width, 800);
    const double ratio = value(
        "(() => { const box = document.getElementById('picture').getBoundingClientRect();"
        " return box.width / box.height; })()");
    EXPECT_NEAR(ratio, 700.0 / 500.0, 0.02) << width;
  }
}

}  // namespace
}  // namespace raytracer::test
