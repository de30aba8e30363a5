// What is wrong with a document is marked at its line, and the picture of the last valid one stays.
#include <gtest/gtest.h>

#include <csignal>
#include <string>
#include <vector>

#include "tests/browser/browser_page.h"

namespace raytracer::test {
namespace {

class Errors : public BrowserPage {
 protected:
  void SetUp() override {
    open("/#scene=first-sphere");
    show_panel("json");
  }

  /// The lines that the listed errors point to.
  static std::vector<std::string> lines() {
    return value("[...document.querySelectorAll('#errors li')].map((item) => item.dataset.line)");
  }
  static std::string list() { return value("document.getElementById('errors').innerText"); }
};

/// A misspelt key on line 3, a radius below 0 on line 4.
const std::string broken_scene = R"({
  "camera": {"origin": [0, 0, -5], "look_at": [0, 0, 0], "fov": 0.9, "width": 60, "height": 40},
  "backgruond": [0, 0, 1],
  "objects": [{"type": "sphere", "center": [0, 0, 0], "radius": -1}]
})";

TEST_F(Errors, all_are_listed_with_their_lines_and_the_picture_stays) {
  const std::string former = picture();
  edit(broken_scene);
  press_ctrl_enter();
  await("error");
  EXPECT_EQ(lines(), (std::vector<std::string>{"3", "4"}));
  EXPECT_NE(list().find("background"), std::string::npos) << list();
  EXPECT_NE(list().find("/objects/0/radius"), std::string::npos) << list();
  EXPECT_EQ(picture(), former);
  EXPECT_EQ(value("document.getElementById('picture').naturalWidth"), 700);
  EXPECT_EQ(value("document.getElementById('picture').hidden"), false);
  keep_screenshot("error");
}

TEST_F(Errors, text_that_is_not_json_is_marked_at_its_line) {
  edit("{\n  \"camera\": {\n    \"fov\" 1\n  }\n}\n");
  press_ctrl_enter();
  await("error");
  EXPECT_EQ(lines(), std::vector<std::string>{"3"});
  EXPECT_NE(list().find("3:11"), std::string::npos) << list();
  browser().run("document.getElementById('editor').setSelectionRange(0, 0)");
  browser().type("#editor", key_enter);
  EXPECT_NE(list().find("4:11"), std::string::npos) << list();
}

TEST_F(Errors, many_are_scrolled_in_their_list_and_not_with_the_page) {
  std::string spheres;
  for (int i = 0; i < 40; ++i)
    spheres += R"({"type": "sphere", "center": [0, 0, 0], "radius": -1},)"
               "\n";
  std::string many = broken_scene;
  edit(many.insert(many.find("{\"type\""), spheres));
  browser().resize(1280, 757);
  press_ctrl_enter();
  await("error");
  keep_screenshot("many_errors");
  EXPECT_EQ(value("document.documentElement.scrollHeight"), 757);
  EXPECT_GT(value("document.getElementById('editor').clientHeight"), 150);
}

TEST_F(Errors, are_gone_after_a_valid_render) {
  const std::string former = picture();
  edit(broken_scene);
  press_ctrl_enter();
  await("error");
  edit(page_scene);
  press_ctrl_enter();
  await("done", former);
  EXPECT_TRUE(lines().empty()) << list();
  EXPECT_EQ(list(), "");
}

TEST_F(Errors, lead_to_their_place_from_any_panel) {
  edit(broken_scene);
  press_ctrl_enter();
  await("error");
  show_panel("form");
  browser().click("#errors li:last-child button");
  EXPECT_EQ(value("document.activeElement.id"), "editor");
  const int start = value("document.getElementById('editor').selectionStart");
  EXPECT_EQ(static_cast<std::size_t>(start), broken_scene.find("-1}"));
}

TEST_F(Errors, limit_of_the_server_is_explained) {
  std::string large = page_scene;
  large.replace(large.find("\"width\": 60"), 11, "\"width\": 9999999");
  edit(large);
  press_ctrl_enter();
  await("error");
  const std::string said = value("document.getElementById('problem').innerText");
  EXPECT_NE(said.find("--max-pixels"), std::string::npos) << said;
}

TEST_F(Errors, server_that_is_gone_is_said_to_be) {
  edit(page_scene);
  server().signal(SIGKILL);
  press_ctrl_enter();
  await("error");
  const std::string said = value("document.getElementById('problem').innerText");
  EXPECT_NE(said.find("raytracer-server"), std::string::npos) << said;
  keep_screenshot("server_gone");
  SetUpTestSuite();  // another one, for whichever test follows
}

}  // namespace
}  // namespace raytracer::test
