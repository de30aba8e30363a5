// The plan: what is chosen for which scene, and that it says why.
#include "engine/plan/plan.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "engine/plan/explain.h"
#include "engine/text/pluralised.h"
#include "tests/support/edit.h"
#include "tests/support/scene_plan.h"

namespace raytracer::test {
namespace {

const Machine machine{{1, "AVX2"}, 2};

Scene scene_with(std::vector<Object> objects) {
  Scene scene;
  scene.camera = {.origin = {0, 2, -50}, .look_at = {}, .fov = 1, .width = 640, .height = 480};
  scene.lights = {{DistantLight{{0, -1, 1}}}};
  Material mirror;
  mirror.reflectivity = 0.5;
  scene.materials = {Material{}, mirror};
  scene.objects = std::move(objects);
  return scene;
}

Spheres many_spheres(int count) {
  Spheres spheres{{}, {0.1}, {}};
  for (int i = 0; i < count; ++i)
    spheres.centers.push_back({i % 10 - 5.0, i / 10 % 10 - 5.0, i / 100.0});
  return spheres;
}

nlohmann::json explained(const Scene& scene) {
  return nlohmann::json::parse(explain(scene, make_plan(scene, machine), {}));
}

/// By what `rays` find what `objects` begins with.
std::string finder_for(const nlohmann::json& plan, const std::string& objects,
                       const std::string& rays) {
  for (const nlohmann::json& row : plan.at("geometry").at("finders")) {
    const std::string all_rays = ", " + row.at("rays").get<std::string>() + ",";
    if (row.at("objects").get<std::string>().starts_with(objects) &&
        all_rays.find(", " + rays + ",") != std::string::npos)
      return row.at("choice");
  }
  return "no such row";
}

TEST(Plan, does_not_depend_on_the_pool) {
  const Scene scene = scene_with({{many_spheres(6000), 0}});
  const std::string alone = explain(scene, make_plan(scene, machine), {});
  for (const std::size_t threads : {1U, 2U, 7U}) {
    WorkerPool pool(threads);
    EXPECT_EQ(explain(scene, make_plan(scene, machine, &pool), {}), alone) << threads;
  }
}

TEST(Plan, is_the_same_for_the_same_scene_and_machine) {
  const Scene scene = scene_with({{many_spheres(300), 1}, {Plane{{0, -9, 0}, {0, 1, 0}}, 0}});
  EXPECT_EQ(explained(scene), explained(scene));
}

TEST(Plan, builds_nothing_that_no_ray_asks) {
  Scene scene = scene_with({{many_spheres(1000), 0}});
  const auto finder_of_spheres = [&](RayKind rays) {
    return finder_of(make_plan(scene, machine).finders[kind_index<SphereKind>], rays);
  };
  EXPECT_EQ(finder_of_spheres(RayKind::to_distant_light), Finder::light_grid);
  EXPECT_EQ(finder_of_spheres(RayKind::to_point_light), Finder::none);
  EXPECT_EQ(finder_of_spheres(RayKind::followed), Finder::none);
  scene.shadows = Shadows::off;
  EXPECT_EQ(finder_of_spheres(RayKind::to_distant_light), Finder::none);
  edit(scene.objects, [](auto& objects) { objects[0].material = 1; });
  EXPECT_EQ(finder_of_spheres(RayKind::followed), Finder::tree);
  scene.render.max_depth = 0;
  EXPECT_EQ(finder_of_spheres(RayKind::followed), Finder::none);
}

TEST(Plan, sweeps_directions_of_soft_lights_for_all_points_of_one_pass) {
  const auto finder_of_spheres = [&](Scene scene, int count) {
    append(scene.lights, {SkyLight{}});
    append(scene.objects, {many_spheres(count), 0});
    return finder_of(make_plan(scene, machine).finders[kind_index<SphereKind>],
                     RayKind::to_soft_light);
  };
  Scene scene = scene_with({});
  EXPECT_EQ(finder_of_spheres(scene, 1000), Finder::light_grid);
  EXPECT_EQ(finder_of_spheres(scene, 1'000'000), Finder::light_sweep);
  scene.render.target_rmse = 0.01;
  EXPECT_EQ(finder_of_spheres(scene, 6000), Finder::light_grid);
  EXPECT_EQ(finder_of_spheres(scene, 1'000'000), Finder::tree);
}

TEST(Plan, tries_few_spheres_one_by_one) {
  const Scene scene = scene_with({{many_spheres(5), 1}});
  EXPECT_EQ(finder_for(explained(scene), "5 spheres", "to the distant lights"), "one by one");
  EXPECT_EQ(finder_for(explained(scene), "5 spheres", "followed"), "one by one");
}

TEST(Plan, finds_many_spheres_by_what_their_rays_share) {
  const nlohmann::json plan = explained(scene_with({{many_spheres(1000), 1}}));
  EXPECT_EQ(finder_for(plan, "1,000 spheres", "from the eye"), "screen bins");
  EXPECT_EQ(finder_for(plan, "1,000 spheres", "to the distant lights"), "light grids");
  EXPECT_EQ(finder_for(plan, "1,000 spheres", "followed"), "tree of boxes");
}

TEST(Plan, finds_by_cells_around_a_point_light_whatever_is_bounded) {
  const Spheres spheres = many_spheres(1000);
  Cylinders cylinders;
  cylinders.from = spheres.centers;
  cylinders.radii = {0.1};
  Cones cones;
  cones.from = spheres.centers;
  cones.radii_from = {0.1};
  cones.radii_to = {0};
  Mesh mesh;
  for (const Vec3& center : spheres.centers) {
    cylinders.to.push_back(center + Vec3{0, 1, 0});
    cones.to.push_back(center + Vec3{1, 0, 0});
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vec3& corner : {Vec3{0, 0, 0}, Vec3{0.1, 0, 0}, Vec3{0, 0.1, 0}})
      mesh.vertices.push_back(center + corner);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  Scene scene = scene_with({{spheres, 0}, {cylinders, 0}, {cones, 0}, {mesh, 0}});
  scene.lights = {{PointLight{{0, 20, 0}}}};
  const nlohmann::json plan = explained(scene);
  for (const char* const objects : {"1,000 spheres", "1,000 cylinders", "1,000 cones", "1,000 tri"})
    EXPECT_EQ(finder_for(plan, objects, "to the point lights"), "point grids") << objects;
  scene.camera.width = 64;
  scene.camera.height = 48;
  EXPECT_EQ(finder_for(explained(scene), "1,000 spheres", "to the point lights"), "point grids");
  for (const char* const objects : {"1,000 cylinders", "1,000 cones", "1,000 tri"})
    EXPECT_EQ(finder_for(explained(scene), objects, "to the point lights"), "tree of boxes")
        << objects << " in an image too small for cells to be worth building";
}

TEST(Plan, mixes_for_shadows_from_afar_of_what_is_round_but_not_of_triangles) {
  const auto precision_with = [](Object far_away) {
    Scene scene = scene_with({{Sphere{{0, 2, -48}, 0.1}, 0}, std::move(far_away)});
    scene.lights = {{PointLight{{0, 500, 0}}}};
    return make_plan(scene, machine).precision.value;
  };
  Mesh mesh;
  mesh.vertices = {{-500, 0, 500}, {500, 0, 500}, {0, 500, 500}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(precision_with({mesh, 0}), Precision::single_precision);
  EXPECT_EQ(precision_with({Cone{{0, 0, 500}, {0, 500, 500}, 500, 0}, 0}), Precision::mixed);
}

TEST(Plan, computes_in_single_though_a_round_mesh_has_slivers_at_its_pole) {
  const auto precision_with = [](double width) {
    Mesh mesh;
    mesh.vertices = {{0, 1, 0}, {1, 0, 0}, {0, 0, -1}, {width, 1, 0}};
    mesh.normals = {{0, 1, 0}, {1, 0.5, 0}, {0, 0.5, -1}, {0.2, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 3, 2}};
    return make_plan(scene_with({{mesh, 0}}), machine).precision.value;
  };
  EXPECT_EQ(precision_with(1e-17), Precision::single_precision);
  EXPECT_EQ(precision_with(1e-4), Precision::double_precision) << "rays meet what is so thin";
}

TEST(Plan, follows_rays_through_glass) {
  Scene scene = scene_with({{many_spheres(5), 1}});
  EXPECT_EQ(explained(scene)["kernel"]["choice"], "packets of rays");
  EXPECT_EQ(explained(scene)["features"]["refractions"], 0);
  Material glass;
  glass.transparency = 0.5;
  edit(scene.materials, [&](auto& materials) { materials[1] = glass; });
  EXPECT_EQ(explained(scene)["kernel"]["choice"], "packets of rays");
  EXPECT_EQ(explained(scene)["features"]["refractions"], 5);
  EXPECT_EQ(explained(scene)["features"]["reflections"], 0);
  edit(scene.objects, [](auto& objects) { objects[0].material = 0; });
  EXPECT_EQ(explained(scene)["features"]["refractions"], 0) << "it is nowhere used";
  Scene square = scene_with({{SphereSquare{{}, 1, 10}, 1}});
  square.materials = scene.materials;
  EXPECT_EQ(explained(square)["kernel"]["choice"], "packets of rays");
  EXPECT_EQ(explained(square)["features"]["refractions"], 5);
}

TEST(Plan, walks_a_square_whatever_its_size) {
  const nlohmann::json plan = explained(scene_with({{SphereSquare{{}, 1, 1'000'000'000}, 0}}));
  EXPECT_EQ(finder_for(plan, "a square of 2,000,000,000 x", "from the eye"), "cell walk");
  EXPECT_EQ(finder_for(plan, "a square", "from itself to the distant lights"), "neighbour list");
}

TEST(Plan, walks_a_square_under_a_low_light) {
  Scene scene = scene_with({{SphereSquare{{}, 1, 10}, 0}});
  scene.lights = {{DistantLight{{1, -0.01, 0}}}};
  EXPECT_EQ(finder_for(explained(scene), "a square", "from itself to the distant lights"),
            "cell walk");
}

/// The ground of half of all first scenes: what is near to it is far from the edge of its shadow.
TEST(Plan, computes_in_single_above_a_sphere_as_large_as_the_ground) {
  const auto precision_under = [](const Light& light, std::uint32_t material = 0) {
    Scene scene =
        scene_with({{Sphere{{0, -1000, 0}, 1000}, 0}, {Sphere{{0, 0.2, 0}, 0.2}, material}});
    scene.camera.origin = {13, 2, 3};
    scene.camera.look_at = {0, 0, 0};
    scene.lights = {light};
    return make_plan(scene, machine).precision.value;
  };
  EXPECT_EQ(precision_under({DistantLight{{-1, -2, -0.7}}}), Precision::single_precision);
  EXPECT_EQ(precision_under({PointLight{{6, 12, 9}}}), Precision::single_precision);
  EXPECT_EQ(precision_under({DistantLight{{-1, -0.002, 0}}}), Precision::double_precision)
      << "its own shadow begins near the eye";
  EXPECT_EQ(precision_under({PointLight{{3, 2, 1}}}), Precision::single_precision)
      << "near to it, but far in the numbers that tell it apart";
  EXPECT_EQ(precision_under({SkyLight{}}), Precision::single_precision);
  EXPECT_NE(precision_under({DistantLight{{-1, -2, -0.7}}}, 1), Precision::double_precision)
      << "mirrors show it";
  EXPECT_NE(precision_under({SkyLight{}}, 1), Precision::double_precision);
}

TEST(Plan, mixes_for_shadows_from_square_to_square_as_from_a_sphere) {
  const auto precision_with = [](std::vector<Object> over_it) {
    over_it.push_back({SphereSquare{{}, 1, 1000}, 0});
    Scene scene = scene_with(std::move(over_it));
    scene.lights = {{DistantLight{{0, -0.2, 1}}}};
    return make_plan(scene, machine).precision.value;
  };
  EXPECT_EQ(precision_with({}), Precision::single_precision);
  EXPECT_EQ(precision_with({{Sphere{{0, 10, 0}, 0.1}, 0}}), Precision::mixed);
  EXPECT_EQ(precision_with({{SphereSquare{{0, 10, 0}, 0.1, 5}, 0}}), Precision::mixed);
}

TEST(Plan, numbers_no_more_primitives_in_single_than_it_tells_apart) {
  Features features;
  features.primitives[kind_index<SphereKind>] = std::size_t{1} << 24;
  EXPECT_EQ(choose_precision(Precision::single_precision, features, {}).value,
            Precision::single_precision);
  ++features.primitives[kind_index<SphereKind>];
  for (const Precision wish : {Precision::single_precision, Precision::automatic})
    EXPECT_EQ(choose_precision(wish, features, {}).value, Precision::double_precision);
}

TEST(Plan, takes_the_plain_kernel_inside_a_sphere) {
  const Plan plan = make_plan(scene_with({{Sphere{{}, 1000}, 0}}), machine);
  EXPECT_EQ(plan.kernel.value, Kernel::single_rays);
  EXPECT_EQ(plan.precision.value, Precision::double_precision);
}

TEST(Plan, gives_each_thread_its_share_of_tiles) {
  Scene scene = scene_with({});
  EXPECT_EQ(make_plan(scene, {{1, "AVX2"}, 1}).tile_side_px.value, 64);
  scene.render.samples = 64;
  EXPECT_LT(make_plan(scene, {{1, "AVX2"}, 1}).tile_side_px.value, 64);
  scene.render.samples = 1;
  EXPECT_LT(make_plan(scene, {{1, "AVX2"}, 64}).tile_side_px.value, 64);
}

TEST(Plan, every_choice_has_a_reason) {
  const nlohmann::json plan = explained(scene_with(
      {{many_spheres(1000), 1}, {SphereSquare{{}, 1, 10}, 0}, {Plane{{0, -9, 0}, {0, 1, 0}}, 0}}));
  for (const char* const key :
       {"kernel", "instruction_set", "precision", "geometry", "sampling", "tiles", "frame"}) {
    EXPECT_TRUE(plan.at(key).contains("choice")) << key;
    EXPECT_GT(plan.at(key).at("reason").get<std::string>().size(), 15U) << key;
  }
  for (const nlohmann::json& row : plan.at("geometry").at("finders"))
    EXPECT_GT(row.at("reason").get<std::string>().size(), 15U) << row;
}

TEST(Plan, says_that_there_is_nothing_to_meet) {
  EXPECT_EQ(explained(scene_with({})).at("geometry").at("choice"), "nothing");
}

TEST(Plan, names_the_contract_that_ends_a_sampling) {
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

TEST(Pluralised, writes_numbers_as_people_do) {
  EXPECT_EQ(pluralised(0, "sphere"), "0 spheres");
  EXPECT_EQ(pluralised(1, "sphere"), "1 sphere");
  EXPECT_EQ(pluralised(999, "triangle"), "999 triangles");
  EXPECT_EQ(pluralised(1000, "sphere"), "1,000 spheres");
  EXPECT_EQ(grouped(12345678), "12,345,678");
  EXPECT_EQ(grouped(std::numeric_limits<std::uint64_t>::max()), "18,446,744,073,709,551,615");
}

}  // namespace
}  // namespace raytracer::test
