// Glass against what is known: Snell's law, total reflection, Fresnel's reflectance, and what of a
// light comes through.

#include <gtest/gtest.h>

#include <numbers>

#include "tests/analytic/expect_color.h"

namespace raytracer::test {
namespace {

const Vec3 behind{0.25, 0.5, 1};

/// Shows nothing of its own.
json glass(double transparency, double ior = 1.5) {
  return {{"ka", 0}, {"kd", 0}, {"ks", 0}, {"transparency", transparency}, {"ior", ior}};
}

/// What the camera's one ray sees, along `direction` from the origin, on this background.
Vec3 seen_along(const Vec3& direction, const std::vector<json>& objects) {
  json text = document(camera_json(1, 1, 1e-6, {}, direction), objects, {});
  text["background"] = vector_json(behind);
  return only_color(text);
}

TEST(Glass, shows_as_much_of_what_is_behind_as_its_transparency_says) {
  for (const double transparency : {0.25, 0.5, 1.0}) {
    const json pane = plane_json({0, 0, 5}, {0, 0, -1}, glass(transparency));
    EXPECT_LE(distance(seen_along({0, 0, 1}, {pane}), behind * transparency), 1e-7);
    const json ball = sphere_json({0, 0, 5}, 1, glass(transparency));
    EXPECT_LE(distance(seen_along({0, 0, 1}, {ball}), behind * (transparency * transparency)),
              1e-7);
  }
}

TEST(Glass, of_a_huge_index_is_the_same_in_every_precision) {
  json text = document(camera_json(24, 16, 0.8, {0, 0, -4}, {0, 0, 0}),
                       {sphere_json({0, 0, 0}, 1, glass(0.8, 1000)),
                        plane_json({0, 0, 5}, {0.1, 0.2, -1}, diffuse_material({1, 0, 0}))},
                       {distant_json({0.2, -0.3, 1})});
  text["render"]["precision"] = "double";
  const Image expected = image_of(text);
  text["render"]["precision"] = "auto";
  EXPECT_LE(distance(image_of(text), expected), 1e-4);
}

TEST(Glass, of_index_one_bends_nothing) {
  const json wall = plane_json({0, 0, 9}, {0.3, 0.2, -1}, diffuse_material(behind));
  json text = document(camera_json(48, 36, 0.8), {wall}, {distant_json({0.2, 0.3, 1})});
  const Image without = image_of(text);
  text["objects"].push_back(sphere_json({0.3, 0, 5}, 1, glass(1, 1)));
  text["objects"].push_back(cylinder_json({-1, -1, 4}, {1, 1, 6}, 0.4, true, glass(1, 1)));
  EXPECT_LE(distance(image_of(text), without), 1e-6);
}

TEST(Glass, bends_by_snells_law) {
  // Into the glass behind z = 1, at the sine s: s / 1.5 inside. What it meets at z = 3 is told by
  // bands of a mirror of known place: a small sphere around where it must be is hit, and beside it
  // is not.
  for (const double sine : {0.0, 0.3, 0.6, 0.9}) {
    const double inside = sine / 1.5;
    const double x =
        sine / std::sqrt(1 - sine * sine) + 2 * inside / std::sqrt(1 - inside * inside);
    const json pane = plane_json({0, 0, 1}, {0, 0, -1}, glass(1));
    const Vec3 direction{sine, 0, std::sqrt(1 - sine * sine)};
    const json there = sphere_json({x, 0, 3}, 1e-3, {{"ka", 0}, {"kd", 0}, {"ks", 0}});
    EXPECT_EQ(seen_along(direction, {pane, there}), Vec3{}) << sine;
    const json beside = sphere_json({x + 2e-3, 0, 3}, 1e-3, {{"ka", 0}, {"kd", 0}, {"ks", 0}});
    EXPECT_LE(distance(seen_along(direction, {pane, beside}), behind), 1e-7) << sine;
  }
}

TEST(Glass, reflects_all_beyond_the_critical_angle) {
  // The eye is inside, below the surface at y = 1; above it is a black ceiling.
  const json surface = plane_json({0, 1, 0}, {0, 1, 0}, glass(1));
  const json ceiling = plane_json({0, 2, 0}, {0, -1, 0}, {{"ka", 0}, {"kd", 0}, {"ks", 0}});
  const double critical = std::asin(1 / 1.5);
  for (const double turn : {-1e-3, 1e-3}) {
    const Vec3 direction{std::sin(critical + turn), std::cos(critical + turn), 0};
    const Vec3 wanted = turn > 0 ? behind : Vec3{};
    EXPECT_LE(distance(seen_along(direction, {surface, ceiling}), wanted), 1e-7) << turn;
  }
}

TEST(Glass, mirrors_by_fresnels_reflectance) {
  json material = glass(1);
  material["fresnel"] = true;
  const json black = plane_json({0, 0, 9}, {0, 0, -1}, {{"ka", 0}, {"kd", 0}, {"ks", 0}});
  const json pane = plane_json({0, 0, 5}, {0, 0, -1}, material);
  // Straight: ((1.5 - 1) / (1.5 + 1))^2.
  EXPECT_LE(distance(seen_along({0, 0, 1}, {pane, black}), behind * 0.04), 1e-7);
  // At Brewster's angle only what is polarised across is reflected.
  const double brewster = std::atan(1.5);
  const double across = std::pow((1.5 * 1.5 - 1) / (1.5 * 1.5 + 1), 2);
  EXPECT_LE(distance(seen_along({std::sin(brewster), 0, std::cos(brewster)}, {pane, black}),
                     behind * (across / 2)),
            1e-7);
  // What is not mirrored goes on.
  EXPECT_LE(distance(seen_along({0, 0, 1}, {pane}), behind), 1e-7);
}

TEST(Glass, that_is_open_bends_nothing) {
  for (const bool caps : {false, true}) {
    const json tube = cylinder_json({0.3, -9, 5}, {0.3, 9, 5}, 1, caps, glass(0.5));
    const json ball = sphere_json({0, 0, 60}, 0.5, {{"ka", 0}, {"kd", 0}, {"ks", 0}});
    EXPECT_EQ(seen_along({0, 0, 1}, {tube, ball}) == Vec3{}, !caps);
  }
}

TEST(Glass, is_followed_as_often_as_max_depth_says) {
  json text = document(camera_json(1, 1, 0.1), {}, {});
  for (int i = 1; i <= 4; ++i)
    text["objects"].push_back(plane_json({0, 0, 1.0 * i}, {0, 0, -1}, glass(1, 1)));
  text["background"] = {1, 1, 1};
  for (int depth = 0; depth <= 5; ++depth) {
    text["render"]["max_depth"] = depth;
    EXPECT_EQ(only_color(text), (depth >= 4 ? Vec3{1, 1, 1} : Vec3{})) << depth;
  }
}

TEST(Glass, weakens_light_by_each_of_its_surfaces) {
  const json floor = plane_json({0, 0, 5}, {0, 0, -1}, {{"ka", 0.5}, {"kd", 1}, {"ks", 0}});
  const json ball = sphere_json({0, 4, 1}, 1, glass(0.5));
  const json pane = plane_json({0, 8, 0}, {0, 1, 0}, glass(0.7));
  json text = document(camera_json(1, 1, 1e-6), {floor}, {distant_json({0, -1, 1}, 0.8)});
  text["ambient"] = 0.25;
  const double cosine = 1 / std::numbers::sqrt2;
  const auto expect_share = [&](double share) {
    const double gray = 0.5 * 0.25 + 0.8 * cosine * share;
    EXPECT_LE(distance(only_color(text), Vec3{gray, gray, gray}), 1e-6) << share;
  };
  expect_share(1);
  text["objects"].push_back(ball);
  expect_share(0.25);
  text["objects"].push_back(pane);
  expect_share(0.25 * 0.7);
  // A lamp before the pane is not weakened by it.
  text["lights"][0] = point_json({0, 7, -2}, 0.8);
  text["lights"][0]["falloff"] = "none";
  expect_share(0.25);
  // What is opaque hides it whole, and with it the ambient part.
  text["objects"].push_back(sphere_json({0, 2, 3}, 0.5));
  EXPECT_EQ(only_color(text), Vec3{});
}

TEST(Glass, lets_light_through_however_many_surfaces_it_has) {
  // Forty surfaces, close and far apart, before a lamp without distance.
  json text = document(camera_json(1, 1, 1e-6),
                       {plane_json({0, 0, 5}, {0, 0, -1}, diffuse_material({1, 1, 1}))},
                       {distant_json({0, -1, 1})});
  for (int i = 0; i < 20; ++i)
    text["objects"].push_back(sphere_json({0, 3 + 2.5 * i, 2 - 2.5 * i}, 1 + 0.02 * i, glass(0.9)));
  expect_gray(text, std::pow(0.9, 40) / std::numbers::sqrt2);
}

TEST(Glass, is_lit_from_behind_through_itself) {
  // The far inside of a ball, seen through its front: the light comes through the front, too.
  json material = glass(0.5, 1);
  material["kd"] = 1;
  const json text = document(camera_json(1, 1, 1e-6), {sphere_json({0, 0, 5}, 1, material)},
                             {distant_json({0, 0, 1})});
  // Front: 1, weakened by nothing. Back: 0.5 of the light, half of which is seen.
  EXPECT_LE(distance(only_color(text), Vec3{1, 1, 1}), 1e-6);
  json dim = text;
  dim["lights"][0]["intensity"] = 0.5;
  EXPECT_LE(distance(only_color(dim), Vec3{0.625, 0.625, 0.625}), 1e-6);
}

}  // namespace
}  // namespace raytracer::test
