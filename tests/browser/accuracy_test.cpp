// One control from instant to exact: what it asks for, what was foreseen, what came true.
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

TEST_F(Accuracy, prediction_stands_beside_what_came_true) {
  const std::string former = picture();
  choose_accuracy(3);
  await("done", former);
  EXPECT_NE(cell("foreseen", "trace_ms").find("ms"), std::string::npos);
  EXPECT_NE(cell("foreseen", "error"), "–");
  EXPECT_NE(cell("measured", "trace_ms").find("ms"), std::string::npos);
  EXPECT_NE(cell("measured", "samples"), "–");
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
