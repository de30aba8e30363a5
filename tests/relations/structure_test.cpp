// The picture does not depend on the structure that finds the objects.

#include <gtest/gtest.h>

#include <memory>

#include "engine/plan/plan.h"
#include "engine/render/tracer.h"
#include "tests/relations/varied_scene.h"

namespace raytracer::test {
namespace {

/// The reference kernel's image with a structure of type S.
template <typename S>
Image reference_image(const Scene& scene) {
  WorkerPool pool(1);
  auto packed = std::make_unique<const PackedScene>(pack_scene(scene, make_frame(scene), pool));
  const PackedScene& kept = *packed;
  const auto structure = [&] {
    if constexpr (std::is_same_v<S, Bvh>)
      return Bvh::build(kept, pool);
    else
      return BruteForce(kept);
  }();
  const Tracer tracer = ReferenceTracer{std::move(packed), structure};
  Image image(kept.view.width, kept.view.height);
  for (const Tile& tile : split_into_tiles(image.width, image.height, 32))
    render_tile(tracer, sample_pattern(scene.render.samples.value_or(1)), Transfer::linear, tile,
                &image);
  return image;
}

/// Renders by brute force, the definition, by the tree, and as the engine chooses.
void expect_equal_images(json text) {
  text["render"]["precision"] = "double";
  const Scene scene = scene_of(text);
  const Image by_force = reference_image<BruteForce>(scene);
  EXPECT_EQ(count_different(by_force, reference_image<Bvh>(scene)), 0);
  // Other kernels round differently: on an edge, hardly ever, to the other side.
  EXPECT_LE(count_different(by_force, image_of(scene), 1e-6), 2);
  EXPECT_GT(count_lit(by_force), 10);
}

TEST(Structure, MakesNoDifferenceInTheVariedScene) {
  for (const char* shadows : {"black", "ambient", "off"}) {
    json text = varied_scene();
    text["shadows"] = shadows;
    text["objects"].push_back(filler());
    text["render"]["samples"] = 4;
    expect_equal_images(text);
  }
}

TEST(Structure, MakesNoDifferenceAmongManySpheresAndTriangles) {
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

TEST(Structure, MakesNoDifferenceInAGridOfTouchingSpheresSeenAlongItsAxes) {
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

TEST(Structure, TilesCoverTheImageOnce) {
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
