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

  // A link to it opens the same.
  const std::string chosen = value("document.getElementById('accuracy-says').textContent");
  browser().click("#share");
  ASSERT_TRUE(comes_true("location.hash.includes('samples=')"));
  const std::string link = value("location.hash");
  open("/" + link);
  EXPECT_EQ(value("document.getElementById('accuracy-says').textContent"), chosen);
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
