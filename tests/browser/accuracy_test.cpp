// One control from instant to exact: what it asks for, what was predicted, what came true.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/browser/browser_page.h"

namespace raytracer::test {
namespace {

class Accuracy : public BrowserPage {
 protected:
  void SetUp() override { open("/#scene=first-sphere"); }

  static std::string cell(const std::string& row, const std::string& what) {
    return value("document.querySelector('[data-row=\"" + row + "\"] [data-is=\"" + what +
                 "\"]').textContent");
  }

  static bool was_asked(const std::string& request, const std::string& parameter) {
    for (const std::string& address : browser().requested())
      if (address.find(request) != std::string::npos &&
          address.find(parameter) != std::string::npos)
        return true;
    return false;
  }
};

TEST_F(Accuracy, stands_over_the_document) {
  browser().requested();
  std::string former = picture();
  choose_accuracy(0);
  await("done", former);
  EXPECT_TRUE(was_asked("/render?", "budget_ms="));
  former = picture();
  choose_accuracy(3);
  await("done", former);
  EXPECT_TRUE(was_asked("/render?", "target_rmse=0.01"));
  former = picture();
  browser().click("#as-written");
  await("done", former);
  EXPECT_TRUE(was_asked("/render?scene=first-sphere", ""));
}

TEST_F(Accuracy, stands_at_the_step_that_a_link_asks_for) {
  open("/#scene=first-sphere&target_rmse=0.001");
  EXPECT_EQ(value("document.getElementById('accuracy').value"), "6");
  EXPECT_EQ(value("document.getElementById('accuracy-says').textContent"), "Finer: error 0.001");
}

TEST_F(Accuracy, prediction_stands_beside_what_came_true) {
  const std::string former = picture();
  choose_accuracy(4);  // no test before has it in the cache
  await("done", former);
  EXPECT_NE(cell("predicted", "trace_ms").find("ms"), std::string::npos);
  EXPECT_NE(cell("predicted", "error"), "–");
  EXPECT_NE(cell("measured", "trace_ms").find("ms"), std::string::npos);
  EXPECT_NE(cell("measured", "samples"), "–");
}

TEST_F(Accuracy, picture_from_the_cache_has_no_time_of_tracing) {
  for (const bool is_new : {true, false}) {
    open("/#scene=first-sphere&samples=3");
    const std::string traced = cell("measured", "trace_ms");
    const std::string status = value("document.getElementById('status').textContent");
    const std::string facts = value("document.getElementById('facts').textContent");
    const std::string stages = value("document.getElementById('timings').textContent");
    EXPECT_EQ(traced == "cached", !is_new) << traced;
    EXPECT_EQ(status.starts_with("From the cache in"), !is_new) << status;
    EXPECT_EQ(facts.find("server's cache") != std::string::npos, !is_new) << facts;
    EXPECT_EQ(stages.find("trace") == std::string::npos, !is_new) << stages;
    EXPECT_NE(cell("measured", "error"), "–");
  }
}

TEST_F(Accuracy, plan_is_said_in_words) {
  show_panel("plan");
  const std::string said = value("document.getElementById('plan').innerText");
  for (const char* const part : {"Expected", "Precision", "Geometry", "Sampling"})
    EXPECT_NE(said.find(part), std::string::npos) << said;
  keep_screenshot("plan");
}

}  // namespace
}  // namespace raytracer::test
