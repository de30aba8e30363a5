// Edits survive a reload of the page; where the browser cannot keep them, it warns.
#include <gtest/gtest.h>

#include <string>

#include "tests/browser/browser_page.h"

namespace raytracer::test {
namespace {

class Unsaved : public BrowserPage {
 protected:
  void SetUp() override {
    open("/#scene=first-sphere");
    show_panel("json");
    edit_and_render(page_scene);
  }

  static void edit_and_render(const std::string& text) {
    const std::string former = picture();
    edit(text);
    press_ctrl_enter();
    await("done", former);
  }

  static void reload() {
    browser().run("window.isOld = true; location.reload()");
    EXPECT_TRUE(comes_true("!window.isOld"));
    await("done");
  }
};

TEST_F(Unsaved, edits_are_there_after_a_reload) {
  edit(page_scene + "\n\n");  // also what was not rendered yet
  reload();
  EXPECT_EQ(text(), page_scene + "\n\n");
  EXPECT_EQ(value("document.getElementById('picture').naturalWidth"), 60);
  EXPECT_TRUE(comes_true("/Edits are back/.test(document.getElementById('status').textContent)"));
  keep_screenshot("edits_back");
  const std::string former = picture();
  browser().click("#undo");
  await("done", former);
  EXPECT_NE(text().find("\"First sphere\""), std::string::npos);
  reload();
  EXPECT_NE(text().find("\"First sphere\""), std::string::npos);
}

TEST_F(Unsaved, view_is_there_after_a_reload) {
  const std::string former = picture();
  browser().type("#board", "\xee\x80\x92");  // arrow left
  await("done", former);
  reload();
  EXPECT_EQ(value("document.getElementById('view-tools').hidden"), false);
}

TEST_F(Unsaved, accuracy_is_there_after_a_reload) {
  const std::string says = "document.getElementById('accuracy-says').textContent";
  for (const char* const address : {"/#scene=first-sphere", "/#scene=first-sphere&accuracy=5"}) {
    open(address);
    std::string former = picture();
    browser().type("#accuracy", "\xee\x80\x94");  // arrow right
    await("done", former);
    const std::string chosen = value(says);
    EXPECT_NE(chosen, "As the scene says") << address;
    reload();
    EXPECT_EQ(value(says), chosen) << address;
    former = picture();
    browser().click("#as-written");
    await("done", former);
    reload();
    EXPECT_EQ(value(says), "As the scene says") << address;
  }
}

TEST_F(Unsaved, edits_of_another_address_can_be_brought_back) {
  browser().open("about:blank");
  browser().open(server().url() + "/#scene=mesh");
  await("done");
  EXPECT_NE(text().find("\"Mesh\""), std::string::npos);
  reload();
  const std::string former = picture();
  browser().click("#restore");
  await("done", former);
  EXPECT_EQ(text(), page_scene);
  EXPECT_EQ(value("location.hash"), "#scene=first-sphere");
}

TEST_F(Unsaved, edits_do_not_become_those_of_a_scene_that_was_still_to_come) {
  browser().run(
      "window.fetch = () => new Promise(() => { window.isAsked = true; });"
      "location.hash = 'scene=mesh';");
  ASSERT_TRUE(comes_true("window.isAsked"));
  reload();
  EXPECT_NE(text().find("\"Mesh\""), std::string::npos);
  const std::string former = picture();
  browser().click("#restore");
  await("done", former);
  EXPECT_EQ(text(), page_scene);
  EXPECT_EQ(value("location.hash"), "#scene=first-sphere");
}

TEST_F(Unsaved, edits_of_several_scenes_wait_until_they_are_brought_back) {
  const auto load = [](const std::string& name) {
    const std::string former = picture();
    browser().run("location.hash = 'scene=" + name + "'");
    await("done", former);
  };
  const auto bring_back = [] {
    const std::string former = picture();
    browser().click("#restore");
    await("done", former);
    return text();
  };
  const std::string other = page_scene + "\n";
  load("mesh");  // where nothing is edited
  load("demo");
  edit_and_render(other);
  EXPECT_EQ(bring_back(), page_scene);
  EXPECT_EQ(value("location.hash"), "#scene=first-sphere");
  EXPECT_EQ(bring_back(), other);
  EXPECT_EQ(value("location.hash"), "#scene=demo");
  reload();
  EXPECT_EQ(text(), other);
  EXPECT_EQ(bring_back(), page_scene);
}

TEST_F(Unsaved, link_to_them_has_them_without_a_word) {
  browser().run("navigator.clipboard.writeText = async () => {};");
  browser().click("#share");
  ASSERT_TRUE(comes_true("location.hash.startsWith('#document=')"));
  reload();
  EXPECT_EQ(text(), page_scene);
  EXPECT_EQ(value("document.getElementById('undo').disabled"), true);
}

TEST_F(Unsaved, browser_warns_only_of_edits_that_it_cannot_keep) {
  const std::string warns =
      "(() => { const leaving = new Event('beforeunload', { cancelable: true });"
      " dispatchEvent(leaving); return leaving.defaultPrevented; })()";
  EXPECT_EQ(value(warns), false);
  browser().run("sessionStorage.setItem('full', 'x'.repeat(5e6));");
  EXPECT_EQ(value(warns), false) << "a short text still fits";
  edit(page_scene + std::string(400'000, ' '));
  EXPECT_EQ(value(warns), true);
  edit(page_scene);
  EXPECT_EQ(value(warns), false);

  // Where it keeps nothing at all, there has to be something to lose.
  browser().run(
      "Storage.prototype.setItem = Storage.prototype.removeItem = () => { throw 'forbidden'; };");
  EXPECT_EQ(value(warns), true);
  browser().run(
      "const undo = document.getElementById('undo'); while (!undo.disabled) undo.click();");
  EXPECT_EQ(value(warns), false);
}

}  // namespace
}  // namespace raytracer::test
