// The page fits its window, wide and narrow, light and dark.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "tests/browser/browser_page.h"

namespace raytracer::test {
namespace {

class Layout : public BrowserPage {
 protected:
  /// Controls of the form that lie over another of their row, or reach out of it.
  inline static const std::string overlaps = R"((() => {
    const found = [];
    for (const row of document.querySelectorAll('#form .form-row > div')) {
      const outer = row.getBoundingClientRect();
      const controls = [...row.querySelectorAll('input, button, select')];
      const boxes = controls.map((each) => each.getBoundingClientRect());
      boxes.forEach((a, i) => {
        const isOver = boxes.slice(i + 1).some((b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom);
        if (isOver || a.right > outer.right + 1) found.push(controls[i].ariaLabel);
      });
    }
    return found;
  })())";
};

TEST_F(Layout, no_window_has_to_be_scrolled_sideways) {
  open();
  for (const int width : {1600, 1024, 768, 360}) {
    browser().resize(width, 800);
    EXPECT_LE(value("document.documentElement.scrollWidth"), width) << width;
    EXPECT_EQ(value(overlaps), std::vector<std::string>{}) << width;
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

TEST_F(Layout, picture_of_a_single_row_or_column_is_seen) {
  open();
  show_panel("json");
  for (const auto [width, height] : {std::array{1, 2000}, std::array{2000, 1}, std::array{3, 3}}) {
    std::string scene = page_scene;
    const std::string size = "\"width\": 60, \"height\": 40";
    scene.replace(scene.find(size), size.size(),
                  fmt::format("\"width\": {}, \"height\": {}", width, height));
    const std::string former = picture();
    edit(scene);
    press_ctrl_enter();
    await("done", former);
    for (const int window : {1280, 360}) {
      browser().resize(window, 800);
      const nlohmann::json box = value(
          "(() => { const box = document.getElementById('picture').getBoundingClientRect();"
          " return [box.width, box.height]; })()");
      EXPECT_GE(box[0], 4) << width << " x " << height;
      EXPECT_GE(box[1], 4) << width << " x " << height;
      EXPECT_LE(box[0], window);
      EXPECT_LE(box[1], 800);
      EXPECT_LE(value("document.documentElement.scrollWidth"), window);
      keep_screenshot(fmt::format("thin_{}_{}", width, window));
    }
  }
}

}  // namespace
}  // namespace raytracer::test
