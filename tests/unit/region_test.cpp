// A picture put together of regions is the picture: the same values, the same estimated error.
#include "engine/render/region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "tests/support/scenes.h"

namespace raytracer::test {
namespace {

Rendering whole(const float*, const PreparedScene& scene, WorkerPool& pool) {
  RenderProgress progress;
  return render(scene, Limits{}, pool, progress);
}
ByteRendering whole(const unsigned char*, const PreparedScene& scene, WorkerPool& pool) {
  RenderProgress progress;
  return render_bytes(scene, Limits{}, pool, progress);
}

template <typename Channel>
RegionRendering<Channel> part_of(const PreparedScene& scene, const Tile& region, WorkerPool& pool) {
  RenderProgress progress;
  auto part = render_region<Channel>(scene, region, pool, progress);
  if (!part) throw std::runtime_error("it was not stopped");
  return *std::move(part);
}

/// Of regions that come in the reverse order, each of its own preparation, as from other machines.
template <typename Channel>
void expect_same(const Scene& scene, int side_px, WorkerPool& pool) {
  const Camera& camera = scene.camera;
  const int samples = scene.render.samples.value_or(1);
  const auto expected =
      whole(static_cast<const Channel*>(nullptr), PreparedScene(scene, pool), pool);
  ImageOfRegions<Channel> image(camera.width, camera.height, samples, channel_count(scene));
  std::vector<Tile> regions = regions_of(camera.width, camera.height, side_px);
  std::reverse(regions.begin(), regions.end());
  for (const Tile& region : regions)
    image.add(part_of<Channel>(PreparedScene(scene, pool), region, pool));
  const auto made = std::move(image).finish();
  EXPECT_EQ(made.image.channels, expected.image.channels);
  EXPECT_TRUE(std::equal(made.image.values.begin(), made.image.values.end(),
                         expected.image.values.begin(), expected.image.values.end()));
  EXPECT_EQ(made.estimated_error, expected.estimated_error);
  EXPECT_EQ(made.samples_per_pixel, expected.samples_per_pixel);
  EXPECT_EQ(made.pixel_count, expected.pixel_count);
  EXPECT_EQ(made.precision, expected.precision);
  EXPECT_EQ(made.stop, expected.stop);
  EXPECT_EQ(made.beyond.clamped, expected.beyond.clamped);
  EXPECT_EQ(made.beyond.not_numbers, expected.beyond.not_numbers);
}

/// Spheres that mirror one another on a plane, or alone: what is followed and what is flat.
std::vector<json> documents(int width, int height) {
  json material = diffuse_material({0.9, 0.2, 0.1});
  material["reflectivity"] = 0.4;
  json mirrors =
      document(camera_json(width, height, 0.9),
               {sphere_json({-0.7, 0, 5}, 1, material), sphere_json({0.9, 0.4, 6}, 1, material),
                plane_json({0, -1, 0}, {0, 1, 0}, diffuse_material())},
               {distant_json({1, -2, 3}), point_json({0, 4, 2}, 30)});
  json bright = document(camera_json(width, height, 0.5), {sphere_json({0, 0, 4}, 1)},
                         {distant_json({1, -1, 2}, 5)});
  bright["background"] = {0.1, 0.2, 0.8};
  json many = document(camera_json(width, height, 0.6), {square_json({0, 0, 60}, 0.4, 30, "xy")},
                       {distant_json({1, -1, 2})});
  return {mirrors, bright, many};
}

TEST(Regions, make_the_picture) {
  WorkerPool pool(2);
  for (const auto& [width, height] : {std::pair{75, 41}, {16, 33}, {100, 7}})
    for (const json& scene : documents(width, height))
      for (const int samples : {1, 2, 3, 4, 16})
        for (const int side_px : {16, 32, 64, 160}) {
          SCOPED_TRACE(testing::Message() << width << " x " << height << ", " << samples
                                          << " samples, sides of " << side_px << ": " << scene);
          Overrides overrides;
          overrides.samples = samples;
          const Scene read = scene_of(scene, overrides);
          expect_same<float>(read, side_px, pool);
          expect_same<unsigned char>(read, side_px, pool);
        }
}

/// Directions of soft lights are swept for the points of a region, or of the whole picture.
TEST(Regions, make_the_picture_under_soft_light) {
  json spheres{
      {"type", "spheres"}, {"radius", 0.2}, {"material", diffuse_material({0.5, 0.4, 0.3})}};
  for (int i = 0; i < 2500; ++i)
    spheres["centers"].push_back({i % 13 - 6.0, i / 13 % 14 - 7.0, 12 + i / 182.0});
  json sun = distant_json({1, -1, 2});
  sun["angle"] = 0.3;
  const json scene = document(camera_json(75, 41, 0.9), {spheres}, {{{"type", "sky"}}, sun});
  for (const int samples : {1, 4})
    for (const std::size_t threads : {1U, 3U})
      for (const int side_px : {32, 64}) {
        WorkerPool pool(threads);
        Overrides overrides;
        overrides.samples = samples;
        const Scene read = scene_of(scene, overrides);
        ASSERT_EQ(finder_of(PreparedScene(read, pool).plan().finders[kind_index<SphereKind>],
                            RayKind::to_soft_light),
                  Finder::light_sweep);
        expect_same<unsigned char>(read, side_px, pool);
      }
}

TEST(Regions, make_the_picture_with_its_cover) {
  WorkerPool pool(2);
  for (json scene : documents(75, 41))
    for (const int samples : {1, 16}) {
      scene["background"] = "transparent";
      Overrides overrides;
      overrides.samples = samples;
      const Scene read = scene_of(scene, overrides);
      expect_same<float>(read, 32, pool);
      EXPECT_THROW(part_of<unsigned char>(PreparedScene(read, pool), {0, 0, 32, 32}, pool),
                   std::logic_error);
    }
}

TEST(Regions, cover_the_picture_once) {
  for (const auto& [width, height] : {std::pair{75, 41}, {16, 16}, {1, 1}, {1000, 17}})
    for (const int side_px : {16, 48, 2000}) {
      std::vector<int> count(static_cast<std::size_t>(width * height));
      for (const Tile& region : regions_of(width, height, side_px))
        for (int y = region.y_begin; y < region.y_end; ++y)
          for (int x = region.x_begin; x < region.x_end; ++x)
            ++count.at(static_cast<std::size_t>(y * width + x));
      EXPECT_EQ(std::count(count.begin(), count.end(), 1), width * height);
    }
}

TEST(Regions, of_a_contract_are_refused) {
  WorkerPool pool(1);
  Overrides overrides;
  overrides.target_rmse = 0.01;
  const Scene scene = scene_of(documents(32, 32).front(), overrides);
  RenderProgress progress;
  EXPECT_THROW(render_region<float>(PreparedScene(scene, pool), {0, 0, 16, 16}, pool, progress),
               std::logic_error);
}

TEST(Regions, stopped_one_is_none) {
  WorkerPool pool(1);
  const Scene scene = scene_of(documents(64, 64).front());
  RenderProgress progress;
  progress.stop = true;
  EXPECT_FALSE(render_region<float>(PreparedScene(scene, pool), {0, 0, 64, 64}, pool, progress));
}

TEST(Regions, wrong_one_changes_nothing) {
  WorkerPool pool(1);
  Overrides overrides;
  overrides.samples = 4;
  const Scene scene = scene_of(documents(40, 40).front(), overrides);
  const RegionRendering<float> right =
      part_of<float>(PreparedScene(scene, pool), {16, 16, 32, 32}, pool);
  ImageOfRegions<float> image(40, 40, 4);
  const auto expect_refused = [&](RegionRendering<float> wrong) {
    EXPECT_THROW(image.add(wrong), std::invalid_argument);
  };
  for (const Tile& region : {Tile{-16, 16, 0, 32},
                             {16, -16, 32, 0},
                             {32, 16, 48, 32},
                             {16, 32, 32, 48},
                             {16, 16, 16, 32},
                             {32, 16, 16, 32},
                             {0, 0, 40, 40}}) {
    RegionRendering<float> wrong = right;
    wrong.region = region;
    expect_refused(wrong);
  }
  RegionRendering<float> too_short = right;
  too_short.values.pop_back();
  expect_refused(too_short);
  RegionRendering<float> without_errors = right;
  without_errors.subtile_error2.clear();
  expect_refused(without_errors);
  EXPECT_EQ(count_lit(image.so_far()), 0);
  image.add(right);
  EXPECT_GT(count_lit(image.so_far()), 0);
}

TEST(Regions, beyond_the_picture_are_refused) {
  WorkerPool pool(1);
  const Scene scene = scene_of(documents(40, 40).front());
  RenderProgress progress;
  for (const Tile& region :
       {Tile{32, 32, 48, 40}, {48, 48, 64, 64}, {-16, 0, 16, 16}, {16, 0, 16, 16}})
    EXPECT_THROW(render_region<float>(PreparedScene(scene, pool), region, pool, progress),
                 std::invalid_argument);
}

}  // namespace
}  // namespace raytracer::test
