// Every kernel tells the same errors of an image's parts.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/engine.h"
#include "engine/kernel/simd/render_tile.h"
#include "engine/plan/plan.h"
#include "engine/render/tracer.h"
#include "engine/sample/pattern.h"
#include "tests/support/scenes.h"

namespace raytracer::test {
namespace {

/// Of a width and a height that no packet divides.
Scene balls() {
  return scene_of(document(camera_json(37, 23, 1, {0, 0, -5}, {}),
                           {sphere_json({}, 1.5), sphere_json({1, 1, -1}, 0.3)},
                           {distant_json({1, 0, 1}), distant_json({0, 1, 1})}));
}

std::vector<double> errors_of(const Plan& plan, const Scene& scene, const Tile& tile) {
  WorkerPool pool(1);
  const Tracer tracer = make_tracer(plan, scene, pool);
  Image image(scene.camera.width, scene.camera.height);
  PartErrors errors(image.width, image.height);
  render_tile(tracer, sample_pattern(8), scene.render.transfer, tile, &image, &errors);
  return errors.all();
}

/// The errors of a tile by the reference kernel and by every instruction set in either precision.
void expect_alike(Scene scene, const Tile& tile) {
  Plan plain = make_plan(scene, this_machine(1));
  plain.kernel.value = Kernel::brute_force;
  const std::vector<double> expected = errors_of(plain, scene, tile);
  double sum = 0;
  for (const double error2 : expected) sum += error2;
  ASSERT_GT(sum, 0.01);
  for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
    scene.render.precision = precision;
    for (const InstructionSet& set : supported_instruction_sets()) {
      const std::vector<double> errors = errors_of(make_plan(scene, {set}), scene, tile);
      for (std::size_t i = 0; i < errors.size(); ++i)
        EXPECT_NEAR(errors[i], expected[i], 1e-5 + 1e-3 * expected[i]) << set.name << ", " << i;
    }
  }
}

TEST(PartErrors, areTheReferencesInAllKernels) { expect_alike(balls(), {0, 0, 37, 23}); }

TEST(PartErrors, areOfEncodedColours) {
  Scene scene = balls();
  scene.render.transfer = Transfer::srgb;
  expect_alike(scene, {0, 0, 37, 23});
}

TEST(PartErrors, areOfTheTracedPartsAlone) {
  const Scene scene = balls();
  constexpr std::uint16_t some = 0b0110'0010'0100'0001;
  const Tile block{16, 0, 32, 16, some};
  expect_alike(scene, block);
  const std::vector<double> errors = errors_of(make_plan(scene, this_machine(1)), scene, block);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const bool is_traced = i / parts_in_block == 1 && (some >> i % parts_in_block & 1) != 0;
    EXPECT_EQ(errors[i] > 0 && !is_traced, false) << i;
  }
}

TEST(PartErrors, areNoneWithoutHalves) {
  const Scene scene = balls();
  WorkerPool pool(1);
  const Tracer tracer = make_tracer(make_plan(scene, this_machine(1)), scene, pool);
  Image image(37, 23);
  PartErrors errors(37, 23);
  render_tile(tracer, sample_pattern(7), Transfer::linear, {0, 0, 37, 23}, &image, &errors);
  for (const double error2 : errors.all()) EXPECT_EQ(error2, 0);
}

}  // namespace
}  // namespace raytracer::test
