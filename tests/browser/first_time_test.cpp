// What the page asks of who sees it for the first time: its size, and the way to a picture of one's
// own.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>

#include "tests/browser/browser_page.h"

namespace raytracer::test {
namespace {

class FirstTime : public BrowserPage {};

TEST_F(FirstTime, one_drag_and_one_click_are_the_way_to_a_picture_of_ones_own) {
  const auto begin = std::chrono::steady_clock::now();
  open();
  const std::string former = picture();
  browser().click("label:has(#tool-move)");
  const nlohmann::json box = value(
      "(() => { const box = document.getElementById('board').getBoundingClientRect();"
      " return [box.left, box.top, box.width, box.height].map(Math.round); })()");
  const int left = box[0];
  const int top = box[1];
  const int width = box[2];
  const int height = box[3];
  browser().drag({left + width * 36 / 100, top + height * 33 / 100},
                 {left + width * 45 / 100, top + height / 4});
  await("done", former);
  browser().click("#download");
  EXPECT_FALSE(downloaded("demo.png").empty());
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  fmt::print(
      "from opening the page to a moved sphere and its picture as a file: {:.1f} s, a click "
      "on \"Move spheres\" (or Shift held), a drag, a click on \"Download PNG\"\n",
      took.count());
}

TEST_F(FirstTime, page_is_small) {
  open_in_new_tab(server().url());  // which has loaded nothing yet
  await("done");
  const nlohmann::json loaded = value(
      "(() => { const all = [...performance.getEntriesByType('navigation'),"
      " ...performance.getEntriesByType('resource')].filter((each) =>"
      " !/\\/(render|plan|scenes)/.test(new URL(each.name).pathname.replace('plan_panel', '')));"
      " return { count: all.length, bytes: all.reduce((sum, each) => sum + each.encodedBodySize, "
      "0) };"
      " })()");
  const double kilobytes = loaded.at("bytes").get<double>() / 1000;
  fmt::print("the page: {} requests, {:.1f} kB\n", loaded.at("count").get<int>(), kilobytes);
  EXPECT_LT(kilobytes, 150);
  EXPECT_GT(kilobytes, 30);
}

}  // namespace
}  // namespace raytracer::test
