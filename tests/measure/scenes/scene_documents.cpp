#include "tests/measure/scenes/scene_documents.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <random>

#include "engine/math/vec.h"
#include "tests/measure/scenes/document_text.h"

namespace raytracer::measure {
namespace {

struct Lighting {
  const char* shadows;
  const char* lights;
};
constexpr Lighting two_suns{"black", R"([
    {"type": "distant", "direction": [-0.6, -1, 0.7], "intensity": 0.6},
    {"type": "distant", "direction": [0.8, -1, 0.3], "color": [1, 0.9, 0.8], "intensity": 0.4}
  ])"};

constexpr Lighting sky{"ambient", R"([{"type": "sky"}])"};
constexpr Lighting wide_sun{"ambient",
                            R"([{"type": "distant", "direction": [-0.6, -1, 0.7], "angle": 0.2}])"};
constexpr Lighting lamp{
    "ambient",
    R"([{"type": "point", "position": [-25, 30, -30], "radius": 4, "falloff": "none"}])"};

constexpr const char* materials = R"({
    "red": {"color": [0.9, 0.2, 0.2]},
    "blue": {"color": [0.2, 0.3, 0.9]},
    "white": {"color": [0.9, 0.9, 0.9]},
    "mirror": {"color": [0.8, 0.8, 0.8], "kd": 0.2, "reflectivity": 0.7},
    "polished": {"color": [0.7, 0.7, 0.7], "ks": 0.1, "reflectivity": 0.2}
  })";

constexpr const char* from_the_front =
    R"("origin": [0, 8, -20], "look_at": [0, -1, 0], "fov": 1.0)";
constexpr const char* at_the_cube = R"("origin": [21, 17, -29], "look_at": [0, 0, 0], "fov": 0.75)";
constexpr const char* at_the_flake =
    R"("origin": [3, 2.9, -4.9], "look_at": [0, 0.15, 0], "fov": 0.75)";
constexpr const char* at_the_torus =
    R"("origin": [2.2, 2.4, -3.6], "look_at": [0, -0.1, 0], "fov": 0.75)";

constexpr double square_half_width = 14;

std::string document(const char* camera, const std::string& objects,
                     const Lighting& lighting = two_suns) {
  return fmt::format(
      R"({{
  "camera": {{{}, "width": 700, "height": 500}},
  "background": [0.53, 0.8, 0.92],
  "ambient": 0.1,
  "shadows": "{}",
  "lights": {},
  "materials": {},
  "objects": [
{}
  ]
}}
)",
      camera, lighting.shadows, lighting.lights, materials, objects);
}

const std::string pair_of_spheres =
    R"(    {"type": "sphere", "center": [-2.5, 0, 0], "radius": 2, "material": "red"},
    {"type": "sphere", "center": [2.5, 0, -1], "radius": 2, "material": "blue"})";

std::string square_object(int n) {
  return fmt::format(
      R"(    {{"type": "sphere_square", "center": [0, -3, 0], "radius": {}, "n": {}, "axes": "xz", "material": "white"}})",
      square_half_width / (2.0 * n), n);
}

void add_flake(SpheresText& spheres, const Vec3& center, double radius, const Vec3& axis,
               int levels) {
  spheres.add(center, radius);
  if (levels == 0) return;
  const Vec3 helper = std::abs(axis.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
  const Vec3 u = unit(cross(helper, axis));
  const Vec3 v = cross(axis, u);
  const double child = radius / 3;
  const auto add_ring = [&](int count, double elevation, double turn) {
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * std::numbers::pi * i / count + turn;
      const Vec3 direction = (u * std::cos(angle) + v * std::sin(angle)) * std::cos(elevation) +
                             axis * std::sin(elevation);
      add_flake(spheres, center + direction * (radius + child), child, direction, levels - 1);
    }
  };
  add_ring(6, 0, 0);
  add_ring(3, std::numbers::pi / 3, std::numbers::pi / 6);
}

SpheresText spheres_in_a_cube(int count) {
  constexpr double half_side = 10;
  constexpr double missed = 0.25;
  // A line along an axis meets pi mean(r^2) count / side^2 spheres on average; r is uniform in
  // mean (1 +- 1/2), so mean(r^2) = mean^2 13 / 12.
  const double mean_radius = std::sqrt(-std::log(missed) * 4 * half_side * half_side /
                                       (std::numbers::pi * static_cast<double>(count) * 13 / 12));
  // Taken from the generator's bits: the standard's distributions differ between libraries.
  std::mt19937_64 generator(1);
  const auto within = [&](double least, double most) {
    return least + (most - least) * (static_cast<double>(generator() >> 11) * 0x1p-53);
  };
  SpheresText spheres;
  for (int i = 0; i < count; ++i) {
    const double x = within(-half_side, half_side);
    const double y = within(-half_side, half_side);
    const double z = within(-half_side, half_side);
    spheres.add({x, y, z}, mean_radius * within(0.5, 1.5));
  }
  return spheres;
}

SpheresText flake(int levels) {
  SpheresText spheres;
  add_flake(spheres, {0, 0, 0}, 1, {0, 1, 0}, levels);
  return spheres;
}

}  // namespace

std::string two_spheres() { return document(from_the_front, pair_of_spheres); }

std::string two_spheres_and_square(int n) {
  return document(from_the_front, pair_of_spheres + ",\n" + square_object(n));
}

std::string two_spheres_and_explicit_square(int n) {
  const double radius = square_half_width / (2.0 * n);
  SpheresText spheres;
  for (int i = 0; i < 2 * n; ++i)
    for (int k = 0; k < 2 * n; ++k)
      spheres.add({(2 * i + 1 - 2 * n) * radius, -3, (2 * k + 1 - 2 * n) * radius}, radius);
  return document(from_the_front, pair_of_spheres + ",\n" + spheres.object("white"));
}

std::string random_spheres(int count) {
  return document(at_the_cube, spheres_in_a_cube(count).object("white"));
}

std::string random_spheres_under_sky(int count) {
  return document(at_the_cube, spheres_in_a_cube(count).object("white"), sky);
}

std::string random_spheres_under_wide_sun(int count) {
  return document(at_the_cube, spheres_in_a_cube(count).object("white"), wide_sun);
}

std::string random_spheres_under_lamp(int count) {
  return document(at_the_cube, spheres_in_a_cube(count).object("white"), lamp);
}

std::string sphereflake(int levels) {
  return document(at_the_flake, flake(levels).object("white"));
}

std::string sphereflake_under_sky(int levels) {
  return document(at_the_flake, flake(levels).object("white"), sky);
}

std::string bumpy_torus(int around, int across) {
  MeshText mesh;
  for (int i = 0; i < around; ++i) {
    for (int k = 0; k < across; ++k) {
      const double u = 2 * std::numbers::pi * i / around;
      const double v = 2 * std::numbers::pi * k / across;
      const double tube = 0.5 * (1 + 0.1 * std::sin(11 * u) * std::sin(5 * v));
      const double ring = 1 + tube * std::cos(v);
      mesh.add_vertex({ring * std::cos(u), tube * std::sin(v), ring * std::sin(u)});
      const auto index = [&](int a, int b) { return a % around * across + b % across; };
      mesh.add_quadrangle(index(i, k), index(i + 1, k), index(i + 1, k + 1), index(i, k + 1));
    }
  }
  return document(at_the_torus, mesh.object("white"));
}

std::string reflections() {
  const std::string spheres =
      R"(    {"type": "sphere", "center": [-2.5, 0, 0], "radius": 2, "material": "mirror"},
    {"type": "sphere", "center": [2.5, 0, -1], "radius": 2, "material": "mirror"},
    {"type": "sphere", "center": [0, 2, 4], "radius": 2, "material": "mirror"},
    {"type": "sphere", "center": [-6.5, -1, -3], "radius": 1.4, "material": "red"},
    {"type": "sphere", "center": [6.5, -1, -3], "radius": 1.4, "material": "blue"},
    {"type": "plane", "point": [0, -4, 0], "normal": [0, 1, 0], "material": "polished"})";
  return document(from_the_front, spheres + ",\n" + square_object(14));
}

}  // namespace raytracer::measure
