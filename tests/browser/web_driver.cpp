#include "tests/browser/web_driver.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <chrono>
#include <csignal>
#include <initializer_list>
#include <regex>
#include <stdexcept>
#include <utility>

#include "tests/process/patience.h"

namespace raytracer::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using namespace std::chrono_literals;

fs::path first_that_exists(const char* what, std::initializer_list<const char*> places) {
  for (const char* const place : places)
    if (fs::exists(place)) return place;
  throw std::runtime_error(
      fmt::format("there is no {} in {}. Debian: apt-get install chromium chromium-driver; macOS: "
                  "brew install --cask google-chrome chromedriver",
                  what, fmt::join(places, ", ")));
}

fs::path find_driver() {
  return first_that_exists("chromedriver",
                           {"/usr/bin/chromedriver", "/usr/lib/chromium-browser/chromedriver",
                            "/opt/homebrew/bin/chromedriver", "/usr/local/bin/chromedriver"});
}

fs::path find_browser() {
  return first_that_exists(
      "Chromium", {"/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome",
                   "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
                   "/Applications/Chromium.app/Contents/MacOS/Chromium"});
}

std::string decode_base64(const std::string& text) {
  std::string bytes(text.size() / 4 * 3, '\0');
  const int length = EVP_DecodeBlock(reinterpret_cast<unsigned char*>(bytes.data()),
                                     reinterpret_cast<const unsigned char*>(text.data()),
                                     static_cast<int>(text.size()));
  if (length < 0) throw std::runtime_error("the screenshot is not base64");
  // EVP_DecodeBlock counts the padding's zeros in.
  const std::size_t padding = text.ends_with("==") ? 2 : text.ends_with('=') ? 1 : 0;
  bytes.resize(static_cast<std::size_t>(length) - padding);
  return bytes;
}

json capabilities(const fs::path& profile, const fs::path& downloads) {
  const json arguments{"--headless=new",
                       "--no-sandbox",  // tests also run as root, in containers
                       "--disable-gpu",
                       "--disable-quic",
                       "--no-first-run",
                       "--disable-background-networking",
                       "--disable-component-update",
                       "--disable-sync",
                       "--disable-dev-shm-usage",
                       "--remote-debugging-pipe",  // the browser ends with its driver
                       "--force-device-scale-factor=1",
                       "--window-size=1280,900",
                       "--user-data-dir=" + profile.string()};
  const json preferences{{"download.default_directory", downloads.string()},
                         {"download.prompt_for_download", false}};
  return {{"browserName", "chrome"},
          {"timeouts", {{"script", nullptr}}},  // each says itself how long it waits
          {"goog:chromeOptions",
           {{"binary", find_browser().string()},
            {"args", arguments},
            {"prefs", preferences},
            {"excludeSwitches", {"enable-automation"}}}},
          {"goog:loggingPrefs", {{"browser", "ALL"}}}};
}

}  // namespace

WebDriver::WebDriver() {
  // The driver takes a free port of IPv6 and fails if IPv4's of that number is in use, which other
  // tests' connections may be.
  constexpr int most_attempts = 8;
  int port = 0;
  for (int attempt = 0; port == 0; ++attempt) {
    if (attempt == most_attempts)
      throw std::runtime_error("chromedriver does not start: " + driver_->out() + driver_->err());
    port = start();
  }
  http_ = std::make_unique<httplib::Client>("127.0.0.1", port);
  http_->set_read_timeout(patience(90s));  // longer than any script waits
  http_->set_keep_alive(true);
  http_->set_tcp_nodelay(true);  // a body goes apart from its header, and would wait 40 ms
  const json session = command(
      "POST", "/session",
      {{"capabilities", {{"alwaysMatch", capabilities(profile_.path(), downloads_.path())}}}});
  session_ = "/session/" + session.at("sessionId").get<std::string>();
}

int WebDriver::start() {
  static const std::regex greeting(R"(started successfully on port (\d+))");
  driver_ = std::make_unique<Process>(
      Command{find_driver(), {"--port=0"}, "", {{"HOME", profile_.path()}}});
  int port = 0;
  eventually(
      [&] {
        std::smatch match;
        const std::string said = driver_->out();
        if (std::regex_search(said, match, greeting)) port = std::stoi(match[1]);
        return port != 0 || driver_->wait(0ms).has_value();
      },
      20s);
  return port;
}

WebDriver::~WebDriver() {
  if (http_ && !session_.empty()) http_->Delete(session_);  // ends the browser
  driver_->signal(SIGTERM);
  driver_->wait(5s);
}

json WebDriver::command(const std::string& method, const std::string& path, const json& body) {
  httplib::Request request;
  request.method = method;
  request.path = path;
  if (method == "POST") {
    request.headers.emplace("Content-Type", "application/json");
    request.body = body.dump();
  }
  const httplib::Result answer = http_->send(request);
  if (!answer)
    throw std::runtime_error(fmt::format("chromedriver does not answer {} ({}):\n{}", path,
                                         httplib::to_string(answer.error()), driver_->out()));
  json value = json::parse(answer->body).at("value");
  if (answer->status != 200)
    throw std::runtime_error(fmt::format("{} {}: {}", method, path, value.value("message", "")));
  return value;
}

void WebDriver::open(const std::string& url) {
  command("POST", session_ + "/url", {{"url", url}});
  run("performance.setResourceTimingBufferSize(100000)");
}

void WebDriver::change_tab() {
  const json tab = command("POST", session_ + "/window/new", {{"type", "tab"}}).at("handle");
  command("DELETE", session_ + "/window");
  command("POST", session_ + "/window", {{"handle", tab}});
  is_changed_ = false;
}

json WebDriver::run(const std::string& script) {
  return command("POST", session_ + "/execute/sync", {{"script", script}, {"args", json::array()}});
}

json WebDriver::run_until_called(const std::string& script) {
  return command("POST", session_ + "/execute/async",
                 {{"script", script}, {"args", json::array()}});
}

std::string WebDriver::element(const std::string& selector) {
  const json found =
      command("POST", session_ + "/element", {{"using", "css selector"}, {"value", selector}});
  return session_ + "/element/" + found.begin().value().get<std::string>();
}

void WebDriver::click(const std::string& selector) {
  command("POST", element(selector) + "/click");
}

void WebDriver::drag(std::array<int, 2> from, std::array<int, 2> to) {
  const auto move = [](std::array<int, 2> place, int duration_ms) {
    return json{
        {"type", "pointerMove"}, {"x", place[0]}, {"y", place[1]}, {"duration", duration_ms}};
  };
  const json steps{move(from, 0),
                   {{"type", "pointerDown"}, {"button", 0}},
                   move(to, 300),
                   {{"type", "pointerUp"}, {"button", 0}}};
  const json mouse{{"type", "pointer"},
                   {"id", "mouse"},
                   {"parameters", {{"pointerType", "mouse"}}},
                   {"actions", steps}};
  command("POST", session_ + "/actions", {{"actions", json::array({mouse})}});
}

void WebDriver::type(const std::string& selector, const std::string& keys) {
  command("POST", element(selector) + "/value", {{"text", keys}});
}

void WebDriver::press(const std::string& key, int count) {
  json steps = json::array();
  for (int i = 0; i < count; ++i)
    for (const char* const type : {"keyDown", "keyUp"})
      steps.push_back({{"type", type}, {"value", key}});
  const json keyboard{{"type", "key"}, {"id", "keyboard"}, {"actions", steps}};
  command("POST", session_ + "/actions", {{"actions", json::array({keyboard})}});
}

std::string WebDriver::screenshot() {
  return decode_base64(command("GET", session_ + "/screenshot").get<std::string>());
}

void WebDriver::devtools(const std::string& method, const json& parameters) {
  is_changed_ = true;
  command("POST", session_ + "/goog/cdp/execute", {{"cmd", method}, {"params", parameters}});
}

void WebDriver::resize(int width, int height) {
  devtools("Emulation.setDeviceMetricsOverride",
           {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", false}});
}

void WebDriver::prefer_dark(bool dark) {
  const json feature{{"name", "prefers-color-scheme"}, {"value", dark ? "dark" : "light"}};
  devtools("Emulation.setEmulatedMedia", {{"features", json::array({feature})}});
}

void WebDriver::drop(const fs::path& file) {
  const json data{{"items", json::array()},
                  {"files", json::array({file.string()})},
                  {"dragOperationsMask", 1}};  // copy
  for (const char* const type : {"dragEnter", "dragOver", "drop"})
    devtools("Input.dispatchDragEvent", {{"type", type}, {"x", 400}, {"y", 300}, {"data", data}});
}

std::vector<json> WebDriver::console() {
  return command("POST", session_ + "/se/log", {{"type", "browser"}}).get<std::vector<json>>();
}

std::vector<std::string> WebDriver::requested() {
  return run(R"(const timings = performance.getEntriesByType('resource');
                performance.clearResourceTimings();
                return timings.map((timing) => timing.name);)");
}

}  // namespace raytracer::test
