// A server that has too much to do: the page says so, waits as long as it is told, and tries again.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/browser/browser_page.h"
#include "tests/process/endless_scene.h"
#include "tests/process/patience.h"

namespace raytracer::test {
namespace {

class Busy : public BrowserPage {
 protected:
  void SetUp() override {
    open_in_new_tab(busy_.url());
    await("done");
    occupy();
    former_ = picture();
    choose_accuracy(4);
    ASSERT_TRUE(
        comes_true("/busy: again in \\d+ s/.test(document.getElementById('status').textContent)"));
  }

  /// Starts endless jobs until there is no place for another.
  void occupy() {
    httplib::Client client = busy_.client();
    for (;;) {
      const httplib::Result job = client.Post("/jobs", endless_scene(), "application/json");
      if (job->status == 429) return;
      ASSERT_EQ(job->status, 202) << job->body;
      jobs_.push_back(job->get_header_value("Location"));
    }
  }

  void free() {
    for (const std::string& job : jobs_) EXPECT_EQ(busy_.client().Delete(job)->status, 204);
  }

  /// Requests of the page that were refused so far.
  int refused_count() const {
    int count = 0;
    const std::string log = busy_.log();
    const std::string wanted = "status=429";
    for (std::size_t at = log.find(wanted); at != log.npos; at = log.find(wanted, at + 1)) ++count;
    return count - 1;  // without that of occupy()
  }

  const ServerProcess busy_{{"--max-queue", "1"}};
  std::vector<std::string> jobs_;
  std::string former_;
};

TEST_F(Busy, server_is_asked_again_until_it_has_time) {
  keep_screenshot("busy");
  EXPECT_TRUE(eventually([&] { return refused_count() >= 2; }, longest_wait)) << busy_.log();
  free();
  await("done", former_);
  const std::string said = value("document.getElementById('status').textContent");
  EXPECT_EQ(said.find("busy"), std::string::npos) << said;
}

TEST_F(Busy, waiting_can_be_cancelled) {
  ASSERT_TRUE(comes_true("!document.getElementById('cancel').hidden"));
  browser().click("#cancel");
  EXPECT_EQ(state(), "done");
  EXPECT_TRUE(comes_true("document.getElementById('status').textContent === 'Cancelled'"));
  free();
  EXPECT_EQ(picture(), former_);
}

TEST_F(Busy, server_that_stays_so_is_given_up) {
  browser().run(
      "window.setTimeout = ((wait) => (work, ms) => wait(work, ms >= 1000 ? 5 : ms))(setTimeout);");
  await("error");
  EXPECT_GE(refused_count(), 4);
  EXPECT_LE(refused_count(), 8);
  const std::string said = value("document.getElementById('problem').innerText");
  EXPECT_NE(said.find("--max-queue"), std::string::npos) << said;
}

}  // namespace
}  // namespace raytracer::test
