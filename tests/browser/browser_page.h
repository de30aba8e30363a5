// The page, opened in a browser from a running server: what every test of it stands on.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <string_view>

#include "tests/browser/web_driver.h"
#include "tests/process/server_process.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {

/// One server and one browser for all tests of a suite; the page is loaded anew for each.
class BrowserPage : public testing::Test {
 protected:
  static void SetUpTestSuite();
  static void TearDownTestSuite();

  static const ServerProcess& server() { return *shared_server; }
  static WebDriver& browser() { return *shared_browser; }
  /// The bytes of the file of that name once it is downloaded; it is gone then, and its name free.
  /// Fails the test if it does not come.
  static std::string downloaded(const std::string& name);

  /// Opens the page, `address` behind the server's, and waits for its first picture.
  static void open(const std::string& address = "/");

  /// "loading", "moving", "rendering", "done" or "error".
  static std::string state();
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
  static std::unique_ptr<TemporaryFolder> shared_downloads;
  static std::unique_ptr<WebDriver> shared_browser;
};

/// A small valid scene of 60 x 40 pixels.
extern const std::string page_scene;

}  // namespace raytracer::test
