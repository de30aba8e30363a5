// The page for those who listen, use a keyboard, or see little: the rules that can be checked by a
// program, by hand, since no checker is packaged. Names of controls and pictures, one h1,
// landmarks, references that lead somewhere, focus that shows, and WCAG's contrast of text in both
// schemes.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/browser/browser_page.h"

namespace raytracer::test {
namespace {

class Access : public BrowserPage {
 protected:
  void SetUp() override { open(); }
  static void expect_contrast(const std::string& what);
};

/// Text in sight whose contrast is below 4.5, or 3 where it is large; disabled controls are exempt.
const std::string low_contrast = R"((() => {
  const paper = document.createElement('canvas').getContext('2d', { willReadFrequently: true });
  const parts = (colour) => {
    paper.clearRect(0, 0, 1, 1);
    paper.fillStyle = colour;
    paper.fillRect(0, 0, 1, 1);
    const [r, g, b, a] = paper.getImageData(0, 0, 1, 1).data;
    return [r / 255, g / 255, b / 255, a / 255];
  };
  const over = (top, below) => [0, 1, 2].map((i) => top[i] * top[3] + below[i] * (1 - top[3]));
  const light = (rgb) => rgb.map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4))
    .reduce((sum, c, i) => sum + c * [0.2126, 0.7152, 0.0722][i], 0);
  const behind = (element) => {
    const layers = [];
    for (let each = element; each; each = each.parentElement)
      layers.push(parts(getComputedStyle(each).backgroundColor));
    return layers.reverse().reduce((below, top) => over(top, below), [1, 1, 1]);
  };
  const found = [];
  for (const element of document.querySelectorAll('body *')) {
    const says = [...element.childNodes].some((node) => node.nodeType === 3 && node.data.trim());
    const style = getComputedStyle(element);
    if (!says || !element.checkVisibility({ visibilityProperty: true }) || element.disabled) continue;
    if (element.closest('.unseen, textarea, noscript, select')) continue;
    const ground = behind(element);
    const ink = over(parts(element instanceof SVGElement ? style.fill : style.color), ground);
    const [bright, dim] = [light(ink), light(ground)].sort((a, b) => b - a);
    const contrast = (bright + 0.05) / (dim + 0.05);
    const size = parseFloat(style.fontSize);
    const isLarge = size >= 24 || (size >= 18.66 && style.fontWeight >= 700);
    if (contrast < (isLarge ? 3 : 4.5))
      found.push(`${element.textContent.trim().slice(0, 40)}: ${contrast.toFixed(2)}`);
  }
  return found;
})())";

/// Of what is in sight now, in both schemes.
void Access::expect_contrast(const std::string& what) {
  for (const bool dark : {false, true}) {
    browser().prefer_dark(dark);
    EXPECT_EQ(value(low_contrast).get<std::vector<std::string>>(), std::vector<std::string>{})
        << what << (dark ? ", dark" : ", light");
  }
  browser().prefer_dark(false);
}

TEST_F(Access, controls_and_pictures_have_names) {
  for (const char* const panel : {"form", "json", "plan", "curve"}) {
    show_panel(panel);
    const std::vector<std::string> nameless = value(
        "[...document.querySelectorAll('input, select, textarea, button, a, img, [role], "
        "[tabindex]')]"
        ".filter((each) => each.checkVisibility())"
        ".filter((each) => each.tagName === 'IMG' ? !each.hasAttribute('alt')"
        "  : !(each.labels?.[0]?.textContent.trim() || each.textContent.trim() || each.ariaLabel"
        "  || each.hasAttribute('aria-labelledby')))"
        ".map((each) => each.outerHTML)");
    EXPECT_EQ(nameless, std::vector<std::string>{}) << panel;
  }
  EXPECT_NE(value("document.getElementById('picture').alt"), "");
  EXPECT_EQ(value("document.documentElement.lang"), "en");
  EXPECT_NE(value("document.title"), "");
  EXPECT_EQ(value("/user-scalable|maximum-scale/.test(document.querySelector('[name=viewport]')"
                  ".content)"),
            false);
}

TEST_F(Access, headings_leave_no_level_out) {
  for (const char* const panel : {"form", "json", "plan", "curve"}) {
    show_panel(panel);
    const std::vector<int> levels = value(
        "[...document.querySelectorAll('h1, h2, h3, h4, h5, h6')].filter((each) =>"
        " each.checkVisibility()).map((each) => Number(each.tagName[1]))");
    ASSERT_FALSE(levels.empty());
    EXPECT_EQ(levels.front(), 1);
    for (std::size_t i = 1; i < levels.size(); ++i)
      EXPECT_LE(levels[i], levels[i - 1] + 1) << panel;
  }
}

TEST_F(Access, page_has_landmarks_and_one_heading_above_all) {
  EXPECT_EQ(value("document.querySelectorAll('h1').length"), 1);
  EXPECT_EQ(value("document.querySelectorAll('main').length"), 1);
  EXPECT_EQ(value("[...document.querySelectorAll('section, main')].filter((each) => "
                  "!each.ariaLabel && each.parentElement.id !== 'plan').length"),
            0);
}

TEST_F(Access, references_lead_somewhere_and_ids_are_unique) {
  const std::vector<std::string> dangling = value(
      "[...document.querySelectorAll('*')].flatMap((each) => "
      "['for', 'aria-controls', 'aria-describedby', 'aria-labelledby'].flatMap((name) => "
      "(each.getAttribute(name) ?? '').split(' ').filter((id) => id && "
      "!document.getElementById(id))))");
  EXPECT_EQ(dangling, std::vector<std::string>{});
  const std::vector<std::string> ids = value(
      "[...document.querySelectorAll('[id]')].map((each) => each.id).filter((id, i, all) => "
      "all.indexOf(id) !== i)");
  EXPECT_EQ(ids, std::vector<std::string>{});
}

TEST_F(Access, text_has_contrast_in_light_and_dark) {
  open("/#scene=first-sphere");
  for (const char* const panel : {"form", "json", "plan"}) {
    show_panel(panel);
    expect_contrast(panel);
  }
  show_panel("curve");
  browser().click("#measure");
  ASSERT_TRUE(comes_true("document.querySelectorAll('#curve-plot .point').length > 0"));
  expect_contrast("curve");
  browser().click("#open-gallery");
  expect_contrast("gallery");
  browser().click("#gallery form button");
  browser().run(
      "const dialog = document.getElementById('token-dialog'); dialog.showModal();"
      "dialog.querySelector('[role=alert]').textContent = 'Not the token.';");
  expect_contrast("token");
  browser().run("document.getElementById('token-dialog').close()");
  show_panel("json");
  edit(R"({"camera": {"fov": "wide"}, "objcets": []})");
  press_ctrl_enter();
  await("error");
  expect_contrast("errors");
}

TEST_F(Access, contrast_that_is_too_low_is_found) {
  browser().run(
      "const faint = document.createElement('p'); faint.textContent = 'faint';"
      "faint.style = 'color: #999; background: #fff'; document.body.append(faint);");
  EXPECT_EQ(value(low_contrast), std::vector<std::string>{"faint: 2.85"});
}

TEST_F(Access, tabs_follow_the_arrow_keys) {
  browser().type("#tab-form", "\xee\x80\x94");  // arrow right
  EXPECT_EQ(value("document.activeElement.id"), "tab-json");
  EXPECT_EQ(value("document.getElementById('panel-json').hidden"), false);
}

TEST_F(Access, focus_is_seen_on_every_control) {
  show_panel("form");
  const std::vector<std::string> unseen = value(R"((() => {
    const bad = [];
    const controls = 'a[href], button, select, input, textarea, [tabindex="0"]';
    for (const each of document.querySelectorAll(controls)) {
      if (!each.checkVisibility() || each.disabled) continue;
      each.focus({ focusVisible: true });
      if (document.activeElement !== each) continue;
      const shower = each.type === 'radio' ? each.nextElementSibling : each;
      if (getComputedStyle(shower).outlineStyle === 'none') bad.push(each.outerHTML);
    }
    return bad;
  })())");
  EXPECT_EQ(unseen, std::vector<std::string>{});
}

}  // namespace
}  // namespace raytracer::test
