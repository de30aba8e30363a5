// A document that is edited is rendered anew.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>

#include "tests/browser/browser_page.h"

namespace raytracer::test {
namespace {

constexpr const char* key_home = "\xee\x80\x91";
constexpr const char* key_end = "\xee\x80\x90";

class Editing : public BrowserPage {
 protected:
  void SetUp() override {
    open("/#scene=first-sphere");
    show_panel("json");
  }

  /// The scene's text after a control of the form has changed a value.
  static std::string text_edited_by_form() {
    browser().run(
        "const ambient = document.querySelector('[aria-label=\"Ambient light\"]');"
        "ambient.value = 0.9; ambient.dispatchEvent(new Event('input'));");
    return text();
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

TEST_F(Editing, undo_knows_keys_as_well_as_the_form) {
  const std::string original = text();
  const std::string by_form = text_edited_by_form();
  ASSERT_NE(by_form, original);
  browser().type("#editor", "typed");
  ASSERT_EQ(text(), by_form + "typed");
  browser().click("#undo");
  EXPECT_EQ(text(), by_form);
  browser().type("#editor", std::string(key_control) + "z" + key_release);
  EXPECT_EQ(text(), original) << "the textarea has nothing to undo by itself";
  EXPECT_EQ(value("document.getElementById('undo').disabled"), true);
  browser().click("#redo");
  EXPECT_EQ(text(), by_form);
  constexpr const char* key_shift = "\xee\x80\x88";
  browser().type("#editor", std::string(key_control) + key_shift + "z" + key_release);
  EXPECT_EQ(text(), by_form + "typed");
  EXPECT_EQ(value("document.getElementById('redo').disabled"), true);
}

TEST_F(Editing, key_that_undoes_goes_on_where_typing_began) {
  const std::string original = text();
  const std::string by_form = text_edited_by_form();
  const auto press_with_control = [](const char* key) {
    browser().type("#editor", std::string(key_control) + key + key_release);
  };
  const auto becomes = [](const std::string& expected) {
    return comes_true("document.getElementById('editor').value === " +
                      nlohmann::json(expected).dump());
  };
  browser().type("#editor", "abc");
  std::this_thread::sleep_for(std::chrono::seconds(1));  // what comes later is another step
  browser().type("#editor", "def");
  for (const std::string& former : {by_form + "abc", by_form, original}) {
    press_with_control("z");
    EXPECT_TRUE(becomes(former)) << text();
  }
  for (const std::string& next : {by_form, by_form + "abc", by_form + "abcdef"}) {
    press_with_control("y");
    EXPECT_TRUE(becomes(next)) << text();
  }
  EXPECT_EQ(value("document.getElementById('editor').selectionStart"), by_form.size() + 6);
  std::this_thread::sleep_for(std::chrono::milliseconds(500));  // a hand has rested since
  EXPECT_NE(state(), "error") << "of what was undone nobody wants to know";
}

TEST_F(Editing, keys_go_to_the_caret_however_far_one_has_scrolled) {
  std::string lines;
  for (int i = 1; i < 10'000; ++i) lines += fmt::format("\"line {}\",\n", i);
  edit(lines);
  const auto press_with_control = [](const std::string& key) {
    browser().type("#editor", key_control + key + key_release);
  };
  const auto scroll_down = [] {
    const int top = value("Number(document.querySelector('#gutter div').textContent)");
    browser().run(
        "clearInterval(window.scrolling); window.scrolling = setInterval(() => {"
        " document.getElementById('editor').scrollTop += 2000; }, 20);");
    EXPECT_TRUE(comes_true(
        fmt::format("document.querySelector('#gutter div').textContent > {}", top + 5000)));
    browser().run("clearInterval(window.scrolling)");
  };
  const auto begin = [] { return value("document.getElementById('editor').value.slice(0, 9)"); };

  press_with_control(key_home);
  EXPECT_TRUE(comes_true("document.getElementById('caret').textContent === '1:1'"));
  scroll_down();
  EXPECT_NE(begin(), "\"line 1\",");
  browser().press("X");
  EXPECT_EQ(begin(), "X\"line 1\"");
  EXPECT_TRUE(comes_true("document.getElementById('caret').textContent === '1:2'"));

  // Nor is it lost to the key that undoes it.
  scroll_down();
  press_with_control("z");
  press_with_control(key_home);
  EXPECT_EQ(begin(), "\"line 1\",");

  press_with_control(key_end);
  EXPECT_TRUE(comes_true("document.getElementById('caret').textContent === '10000:1'"));
}

}  // namespace
}  // namespace raytracer::test
