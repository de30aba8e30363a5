// The page, opened in a browser from a running server: what every test of it stands on.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <string_view>

#include "tests/browser/web_driver.h"
#include "tests/process/server_process.h"

namespace raytracer::test {

/// The one browser of all tests: it takes longer to start than a test takes. It ends with the
/// program.
WebDriver& shared_browser();

/// One server for all tests of a suite; the page is loaded anew for each.
class BrowserPage : public testing::Test {
 protected:
  /// Only a failure lasts so long: what is waited for takes a second, or some beside other tests.
  static constexpr std::chrono::milliseconds longest_wait{60'000};

  static void SetUpTestSuite();
  static void TearDownTestSuite();

  static const ServerProcess& server() { return *shared_server; }
  static WebDriver& browser() { return shared_browser(); }
  /// The bytes of the file of that name once it is downloaded; it is gone then, and its name free.
  /// Fails the test if it does not come.
  static std::string downloaded(const std::string& name);

  /// Opens the page, `address` behind the server's, in a tab without a past, and waits for its
  /// first picture.
  static void open(const std::string& address = "/");
  /// Opens any page, and does not wait.
  static void open_in_new_tab(const std::string& url);

  /// "loading", "moving", "rendering", "done" or "error".
  static std::string state();
  /// Whether `expression` becomes true in the page, which watches it by itself: asking from here
  /// again and again would take the time of what is waited for.
  static bool comes_true(const std::string& expression);
  /// Waits until the state is `state` and the picture another than `former`, if that is given.
  static void await(const std::string& state, const std::string& former = "");
  /// The address of the picture in sight; every picture has its own.
  static std::string picture();
  /// What `expression` is in the page.
  static nlohmann::json value(const std::string& expression);

  /// Shows one of the scene's panels: "form", "json" or "plan".
  static void show_panel(const std::string& name);
  /// The scene's text.
  static std::string text();
  /// Moves the accuracy's control to one of its steps, from 0.
  static void choose_accuracy(int step);

  /// Puts another text into the editor, as a paste would.
  static void edit(const std::string& text);
  /// Presses Ctrl+Enter in the editor.
  static void press_ctrl_enter();

  /// Leaves NAME.png in the build for people.
  static void keep_screenshot(const std::string& name);

 private:
  static std::unique_ptr<ServerProcess> shared_server;
};

/// A small valid scene of 60 x 40 pixels.
extern const std::string page_scene;

/// For comes_true(): every scene of the gallery is seen.
inline const std::string gallery_has_pictures =
    "[...document.querySelectorAll('#gallery img')].every((each) => each.naturalWidth > 0)";

}  // namespace raytracer::test
