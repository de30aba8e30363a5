// Scenes that are drawn, not written: valid, ordinary, and all different.
#include "tests/measure/contracts/random_scene.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "engine/engine.h"
#include "tests/measure/contracts/random_objects.h"

namespace raytracer::published {
namespace {

constexpr std::uint64_t seed_count = 200;

TEST(RandomScene, of_any_seed_is_a_valid_document) {
  for (std::uint64_t seed = 0; seed < seed_count; ++seed) {
    const Result<Scene> scene = read_scene(random_scene(seed).document, Limits{});
    ASSERT_TRUE(scene.ok()) << seed << ": " << scene.errors()[0].pointer << ": "
                            << scene.errors()[0].detail;
    EXPECT_GE(scene.value().camera.width, 32);
    EXPECT_LE(scene.value().camera.width, 320);
    EXPECT_GE(scene.value().lights.size(), 1U);
    EXPECT_LE(scene.value().lights.size(), 5U);
    EXPECT_FALSE(scene.value().render.samples) << "a target could not replace them";
  }
}

TEST(RandomScene, of_one_seed_is_the_same_bytes) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    EXPECT_EQ(random_scene(seed).document, random_scene(seed).document);
    EXPECT_EQ(random_scene(seed).summary, random_scene(seed).summary);
  }
}

TEST(RandomScene, of_different_seeds_differ) {
  std::set<std::string> documents;
  for (std::uint64_t seed = 0; seed < seed_count; ++seed) {
    // Without its name, which says the seed.
    nlohmann::json document = nlohmann::json::parse(random_scene(seed).document);
    document.erase("name");
    documents.insert(document.dump());
  }
  EXPECT_EQ(documents.size(), seed_count);
}

TEST(RandomScene, every_kind_of_object_light_and_mode_occurs) {
  std::set<std::string> found;
  for (std::uint64_t seed = 0; seed < seed_count; ++seed) {
    const RandomScene scene = random_scene(seed);
    for (const ObjectKind& kind : object_kinds())
      if (scene.summary.find(kind.name) != std::string::npos) found.insert(kind.name);
    const nlohmann::json document = nlohmann::json::parse(scene.document);
    for (const nlohmann::json& light : document["lights"]) {
      found.insert(light["type"]);
      if (light.contains("angle")) found.insert("wide sun");
      if (light.contains("radius")) found.insert("lamp");
      if (light.contains("reach")) found.insert("near sky");
    }
    for (const nlohmann::json& object : document["objects"]) {
      if (object.contains("axes")) found.insert(object["axes"]);
      if (object.contains("caps")) found.insert(object["caps"].get<bool>() ? "closed" : "open");
      if (object.contains("colors")) found.insert("colors");
      if (object.contains("normals")) found.insert("smooth");
    }
    found.insert(document["shadows"]);
    found.insert(document["render"]["transfer"]);
    if (scene.summary.find("mirrors") != std::string::npos) found.insert("mirrors");
    if (scene.summary.find("glass") != std::string::npos) found.insert("glass");
  }
  for (const ObjectKind& kind : object_kinds()) EXPECT_TRUE(found.contains(kind.name)) << kind.name;
  for (const char* const word :
       {"distant", "point", "sky",    "wide sun", "lamp",    "near sky", "xz",
        "xy",      "yz",    "closed", "open",     "colors",  "smooth",   "black",
        "ambient", "off",   "linear", "srgb",     "mirrors", "glass"})
    EXPECT_TRUE(found.contains(word)) << word;
}

TEST(RandomScene, counts_are_within_what_is_ordinary) {
  for (std::uint64_t seed = 0; seed < seed_count; ++seed) {
    const nlohmann::json document = nlohmann::json::parse(random_scene(seed).document);
    for (const nlohmann::json& object : document["objects"]) {
      if (object.contains("centers")) {
        EXPECT_GE(object["centers"].size(), 3U);
        EXPECT_LE(object["centers"].size(), 2000U);
      }
      if (object.contains("triangles")) {
        EXPECT_GE(object["triangles"].size(), 1U);
        EXPECT_LE(object["triangles"].size(), 2000U);
      }
      if (object["type"] == "cylinders") {
        EXPECT_GE(object["from"].size(), 3U);
        EXPECT_LE(object["from"].size(), 1000U);
      }
      if (object.contains("n")) {
        EXPECT_GE(object["n"], 1);
        EXPECT_LE(object["n"], 60);
      }
    }
  }
}

}  // namespace
}  // namespace raytracer::published
