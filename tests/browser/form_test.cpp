// The form where there is little to show or nothing that it can read: it neither hides what is
// wrong nor writes into the wrong place.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/browser/browser_page.h"

namespace raytracer::test {
namespace {

class Form : public BrowserPage {
 protected:
  void SetUp() override {
    open("/#scene=first-sphere");
    show_panel("json");
  }

  /// Renders `text`, in which something is wrong; what is said of it.
  static std::string refusal_of(const std::string& text) {
    browser().run("document.documentElement.dataset.state = ''");  // not the error before
    edit(text);
    press_ctrl_enter();
    await("error");
    return value("document.getElementById('problem').innerText");
  }

  static void press(const std::string& button) {
    browser().run(
        "[...document.querySelectorAll('#form button')].find((each) => each.textContent === '" +
        button + "').click()");
  }

  static std::string replaced(std::string text, const std::string& part, const std::string& by) {
    const std::size_t at = text.find(part);
    EXPECT_NE(at, std::string::npos) << part;
    return text.replace(at, part.size(), by);
  }

  inline static const std::string rests = "document.getElementById('form').inert";
};

TEST_F(Form, rests_while_it_cannot_read_the_text_and_what_is_wrong_is_said) {
  const std::string odd_colour = replaced(page_scene, "[0, 0, 1]", "0.5");
  EXPECT_NE(refusal_of(odd_colour).find("/background"), std::string::npos);
  EXPECT_EQ(value(rests), false);

  const std::string no_json = replaced(page_scene, "0.9,", "0.9");
  edit(no_json);
  ASSERT_TRUE(comes_true(rests));
  EXPECT_EQ(value("document.getElementById('form-rests').hidden"), false);
  EXPECT_NE(refusal_of(no_json).find("not JSON"), std::string::npos);

  // Typed at this moment, and not read yet: the form's places are those of the former text.
  edit(page_scene);
  ASSERT_TRUE(comes_true("!" + rests));
  const std::string none =
      replaced(page_scene, R"({"type": "sphere", "center": [0, 0, 0], "radius": 1})", "");
  browser().run(
      "const removes = document.querySelector('[aria-label=\"Remove Sphere 1\"]');"
      "const editor = document.getElementById('editor'); editor.value = " +
      nlohmann::json(none).dump() +
      "; editor.dispatchEvent(new Event('input', { bubbles: true })); removes.click();");
  EXPECT_EQ(text(), none);
}

TEST_F(Form, adds_to_lists_that_are_missing) {
  const std::string camera =
      R"({"camera": {"origin": [0, 0, -5], "look_at": [0, 0, 0], "fov": 0.9, "width": 60, "height": 40}})";
  std::string former = picture();
  edit(camera);
  press_ctrl_enter();
  await("done", former);
  for (const char* const button : {"Add a sphere", "Add a sky"}) {
    former = picture();
    press(button);
    await("done", former);
  }
  const auto scene = nlohmann::json::parse(text());
  EXPECT_EQ(scene.at("objects").at(0).at("type"), "sphere");
  EXPECT_EQ(scene.at("lights").at(0).at("type"), "sky");

  // Nobody knows where without a camera.
  EXPECT_NE(refusal_of("{}").find("camera"), std::string::npos);
  browser().run("document.documentElement.dataset.state = ''");
  press("Add a sphere");
  await("error");
  EXPECT_EQ(text(), "{}");
}

}  // namespace
}  // namespace raytracer::test
