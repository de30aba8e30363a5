#include "tests/browser/browser_page.h"

#include <fmt/format.h>

#include <fstream>
#include <system_error>

#include "tests/process/patience.h"

namespace raytracer::test {

using namespace std::chrono_literals;

std::unique_ptr<ServerProcess> BrowserPage::shared_server;

const std::string page_scene = R"({
  "camera": {"origin": [0, 0, -5], "look_at": [0, 0, 0], "fov": 0.9, "width": 60, "height": 40},
  "background": [0, 0, 1],
  "objects": [{"type": "sphere", "center": [0, 0, 0], "radius": 1}]
})";

WebDriver& shared_browser() {
  static WebDriver browser;
  return browser;
}

void BrowserPage::SetUpTestSuite() { shared_server = std::make_unique<ServerProcess>(); }

void BrowserPage::TearDownTestSuite() {
  shared_browser().open("about:blank");  // nothing of the page asks a server that is gone
  shared_server.reset();
}

std::string BrowserPage::downloaded(const std::string& name) {
  const std::filesystem::path file = browser().downloads() / name;
  // The browser reserves the name with an empty file.
  const bool came = eventually(
      [&] {
        std::error_code error;
        const auto size = std::filesystem::file_size(file, error);
        return !error && size > 0;
      },
      longest_wait);
  EXPECT_TRUE(came) << name << " was not downloaded";
  if (!came) return {};
  std::string bytes = read_file(file);
  std::filesystem::remove(file);
  return bytes;
}

void BrowserPage::open_in_new_tab(const std::string& url) {
  browser().change_tab();
  browser().console();  // forgets what was before
  browser().open(url);
}

/// A tab takes the browser longer to open than a page.
void BrowserPage::open(const std::string& address) {
  if (browser().is_changed()) {
    open_in_new_tab(server().url() + address);
  } else {
    browser().open(server().url() + "/healthz");  // what is no page, in whose place it may
    browser().run("sessionStorage.clear()");
    browser().console();
    browser().open(server().url() + address);
  }
  await("done");
}

nlohmann::json BrowserPage::value(const std::string& expression) {
  return browser().run("return " + expression + ";");
}

std::string BrowserPage::state() { return value("document.documentElement.dataset.state"); }

std::string BrowserPage::picture() { return value("document.getElementById('picture').src"); }

bool BrowserPage::comes_true(const std::string& expression) {
  constexpr auto between_looks = 10ms;
  return browser().run_until_called(fmt::format(
      R"(const tell = arguments[0];
         const end_ms = performance.now() + {};
         const look = () => {{
           let holds = false;
           try {{
             holds = Boolean({});
           }} catch (error) {{
             return void tell(String(error));
           }}
           if (holds || performance.now() > end_ms) tell(holds);
           else setTimeout(look, {});
         }};
         look();)",
      patience(longest_wait).count(), expression, between_looks.count()));
}

void BrowserPage::await(const std::string& state, const std::string& former) {
  if (comes_true(fmt::format("document.documentElement.dataset.state === '{}' && "
                             "document.getElementById('picture').src !== '{}'",
                             state, former.empty() ? "none" : former)))
    return;
  keep_screenshot("stuck");
  FAIL() << "the page is in state \"" << BrowserPage::state() << "\" (\""
         << value("document.getElementById('status').textContent").get<std::string>()
         << "\"), not \"" << state << "\"; see stuck.png";
}

void BrowserPage::show_panel(const std::string& name) { browser().click("#tab-" + name); }

std::string BrowserPage::text() { return value("document.getElementById('editor').value"); }

void BrowserPage::choose_accuracy(int step) {
  browser().run(
      "const dial = document.getElementById('accuracy'); dial.value = " + std::to_string(step) +
      "; dial.dispatchEvent(new Event('input', { bubbles: true }));");
}

void BrowserPage::edit(const std::string& text) {
  browser().run(
      "const editor = document.getElementById('editor'); editor.focus(); editor.select();"
      "editor.dispatchEvent(new InputEvent('beforeinput', { inputType: 'insertFromPaste' }));"
      "editor.value = " +
      nlohmann::json(text).dump() +
      "; editor.dispatchEvent(new Event('input', { bubbles: true }));");
}

void BrowserPage::press_ctrl_enter() {
  browser().type("#editor", std::string(key_control) + key_enter + key_release);
}

void BrowserPage::keep_screenshot(const std::string& name) {
  std::ofstream file(std::filesystem::path(RAYTRACER_SCREENSHOT_DIR) / (name + ".png"),
                     std::ios::binary);
  file << browser().screenshot();
}

}  // namespace raytracer::test
