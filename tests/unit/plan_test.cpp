// The plan: what is chosen for which scene, and that it says why.
#include "engine/plan/plan.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "engine/plan/counted.h"
#include "engine/plan/explain.h"

namespace raytracer::test {
namespace {

const Machine machine{{1, "AVX2"}, 2};

Scene scene_with(std::vector<Object> objects) {
  Scene scene;
  scene.camera = {.origin = {0, 2, -50}, .look_at = {}, .fov = 1, .width = 640, .height = 480};
  scene.lights = {{DistantLight{{0, -1, 1}}}};
  scene.materials = {Material{}, Material{.reflectivity = 0.5}};
  scene.objects = std::move(objects);
  return scene;
}

Spheres many_spheres(int count) {
  Spheres spheres{{}, {0.1}};
  for (int i = 0; i < count; ++i)
    spheres.centers.push_back({i % 10 - 5.0, i / 10 % 10 - 5.0, i / 100.0});
  return spheres;
}

nlohmann::json explained(const Scene& scene) {
  return nlohmann::json::parse(explain(scene, make_plan(scene, machine), {}));
}

/// The structure by which `rays` find what `objects` begins with.
std::string way_of(const nlohmann::json& plan, const std::string& objects,
                   const std::string& rays) {
  for (const nlohmann::json& way : plan.at("geometry").at("ways"))
    if (way.at("objects").get<std::string>().starts_with(objects) && way.at("rays") == rays)
      return way.at("choice");
  return "no such way";
}

TEST(Plan, DoesNotDependOnThePool) {
  const Scene scene = scene_with({{many_spheres(6000), 0}});
  const std::string alone = explain(scene, make_plan(scene, machine), {});
  for (const std::size_t threads : {1U, 2U, 7U}) {
    WorkerPool pool(threads);
    EXPECT_EQ(explain(scene, make_plan(scene, machine, &pool), {}), alone) << threads;
  }
}

TEST(Plan, IsTheSameForTheSameSceneAndMachine) {
  const Scene scene = scene_with({{many_spheres(300), 1}, {Plane{{0, -9, 0}, {0, 1, 0}}, 0}});
  EXPECT_EQ(explained(scene), explained(scene));
}

TEST(Plan, BuildsNothingThatNoRayAsks) {
  Scene scene = scene_with({{many_spheres(1000), 0}});
  EXPECT_TRUE(make_plan(scene, machine).structures.light_grids);
  EXPECT_FALSE(make_plan(scene, machine).structures.sphere_tree);
  scene.shadows = Shadows::off;
  EXPECT_FALSE(make_plan(scene, machine).structures.light_grids);
  scene.objects[0].material = 1;
  EXPECT_TRUE(make_plan(scene, machine).structures.sphere_tree);
  scene.render.max_depth = 0;
  EXPECT_FALSE(make_plan(scene, machine).structures.sphere_tree);
}

TEST(Plan, TriesFewSpheresOneByOne) {
  const Scene scene = scene_with({{many_spheres(5), 1}});
  EXPECT_EQ(way_of(explained(scene), "5 spheres", "to the lights"), "one by one");
  EXPECT_EQ(way_of(explained(scene), "5 spheres", "reflected"), "one by one");
}

TEST(Plan, FindsManySpheresByWhatTheirRaysShare) {
  const nlohmann::json plan = explained(scene_with({{many_spheres(1000), 1}}));
  EXPECT_EQ(way_of(plan, "1,000 spheres", "from the eye"), "screen bins");
  EXPECT_EQ(way_of(plan, "1,000 spheres", "to the lights"), "light grids");
  EXPECT_EQ(way_of(plan, "1,000 spheres", "reflected"), "tree of boxes");
}

TEST(Plan, WalksASquareWhateverItsSize) {
  const nlohmann::json plan = explained(scene_with({{SphereSquare{{}, 1, 1'000'000'000}, 0}}));
  EXPECT_EQ(way_of(plan, "a square of 2,000,000,000 x", "from the eye"), "cell walk");
  EXPECT_EQ(way_of(plan, "a square", "from its own spheres to the distant lights"),
            "neighbour list");
}

TEST(Plan, WalksASquareUnderALowLight) {
  Scene scene = scene_with({{SphereSquare{{}, 1, 10}, 0}});
  scene.lights = {{DistantLight{{1, -0.01, 0}}}};
  EXPECT_EQ(way_of(explained(scene), "a square", "from its own spheres to the distant lights"),
            "cell walk");
}

TEST(Plan, TakesDoubleForShadowsFromSquareToSquareAsFromASphere) {
  const auto precision_with = [](std::vector<Object> over_it) {
    over_it.push_back({SphereSquare{{}, 1, 1000}, 0});
    Scene scene = scene_with(std::move(over_it));
    scene.lights = {{DistantLight{{0, -0.2, 1}}}};
    return make_plan(scene, machine).precision.value;
  };
  EXPECT_EQ(precision_with({}), Precision::single_precision);
  EXPECT_EQ(precision_with({{Sphere{{0, 10, 0}, 0.1}, 0}}), Precision::double_precision);
  EXPECT_EQ(precision_with({{SphereSquare{{0, 10, 0}, 0.1, 5}, 0}}), Precision::double_precision);
}

TEST(Plan, NumbersNoMorePrimitivesInSingleThanItTellsApart) {
  Features features;
  features.spheres = std::size_t{1} << 24;
  EXPECT_EQ(choose_precision(Precision::single_precision, features, {}).value,
            Precision::single_precision);
  ++features.spheres;
  for (const Precision wish : {Precision::single_precision, Precision::automatic})
    EXPECT_EQ(choose_precision(wish, features, {}).value, Precision::double_precision);
}

TEST(Plan, TakesThePlainKernelInsideASphere) {
  const Plan plan = make_plan(scene_with({{Sphere{{}, 1000}, 0}}), machine);
  EXPECT_NE(plan.kernel.value, Kernel::simd);
  EXPECT_EQ(plan.precision.value, Precision::double_precision);
}

TEST(Plan, GivesEachThreadItsShareOfTiles) {
  Scene scene = scene_with({});
  EXPECT_EQ(make_plan(scene, {{1, "AVX2"}, 1}).tile_side_px.value, 64);
  scene.render.samples = 64;
  EXPECT_LT(make_plan(scene, {{1, "AVX2"}, 1}).tile_side_px.value, 64);
  scene.render.samples = 1;
  EXPECT_LT(make_plan(scene, {{1, "AVX2"}, 64}).tile_side_px.value, 64);
}

TEST(Plan, EveryChoiceHasAReason) {
  const nlohmann::json plan = explained(scene_with(
      {{many_spheres(1000), 1}, {SphereSquare{{}, 1, 10}, 0}, {Plane{{0, -9, 0}, {0, 1, 0}}, 0}}));
  for (const char* const key :
       {"kernel", "instruction_set", "precision", "geometry", "sampling", "tiles", "frame"}) {
    EXPECT_TRUE(plan.at(key).contains("choice")) << key;
    EXPECT_GT(plan.at(key).at("reason").get<std::string>().size(), 15U) << key;
  }
  for (const nlohmann::json& way : plan.at("geometry").at("ways"))
    EXPECT_GT(way.at("reason").get<std::string>().size(), 15U) << way;
}

TEST(Plan, SaysThatThereIsNothingToMeet) {
  EXPECT_EQ(explained(scene_with({})).at("geometry").at("choice"), "nothing");
}

TEST(Plan, NamesTheContractThatEndsASampling) {
  Scene scene = scene_with({});
  scene.render.samples = 9;
  EXPECT_EQ(explained(scene).at("sampling").at("choice"), 9);
  scene.render.samples.reset();
  scene.render.target_rmse = 0.004;
  scene.render.budget_ms = 50;
  const nlohmann::json sampling = explained(scene).at("sampling");
  EXPECT_EQ(sampling.at("choice"), "refined");
  EXPECT_NE(sampling.at("reason").get<std::string>().find("0.004"), std::string::npos);
  EXPECT_NE(sampling.at("reason").get<std::string>().find("50 ms"), std::string::npos);
}

TEST(Counted, WritesNumbersAsPeopleDo) {
  EXPECT_EQ(counted(0, "sphere"), "0 spheres");
  EXPECT_EQ(counted(1, "sphere"), "1 sphere");
  EXPECT_EQ(counted(999, "mesh", "meshes"), "999 meshes");
  EXPECT_EQ(counted(1000, "sphere"), "1,000 spheres");
  EXPECT_EQ(grouped(12345678), "12,345,678");
  EXPECT_EQ(grouped(std::numeric_limits<std::uint64_t>::max()), "18,446,744,073,709,551,615");
}

}  // namespace
}  // namespace raytracer::test
