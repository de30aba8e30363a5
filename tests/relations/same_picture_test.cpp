// Changes to a document that do not change its picture, or change it in a known way.

#include <gtest/gtest.h>

#include <numbers>

#include "tests/relations/varied_scene.h"

namespace raytracer::test {
namespace {

void expect_same_bytes(const Image& a, const Image& b) {
  EXPECT_TRUE(a.values == b.values)
      << count_different(a, b) << " pixels differ, by " << distance(a, b) << " at most";
}

/// The varied scene with and without enough spheres for a tree, with one sample and several.
std::vector<json> scenes() {
  json plain = varied_scene();
  json with_tree = plain;
  with_tree["objects"].push_back(filler());
  with_tree["render"]["samples"] = 3;
  json gray = plain;
  gray["shadows"] = "ambient";
  gray["render"] = {{"max_depth", 2}, {"transfer", "srgb"}};
  return {plain, with_tree, gray};
}

TEST(Picture, ShowsSomethingOfEverything) {
  // Else the relations below would say nothing.
  const json text = varied_scene();
  const Image image = image_of(text);
  for (std::size_t i = 0; i < text["objects"].size(); ++i) {
    json without = text;
    without["objects"].erase(i);
    EXPECT_GT(count_different(image, image_of(without)), 20) << i;
  }
  for (std::size_t i = 0; i < text["lights"].size(); ++i) {
    json without = text;
    without["lights"].erase(i);
    EXPECT_GT(count_different(image, image_of(without)), 100) << i;
  }
}

TEST(Picture, IsTheSameScaledByAPowerOfTwo) {
  for (const json& text : scenes()) {
    const Image image = image_of(text);
    for (const int exponent : {1, -1, 10, 100, -100, 400, -400})
      expect_same_bytes(image, image_of(changed(text, scaling(std::ldexp(1.0, exponent)))));
  }
}

TEST(Picture, IsTheSameScaledByAnyFactorButForPixelsOnEdges) {
  // Coordinates are rounded anew, to 1e-16 of their size in double: a sample within 1e-13 of an
  // edge may fall to the other side, which among a few thousand hardly ever happens. In single,
  // where the plan chooses it, colours move by roundings too, but not by half a level.
  constexpr double half_level = 0.5 / 255;
  for (json text : scenes()) {
    for (const auto& [precision, tolerance] : {std::pair{"double", 1e-6}, {"auto", half_level}}) {
      text["render"]["precision"] = precision;
      const Image image = image_of(text);
      for (const double factor : {1e-30, 1e30, 1e-3, 3.0, 1e100, 1e-100})
        EXPECT_LE(count_different(image, image_of(changed(text, scaling(factor))), tolerance), 2)
            << precision << ' ' << factor;
    }
  }
}

TEST(Picture, IsTheSameMovedByExactSums) {
  for (const json& text : scenes()) {
    const Image image = image_of(text);
    for (const Vec3& shift : {Vec3{1024, -512, 4096}, Vec3{-0x1p40, 0x1p41, 3 * 0x1p39}}) {
      const Change move{.point = [shift](const Vec3& p) { return p + shift; }};
      expect_same_bytes(image, image_of(changed(text, move)));
    }
  }
}

TEST(Picture, OfTheMirroredSceneIsMirrored) {
  const auto negate_x = [](const Vec3& v) { return Vec3{-v.x, v.y, v.z}; };
  for (json text : scenes()) {
    text["render"]["samples"] = 1;  // the places of more samples are not symmetrical
    const Image image = image_of(text);
    const Image mirrored = image_of(changed(text, {.point = negate_x, .direction = negate_x}));
    Image back(image.width, image.height);
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        std::copy_n(mirrored.pixel(image.width - 1 - x, y), 3, back.pixel(x, y));
    expect_same_bytes(image, back);
  }
}

TEST(Picture, DoesNotDependOnTheOrderOfObjects) {
  for (const json& text : scenes()) {
    const Image image = image_of(text);
    json shuffled = text;
    json& objects = shuffled["objects"];
    Random random(40);
    for (int round = 0; round < 5; ++round) {
      for (std::size_t i = objects.size(); i > 1; --i)
        std::swap(objects[i - 1], objects[random.below(i)]);
      expect_same_bytes(image, image_of(shuffled));
    }
  }
}

TEST(Picture, DoesNotDependOnTheOrderWithinASetOfSpheresOrAMesh) {
  json text = varied_scene();
  const Image image = image_of(text);
  json& set = text["objects"][5];
  std::reverse(set["centers"].begin(), set["centers"].end());
  std::reverse(set["radius"].begin(), set["radius"].end());
  json& mesh = text["objects"][4];
  std::reverse(mesh["triangles"].begin(), mesh["triangles"].end());
  expect_same_bytes(image, image_of(text));
}

TEST(Picture, OfASetIsThatOfItsSpheres) {
  json text = varied_scene();
  const Image image = image_of(text);
  const json set = text["objects"][5];
  text["objects"].erase(5);
  for (std::size_t i = 0; i < set["centers"].size(); ++i)
    text["objects"].push_back(
        sphere_json(vector_of(set["centers"][i]), set["radius"][i].get<double>(), set["material"]));
  expect_same_bytes(image, image_of(text));
}

TEST(Picture, OfASquareIsThatOfItsSpheres) {
  // Offsets (2i + 1 - 2n) r are exact here, so every pixel is the same, reflections included.
  for (const char* axes : {"xz", "xy", "yz"}) {
    json text = varied_scene();
    text["render"]["precision"] = "double";
    json& square = text["objects"][3];
    square["axes"] = axes;
    const Image image = image_of(text);
    text["render"]["precision"] = "auto";
    const Image automatic = image_of(text);
    const Vec3 center = vector_of(square["center"]);
    json centers = json::array();
    for (int i = 0; i < 14; ++i) {
      for (int k = 0; k < 14; ++k) {
        const double first = (2 * i + 1 - 14) * 0.1875;
        const double second = (2 * k + 1 - 14) * 0.1875;
        const Vec3 offset = axes == std::string_view("xz")   ? Vec3{first, 0, second}
                            : axes == std::string_view("xy") ? Vec3{first, second, 0}
                                                             : Vec3{0, first, second};
        centers.push_back(vector_json(center + offset));
      }
    }
    square = {{"type", "spheres"},
              {"centers", centers},
              {"radius", 0.1875},
              {"material", square["material"]}};
    text["render"]["precision"] = "double";
    EXPECT_EQ(count_different(image, image_of(text)), 0) << axes;
    // In single the two find the same spheres by other roundings: on an edge, now and then,
    // another.
    text["render"]["precision"] = "auto";
    EXPECT_LE(count_different(automatic, image_of(text), 1.0 / 255), 2) << axes;
  }
}

TEST(Picture, DoesNotDependOnTheNumberOfThreads) {
  for (const json& text : scenes()) {
    const Image image = image_of(text, 1);
    for (const std::size_t threads : {2U, 3U, 7U})
      expect_same_bytes(image, image_of(text, threads));
    expect_same_bytes(image, image_of(text, 1));
  }
}

/// So many spheres that every structure is built in several pieces, and under a contract.
TEST(Picture, OfThousandsOfSpheresDoesNotDependOnTheNumberOfThreads) {
  json text = varied_scene();
  json centers = json::array();
  for (int i = 0; i < 6000; ++i)
    centers.push_back({std::sin(i * 1.7) * 4, std::sin(i * 2.3) * 2 + 2, std::sin(i * 0.9) * 4});
  text["objects"].push_back({{"type", "spheres"}, {"centers", centers}, {"radius", 0.04}});
  for (const json& render : {json{{"samples", 1}}, json{{"target_rmse", 0.02}}}) {
    text["render"] = render;
    const Image image = image_of(text, 1);
    for (const std::size_t threads : {2U, 3U, 7U})
      expect_same_bytes(image, image_of(text, threads));
  }
}

TEST(Picture, OfSeveralCallersAtOnceIsThatOfEachAlone) {
  const std::vector<json> all = scenes();
  WorkerPool pool(3);
  std::vector<Image> together(all.size());
  std::vector<std::thread> callers;
  for (std::size_t i = 0; i < all.size(); ++i) {
    callers.emplace_back([&, i] {
      RenderProgress progress;
      together[i] = render(scene_of(all[i]), Limits{}, pool, progress).image;
    });
  }
  for (std::thread& caller : callers) caller.join();
  for (std::size_t i = 0; i < all.size(); ++i) expect_same_bytes(together[i], image_of(all[i], 1));
}

TEST(Picture, IsTheSameUnderAFieldOfViewTwoPiWider) {
  // alpha + 2 pi is rounded: directions change by 1e-15, so a sample within that of an edge may
  // change sides, and no value changes by a visible amount otherwise.
  for (json text : scenes()) {
    const Image image = image_of(text);
    for (const double turns : {1, -1, 3}) {
      text["camera"]["fov"] = 1.1 + turns * 2 * std::numbers::pi;
      EXPECT_LE(count_different(image, image_of(text), 1e-6), 1) << turns;
    }
  }
}

TEST(Picture, DoesNotDependOnNamesNorUnusedMaterials) {
  json text = varied_scene();
  const Image image = image_of(text);
  text["name"] = "x";
  text["materials"] = {{"unused", {{"reflectivity", 1}}}};
  expect_same_bytes(image, image_of(text));
}

}  // namespace
}  // namespace raytracer::test
