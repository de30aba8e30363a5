// Shadows where what is lit, what stands before the light, or a point light is far.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "engine/kernel/this_machine.h"
#include "engine/plan/health.h"
#include "engine/plan/plan.h"
#include "engine/render/tracer.h"
#include "engine/sample/pattern.h"
#include "tests/support/reference_plan.h"
#include "tests/support/scene_plan.h"
#include "tests/support/scenes.h"

namespace raytracer::test {
namespace {

json in_precision(json text, const char* precision) {
  text["render"] = {{"precision", precision}};
  return text;
}

/// Ground kilometres away, up to the horizon, and a lamp near the eye with something before it.
json far_ground(const Vec3& lamp, std::vector<json> objects, double fov = 0.02) {
  objects.push_back(plane_json({0, 0, 0}, {0, 1, 0}));
  json text = document(camera_json(120, 90, fov, {8, 6, 0}, {-100000, 6, 0}), objects,
                       {point_json(lamp, 30)});
  text["ambient"] = 1;
  text["background"] = {0, 0, 1};
  return text;
}

void expect_no_light_on_the_ground(const json& text) {
  const Vec3 shadow{0, 0, 0};
  const Vec3 sky{0, 0, 1};
  for (const char* precision : {"auto", "single", "double"}) {
    const Image image = image_of(in_precision(text, precision));
    int black = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        const Vec3 seen = color_at(image, x, y);
        black += seen == shadow ? 1 : 0;
        ASSERT_TRUE(seen == shadow || seen == sky)
            << precision << " at " << x << ", " << y << ": " << seen.x;
      }
    EXPECT_GT(black, 3000) << precision;
  }
}

/// All of the ball is nearer to the lamp than a thousandth of the way there.
TEST(LampShadow, of_a_ball_reaches_the_horizon) {
  expect_no_light_on_the_ground(far_ground({2, 1.6, 0}, {sphere_json({0, 2.8, 0}, 1.5)}));
}

TEST(LampShadow, of_many_balls_reaches_the_horizon) {
  std::vector<json> balls;
  balls.reserve(40);
  for (int i = 0; i < 40; ++i) balls.push_back(sphere_json({0, 2.8, 0}, 1.5 - 0.01 * i));
  expect_no_light_on_the_ground(far_ground({2, 1.6, 0}, balls));
}

TEST(LampShadow, of_a_plane_reaches_the_horizon) {
  expect_no_light_on_the_ground(far_ground({2, 30, 0}, {plane_json({0, 29.99, 0}, {0, 1, 0})}));
}

/// From the lamp, an edge is as sharp however far its shadow goes: single suffices.
TEST(LampShadow, of_a_mesh_reaches_the_horizon) {
  const json wall = {{"type", "mesh"},
                     {"vertices", {{0, 0, -4}, {0, 4, -4}, {0, 4, 4}, {0, 0, 4}}},
                     {"triangles", {{0, 1, 2}, {0, 2, 3}}}};
  const json text = far_ground({2, 1.6, 0}, {wall}, 0.4);
  EXPECT_EQ(make_plan(scene_of(text), this_machine(1)).precision.value,
            Precision::single_precision);
  const Image image = image_of(text);
  EXPECT_EQ(count_different(image, image_of(in_precision(text, "double"))), 0);
}

/// Balls on a floor under a lamp as far away as a sun: what is near to each other is not so to the
/// lamp. Single finds its shadows, too.
TEST(LampShadow, of_a_far_lamp_is_that_of_the_reference) {
  std::mt19937 random(4);  // the same numbers everywhere
  const auto from_to = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967295.0);
  };
  WorkerPool pool(2);
  for (const int count : {10, 40}) {
    for (const double far : {1e2, 1e4, 1e6, 1e12, 1e15, 1e17}) {
      std::vector<json> objects{plane_json({0, -0.5, 0}, {0, 1, 0})};
      for (int i = 0; i < count; ++i) {
        const double x = from_to(-4, 4);
        const double y = from_to(0, 3);
        objects.push_back(sphere_json({x, y, from_to(-4, 4)}, 0.4));
      }
      const json text = document(camera_json(150, 100, 0.8, {0, 4, -12}, {0, 0, 0}), objects,
                                 {point_json({far, far, 0}, 12 * far * far)});
      const Scene scene = scene_of(text);
      const Plan plan = make_plan(scene, this_machine(1));
      EXPECT_EQ(plan.precision.value, Precision::single_precision) << far;
      const Tracer tracer = make_tracer(reference_plan(plan), pack_scene(scene, &pool), pool);
      Image exact(150, 100);
      render_tile(tracer, sample_pattern(1), {0, 0, 150, 100}, {Transfer::linear, &exact});
      EXPECT_GT(count_lit(exact), 5000) << far;
      for (const char* precision : {"single", "double"})
        EXPECT_LE(count_different(image_of(in_precision(text, precision)), exact, 1.0 / 255), 2)
            << count << " balls, " << far << ", " << precision;
    }
  }
}

/// Their edges are as sharp as single has places near the eye, however far it is along the light.
TEST(DistantShadow, of_a_mesh_is_no_wider_for_its_height) {
  const Vec3 above = Vec3{-0.3, 1, -0.2} * 2e5;
  const json sheet = mesh_json({above + Vec3{0, 0, -3}, above + Vec3{3, 0, -3},
                                above + Vec3{3, 0, 3}, above + Vec3{0, 0, 3}},
                               {{0, 1, 2}, {0, 2, 3}});
  const json text = document(camera_json(100, 80, 0.4, {0.3, 1, -0.4}, {0, 0, 0}),
                             {plane_json({0, 0, 0}, {0, 1, 0}), sheet}, {distant_json(-above)});
  const Image exact = image_of(in_precision(text, "double"));
  EXPECT_GT(count_lit(exact), 2000);
  EXPECT_LT(count_lit(exact), 6000);
  EXPECT_LE(count_different(image_of(in_precision(text, "single")), exact, 1.0 / 255), 2);
}

/// What a triangle's side adds to its shadow, so that no light comes between two, is what rounding
/// may take from it: 2.5 epsilons. A pixel is half of one wide here, and the light slanting.
TEST(LampShadow, of_a_triangle_is_hardly_wider_than_it_is) {
  constexpr double eye = 1000;
  const json sheet = mesh_json({{-500, -300, 500}, {-500, 300, 500}, {-800, 0, 500}}, {{0, 1, 2}});
  const json text =
      document(camera_json(64, 16, 64 * 0x1p-24, {0, 0, eye}, {0, 0, 0}),
               {plane_json({0, 0, 0}, {0, 0, 1}), sheet}, {point_json({-eye, 0, eye}, 2e8)});
  const int exact = count_lit(image_of(in_precision(text, "double")));
  EXPECT_EQ(exact, 32 * 16);
  const int lit = count_lit(image_of(in_precision(text, "single")));
  EXPECT_LE(lit, exact);
  EXPECT_GE(lit, exact - 9 * 16);
}

/// Numbers around others, the same everywhere.
class Near {
 public:
  explicit Near(unsigned seed) : random_(seed) {}
  double operator()(double middle) {
    return middle + 0.2 * (static_cast<double>(random_()) / 4294967295.0 - 0.5);
  }

 private:
  std::mt19937 random_;
};

/// Three triangles around a corner that they share, before a light, and a plane that they shade.
struct Fan {
  static inline const Vec3 along{std::sqrt(0.5), std::sqrt(0.5), 0};  ///< towards the light
  static inline const Vec3 aside{std::sqrt(0.5), -std::sqrt(0.5), 0};
  static inline const Vec3 up{0, 0, 1};

  std::vector<Vec3> corners;
  Vec3 shaded;  ///< in the shadow of the shared corner

  /// `height`: how far they reach towards the light, against how far across.
  Fan(const Vec3& middle, const Vec3& of_plane, double size, double height, Near& near)
      : corners{middle}, shaded(of_plane) {
    for (const Vec3& corner : {aside, -0.5 * aside + 0.8 * up, -0.5 * aside - 0.8 * up}) {
      const double across = near(1);
      corners.push_back(middle + size * (across * corner + near(height) * along));
    }
  }

  json scene(const json& light, double fov, bool is_open) const {
    std::vector<std::array<int, 3>> triangles{{0, 1, 2}, {0, 2, 3}};
    if (!is_open) triangles.push_back({0, 3, 1});
    return document(camera_json(64, 64, fov, shaded + 3 * along + 4 * up, shaded),
                    {plane_json(shaded, along), mesh_json(corners, triangles)}, {light});
  }
};

void expect_no_holes(const Fan& fan, const json& light, double fov) {
  for (const char* precision : {"single", "double"})
    EXPECT_EQ(count_lit(image_of(in_precision(fan.scene(light, fov, false), precision))), 0)
        << precision << ", " << light.dump();
}

/// Places at a lamp's distance are 1e-4 apart here, and a pixel is 1e-5 wide: a side belongs to
/// both of its triangles all the same, and a corner to all.
TEST(LampShadow, of_a_far_lamp_has_no_holes_where_triangles_meet) {
  constexpr double far = 1e12;
  constexpr double fov = 64e-5 / 5;
  const json light = point_json(far * Fan::along, 12 * far * far);
  Near near(5);
  for (int i = 0; i < 8; ++i) {
    const Vec3 middle{near(0), near(0), near(0)};
    const Fan fan(middle, middle - 10 * Fan::along, 1, 0, near);
    EXPECT_GT(count_lit(image_of(fan.scene(light, fov, true))), 500);
    expect_no_holes(fan, light, fov);
  }
}

/// Triangles a million times farther away than what they shade: their places are 1e-10 apart, and a
/// pixel is 2e-11 wide.
TEST(LampShadow, of_far_triangles_has_no_holes_where_they_meet) {
  constexpr double far = 1e6;
  Near near(6);
  for (int i = 0; i < 8; ++i) {
    const Vec3 shaded{near(0), near(0), near(0)};
    const Fan fan(shaded + far * Fan::along, shaded, far, 0, near);
    for (const json& light :
         {point_json(shaded + 3 * far * Fan::along, 100 * far * far), distant_json(-Fan::along)}) {
      const json open = in_precision(fan.scene(light, 0.1, true), "double");
      EXPECT_GT(count_lit(image_of(open)), 500);
      expect_no_holes(fan, light, 64 * 2e-11 / 5);
    }
  }
}

/// As flat as it sees a triangle, a lamp stands above it.
TEST(LampShadow, of_a_vast_triangle_under_a_low_lamp_is_whole) {
  const json floor = mesh_json({{-1e12, 0, -1e12}, {1e12, 0, -1e12}, {0, 0, 1e12}}, {{0, 1, 2}});
  const json text =
      document(camera_json(40, 30, 0.8, {0, -2, -5}, {0, -3, 0}),
               {floor, plane_json({0, -3, 0}, {0, 1, 0})}, {point_json({0, 0.5, 0}, 400)});
  for (const char* precision : {"auto", "double"})
    EXPECT_EQ(count_lit(image_of(in_precision(text, precision))), 0) << precision;
}

/// A lamp in a tilted plane that passes near the eye lights what is before it.
TEST(LampShadow, of_the_plane_that_the_lamp_is_in_is_none) {
  const Vec3 normal{1, 2, 3};
  const json text = document(
      camera_json(40, 30, 0.8, normal * 0x1p-12, {18, -4, 6}),
      {plane_json({0, 0, 0}, normal, constant_material({0, 0, 0})), sphere_json({18, -4, 6}, 4)},
      {point_json({-29, 40, -17}, 60000)});
  for (const char* precision : {"auto", "single", "double"})
    EXPECT_GT(count_lit(image_of(in_precision(text, precision))), 200) << precision;
}

/// Single that a plan chose by itself it does not warn of, as it does of single that is asked for.
TEST(LampShadow, near_a_lamp_the_plan_agrees_with_itself) {
  const auto near_the_ground = [](double height, const char* precision) {
    const json text =
        document(camera_json(40, 30, 1, {0, 3, -8}, {0, 0, 0}), {plane_json({0, 0, 0}, {0, 1, 0})},
                 {point_json({0, height, 0}, 400)});
    return scene_of(in_precision(text, precision));
  };
  for (const auto& [height, chosen] :
       {std::pair{0.1, Precision::double_precision}, std::pair{0.2, Precision::single_precision}}) {
    const Scene scene = near_the_ground(height, "auto");
    const Plan plan = make_plan(scene, this_machine(1));
    EXPECT_EQ(plan.precision.value, chosen) << height;
    EXPECT_TRUE(find_strains(scene, plan).empty()) << height;
    const Scene single = near_the_ground(height, "single");
    EXPECT_EQ(find_strains(single, make_plan(single, this_machine(1))).size(), 1U) << height;
  }
}

}  // namespace
}  // namespace raytracer::test
