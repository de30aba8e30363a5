// Files dropped onto the page or opened in it: a scene document is shown, of any other it is said
// which command shows it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/browser/browser_page.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {
namespace {

class Files : public BrowserPage {
 protected:
  void SetUp() override { open("/#scene=first-sphere"); }

  /// The path of a file of this name.
  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    return folder_.write(name, bytes);
  }

  void drop(const std::string& name, const std::string& bytes) const {
    browser().drop(write(name, bytes));
  }

  static std::string says() { return value("document.getElementById('problem').innerText"); }

  /// Expects the page to say this and to stay as it is.
  static void expect_refusal(const std::string& words) {
    EXPECT_TRUE(comes_true("!document.getElementById('problem').hidden"));
    EXPECT_NE(says().find(words), std::string::npos) << says();
    EXPECT_EQ(state(), "done");
    EXPECT_NE(text().find("\"First sphere\""), std::string::npos);
  }

 private:
  const TemporaryFolder folder_;
};

TEST_F(Files, scene_document_is_opened) {
  const std::string former = picture();
  browser().click("#open-gallery");
  drop("mine.json", page_scene);
  await("done", former);
  EXPECT_EQ(value("document.getElementById('gallery').open"), false);
  EXPECT_EQ(text(), page_scene);
  EXPECT_EQ(value("document.getElementById('picture').naturalWidth"), 60);
  EXPECT_EQ(value("document.getElementById('scene-select').value"), "");
  EXPECT_EQ(value("location.hash"), "");
  keep_screenshot("dropped");
}

TEST_F(Files, scene_document_is_opened_from_the_gallery) {
  for (const char* const time : {"once", "again"}) {
    std::string former = picture();
    browser().click("#open-gallery");
    browser().run(fmt::format(
        "document.getElementById('file').click = () => {{ window.asked = '{}'; }}", time));
    browser().click("#open-file");
    EXPECT_EQ(value("window.asked"), time);
    browser().type("#file", write("mine.json", page_scene).string());
    await("done", former);
    EXPECT_EQ(value("document.getElementById('gallery').open"), false) << time;
    EXPECT_EQ(text(), page_scene) << time;
    former = picture();
    browser().run("location.hash = 'scene=first-sphere'");
    await("done", former);
  }
}

TEST_F(Files, list_offers_nothing_that_it_cannot_open) {
  std::string former = picture();
  drop("mine.json", page_scene);
  await("done", former);
  former = picture();
  browser().run(
      "const list = document.getElementById('scene-select'); list.value = 'demo';"
      "list.dispatchEvent(new Event('change'))");
  await("done", former);
  EXPECT_EQ(value("[...document.getElementById('scene-select').options].filter("
                  "({ value }) => value === '').length"),
            0);
}

TEST_F(Files, scene_survives_a_reload_and_back_leads_to_the_one_before) {
  std::string former = picture();
  drop("mine.json", page_scene);
  await("done", former);
  browser().run("location.reload()");
  await("done");
  EXPECT_EQ(text(), page_scene);
  EXPECT_EQ(value("document.getElementById('scene-select').value"), "");
  EXPECT_EQ(value("document.getElementById('download').download"), "scene.png");
  EXPECT_EQ(value("document.getElementById('undo').disabled"), true) << "to which scene?";
  former = picture();
  browser().run("history.back()");
  await("done", former);
  EXPECT_NE(text().find("\"First sphere\""), std::string::npos);
}

TEST_F(Files, errors_of_a_document_are_marked) {
  drop("wrong.JSON", "{\n  \"camera\": {\n    \"fov\" 1\n  }\n}\n");
  await("error");
  EXPECT_EQ(value("document.querySelector('#errors li').dataset.line"), "3");
}

TEST_F(Files, other_formats_name_the_command_that_opens_them) {
  drop("water.pdb", "HETATM    1  O   HOH A   1       0.000   0.000   0.000\n");
  expect_refusal("raytracer open water.pdb");
  keep_screenshot("drop_refused");
  drop("a b's.gltf", "{}");
  EXPECT_TRUE(comes_true("/b/.test(document.getElementById('problem').innerText)"));
  expect_refusal(R"(raytracer open 'a b'\''s.gltf')");
}

TEST_F(Files, what_nothing_here_reads_is_not_said_to_be_read) {
  drop("holiday.png", "PNG");
  expect_refusal("holiday.png is none");
  EXPECT_EQ(says().find("raytracer open"), std::string::npos) << says();
  drop("melt.dump.gz", "packed");
  EXPECT_TRUE(comes_true("/melt/.test(document.getElementById('problem').innerText)"));
  expect_refusal("raytracer open melt.dump.gz");
}

TEST_F(Files, edits_are_laid_aside_for_it) {
  show_panel("json");
  edit(page_scene + "\n");
  std::string former = picture();
  press_ctrl_enter();
  await("done", former);
  former = picture();
  drop("mine.json", page_scene);
  await("done", former);
  former = picture();
  browser().click("#restore");
  await("done", former);
  EXPECT_EQ(text(), page_scene + "\n");
}

}  // namespace
}  // namespace raytracer::test
