// At rest the picture is refined: what takes long is a job, seen as it comes, and ended when nobody
// waits for it any more.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <regex>
#include <string>

#include "tests/browser/browser_page.h"
#include "tests/process/endless_scene.h"
#include "tests/process/patience.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

constexpr int long_width_px = speed_counts ? 1200 : 300;

/// Seconds instead of minutes.
std::string long_scene() {
  std::string text = endless_scene();
  const std::string size = "\"width\": 2000, \"height\": 2000";
  text.replace(text.find(size), size.size(),
               fmt::format("\"width\": {}, \"height\": {}", long_width_px, long_width_px / 3 * 2));
  return text;
}

class Refine : public BrowserPage {
 protected:
  void SetUp() override {
    open("/#scene=first-sphere");
    show_panel("json");
  }

  static void render(const std::string& document) {
    edit(document);
    press_ctrl_enter();
  }

  static int count(const std::vector<std::string>& addresses, const std::string& pattern) {
    int found = 0;
    for (const std::string& address : addresses)
      found += std::regex_search(address, std::regex(pattern));
    return found;
  }

  static bool was_ended(int former_count) { return ended_count() > former_count; }

  /// Jobs that the page has deleted so far.
  static int ended_count() {
    int found = 0;
    const std::string log = server().log();
    const std::string wanted = "DELETE /jobs/";
    for (std::size_t at = log.find(wanted); at != log.npos; at = log.find(wanted, at + 1)) ++found;
    return found;
  }

  /// Waits until the endless render runs and something of it is seen.
  static void begin_endless() {
    render(endless_scene());
    ASSERT_TRUE(eventually(
        [] { return running_jobs() == 1 && value("!document.getElementById('motion').hidden"); },
        30s))
        << server().log();
  }

  /// The addresses that its render takes, from the click to the last picture.
  static std::vector<std::string> requested_for_long_scene() {
    const std::string former = picture();
    browser().requested();
    render(long_scene());
    await("done", former);
    return browser().requested();
  }

  static int running_jobs() {
    const std::string metrics = server().client().Get("/metrics")->body;
    static const std::regex running("\nraytracer_jobs\\{[^}]*status=\"running\"[^}]*\\} (\\d+)");
    std::smatch match;
    EXPECT_TRUE(std::regex_search(metrics, match, running)) << metrics;
    return match.empty() ? -1 : std::stoi(match[1]);
  }
};

TEST_F(Refine, long_render_is_a_job_with_events_and_seen_as_it_comes) {
  const int ended = ended_count();
  const std::vector<std::string> addresses = requested_for_long_scene();
  EXPECT_EQ(count(addresses, "/jobs\\?task=render&scene="), 1);
  EXPECT_EQ(count(addresses, "/jobs/[^/]+/events$"), 1);
  EXPECT_GE(count(addresses, "/jobs/[^/]+/image$"), 2) << "on the way, and at the end";
  EXPECT_EQ(count(addresses, "/jobs/[^/]+$"), 1) << "one DELETE, and it was not asked for";
  EXPECT_EQ(value("document.getElementById('picture').naturalWidth"), long_width_px);
  EXPECT_TRUE(eventually([&] { return was_ended(ended); }, 5s)) << server().log();
  for (const nlohmann::json& entry : browser().console()) ADD_FAILURE() << entry.dump(2);
}

TEST_F(Refine, job_without_events_is_asked_for) {
  browser().run(
      "window.EventSource = class { constructor() { setTimeout(() => this.onerror()); }"
      " addEventListener() {} close() {} };");
  const std::vector<std::string> addresses = requested_for_long_scene();
  EXPECT_EQ(count(addresses, "/events$"), 0);
  EXPECT_GE(count(addresses, "/jobs/[^/]+$"), 3);
}

TEST_F(Refine, movement_ends_the_job) {
  begin_endless();
  const int ended = ended_count();
  browser().type("#board", "\xee\x80\x92");  // arrow left
  EXPECT_TRUE(eventually([&] { return was_ended(ended); }, 5s)) << server().log();
  EXPECT_TRUE(eventually([] { return state() == "rendering"; }, 10s)) << state();
  browser().open("about:blank");
}

TEST_F(Refine, cancel_ends_the_job_and_brings_no_picture) {
  const std::string former = picture();
  begin_endless();
  keep_screenshot("refining");
  browser().click("#cancel");
  EXPECT_TRUE(eventually([] { return running_jobs() == 0; }, 5s)) << server().log();
  EXPECT_EQ(state(), "done");
  EXPECT_EQ(picture(), former);
}

TEST_F(Refine, leaving_the_page_ends_the_job) {
  begin_endless();
  browser().open("about:blank");
  EXPECT_TRUE(eventually([] { return running_jobs() == 0; }, 5s)) << server().log();
}

}  // namespace
}  // namespace raytracer::test
