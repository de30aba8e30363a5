// The page by keyboard alone: everything can be reached, nothing holds the focus, and what opens
// gives it back.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/browser/browser_page.h"
#include "tests/process/patience.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

constexpr const char* key_tab = "\xee\x80\x84";
constexpr const char* key_escape = "\xee\x80\x8c";

class Keyboard : public BrowserPage {
 protected:
  void SetUp() override { open(); }

  static std::string focused() {
    return value("document.activeElement === document.body ? '' : document.activeElement.id");
  }

  /// Where the focus is after each Tab, from the first control until it leaves the page or comes
  /// round; controls without an id are "". At most `most` steps.
  static std::vector<std::string> tab_through(int most) {
    browser().run("document.getElementById('scene-select').focus()");
    std::vector<std::string> places{focused()};
    for (int step = 0; step < most; ++step) {
      browser().press(key_tab);
      if (value("document.activeElement === document.body") == true) break;
      if (focused() == places.front()) break;
      places.push_back(focused());
    }
    return places;
  }

  static bool has(const std::vector<std::string>& places, const std::string& id) {
    return std::count(places.begin(), places.end(), id) > 0;
  }
};

TEST_F(Keyboard, tab_reaches_every_control_and_is_never_held) {
  constexpr int most = 120;
  show_panel("form");
  const int controls = value(
      "[...document.querySelectorAll('a[href], button, select, input, textarea, [tabindex=\"0\"]')]"
      ".filter((each) => each.checkVisibility({ visibilityProperty: true }) && !each.disabled &&"
      " each.tabIndex >= 0 && !(each.type === 'radio' && !each.checked)).length");
  const std::vector<std::string> places = tab_through(most);
  EXPECT_EQ(static_cast<int>(places.size()), controls) << testing::PrintToString(places);
  for (const char* const id :
       {"open-gallery", "board", "share", "curl", "download", "accuracy", "render", "tab-form"})
    EXPECT_TRUE(has(places, id)) << id;
}

TEST_F(Keyboard, editor_keeps_tab_until_escape) {
  show_panel("json");
  browser().run("document.getElementById('editor').focus()");
  browser().press(key_tab);
  EXPECT_EQ(focused(), "editor");
  browser().press(key_escape);
  browser().press(key_tab);
  EXPECT_NE(focused(), "editor");
}

TEST_F(Keyboard, gallery_is_left_with_escape_and_gives_the_focus_back) {
  browser().type("#open-gallery", key_enter);
  EXPECT_EQ(value("document.getElementById('gallery').open"), true);
  EXPECT_EQ(value("document.getElementById('gallery').contains(document.activeElement)"), true);
  EXPECT_TRUE(eventually(
      [] {
        return value(
            "[...document.querySelectorAll('#gallery img')].every((each) => each.naturalWidth)");
      },
      10s));
  keep_screenshot("gallery");
  browser().press(key_escape);
  EXPECT_EQ(value("document.getElementById('gallery').open"), false);
  EXPECT_EQ(focused(), "open-gallery");
}

}  // namespace
}  // namespace raytracer::test
