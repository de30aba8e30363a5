// The page loads by itself, from its own server alone, and shows a picture without being asked.
#include <gtest/gtest.h>

#include <csignal>
#include <string>
#include <vector>

#include "tests/browser/browser_page.h"

namespace raytracer::test {
namespace {

class Loading : public BrowserPage {};

TEST_F(Loading, demo_is_rendered_without_being_asked) {
  open();
  EXPECT_EQ(value("document.getElementById('picture').naturalWidth"), 700);
  EXPECT_EQ(value("document.getElementById('picture').naturalHeight"), 500);
  EXPECT_EQ(value("document.getElementById('scene-select').value"), "demo");
  const std::string text = value("document.getElementById('editor').value");
  EXPECT_NE(text.find("\"Demo\""), std::string::npos);
  keep_screenshot("page");
}

TEST_F(Loading, console_stays_empty) {
  open();
  for (const nlohmann::json& entry : browser().console()) ADD_FAILURE() << entry.dump(2);
}

TEST_F(Loading, nothing_is_asked_of_other_servers) {
  open();
  int own_count = 0;
  for (const std::string& address : browser().requested()) {
    const bool is_own = address.starts_with(server().url() + "/");
    own_count += is_own;
    EXPECT_TRUE(is_own || address.starts_with("blob:" + server().url()) ||
                address.starts_with("data:") || address == "about:blank")
        << address;
  }
  EXPECT_GE(own_count, 4) << "the log of requests is empty or short";
}

TEST_F(Loading, every_scene_can_be_chosen) {
  open();
  const std::vector<std::string> names =
      value("[...document.getElementById('scene-select').options].map((option) => option.value)");
  EXPECT_GE(names.size(), 10U);
  const auto listed = nlohmann::json::parse(server().client().Get("/scenes")->body);
  EXPECT_EQ(names.size(), listed.at("scenes").size());
}

TEST_F(Loading, chosen_scene_is_rendered) {
  open();
  const std::string former = picture();
  browser().run(
      "const select = document.getElementById('scene-select'); select.value = 'first-sphere';"
      "select.dispatchEvent(new Event('change', { bubbles: true }));");
  await("done", former);
  const std::string text = value("document.getElementById('editor').value");
  EXPECT_NE(text.find("\"First sphere\""), std::string::npos);
}

TEST_F(Loading, address_names_the_scene) {
  open("/#scene=first-sphere");
  EXPECT_EQ(value("document.getElementById('scene-select').value"), "first-sphere");
  const std::string text = value("document.getElementById('editor').value");
  EXPECT_NE(text.find("\"First sphere\""), std::string::npos);
}

/// The scene that the page names, in the chooser, its description and the address.
const std::string named =
    "[document.getElementById('scene-select').value,"
    " document.getElementById('scene-about').textContent, location.hash]";

TEST_F(Loading, scene_that_does_not_come_leaves_the_one_before_and_its_name) {
  open();
  const nlohmann::json before = value(named);
  const std::string former = text();
  browser().run("location.hash = 'scene=nope'");
  await("error");
  EXPECT_EQ(value(named), before);
  EXPECT_EQ(text(), former);

  browser().click("#render");
  await("done");
  server().signal(SIGKILL);
  browser().run(
      "const select = document.getElementById('scene-select'); select.value = 'glass';"
      "select.dispatchEvent(new Event('change', { bubbles: true }));");
  await("error");
  EXPECT_EQ(value(named), before);
  EXPECT_EQ(text(), former);
  SetUpTestSuite();  // another one, for whichever test follows
}

TEST_F(Loading, nothing_is_offered_to_be_done_with_a_scene_that_is_not_there) {
  open_in_new_tab(server().url() + "/#scene=nope");
  await("error");
  const std::string offered =
      "['share', 'curl', 'compare', 'measure', 'undo', 'redo'].filter("
      "(id) => !document.getElementById(id).disabled)";
  EXPECT_EQ(value(offered), std::vector<std::string>{});
  EXPECT_EQ(value("document.getElementById('scene-select').selectedIndex"), -1);
  EXPECT_EQ(value("document.getElementById('scene-about').textContent"), "");
  const std::string before = text();
  browser().run("document.documentElement.dataset.state = ''");
  choose_accuracy(1);
  await("error");
  const std::string said = value("document.getElementById('problem').innerText");
  EXPECT_NE(said.find("nope"), std::string::npos) << said;
  browser().run("location.hash = 'scene=first-sphere'");
  await("done");
  EXPECT_EQ(value(offered), (std::vector<std::string>{"share", "curl", "compare", "measure"}));
}

TEST_F(Loading, scene_that_a_hand_does_not_wait_for_is_not_named) {
  open();
  const nlohmann::json before = value(named);
  browser().run(
      "const { fetch } = window;"
      "window.fetch = (address, request) => /scenes.glass/.test(address) ?"
      "  new Promise((resolve, reject) => {"
      "    request.signal.onabort = () => reject(request.signal.reason); window.isAsked = true;"
      "  }) : fetch(address, request);"
      "location.hash = 'scene=glass';");
  ASSERT_TRUE(comes_true("window.isAsked"));
  choose_accuracy(0);
  await("done");
  EXPECT_EQ(value(named), before);
}

TEST_F(Loading, picture_that_several_rendered_says_so) {
  open();
  const char* const facts = "document.getElementById('facts').innerText";
  EXPECT_EQ(value(facts).get<std::string>().find("worker"), std::string::npos) << value(facts);
  browser().run(R"(
    window.fetch = ((ask) => async (...request) => {
      const answer = await ask(...request);
      const get = answer.headers.get.bind(answer.headers);
      answer.headers.get = (name) => ({ "Render-Tasks": "12", "Render-Workers": "1" })[name] ?? get(name);
      return answer;
    })(window.fetch);)");
  const std::string former = picture();
  choose_accuracy(4);
  await("done", former);
  EXPECT_NE(value(facts).get<std::string>().find("12 tasks by 1 worker"), std::string::npos)
      << value(facts);
}

TEST_F(Loading, times_of_the_stages_are_shown) {
  open("/#scene=demo&samples=2");  // which is in no cache
  const std::string timings = value("document.getElementById('timings').innerText");
  for (const char* const stage : {"queue", "parse", "plan", "build", "trace", "encode"})
    EXPECT_NE(timings.find(stage), std::string::npos) << timings;
  EXPECT_EQ(value("document.getElementById('timings').hidden"), false);
  EXPECT_NE(value("document.getElementById('status').textContent"), "");
}

}  // namespace
}  // namespace raytracer::test
