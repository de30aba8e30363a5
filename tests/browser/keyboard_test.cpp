// The page by keyboard alone: everything can be reached, nothing holds the focus, and what opens
// gives it back.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/browser/browser_page.h"

namespace raytracer::test {
namespace {

constexpr const char* key_tab = "\xee\x80\x84";
constexpr const char* key_escape = "\xee\x80\x8c";

class Keyboard : public BrowserPage {
 protected:
  void SetUp() override { open(); }

  static std::string focused() {
    return value("document.activeElement === document.body ? '' : document.activeElement.id");
  }

  /// Where the focus is, from the first control through each of `count` times Tab, until it comes
  /// round; controls without an id are "".
  static std::vector<std::string> tab_through(int count) {
    browser().run(
        "const first = document.getElementById('scene-select'); first.focus();"
        "window.places = [first.id];"
        "document.addEventListener('focusin', ({ target }) => window.places.push(target.id));");
    browser().press(key_tab, count);
    std::vector<std::string> places = value("window.places");
    const auto round = std::find(places.begin() + 1, places.end(), places.front());
    places.erase(round, places.end());
    return places;
  }

  static bool has(const std::vector<std::string>& places, const std::string& id) {
    return std::count(places.begin(), places.end(), id) > 0;
  }
};

TEST_F(Keyboard, tab_reaches_every_control_and_is_never_held) {
  show_panel("form");
  const int controls = value(
      "[...document.querySelectorAll('a[href], button, select, input, textarea, [tabindex=\"0\"]')]"
      ".filter((each) => each.checkVisibility({ visibilityProperty: true }) && !each.disabled &&"
      " each.tabIndex >= 0 && !(each.type === 'radio' && !each.checked)).length");
  const std::vector<std::string> places = tab_through(controls + 10);
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

TEST_F(Keyboard, focus_stays_where_the_form_adds_and_removes) {
  const auto press = [](const std::string& name, const std::string& then) {
    const std::string name_of_focused =
        "(document.activeElement.ariaLabel ?? document.activeElement.textContent)";
    browser().run(
        "[...document.querySelectorAll('#form button')].find((each) =>"
        " (each.ariaLabel ?? each.textContent) === '" +
        name + "').focus(); window.form = document.querySelector('#form fieldset');");
    browser().press(key_enter);
    ASSERT_TRUE(comes_true("window.form !== document.querySelector('#form fieldset')")) << name;
    EXPECT_EQ(value(name_of_focused), then);
  };
  show_panel("form");
  press("Add a cone", "Add a cone");
  press("Remove Cone 1", "Add a cone");
  press("Remove Sphere 1", "Remove Sphere 1");
  press("Add a sky", "Add a point light");
}

TEST_F(Keyboard, focus_goes_to_a_neighbour_where_a_button_goes) {
  const auto press = [](const std::string& button, const std::string& then) {
    browser().run("document.getElementById('" + button + "').focus()");
    browser().press(key_enter);
    EXPECT_TRUE(comes_true("document.activeElement.id === '" + then + "'"))
        << button << " leads to \"" << focused() << "\"";
  };
  for (const char* const button : {"reset-view", "keep-view"}) {
    const std::string former = picture();
    browser().type("#board", "\xee\x80\x92");  // arrow left
    await("done", former);
    press(button, "board");
  }
  press("undo", "redo");
  press("redo", "undo");
  const std::string former = picture();
  choose_accuracy(0);
  await("done", former);
  press("as-written", "accuracy");

  // A render that is never answered.
  browser().run(
      "const { fetch } = window; window.fetch = (address, request) =>"
      " /^render/.test(address) ? new Promise((resolve, reject) => {"
      "  request.signal.onabort = () => reject(request.signal.reason); }) : fetch(address, "
      "request);");
  choose_accuracy(3);
  ASSERT_TRUE(comes_true("!document.getElementById('cancel').hidden"));
  press("cancel", "board");
}

TEST_F(Keyboard, gallery_is_left_with_escape_and_gives_the_focus_back) {
  browser().type("#open-gallery", key_enter);
  EXPECT_EQ(value("document.getElementById('gallery').open"), true);
  EXPECT_EQ(value("document.getElementById('gallery').contains(document.activeElement)"), true);
  EXPECT_TRUE(comes_true(gallery_has_pictures));
  keep_screenshot("gallery");
  browser().press(key_escape);
  EXPECT_EQ(value("document.getElementById('gallery').open"), false);
  EXPECT_EQ(focused(), "open-gallery");
}

}  // namespace
}  // namespace raytracer::test
