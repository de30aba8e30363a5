// A link holds the scene and the view; a command renders the same picture without the page.
#include <gtest/gtest.h>

#include <string>

#include "tests/browser/browser_page.h"
#include "tests/golden/picture.h"

namespace raytracer::test {
namespace {

class Share : public BrowserPage {
 protected:
  /// What `button` puts into the clipboard.
  static std::string copied_by(const std::string& button) {
    browser().run(
        "navigator.clipboard.writeText = async (text) => { window.copied = text; };"
        "window.copied = null;");
    browser().click(button);
    EXPECT_TRUE(comes_true("window.copied !== null"));
    return value("window.copied");
  }
};

TEST_F(Share, link_opens_the_same_scene_view_and_accuracy) {
  open();
  show_panel("json");
  std::string former = picture();
  edit(page_scene + "\n");
  press_ctrl_enter();
  await("done", former);
  former = picture();
  browser().type("#board", "\xee\x80\x92");  // arrow left
  await("done", former);
  former = picture();
  choose_accuracy(3);
  await("done", former);
  const std::string link = copied_by("#share");
  ASSERT_TRUE(link.starts_with(server().url() + "/#")) << link;
  const std::string query_before = value("document.getElementById('accuracy-says').textContent");
  open(link.substr(server().url().size()));
  EXPECT_EQ(text(), page_scene + "\n");
  EXPECT_EQ(value("document.getElementById('view-tools').hidden"), false);
  EXPECT_EQ(value("document.getElementById('accuracy-says').textContent"), query_before);
  EXPECT_EQ(value("document.getElementById('picture').naturalWidth"), 60);
}

TEST_F(Share, link_carries_settings_that_no_step_of_accuracy_stands_for) {
  open("/#scene=first-sphere&width=9&samples=16&precision=double");
  const std::string chosen = value("document.getElementById('accuracy-says').textContent");
  EXPECT_EQ(chosen, "16 samples, double precision");
  bool was_asked = false;
  for (const std::string& address : browser().requested())
    was_asked =
        was_asked || address.ends_with("/render?scene=first-sphere&samples=16&precision=double");
  EXPECT_TRUE(was_asked);
  EXPECT_EQ(copied_by("#share"),
            server().url() + "/#scene=first-sphere&samples=16&precision=double");
  EXPECT_NE(copied_by("#curl").find("samples=16&precision=double"), std::string::npos);
}

TEST_F(Share, text_that_no_browser_follows_a_link_to_is_not_linked_to) {
  open("/#scene=first-sphere");
  // 1.6 MB that cannot be compressed below 1.2.
  browser().run(R"(
      const bytes = Array.from({ length: 25 }, () => crypto.getRandomValues(new Uint8Array(48000)));
      const editor = document.getElementById('editor');
      editor.value = bytes.map((each) => btoa(String.fromCharCode(...each))).join('\n');
      editor.dispatchEvent(new Event('input'));)");
  browser().run("navigator.clipboard.writeText = async (text) => { window.copied = text; };");
  browser().click("#share");
  EXPECT_TRUE(comes_true("/Too large/.test(document.getElementById('status').textContent)"));
  EXPECT_EQ(value("window.copied ?? null"), nullptr);
  EXPECT_EQ(value("location.hash"), "#scene=first-sphere");
}

TEST_F(Share, link_to_a_shipped_scene_names_it) {
  open("/#scene=mesh");
  EXPECT_EQ(copied_by("#share"), server().url() + "/#scene=mesh");
}

TEST_F(Share, query_typed_by_hand_is_read_as_a_link) {
  open("/?scene=mesh&samples=4");
  const std::string link = copied_by("#share");
  EXPECT_TRUE(link.ends_with("#scene=mesh&samples=4")) << link;
}

TEST_F(Share, damaged_link_is_said_to_be_and_the_demo_shown) {
  for (const char* const damaged : {"AAAA", "xx", "%25%25", "q1bKSM1NVLJSMDQ"}) {
    open("/#document=" + std::string(damaged));
    ASSERT_TRUE(comes_true("!document.getElementById('problem').hidden")) << damaged;
    const std::string said = value("document.getElementById('problem').innerText");
    EXPECT_NE(said.find("link is damaged"), std::string::npos) << said;
    EXPECT_NE(said.find("Copy the whole link"), std::string::npos) << said;
    EXPECT_EQ(value("document.getElementById('scene-select').value"), "demo");
    EXPECT_EQ(value("document.getElementById('dated').hidden"), true);
  }
  keep_screenshot("damaged_link");
  const std::string former = picture();
  choose_accuracy(0);
  await("done", former);
  EXPECT_EQ(value("document.getElementById('problem').hidden"), true);
}

TEST_F(Share, command_renders_the_picture_in_sight) {
  open("/#scene=first-sphere");
  std::string former = picture();
  browser().type("#board", "\xee\x80\x92");  // arrow left
  await("done", former);
  const TemporaryFolder folder;
  const Outcome outcome = run({"sh", {}, copied_by("#curl"), {}, folder.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Picture rendered = decode_png(read_file(folder.path() / "first-sphere.png"));
  browser().click("#download");
  EXPECT_EQ(rendered, decode_png(downloaded("first-sphere.png")));
}

}  // namespace
}  // namespace raytracer::test
