// The picture does not depend on the structure that finds the objects.

#include <gtest/gtest.h>

#include "engine/kernel/this_machine.h"
#include "engine/plan/plan.h"
#include "engine/render/tracer.h"
#include "tests/relations/varied_scene.h"
#include "tests/support/reference_plan.h"
#include "tests/support/scene_plan.h"

namespace raytracer::test {
namespace {

/// The reference's image, by such a finder.
Image reference_image(const Scene& scene, Finder finder) {
  WorkerPool pool(1);
  const Plan plan = reference_plan(make_plan(scene, this_machine(1)), finder);
  const Tracer tracer = make_tracer(plan, pack_scene(scene, &pool), pool);
  Image image(scene.camera.width, scene.camera.height);
  for (const Tile& tile : split_into_tiles(image.width, image.height, 32))
    render_tile(tracer, sample_pattern(scene.render.samples.value_or(1)), tile,
                {Transfer::linear, &image});
  return image;
}

/// Renders one by one, the definition, by trees, and as the engine chooses.
void expect_equal_images(json text) {
  text["render"]["precision"] = "double";
  const Scene scene = scene_of(text);
  const Image one_by_one = reference_image(scene, Finder::one_by_one);
  EXPECT_EQ(count_different(one_by_one, reference_image(scene, Finder::tree)), 0);
  // Other kernels round differently: on an edge, hardly ever, to the other side.
  EXPECT_LE(count_different(one_by_one, image_of(scene), 1e-6), 2);
  EXPECT_GT(count_lit(one_by_one), 10);
}

TEST(Structure, makes_no_difference_in_the_varied_scene) {
  for (const char* shadows : {"black", "ambient", "off"}) {
    json text = varied_scene();
    text["shadows"] = shadows;
    text["objects"].push_back(filler());
    text["render"]["samples"] = 4;
    expect_equal_images(text);
  }
}

TEST(Structure, makes_no_difference_among_many_spheres_and_triangles) {
  Random random(50);
  for (int round = 0; round < 4; ++round) {
    std::vector<json> objects;
    for (int i = 0; i < 60; ++i) {
      const json material = {{"color", vector_json(random.point(0, 1))},
                             {"reflectivity", random.between(0, 1)}};
      objects.push_back(sphere_json(random.point(-4, 4), random.between(0.05, 1), material));
      const Vec3 corner = random.point(-4, 4);
      objects.push_back(
          mesh_json({corner, corner + random.point(-2, 2), corner + random.point(-2, 2)},
                    {{0, 1, 2}}, material));
    }
    expect_equal_images(document(camera_json(64, 48, 1.2, {0, 0, -9}, {0, 0, 0}), objects,
                                 {distant_json({1, -2, 1}), point_json({0, 0, -8}, 500)}));
  }
}

TEST(Structure, makes_no_difference_in_a_grid_of_touching_spheres_seen_along_its_axes) {
  json centers = json::array();
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      for (int k = 0; k < 6; ++k) centers.push_back({i - 2.5, j - 2.5, k - 2.5});
  const json grid = {{"type", "spheres"},
                     {"centers", centers},
                     {"radius", 0.5},
                     {"material", {{"reflectivity", 0.5}}}};
  for (const Vec3& eye :
       {Vec3{0, 0, -9}, Vec3{9, 0, 0}, Vec3{0, 9, 0}, Vec3{0, 0, 0}, Vec3{2, 2, -2}})
    expect_equal_images(
        document(camera_json(63, 47, 1.0, eye, length(eye) > 0 ? Vec3{} : Vec3{0, 0, 1}), {grid},
                 {distant_json({0, -1, 0}), point_json(eye, 100)}));
}

TEST(Structure, tiles_cover_the_image_once) {
  for (const auto& [width, height] : {std::pair{1, 1}, {32, 32}, {33, 31}, {700, 500}}) {
    std::vector<int> covered(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (const Tile& tile : split_into_tiles(width, height, 32))
      for (int y = tile.y_begin; y < tile.y_end; ++y)
        for (int x = tile.x_begin; x < tile.x_end; ++x)
          ++covered[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                    static_cast<std::size_t>(x)];
    EXPECT_EQ(std::count(covered.begin(), covered.end(), 1), std::ssize(covered));
  }
}

}  // namespace
}  // namespace raytracer::test
