// Every instruction set integrates the same along lines, in blocks and in single pixels, and what
// the lines tell of their errors is true.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/engine.h"
#include "engine/kernel/simd/instruction_sets.h"
#include "engine/plan/plan.h"
#include "engine/render/tracer.h"
#include "engine/tradeoff/difference.h"
#include "tests/support/scenes.h"

namespace raytracer::test {
namespace {

/// A large and a small sphere over a square, with shadows of each on each, of a width and a height
/// that no packet divides.
json balls_over_a_square(double intensity = 0.4) {
  return document(camera_json(53, 37, 1, {0, 3, -8}, {}),
                  {sphere_json({-1, 0, 0}, 1.2), sphere_json({1.2, 0.5, -1}, 0.4),
                   square_json({0, -2, 0}, 0.5, 4)},
                  {distant_json({1, -1, 1}, intensity), distant_json({-0.7, -1, 0.2}, intensity)});
}

Scene with_target(json text, const char* precision) {
  text["render"] = {{"target_rmse", 0.01}, {"precision", precision}};
  return scene_of(text);
}

struct Integrated {
  Image image;
  PixelSpreads spreads;
  int left = 0;
  BeyondRange beyond;

  Integrated(const Plan& plan, const Scene& scene, std::size_t lines)
      : image(scene.camera.width, scene.camera.height), spreads(image.width, image.height) {
    WorkerPool pool(1);
    const Tracer tracer = make_tracer(plan, scene, pool);
    for (const Tile& tile : split_into_tiles(image.width, image.height, block_side)) {
      const IntegratedBlock block =
          integrate_block(tracer, {lines}, scene.render.transfer, tile, image, spreads);
      left += block.left;
      beyond += block.beyond;
    }
  }
};

double told_error(const Integrated& integrated) {
  double told2 = 0;
  for (const float error2 : integrated.spreads.error2) told2 += static_cast<double>(error2);
  return std::sqrt(told2 / static_cast<double>(integrated.image.values.size()));
}

Image reference_of(json text) {
  text["render"] = {{"samples", 2048}, {"precision", "double"}};
  return image_of(text);
}

TEST(Lines, AreTheSameInAllInstructionSets) {
  const Image exact = reference_of(balls_over_a_square());
  for (const char* precision : {"single", "double"}) {
    const Scene scene = with_target(balls_over_a_square(), precision);
    for (const InstructionSet& set : supported_instruction_sets()) {
      const Plan plan = make_plan(scene, {set});
      ASSERT_EQ(plan.integration.value, Integration::lines);
      const Integrated coarse(plan, scene, 3);
      const Integrated fine(plan, scene, 12);
      EXPECT_EQ(coarse.left, 0) << set.name;
      EXPECT_LT(difference(coarse.image, exact).rmse, 0.004) << set.name << ", " << precision;
      EXPECT_LT(difference(fine.image, exact).rmse, 0.0007) << set.name << ", " << precision;
    }
  }
}

/// By light that can be shown, and by light that is clamped.
TEST(Lines, TellTheirErrors) {
  for (const double intensity : {0.4, 1.0}) {
    const Image exact = reference_of(balls_over_a_square(intensity));
    const Scene scene = with_target(balls_over_a_square(intensity), "single");
    for (const std::size_t lines : {3U, 6U}) {
      const Integrated integrated(make_plan(scene, this_machine(1)), scene, lines);
      const double told = told_error(integrated);
      const double rmse = difference(integrated.image, exact).rmse;
      EXPECT_EQ(integrated.left, 0);
      EXPECT_EQ(integrated.beyond.clamped > 0, intensity > 0.5);
      EXPECT_GT(told, rmse / 2) << lines;
      EXPECT_LT(told, 2 * rmse) << lines;
    }
  }
}

TEST(Lines, OfSinglePixelsAreThoseOfTheirBlock) {
  for (const char* precision : {"single", "double"}) {
    const Scene scene = with_target(balls_over_a_square(), precision);
    for (const InstructionSet& set : supported_instruction_sets()) {
      const Plan plan = make_plan(scene, {set});
      const Integrated all(plan, scene, 6);
      WorkerPool pool(1);
      const Tracer tracer = make_tracer(plan, scene, pool);
      const std::vector<std::uint8_t> places{0, 3, 17, 5, 21, 54, 130, 255};
      std::vector<SampledPixel> pixels(places.size());
      integrate_pixels(tracer, {6}, scene.render.transfer, {16, 16, places}, pixels);
      for (std::size_t i = 0; i < places.size(); ++i) {
        const int x = 16 + places[i] % block_side;
        const int y = 16 + places[i] / block_side;
        EXPECT_TRUE(pixels[i].is_number);
        for (std::size_t k = 0; k < 3; ++k)
          EXPECT_NEAR(pixels[i].color[k], all.image.pixel(x, y)[k], 1e-5)
              << set.name << " at " << x << ", " << y;
      }
    }
  }
}

/// Where spheres intersect, and where more are in sight than are looked for.
TEST(Lines, AreNotDrawnWhereTheyWouldNotBeExact) {
  const auto left_of = [](const json& text) {
    const Scene scene = with_target(text, "single");
    return Integrated(make_plan(scene, this_machine(1)), scene, 3).left;
  };
  const json camera = camera_json(32, 32, 0.5, {0, 0, -8}, {});
  const json light = distant_json({1, -1, 1});
  EXPECT_EQ(left_of(document(camera, {sphere_json({-1, 0, 0}, 0.9)}, {light})), 0);
  EXPECT_NE(left_of(document(camera, {sphere_json({-0.5, 0, 0}, 1), sphere_json({0.5, 0, 0}, 1)},
                             {light})),
            0);
  EXPECT_NE(left_of(document(camera_json(32, 32, 0.5, {0, 3, -8}, {0, -2, 40}),
                             {square_json({0, -2, 40}, 0.05, 200)}, {light})),
            0);
}

/// Those beyond the eye's plane have silhouettes' cones that go on before it.
TEST(Lines, DoNotShowWhatIsBehindTheEye) {
  const json text = document(
      camera_json(48, 32, 2.7, {0, 0, 0}, {0, 0, 1}),
      {sphere_json({6, 0.5, -1.5}, 3), sphere_json({-5, -3, -1}, 2), sphere_json({0, 0, 5}, 1)},
      {distant_json({0, -1, 1})});
  const Scene scene = with_target(text, "double");
  const Plan plan = make_plan(scene, this_machine(1));
  ASSERT_EQ(plan.integration.value, Integration::lines);
  EXPECT_LT(difference(image_of(scene), reference_of(text)).rmse, 0.01);
}

/// Along a line it is a step of less than the line's numbers tell apart.
TEST(Lines, EndWhereASphereIsAsGoodAsAPoint) {
  for (const double radius : {1e-4, 1e-8, 1e-12, 1e-17})
    for (const char* precision : {"single", "double"}) {
      const json text = document(camera_json(17, 9, 0.5, {0, 0, -10}, {}),
                                 {sphere_json({0, 0, 0}, radius)}, {distant_json({0, 0, 1})});
      const Image image = image_of(with_target(text, precision));
      EXPECT_LT(color_at(image, 8, 4).x, 1e-3) << radius;
    }
}

/// What a square shadows, beyond its own spheres, and what is several times brighter than can be
/// shown has edges that lines do not look for.
TEST(Lines, LeaveShadowsOfSquaresAndGlareToSamples) {
  const json camera = camera_json(32, 32, 0.8, {0, 2, -8}, {});
  const auto left_of = [&](const std::vector<json>& objects, double intensity) {
    const Scene scene =
        with_target(document(camera, objects, {distant_json({0.2, -1, 0.3}, intensity)}), "single");
    const Plan plan = make_plan(scene, this_machine(1));
    EXPECT_EQ(plan.integration.value, Integration::lines);
    return Integrated(plan, scene, 3).left;
  };
  const json ball = sphere_json({0, 0, 0}, 1);
  EXPECT_EQ(left_of({ball, square_json({0, -2, 0}, 0.5, 2)}, 0.5), 0);
  EXPECT_NE(left_of({ball, square_json({0, 2, 2}, 0.5, 2)}, 0.5), 0);
  EXPECT_EQ(left_of({ball}, 2), 0);
  EXPECT_NE(left_of({ball}, 50), 0);
}

/// Of a ball against black, which the transfer to sRGB makes much of, two corners lie between three
/// lines: that they agree is no reason to trust them.
TEST(Lines, ReckonWithCornersBetweenThem) {
  json ball = document(
      camera_json(44, 31, 0.326576968, {0.900473744, 1.47136596, -7.25698634},
                  {0.812666991, 0.378132693, 0}),
      {sphere_json({0.971107643, 0.349931894, -1.26353144}, 0.514337376,
                   {{"ka", 0.36}, {"kd", 0.644163308}, {"ks", 0.795472939}, {"shininess", 1}})},
      {distant_json({0.818305731, -0.690955785, 0.530956188}, 2.66159229)});
  ball["background"] = {0, 0, 0};
  ball["ambient"] = 0;
  ball["shadows"] = "off";
  const auto image = [&](const json& render) {
    json text = ball;
    text["render"] = render;
    text["render"]["transfer"] = "srgb";
    return image_of(text);
  };
  const Image exact = image({{"samples", 4096}});
  EXPECT_LT(difference(image({{"target_rmse", 0.001}, {"precision", "single"}}), exact).rmse,
            0.001);
}

/// Where the light is too bright to be shown, colours are cut off along a line that nothing else
/// marks: it is found finely enough, its pixels are counted, and the error told is true.
TEST(Lines, LookFinelyAtClampedColours) {
  json bright = document(camera_json(53, 37, 0.6, {0, 8, -12}, {}),
                         {square_json({0, 0, 0}, 0.25, 12)}, {distant_json({0.3, -1, 0.5}, 3)});
  const Image exact = reference_of(bright);
  const Scene scene = with_target(bright, "single");
  const Plan plan = make_plan(scene, this_machine(1));
  ASSERT_EQ(plan.integration.value, Integration::lines);
  // With as few points as other colours need they are off by a tenth to a third more.
  const std::vector<std::pair<std::size_t, double>> bounds{{3, 0.0064}, {6, 0.0019}, {12, 0.0008}};
  for (const auto& [lines, bound] : bounds) {
    const Integrated integrated(plan, scene, lines);
    const double rmse = difference(integrated.image, exact).rmse;
    EXPECT_EQ(integrated.left, 0);
    EXPECT_EQ(integrated.beyond.not_numbers, 0U);
    EXPECT_NEAR(static_cast<double>(integrated.beyond.clamped), 1800, 10);
    EXPECT_LT(rmse, bound) << lines;
    EXPECT_GT(told_error(integrated), rmse / 2) << lines;
    EXPECT_LT(told_error(integrated), 2 * rmse) << lines;
  }
}

}  // namespace
}  // namespace raytracer::test
