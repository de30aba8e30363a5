// A server that asks for a token: the page asks the person, keeps the answer for the tab, and sends
// it with all that it asks for.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "tests/browser/browser_page.h"
#include "tests/process/endless_scene.h"
#include "tests/process/patience.h"

namespace raytracer::test {
namespace {

class Token : public BrowserPage {
 protected:
  /// Opens the page of `guarded_` and waits until it asks.
  void open_guarded() const {
    open_in_new_tab(guarded_.url());
    ASSERT_TRUE(comes_true(is_asked));
  }

  static void give(const std::string& token) {
    browser().type("#token", token);
    browser().press(key_enter);
  }

  const ServerProcess guarded_{{"--token", "s3cret"}};
  inline static const std::string is_asked = "document.getElementById('token-dialog').open";
};

TEST_F(Token, is_asked_for_once_and_kept_for_the_tab) {
  open_guarded();
  EXPECT_EQ(value("document.activeElement.id"), "token");
  keep_screenshot("token");
  give(" s3cret ");
  await("done");
  EXPECT_EQ(value("document.getElementById('picture').naturalWidth"), 700);
  browser().run("location.reload()");
  await("done");
  EXPECT_EQ(value(is_asked), false);
  EXPECT_EQ(value("localStorage.length"), 0);
}

TEST_F(Token, that_is_wrong_is_asked_for_again) {
  open_guarded();
  give("guess");
  ASSERT_TRUE(comes_true(is_asked + " && /not this server/.test(" +
                         "document.querySelector('#token-dialog [role=alert]').textContent)"));
  EXPECT_EQ(value("document.getElementById('token').value"), "");
  keep_screenshot("token_wrong");
  give("s3cret");
  await("done");
}

TEST_F(Token, that_is_not_given_is_said_to_be_missing_and_asked_for_again) {
  open_guarded();
  browser().press("\xee\x80\x8c");  // escape
  await("error");
  const std::string said = value("document.getElementById('problem').innerText");
  EXPECT_NE(said.find("token"), std::string::npos) << said;
  browser().click("#render");
  ASSERT_TRUE(comes_true(is_asked));
  give("s3cret");
  await("done");
  EXPECT_EQ(value("document.getElementById('scene-select').value"), "demo");
  EXPECT_EQ(value("document.getElementById('open-gallery').disabled"), false);
}

TEST_F(Token, goes_with_pictures_of_the_gallery_jobs_and_their_end) {
  open_guarded();
  give("s3cret");
  await("done");
  browser().click("#open-gallery");
  EXPECT_TRUE(comes_true(gallery_has_pictures));
  browser().click("#gallery form button");
  show_panel("json");
  edit(endless_scene());
  press_ctrl_enter();
  const auto logged = [&](const std::string& part) {
    return eventually([&] { return guarded_.log().find(part) != std::string::npos; }, longest_wait);
  };
  ASSERT_TRUE(comes_true("!document.getElementById('motion').hidden"));
  EXPECT_TRUE(logged("/image\" status=200"));
  browser().click("#cancel");
  EXPECT_TRUE(logged("DELETE /jobs/")) << guarded_.log();
  EXPECT_EQ(guarded_.log().find("/events\" status=401"), std::string::npos) << guarded_.log();
}

}  // namespace
}  // namespace raytracer::test
