// A document that is edited is rendered anew.
#include <gtest/gtest.h>

#include <string>

#include "tests/browser/browser_page.h"

namespace raytracer::test {
namespace {

class Editing : public BrowserPage {
 protected:
  void SetUp() override {
    open("/#scene=first-sphere");
    show_panel("json");
  }
};

TEST_F(Editing, ctrl_enter_renders_the_edited_text) {
  const std::string former = picture();
  edit(page_scene);
  press_ctrl_enter();
  await("done", former);
  EXPECT_EQ(value("document.getElementById('picture').naturalWidth"), 60);
  EXPECT_EQ(value("document.getElementById('picture').naturalHeight"), 40);
}

TEST_F(Editing, button_renders_the_edited_text) {
  const std::string former = picture();
  edit(page_scene);
  browser().click("#render");
  await("done", former);
  EXPECT_EQ(value("document.getElementById('picture').naturalWidth"), 60);
}

TEST_F(Editing, edit_is_said_to_be_newer_than_the_picture) {
  const std::string before = value("document.getElementById('status').textContent");
  browser().type("#editor", " ");
  EXPECT_NE(value("document.getElementById('status').textContent"), before);
}

}  // namespace
}  // namespace raytracer::test
