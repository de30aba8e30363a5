// Pixels under soft lights that are sampled by themselves, those of many blocks side by side: as in
// a whole picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/engine.h"
#include "engine/kernel/this_machine.h"
#include "engine/math/block.h"
#include "engine/plan/plan.h"
#include "engine/render/tracer.h"
#include "engine/sample/pattern.h"
#include "tests/support/reference_plan.h"
#include "tests/support/scene_plan.h"
#include "tests/support/scenes.h"

namespace raytracer::test {
namespace {

constexpr int width = 69;  // five by three blocks, of which the last ones are cut off
constexpr int height = 37;

/// A wide sun, a lamp and a sky over spheres before a wall, to a target.
json soft_document() {
  json sun = distant_json({1, 0, 1});
  sun["angle"] = 0.7;
  const json lamp = {{"type", "point"},
                     {"position", {-2, 3, -4}},
                     {"radius", 0.5},
                     {"falloff", "none"},
                     {"intensity", 0.4}};
  const json mirror = {{"color", {0.8, 0.8, 0.8}}, {"reflectivity", 0.3}};
  json text = document(camera_json(width, height, 1, {0, 0, -5}, {}),
                       {sphere_json({1.5, -1, 0}, 1, mirror), sphere_json({2.4, -0.7, -1}, 0.3),
                        sphere_json({-1, 0.5, 0}, 0.8), plane_json({0, 0, 2}, {0.3, -0.4, -1})},
                       {sun, lamp, {{"type", "sky"}, {"intensity", 0.5}}});
  text["render"]["target_rmse"] = 0.01;
  return text;
}

json without_wall(json text) {
  text["objects"].erase(3);
  text["background"] = "transparent";
  return text;
}

json with_glass(json text) {
  text["objects"][2]["material"] = {{"color", {1, 1, 1}}, {"transparency", 0.8}, {"ior", 1.5}};
  return text;
}

json with_dark_shadows(json text) {
  text["ambient"] = 0.2;
  text["shadows"] = "black";
  return text;
}

/// A third of each block's pixels in the image, and none of some blocks'.
std::vector<std::vector<std::uint8_t>> picked_places() {
  std::vector<std::vector<std::uint8_t>> picked;
  for (int y_begin = 0; y_begin < height; y_begin += block_side)
    for (int x_begin = 0; x_begin < width; x_begin += block_side) {
      std::vector<std::uint8_t>& places = picked.emplace_back();
      if (picked.size() % 5 == 0) continue;
      for (int y = 0; y < std::min(block_side, height - y_begin); ++y)
        for (int x = 0; x < std::min(block_side, width - x_begin); ++x)
          if ((x + y * y + y_begin) % 3 == 0)
            places.push_back(static_cast<std::uint8_t>(x + block_side * y));
    }
  return picked;
}

void expect_as_together(const Scene& scene, const Plan& plan, int samples, float most,
                        const std::string& by) {
  WorkerPool pool(1);
  const Tracer tracer = make_tracer(plan, pack_scene(scene, &pool), pool);
  const int channels = channel_count(scene);
  const SamplePattern pattern = jittered_pattern(samples);
  Image whole(width, height, channels);
  PixelSpreads spreads(width, height);
  render_tile(tracer, pattern, whole_image(width, height),
              {scene.render.transfer, &whole, {.pixels = &spreads}});

  const auto picked = picked_places();
  std::vector<BlockPixels> blocks;
  std::size_t count = 0;
  for (std::size_t i = 0; i < picked.size(); ++i) {
    const int across = (width + block_side - 1) / block_side;
    const int number = static_cast<int>(i);
    if (picked[i].empty()) continue;
    blocks.push_back(
        {number % across * block_side, number / across * block_side, picked[i], channels});
    count += picked[i].size();
  }
  std::vector<SampledPixel> sampled(count);
  sample_pixels(tracer, pattern, scene.render.transfer, blocks, sampled);

  std::size_t nth = 0;
  double varied = 0;
  for (const BlockPixels& block : blocks)
    for (const std::uint8_t place : block.places) {
      const int x = block.x_begin + place % block_side;
      const int y = block.y_begin + place / block_side;
      const SampledPixel& alone = sampled[nth++];
      const float* const together = whole.pixel(x, y);
      for (int k = 0; k < channels; ++k)
        ASSERT_NEAR(alone.values[static_cast<std::size_t>(k)], together[k], most)
            << by << ", " << samples << " samples, " << x << ' ' << y;
      const std::size_t at = spreads.index(x, y);
      ASSERT_NEAR(alone.spread.error2, spreads.error2[at], 1e-6 + 1e-3 * spreads.error2[at]) << by;
      ASSERT_NEAR(alone.spread.variance, spreads.variance[at], 1e-6 + 1e-3 * spreads.variance[at])
          << by;
      EXPECT_TRUE(alone.is_number);
      varied += static_cast<double>(alone.spread.variance);
    }
  EXPECT_GT(varied, 0.01) << by;
}

void expect_as_together_in_all_kernels(const json& text, float most) {
  Scene scene = scene_of(text);
  for (const Precision precision :
       {Precision::single_precision, Precision::automatic, Precision::double_precision}) {
    scene.render.precision = precision;
    for (const InstructionSet& set : supported_instruction_sets()) {
      const Plan plan = make_plan(scene, {set});
      ASSERT_GT(plan.light_sampling.value.sets, 1);
      for (const int samples : {8, 72}) expect_as_together(scene, plan, samples, most, set.name);
    }
  }
  const Plan plain = reference_plan(make_plan(scene, this_machine(1)));
  expect_as_together(scene, plain, 8, 0, "reference");
}

TEST(SoftPixels, are_those_of_a_whole_picture) {
  expect_as_together_in_all_kernels(soft_document(), 0);
}

TEST(SoftPixels, have_the_cover_of_a_whole_picture) {
  expect_as_together_in_all_kernels(without_wall(soft_document()), 0);
}

TEST(SoftPixels, see_any_of_a_light_as_in_a_whole_picture) {
  expect_as_together_in_all_kernels(with_dark_shadows(soft_document()), 0);
}

/// Rays that branch are added up in another order where more are traced together.
TEST(SoftPixels, are_those_of_a_whole_picture_through_glass) {
  expect_as_together_in_all_kernels(with_glass(soft_document()), 1e-6F);
}

TEST(SoftPixels, are_the_same_for_any_number_of_threads) {
  for (const json& text : {soft_document(), with_glass(soft_document())}) {
    const Scene scene = scene_of(text);
    std::vector<Image> images;
    for (const std::size_t threads : {1U, 2U, 5U}) {
      WorkerPool pool(threads);
      RenderProgress progress;
      images.push_back(render(scene, Limits{}, pool, progress).image);
      EXPECT_TRUE(images.back().values == images.front().values) << threads;
    }
  }
}

}  // namespace
}  // namespace raytracer::test
