// Common edits without JSON: the form and the hand write the same document, and leave its rest
// alone.
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "tests/browser/browser_page.h"

namespace raytracer::test {
namespace {

class Spheres : public BrowserPage {
 protected:
  void SetUp() override { open(); }

  static std::string set_value(const std::string& label, const std::string& input) {
    return "const control = document.querySelector('[aria-label=\"" + label +
           "\"]'); control.value = '" + input +
           "'; control.dispatchEvent(new Event('input', { bubbles: true }));";
  }

  /// In pixels of the window, from parts of the picture.
  static std::array<int, 2> place(double x, double y) {
    const nlohmann::json box = value(
        "(() => { const box = document.getElementById('board').getBoundingClientRect();"
        " return [box.left, box.top, box.width, box.height]; })()");
    return {static_cast<int>(box[0].get<double>() + x * box[2].get<double>()),
            static_cast<int>(box[1].get<double>() + y * box[3].get<double>())};
  }

  static std::string without(std::string text, const std::string& part) {
    const std::size_t at = text.find(part);
    EXPECT_NE(at, std::string::npos) << part;
    return text.erase(at, part.size());
  }
};

TEST_F(Spheres, form_moves_one_and_nothing_else) {
  const std::string before = text();
  const std::string former = picture();
  browser().run(set_value("Sphere 1, x", "-1.5"));
  await("done", former);
  EXPECT_EQ(without(text(), "\"center\": [-1.5, 2.9, -2]"),
            without(before, "\"center\": [-3.2, 2.9, -2]"));
}

TEST_F(Spheres, drag_in_the_picture_moves_one_and_nothing_else) {
  const auto before = nlohmann::json::parse(text());
  const std::string former = picture();
  browser().click("label:has(#tool-move)");
  browser().drag(place(0.36, 0.33), place(0.46, 0.2));
  await("done", former);
  keep_screenshot("dragged_sphere");
  auto after = nlohmann::json::parse(text());
  nlohmann::json& center = after["objects"][0]["center"];
  EXPECT_GT(center[0].get<double>(), -3.2 + 0.5);  // to the right
  EXPECT_GT(center[1].get<double>(), 2.9 + 0.5);   // and up
  center = before.at("objects")[0].at("center");
  EXPECT_EQ(after, before);
  EXPECT_EQ(value("document.getElementById('view-tools').hidden"), true);
}

/// Events of a pointer on the board, at a place in parts of the picture.
std::string pointer(const std::string& type, double x, double y) {
  return "{ const box = document.getElementById('board').getBoundingClientRect();"
         "document.getElementById('board').dispatchEvent(new PointerEvent('" +
         type + "', { pointerId: 9, button: 0, bubbles: true, clientX: box.left + " +
         std::to_string(x) + " * box.width, clientY: box.top + " + std::to_string(y) +
         " * box.height })); }";
}

TEST_F(Spheres, click_on_one_edits_nothing) {
  std::string former = picture();
  browser().run(set_value("red, colour", "#00ff00"));
  await("done", former);
  former = picture();
  browser().click("#undo");
  await("done", former);
  browser().click("label:has(#tool-move)");
  browser().run(pointer("pointerdown", 0.36, 0.33) + pointer("pointerup", 0.36, 0.33));
  EXPECT_EQ(value("document.getElementById('redo').disabled"), false);
  EXPECT_EQ(value("document.getElementById('undo').disabled"), true);
}

TEST_F(Spheres, wheel_while_one_is_dragged_lets_go_of_nothing) {
  const std::string before = text();
  browser().click("label:has(#tool-move)");
  browser().run(pointer("pointerdown", 0.36, 0.33) + pointer("pointermove", 0.4, 0.3) +
                "document.getElementById('board').dispatchEvent(new WheelEvent('wheel', { deltaY: "
                "20, bubbles: true, cancelable: true }));" +
                pointer("pointermove", 0.46, 0.2) + pointer("pointerup", 0.46, 0.2));
  EXPECT_TRUE(comes_true("document.getElementById('status').innerText.includes('Rendered')"));
  EXPECT_EQ(value("document.getElementById('problem').hidden"), true);
  EXPECT_NE(text(), before);
}

TEST_F(Spheres, arrows_keep_the_digits_of_a_number) {
  const std::string field = "document.querySelector('[aria-label=\"Sphere 1, x\"]')";
  browser().run(set_value("Sphere 1, x", "1.23456789"));
  const auto press = [&](const std::string& key) {
    browser().run(field + ".dispatchEvent(new KeyboardEvent('keydown', { key: '" + key +
                  "', bubbles: true, cancelable: true }))");
  };
  press("ArrowUp");
  EXPECT_EQ(value(field + ".value"), "1.33456789");
  browser().run(set_value("Sphere 1, x", "3e-8"));
  press("ArrowDown");
  EXPECT_EQ(value(field + ".valueAsNumber").get<double>(), 2.9e-8);
}

TEST_F(Spheres, undo_brings_the_text_back) {
  const std::string before = text();
  std::string former = picture();
  browser().run(set_value("red, colour", "#00ff00"));
  await("done", former);
  EXPECT_NE(text().find("\"color\": [0, 1, 0]"), std::string::npos) << text();
  former = picture();
  browser().click("#undo");
  await("done", former);
  EXPECT_EQ(text(), before);
}

TEST_F(Spheres, one_can_be_added_and_removed) {
  const auto before = nlohmann::json::parse(text());
  std::string former = picture();
  browser().run(
      "[...document.querySelectorAll('#panel-form button')].find((each) => each.textContent === "
      "'Add a sphere').click()");
  await("done", former);
  EXPECT_EQ(nlohmann::json::parse(text()).at("objects").size(), before.at("objects").size() + 1);
  former = picture();
  browser().click("[aria-label='Remove Sphere 3']");
  await("done", former);
  EXPECT_EQ(nlohmann::json::parse(text()), before);
}

TEST_F(Spheres, added_at_once_are_undone_one_by_one) {
  const std::string before = text();
  const std::string count = "JSON.parse(document.getElementById('editor').value).objects.length";
  browser().run(
      "window.add = () => [...document.querySelectorAll('#panel-form button')].find((each) =>"
      " each.textContent === 'Add a sphere').click(); window.add();");
  ASSERT_TRUE(comes_true(count + " === 4"));
  browser().run("window.add()");
  ASSERT_TRUE(comes_true(count + " === 5"));
  browser().click("#undo");
  EXPECT_TRUE(comes_true(count + " === 4"));
  browser().click("#undo");
  EXPECT_TRUE(comes_true(count + " === 3"));
  EXPECT_EQ(text(), before);
}

TEST_F(Spheres, sky_can_be_added_and_removed_and_a_light_softened) {
  const auto before = nlohmann::json::parse(text());
  const std::string add_sky =
      "[...document.querySelectorAll('#panel-form button')].find((each) => each.textContent === "
      "'Add a sky')";
  std::string former = picture();
  browser().run(add_sky + ".click()");
  await("done", former);
  const auto with_sky = nlohmann::json::parse(text());
  ASSERT_EQ(with_sky.at("lights").size(), before.at("lights").size() + 1);
  EXPECT_EQ(with_sky.at("lights").back().at("type"), "sky");
  EXPECT_EQ(value(add_sky + " === undefined"), true);
  const auto name = "Light " + std::to_string(with_sky.at("lights").size());
  former = picture();
  browser().click("[aria-label='Remove " + name + "']");
  await("done", former);
  EXPECT_EQ(nlohmann::json::parse(text()), before);
  former = picture();
  browser().run(set_value("Light 1, angle", "0.2"));
  await("done", former);
  EXPECT_EQ(nlohmann::json::parse(text()).at("lights")[0].at("angle"), 0.2);
}

TEST_F(Spheres, member_that_is_missing_is_added) {
  const std::string former = picture();
  browser().run(set_value("sand, reflectivity", "0.5"));
  await("done", former);
  EXPECT_EQ(nlohmann::json::parse(text()).at("materials").at("sand").at("reflectivity"), 0.5);
}

TEST_F(Spheres, glass_gets_fresnels_reflections_and_loses_them) {
  for (const bool is_on : {true, false}) {
    const std::string former = picture();
    browser().run("document.querySelector('[aria-label=\"sand, Fresnel\"]').click()");
    await("done", former);
    EXPECT_EQ(nlohmann::json::parse(text()).at("materials").at("sand").at("fresnel"), is_on);
  }
}

TEST_F(Spheres, background_becomes_transparent_and_has_its_colour_again) {
  const auto before = nlohmann::json::parse(text()).at("background");
  const std::string press =
      "document.querySelector('[aria-label=\"Background, transparent\"]').click()";
  // Of the picture's upper left corner, where nothing is.
  const std::string alpha =
      "(() => { const paper = new OffscreenCanvas(1, 1).getContext('2d');"
      " paper.drawImage(document.getElementById('picture'), 0, 0);"
      " return paper.getImageData(0, 0, 1, 1).data[3]; })()";
  EXPECT_EQ(value(alpha), 255);
  std::string former = picture();
  browser().run(press);
  await("done", former);
  EXPECT_EQ(nlohmann::json::parse(text()).at("background"), "transparent");
  EXPECT_EQ(value(alpha), 0);
  keep_screenshot("transparent_background");
  former = picture();
  browser().run(press);
  await("done", former);
  EXPECT_EQ(value(alpha), 255);
  const auto after = nlohmann::json::parse(text()).at("background");
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(after.at(i).get<double>(), before.at(i).get<double>(), 0.003);
}

}  // namespace
}  // namespace raytracer::test
