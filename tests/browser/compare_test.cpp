// Before and after, with a slider between them; and the gallery, where there is much to compare.
#include <gtest/gtest.h>

#include <string>

#include "tests/browser/browser_page.h"

namespace raytracer::test {
namespace {

class Compare : public BrowserPage {};

TEST_F(Compare, picture_before_stays_beside_the_one_after) {
  open();
  browser().click("#compare");
  const std::string former = picture();
  choose_accuracy(0);
  await("done", former);
  EXPECT_EQ(value("document.getElementById('before').hidden"), false);
  EXPECT_EQ(value("document.getElementById('before').naturalWidth"), 700);
  EXPECT_NE(value("document.getElementById('before').src"), picture());
  const std::string after = value("document.getElementById('after-label').textContent");
  EXPECT_NE(after.find("Instant"), std::string::npos) << after;
  browser().type("#split", "\xee\x80\x92");  // arrow left
  EXPECT_EQ(value("document.getElementById('split').value"), "49");
  keep_screenshot("compare");
  browser().click("#compare");
  EXPECT_EQ(value("document.getElementById('before').hidden"), true);
}

TEST_F(Compare, ends_with_the_scene) {
  open();
  browser().click("#compare");
  const std::string former = picture();
  browser().run("location.hash = 'scene=first-sphere'");
  await("done", former);
  EXPECT_EQ(value("document.getElementById('before').hidden"), true);
  EXPECT_EQ(value("document.getElementById('compare').ariaPressed"), "false");
}

TEST_F(Compare, gallery_shows_every_scene_and_opens_one) {
  open();
  const std::string former = picture();
  browser().click("#open-gallery");
  EXPECT_TRUE(comes_true(gallery_has_pictures));
  EXPECT_EQ(value("document.querySelectorAll('#gallery img').length"),
            value("document.getElementById('scene-select').options.length"));
  keep_screenshot("gallery");
  browser().click("#gallery [data-scene=mesh]");
  await("done", former);
  EXPECT_EQ(value("document.getElementById('scene-select').value"), "mesh");
}

}  // namespace
}  // namespace raytracer::test
