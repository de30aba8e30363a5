// The camera that a file gets which has none: everything is in view, and no more.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <string>

#include "tests/formats/read_text.h"

namespace raytracer::test {
namespace {

using nlohmann::json;
using Vector = std::array<double, 3>;

Vector difference(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector unit(const Vector& a) {
  const double length = std::sqrt(dot(a, a));
  return {a[0] / length, a[1] / length, a[2] / length};
}

/// How much of the image's half height or width the spheres reach: at most 1 if all is in view.
double reach_of(const json& scene) {
  const json& camera = scene.at("camera");
  const Vector origin = camera.at("origin");
  const Vector d = unit(difference(camera.at("look_at"), origin));
  const Vector u = unit(cross(camera.at("up"), d));
  const Vector v = cross(d, u);
  const double tw = std::tan(camera.at("fov").get<double>() / 2);
  const double th = tw * camera.at("height").get<double>() / camera.at("width").get<double>();
  double reach = 0;
  for (const json& object : scene.at("objects"))
    for (std::size_t i = 0; i < object.at("centers").size(); ++i) {
      const Vector to = difference(object.at("centers")[i], origin);
      const double radius = object.at("radius").is_array() ? object.at("radius")[i].get<double>()
                                                           : object.at("radius").get<double>();
      const auto widest = [&](const Vector& across, double tangent) {
        return (std::abs(dot(to, across)) + radius * std::sqrt(1 + tangent * tangent)) /
               (dot(to, d) * tangent);
      };
      reach = std::max({reach, widest(u, tw), widest(v, th)});
    }
  return reach;
}

std::string random_points(unsigned seed, const Vector& size, const Vector& center) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(-0.5, 0.5);
  std::string text = "x,y,z,radius\n";
  for (int i = 0; i < 50; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      text += std::to_string(center[axis] + size[axis] * share(random)) + ",";
    text += std::to_string(0.3 + share(random) / 4) + "\n";
  }
  return text;
}

TEST(Arrange, everything_is_in_view_and_fills_it) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    client::ImportOptions options;
    options.width_px = 100 + 50 * static_cast<int>(seed % 7);
    options.height_px = 100 + 30 * static_cast<int>(seed % 5);
    if (seed % 3 == 1) options.view = client::model::Triple{1, -2, 0.5 * seed};
    const double reach = reach_of(
        document(".csv", random_points(seed, {10, 3.0 + seed, 1}, {100, 0, -50}), options));
    EXPECT_LT(reach, 1);
    EXPECT_GT(reach, 0.9);
  }
}

TEST(Arrange, zoom_enlarges) {
  client::ImportOptions options;
  const std::string text = random_points(1, {5, 5, 5}, {0, 0, 0});
  const double whole = reach_of(document(".csv", text, options));
  options.zoom = 2;
  EXPECT_NEAR(reach_of(document(".csv", text, options)), 2 * whole, 0.01);
}

TEST(Arrange, turning_leaves_everything_in_view) {
  client::ImportOptions options;
  options.is_turned = true;
  json scene = document(".csv", random_points(2, {9, 4, 2}, {7, 7, 7}), options);
  const Vector look_at = scene.at("camera").at("look_at");
  const Vector up = unit(scene.at("camera").at("up"));
  const Vector arm = difference(scene.at("camera").at("origin"), look_at);
  for (int degrees = 0; degrees < 360; degrees += 10) {
    const double angle = degrees * 3.14159265 / 180;
    const Vector across = cross(up, arm);
    Vector origin{};
    for (std::size_t i = 0; i < 3; ++i)
      origin[i] = look_at[i] + arm[i] * std::cos(angle) + across[i] * std::sin(angle) +
                  up[i] * dot(up, arm) * (1 - std::cos(angle));
    scene["camera"]["origin"] = origin;
    EXPECT_LT(reach_of(scene), 1) << degrees;
  }
}

/// Seen along its least extent.
TEST(Arrange, flat_things_are_seen_from_their_broad_side) {
  const json camera = document(".csv", random_points(3, {30, 0.1, 20}, {0, 0, 0})).at("camera");
  const Vector d = unit(difference(camera.at("look_at"), camera.at("origin")));
  EXPECT_GT(std::abs(d[1]), 0.95);
}

TEST(Arrange, view_is_where_the_eye_stands_with_z_upward) {
  client::ImportOptions options;
  options.view = client::model::Triple{1, 0, 0};
  const json camera =
      document(".csv", random_points(4, {3, 3, 3}, {0, 0, 0}), options).at("camera");
  const Vector arm = unit(difference(camera.at("origin"), camera.at("look_at")));
  EXPECT_NEAR(arm[0], -1, 1e-9);  // scenes have x mirrored
  EXPECT_EQ(camera.at("up"), json({0, 0, 1}));
}

/// Farther away than its size is from one number to the next.
TEST(Arrange, eye_is_apart_from_what_is_very_far_away) {
  const json scene = document(".csv", "x,y,z,radius\n1e17,0,0,1\n");
  const json& camera = scene.at("camera");
  EXPECT_NE(camera.at("origin"), camera.at("look_at"));
  for (const json& light : scene.at("lights"))
    for (const json& component : light.value("direction", json::array()))
      EXPECT_TRUE(std::isfinite(component.get<double>())) << light;
}

TEST(Arrange, background_may_be_transparent) {
  client::ImportOptions options;
  options.background = std::nullopt;
  EXPECT_EQ(document(".csv", "x,y,z\n1,2,3\n", options).at("background"), "transparent");
}

}  // namespace
}  // namespace raytracer::test
