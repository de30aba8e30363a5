// The scene's own curve of error against time, measured, drawn, and each point a picture.
#include <gtest/gtest.h>

#include <string>

#include "tests/browser/browser_page.h"
#include "tests/process/patience.h"

namespace raytracer::test {
namespace {

class Curve : public BrowserPage {
 protected:
  void SetUp() override {
    open("/#scene=first-sphere");
    show_panel("curve");
  }

  static int count(const std::string& selector) {
    return value("document.querySelectorAll('" + selector + "').length");
  }
};

TEST_F(Curve, is_drawn_and_its_points_are_pictures) {
  const std::string former = picture();
  browser().click("#measure");
  ASSERT_TRUE(comes_true("document.querySelectorAll('#curve-plot .point').length > 0"))
      << value("document.getElementById('curve-says').textContent");
  EXPECT_GE(count("#curve-plot .pareto"), 2);
  EXPECT_EQ(value("document.getElementById('curve-progress').hidden"), true);
  browser().requested();
  browser().type("#curve-plot .pareto", key_enter);
  ASSERT_TRUE(comes_true("document.querySelectorAll('#curve-figures canvas').length === 1"));
  await("done", former);
  keep_screenshot("curve");
  bool was_asked = false;
  for (const std::string& address : browser().requested())
    was_asked =
        was_asked || address.find("/render?scene=first-sphere&samples=") != std::string::npos;
  EXPECT_TRUE(was_asked);

  // It is no other scene's.
  browser().run("window.formerHash = location.hash; location.hash = 'scene=spheres'");
  const std::string inert = "document.getElementById('curve-plot').inert";
  ASSERT_TRUE(comes_true(inert));
  EXPECT_EQ(count("#curve-figures canvas"), 0);
  browser().run("location.hash = window.formerHash");
  ASSERT_TRUE(comes_true("!" + inert));
  await("done");

  // A link to it opens the same.
  const std::string chosen = value("document.getElementById('accuracy-says').textContent");
  browser().click("#share");
  ASSERT_TRUE(comes_true("location.hash.includes('samples=')"));
  const std::string link = value("location.hash");
  open("/" + link);
  EXPECT_EQ(value("document.getElementById('accuracy-says').textContent"), chosen);
}

/// Small, and with a shadow to leave out.
const std::string shadow_scene = R"({
  "camera": {"origin": [0, 1, -5], "look_at": [0, 0, 0], "fov": 0.5, "width": 60, "height": 40},
  "lights": [{"type": "distant", "direction": [0, -1, 0.2]}],
  "objects": [{"type": "sphere", "center": [0, 1, 0], "radius": 0.5},
              {"type": "sphere", "center": [0, -9, 0], "radius": 9}]
})";

TEST_F(Curve, picture_of_a_point_does_not_wait_for_the_reference) {
  show_panel("json");
  std::string former = picture();
  edit(shadow_scene);
  press_ctrl_enter();
  await("done", former);
  show_panel("curve");
  browser().click("#measure");
  ASSERT_TRUE(comes_true("document.querySelector('#curve-plot [aria-label*=shadows]')"));

  // From here on nothing of more than a hundred samples is answered until it is allowed.
  browser().run(R"(
      const { fetch } = window;
      window.references = 0;
      const allowed = new Promise((resolve) => { window.allow = resolve; });
      window.fetch = async (address, ...rest) => {
        if (/samples=\d{3}/.test(address)) {
          window.references += 1;
          await allowed;
        }
        return fetch(address, ...rest);
      };)");
  browser().type("#curve-plot [aria-label*=shadows]", key_enter);
  ASSERT_TRUE(comes_true("document.querySelectorAll('#curve-figures canvas').length === 1"));
  former = picture();
  browser().type("#curve-plot .pareto", key_enter);
  await("done", former);
  browser().run("window.allow()");
  ASSERT_TRUE(comes_true("document.querySelectorAll('#curve-figures canvas').length === 1"));
  browser().run("window.references = 0");
  browser().type("#curve-plot [aria-label*=shadows]", key_enter);
  EXPECT_TRUE(comes_true("document.querySelectorAll('#curve-figures canvas').length === 2"));
  EXPECT_EQ(value("window.references"), 0) << "it is there already";
}

TEST_F(Curve, measuring_can_be_stopped) {
  browser().click("#measure");
  ASSERT_TRUE(comes_true("document.getElementById('curve-progress').value > 0"));
  browser().click("#measure");
  EXPECT_TRUE(comes_true("document.getElementById('curve-says').textContent === 'Stopped.'"));
  EXPECT_TRUE(eventually([] { return server().log().find("DELETE /jobs/") != std::string::npos; },
                         longest_wait))
      << server().log();
}

}  // namespace
}  // namespace raytracer::test
