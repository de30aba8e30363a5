// At rest the picture is refined: what takes long is a job, seen as it comes, and ended when nobody
// waits for it any more.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <string>

#include "tests/browser/browser_page.h"
#include "tests/process/endless_scene.h"
#include "tests/process/patience.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {
namespace {

std::string scene_of_width(int width_px) {
  std::string text = endless_scene();
  const std::string size = "\"width\": 2000, \"height\": 2000";
  text.replace(text.find(size), size.size(),
               fmt::format("\"width\": {}, \"height\": {}", width_px, width_px * 2 / 3));
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

  static bool was_ended(int former_count) {
    return eventually([&] { return ended_count() > former_count; }, longest_wait);
  }
  static bool no_job_runs() {
    return eventually([] { return running_jobs() == 0; }, longest_wait);
  }

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
    ASSERT_TRUE(comes_true("!document.getElementById('motion').hidden"));
    ASSERT_TRUE(eventually([] { return running_jobs() == 1; }, longest_wait)) << server().log();
  }

  /// The width at which the server predicts so much tracing, in this build and on this machine: the
  /// page takes its word for what is a job, and beside other tests it takes a few times as long.
  static int long_width_px() {
    constexpr double long_ms = 1500;
    constexpr int tried_px = 300;
    const httplib::Result plan =
        server().client().Post("/plan", scene_of_width(tried_px), "application/json");
    const double predicted_ms =
        nlohmann::json::parse(plan->body).at("prediction").at("trace_ms").get<double>();
    return static_cast<int>(tried_px * std::sqrt(long_ms / predicted_ms));
  }

  /// The addresses that a render takes that is worth a job, from the click to the last picture.
  static std::vector<std::string> requested_for_long_scene(int width_px) {
    const std::string former = picture();
    browser().requested();
    render(scene_of_width(width_px));
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
  const int width_px = long_width_px();
  const std::vector<std::string> addresses = requested_for_long_scene(width_px);
  EXPECT_EQ(count(addresses, "/jobs\\?task=render&scene="), 1);
  EXPECT_EQ(count(addresses, "/jobs/[^/]+/events$"), 1);
  EXPECT_GE(count(addresses, "/jobs/[^/]+/image$"), 2) << "on the way, and at the end";
  EXPECT_EQ(count(addresses, "/jobs/[^/]+$"), 1) << "one DELETE, and it was not asked for";
  EXPECT_EQ(value("document.getElementById('picture').naturalWidth"), width_px);
  EXPECT_TRUE(was_ended(ended)) << server().log();
  for (const nlohmann::json& entry : browser().console()) ADD_FAILURE() << entry.dump(2);
}

TEST_F(Refine, job_without_events_is_asked_for) {
  browser().run(
      "const { fetch } = window; window.fetch = (address, ...rest) =>"
      " /events$/.test(address) ? Promise.reject(new TypeError('no events')) : fetch(address, "
      "...rest);");
  const std::vector<std::string> addresses = requested_for_long_scene(long_width_px());
  EXPECT_EQ(count(addresses, "/events$"), 0);
  EXPECT_GE(count(addresses, "/jobs/[^/]+$"), 3);
}

TEST_F(Refine, movement_ends_the_job) {
  begin_endless();
  const int ended = ended_count();
  browser().type("#board", "\xee\x80\x92");  // arrow left
  EXPECT_TRUE(was_ended(ended)) << server().log();
  // Ends the next one. A page that is left while it asks for a job knows none to end.
  ASSERT_TRUE(comes_true("!document.getElementById('cancel').hidden"));
  browser().click("#cancel");
  EXPECT_TRUE(no_job_runs()) << server().log();
}

TEST_F(Refine, cancel_ends_the_job_and_brings_no_picture) {
  const std::string former = picture();
  begin_endless();
  keep_screenshot("refining");

  // What is said meanwhile stays.
  const TemporaryFolder folder;
  browser().drop(folder.write("water.pdb", "END\n"));
  ASSERT_TRUE(comes_true("!document.getElementById('problem').hidden"));
  browser().run("window.before = document.getElementById('elapsed').textContent");
  ASSERT_TRUE(comes_true("document.getElementById('elapsed').textContent !== window.before"));
  EXPECT_EQ(value("document.getElementById('problem').hidden"), false);

  browser().click("#cancel");
  EXPECT_TRUE(no_job_runs()) << server().log();
  EXPECT_EQ(state(), "done");
  EXPECT_EQ(picture(), former);
  EXPECT_EQ(value("document.getElementById('motion').hidden"), true) << "the picture is in sight";
  EXPECT_EQ(value("document.getElementById('dated').hidden"), false);
}

TEST_F(Refine, leaving_the_page_ends_the_job) {
  begin_endless();
  browser().open("about:blank");
  EXPECT_TRUE(no_job_runs()) << server().log();
}

/// Its decoding ends when the picture that was asked for instead is in sight.
TEST_F(Refine, picture_that_was_replaced_while_it_was_decoded_is_not_shown) {
  browser().run(
      "const decode = Image.prototype.decode;"
      "Image.prototype.decode = function () {"
      "  Image.prototype.decode = decode;"
      "  return new Promise((resolve) => { window.endDecoding = resolve; })"
      "    .then(() => decode.call(this)).finally(() => { window.isDecoded = true; });"
      "};");
  render(page_scene);
  ASSERT_TRUE(comes_true("window.endDecoding !== undefined"));
  const std::string former = picture();
  render(scene_of_width(30));
  await("done", former);
  const std::string shown = picture();
  browser().run("window.endDecoding()");
  ASSERT_TRUE(comes_true("window.isDecoded"));
  EXPECT_EQ(value("new Promise((resolve) => setTimeout(resolve)).then("
                  "() => document.getElementById('picture').src)"),
            shown);
}

}  // namespace
}  // namespace raytracer::test
