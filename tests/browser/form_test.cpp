// The form where there is little to show or nothing that it can read: it neither hides what is
// wrong nor writes into the wrong place.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
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

TEST_F(Form, says_why_a_number_is_not_taken) {
  open();
  const std::string before = text();
  const std::string field = "document.querySelector('[aria-label=\"Sphere 1, radius\"]')";
  const std::string said = "document.querySelector('#form [role=alert]')";
  const auto enter = [&](const std::string& keys) {
    browser().run(field + ".select()");
    browser().type("[aria-label='Sphere 1, radius']", keys);
  };
  for (const char* const wrong : {"-1", "0", "e400", "1e400"}) {
    enter(wrong);
    ASSERT_NE(value(said), nullptr) << wrong;
    const std::string words = value(said + ".textContent");
    EXPECT_NE(words.find("The scene keeps 2."), std::string::npos) << words;
    EXPECT_EQ(value(field + ".ariaInvalid"), "true");
    EXPECT_EQ(value(field + ".getAttribute('aria-describedby')"), value(said + ".id"));
    EXPECT_EQ(text(), before);
    keep_screenshot("form_refusal");
  }
  const std::string former = picture();
  enter("1.5");
  await("done", former);
  EXPECT_EQ(value(said), nullptr);
  EXPECT_EQ(value(field + ".ariaInvalid"), nullptr);
  EXPECT_EQ(nlohmann::json::parse(text()).at("objects")[0].at("radius"), 1.5);
}

TEST_F(Form, names_what_it_does_not_show) {
  open("/#scene=still-life");
  EXPECT_EQ(
      value("document.querySelector('#form .form-rest').textContent"),
      "Also in the scene: 1 set of spheres, 1 set of cylinders, 1 square of spheres, 1 plane, "
      "1 mesh. Edit them as JSON.");
  keep_screenshot("form_rest");
  open("/#scene=first-sphere");
  EXPECT_EQ(value("document.querySelector('#form .form-rest')"), nullptr);
}

TEST_F(Form, lights_are_added_and_removed) {
  for (const char* const kind : {"distant", "point"}) {
    std::string former = picture();
    const auto before = nlohmann::json::parse(text()).at("lights");
    press(std::string("Add a ") + kind + " light");
    await("done", former);
    EXPECT_EQ(nlohmann::json::parse(text()).at("lights").back().at("type"), kind);
    former = picture();
    browser().run("document.querySelector('[aria-label=\"Remove Light " +
                  std::to_string(before.size() + 1) + "\"]').click()");
    await("done", former);
    EXPECT_EQ(nlohmann::json::parse(text()).at("lights"), before);
  }
}

TEST_F(Form, gives_an_object_one_of_the_materials) {
  open();
  const std::string former = picture();
  browser().run(
      "const select = document.querySelector('[aria-label=\"Sphere 1, material\"]');"
      "select.value = 'sand'; select.dispatchEvent(new Event('change', { bubbles: true }));");
  await("done", former);
  EXPECT_EQ(nlohmann::json::parse(text()).at("objects")[0].at("material"), "sand");
}

TEST_F(Form, puts_what_is_added_beside_the_rest) {
  open();
  const std::string count = "JSON.parse(document.getElementById('editor').value).objects.length";
  const std::array kinds = {"sphere", "cylinder", "cone", "sphere", "sphere"};
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    press(std::string("Add a ") + kinds.at(i));
    ASSERT_TRUE(comes_true(count + " === " + std::to_string(4 + i)));
  }
  await("done");
  keep_screenshot("form_added");
  const auto objects = nlohmann::json::parse(text()).at("objects");
  std::vector<std::array<double, 3>> places;
  for (std::size_t i = 3; i < objects.size(); ++i) {
    const nlohmann::json& object = objects[i];
    const bool has_ends = object.contains("from");
    const std::array<double, 3> from = object.at(has_ends ? "from" : "center");
    const std::array<double, 3> to = object.at(has_ends ? "to" : "center");
    std::array<double, 3> place{};
    for (std::size_t axis = 0; axis < 3; ++axis) place.at(axis) = (from.at(axis) + to.at(axis)) / 2;
    for (const auto& [x, y, z] : places)
      EXPECT_GT(std::hypot(x - place[0], y - place[1], z - place[2]),
                2 * objects[3].at("radius").get<double>());
    places.push_back(place);
  }
}

}  // namespace
}  // namespace raytracer::test
