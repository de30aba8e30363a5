// Every kernel counts the pixels that it clamps and those that are no numbers.
#include <gtest/gtest.h>

#include <limits>

#include "engine/engine.h"
#include "engine/kernel/this_machine.h"
#include "engine/plan/plan.h"
#include "engine/render/tracer.h"
#include "engine/sample/pattern.h"
#include "tests/support/reference_plan.h"
#include "tests/support/scene_plan.h"
#include "tests/support/scenes.h"

namespace raytracer::test {
namespace {

/// A ball that two lights, one light or none reach: 1.5, 0.75 or 0. Of a width and a height that no
/// packet divides.
Scene lit_ball() {
  json text = document(camera_json(61, 43, 1, {0, 0, -5}, {}),
                       {sphere_json({}, 1.5, constant_material({1, 1, 1}))},
                       {distant_json({1, 0, 1}), distant_json({0, 1, 1})});
  text["ambient"] = 0.75;
  text["background"] = {0.5, 0.5, 0.5};
  return scene_of(text);
}

struct Traced {
  BeyondRange beyond;
  Image image;
};

Traced trace(const Plan& plan, const Scene& scene, int samples) {
  WorkerPool pool(1);
  const Tracer tracer = make_tracer(plan, pack_scene(scene, &pool), pool);
  Traced traced{{}, Image(scene.camera.width, scene.camera.height)};
  for (const Tile& tile : split_into_tiles(scene.camera.width, scene.camera.height, 32))
    traced.beyond +=
        render_tile(tracer, sample_pattern(samples), tile, {Transfer::linear, &traced.image});
  return traced;
}

/// The scene's plans for the reference and for every instruction set in either precision.
std::vector<Plan> all_plans(Scene scene) {
  std::vector<Plan> plans{reference_plan(make_plan(scene, this_machine(1)))};
  for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
    scene.render.precision = precision;
    for (const InstructionSet& set : supported_instruction_sets())
      plans.push_back(make_plan(scene, {set}));
  }
  return plans;
}

std::size_t count_pixels(const Image& image, float value) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < image.values.size(); i += 3)
    count += image.values[i] == value ? 1 : 0;
  return count;
}

TEST(BeyondRange, clamped_pixels_are_those_of_both_lights) {
  const Scene scene = lit_ball();
  for (const Plan& plan : all_plans(scene)) {
    const Traced traced = trace(plan, scene, 1);
    EXPECT_GT(traced.beyond.clamped, 100U);
    EXPECT_EQ(traced.beyond.clamped, count_pixels(traced.image, 1));
    EXPECT_EQ(traced.beyond.not_numbers, 0U);
  }
}

TEST(BeyondRange, a_pixel_counts_once_for_all_of_its_samples) {
  const Scene scene = lit_ball();
  const std::vector<Plan> plans = all_plans(scene);
  const BeyondRange expected = trace(plans[0], scene, 7).beyond;
  EXPECT_GT(expected.clamped, trace(plans[0], scene, 1).beyond.clamped);
  for (const Plan& plan : plans) EXPECT_EQ(trace(plan, scene, 7).beyond.clamped, expected.clamped);
}

TEST(BeyondRange, what_is_no_number_is_counted_though_it_is_clamped) {
  Scene scene = lit_ball();
  const Image image = trace(all_plans(scene)[0], scene, 1).image;
  const std::size_t lit = count_pixels(image, 1) + count_pixels(image, 0.75F);
  Material material = scene.materials[0];
  material.kd = std::numeric_limits<double>::quiet_NaN();  // which no document can say
  scene.materials = {material};
  for (const Plan& plan : all_plans(scene)) {
    const Traced traced = trace(plan, scene, 1);
    EXPECT_EQ(traced.beyond.not_numbers, lit);
    EXPECT_EQ(traced.beyond.clamped, 0U);
  }
}

TEST(BeyondRange, what_is_no_number_is_the_same_byte_in_every_kernel) {
  Scene scene = lit_ball();
  Material material = scene.materials[0];
  material.kd = std::numeric_limits<double>::quiet_NaN();
  scene.materials = {material};
  WorkerPool pool(1);
  std::vector<unsigned char> of_reference;
  for (const Plan& plan : all_plans(scene)) {
    ByteImage image(scene.camera.width, scene.camera.height);
    for (const Tile& tile : split_into_tiles(image.width, image.height, 64))
      render_tile(make_tracer(plan, pack_scene(scene, &pool), pool), sample_pattern(1), tile,
                  {Transfer::linear, &image});
    const std::vector<unsigned char> bytes(image.values.begin(), image.values.end());
    if (of_reference.empty()) of_reference = bytes;
    EXPECT_EQ(bytes, of_reference) << plan.instruction_set.name;
  }
}

TEST(BeyondRange, a_render_reports_its_pixels) {
  const Scene scene = lit_ball();
  WorkerPool pool(2);
  RenderProgress progress;
  const Rendering floats = render(scene, {}, pool, progress);
  EXPECT_GT(floats.beyond.clamped, 100U);
  EXPECT_EQ(floats.beyond.clamped, count_pixels(floats.image, 1));
  EXPECT_EQ(render_bytes(scene, {}, pool, progress).beyond.clamped, floats.beyond.clamped);
}

}  // namespace
}  // namespace raytracer::test
