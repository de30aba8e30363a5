// A document that is edited is rendered anew.
#include <gtest/gtest.h>

#include <string>

#include "tests/browser/browser_page.h"
#include "tests/process/endless_scene.h"
#include "tests/process/patience.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

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

TEST_F(Editing, long_render_can_be_cancelled) {
  const std::string former = picture();
  edit(endless_scene());
  press_ctrl_enter();
  // Beyond the previews, into the render itself.
  ASSERT_TRUE(eventually([] {
    return value("parseFloat(document.getElementById('elapsed').textContent) > 3") == true;
  }));
  browser().click("#cancel");
  await("done");
  EXPECT_EQ(picture(), former);
  // The server has noticed too.
  EXPECT_TRUE(
      eventually([] { return server().log().find(" status=499 ") != std::string::npos; }, 5s))
      << server().log();
}

}  // namespace
}  // namespace raytracer::test
