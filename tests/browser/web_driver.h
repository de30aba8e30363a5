// A browser under remote control: the part of the WebDriver protocol (W3C) that the tests use,
// spoken with chromedriver.
#pragma once

#include <httplib.h>

#include <array>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "tests/process/program.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {

/// Keys as WebDriver writes them.
inline constexpr const char* key_control = "\xee\x80\x89";
inline constexpr const char* key_enter = "\xee\x80\x87";
inline constexpr const char* key_release = "\xee\x80\x80";  ///< of all modifiers

/// One headless browser with one window, a new profile, and no network but what the page asks for.
/// Every function throws std::runtime_error with the driver's own words if it fails.
class WebDriver {
 public:
  /// Throws std::runtime_error that names the packages if there is no browser or no driver.
  WebDriver();
  ~WebDriver();
  WebDriver(const WebDriver&) = delete;
  WebDriver& operator=(const WebDriver&) = delete;

  /// Where files go that are downloaded, without a question.
  const std::filesystem::path& downloads() const { return downloads_.path(); }

  void open(const std::string& url);
  /// An empty tab in place of the one before: nothing of that is left, such as what it kept or how
  /// large a screen it was told to be.
  void change_tab();
  /// Whether the tab has another size, other media or the like than a new one.
  bool is_changed() const { return is_changed_; }
  /// What `return ...;` in the function body `script` gives.
  nlohmann::json run(const std::string& script);
  /// What the function body `script` gives to the callback that is its last argument.
  nlohmann::json run_until_called(const std::string& script);
  void click(const std::string& selector);
  /// A mouse goes to `from`, is pressed, goes to `to` and is released; CSS pixels of the window.
  void drag(std::array<int, 2> from, std::array<int, 2> to);
  /// A file manager's file is dragged to the middle of the window and dropped.
  void drop(const std::filesystem::path& file);
  /// Presses keys in the element.
  void type(const std::string& selector, const std::string& keys);
  /// Presses and releases a key wherever the focus is, as a keyboard does, so many times.
  void press(const std::string& key, int count = 1);
  /// A PNG of the window.
  std::string screenshot();
  /// Pretends to be a screen of this size, in CSS pixels.
  void resize(int width, int height);

  /// Pretends that the person has asked for dark colours, or for light ones.
  void prefer_dark(bool dark);

  /// Entries of the console since the last call: {"level", "message", ...}.
  std::vector<nlohmann::json> console();
  /// The addresses that the page asked for since the last call, of what has been answered or has
  /// failed.
  std::vector<std::string> requested();

 private:
  /// Starts the driver anew; its port, or 0 if it has ended.
  int start();
  nlohmann::json command(const std::string& method, const std::string& path,
                         const nlohmann::json& body = nlohmann::json::object());
  std::string element(const std::string& selector);
  /// A method of the Chrome DevTools Protocol.
  void devtools(const std::string& method, const nlohmann::json& parameters);

  TemporaryFolder profile_;
  TemporaryFolder downloads_;
  std::unique_ptr<Process> driver_;
  std::unique_ptr<httplib::Client> http_;
  std::string session_;  ///< "/session/ID"
  bool is_changed_ = false;
};

}  // namespace raytracer::test
