// Those of spheres, cylinders and cones, and the mountain.
#include "tests/measure/scenes/haines_scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/measure/scenes/dice.h"
#include "tests/measure/scenes/document_text.h"
#include "tests/measure/scenes/haines_document.h"

namespace raytracer::measure {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// Three axes at right angles.
struct Axes3 {
  Vec3 x{1, 0, 0};
  Vec3 y{0, 1, 0};
  Vec3 z{0, 0, 1};

  Vec3 along(const Vec3& v) const { return x * v.x + y * v.y + z * v.z; }
  /// Turned around its own z.
  Axes3 turned(double angle) const {
    return {x * std::cos(angle) + y * std::sin(angle), y * std::cos(angle) - x * std::sin(angle),
            z};
  }
  /// z tilted towards its own x.
  Axes3 tilted(double angle) const {
    return {x * std::cos(angle) - z * std::sin(angle), y,
            z * std::cos(angle) + x * std::sin(angle)};
  }
};

/// `axes` that take z to `direction` the short way.
Axes3 towards(const Vec3& direction) {
  const bool is_along_z = std::hypot(direction.x, direction.y) < 1e-9;
  const double azimuth = is_along_z ? 0 : std::atan2(direction.y, direction.x);
  const double inclination = std::acos(std::clamp(direction.z, -1.0, 1.0));
  return Axes3{}.turned(azimuth).tilted(inclination).turned(-azimuth);
}

Vec3 polar(double azimuth, double elevation) {
  return {std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation),
          std::sin(elevation)};
}

/// Where a ball's nine sit if it sits on z: six around it, three above.
std::array<Vec3, 9> nine_directions() {
  std::array<Vec3, 9> directions;
  for (std::size_t i = 0; i < 3; ++i) {
    const double turn = 120 * degree * static_cast<double>(i);
    directions[3 * i] = polar(45 * degree + turn, std::asin(std::sqrt(2.0 / 3)));
    directions[3 * i + 1] = polar(75 * degree + turn, 0);
    directions[3 * i + 2] = polar(15 * degree + turn, 0);
  }
  return directions;
}

void add_ball(SpheresText& spheres, const std::array<Vec3, 9>& nine, const Vec3& center,
              double radius, const Vec3& direction, int levels) {
  spheres.add(mirrored(center), radius);
  if (levels == 0) return;
  const Axes3 axes = towards(direction);
  for (const Vec3& each : nine) {
    const Vec3 outward = axes.along(each);
    add_ball(spheres, nine, center + outward * (radius * 4 / 3), radius / 3, outward, levels - 1);
  }
}

/// One `cylinders` or `cones` object without caps.
class TubesText {
 public:
  void add(const Vec3& from, double radius_from, const Vec3& to, double radius_to) {
    from_.add(mirrored(from));
    to_.add(mirrored(to));
    radii_from_.add(radius_from);
    radii_to_.add(radius_to);
  }
  std::string cones(const std::string& material) const {
    return fmt::format(
        R"(    {{"type": "cones", "from": {}, "to": {}, "radius_from": {}, "radius_to": {}, "caps": false, "material": "{}"}})",
        from_.text(), to_.text(), radii_from_.text(), radii_to_.text(), material);
  }
  std::string cylinders(const std::string& material) const {
    return fmt::format(
        R"(    {{"type": "cylinders", "from": {}, "to": {}, "radius": {}, "caps": false, "material": "{}"}})",
        from_.text(), to_.text(), radii_from_.text(), material);
  }

 private:
  ListText from_;
  ListText to_;
  ListText radii_from_;
  ListText radii_to_;
};

/// A cone from `foot` along z of `axes`, a sphere on its end, and two branches from there.
void add_branches(TubesText& cones, SpheresText& spheres, const Vec3& foot, double radius,
                  const Axes3& axes, double length, int levels) {
  constexpr double thinner = 0.67;
  const Vec3 end = foot + axes.z * length;
  cones.add(foot, radius, end, radius * thinner);
  spheres.add(mirrored(end), radius * thinner);
  if (levels == 0) return;
  add_branches(cones, spheres, end, radius * thinner, axes.turned(90 * degree).tilted(40 * degree),
               0.65 * length, levels - 1);
  add_branches(cones, spheres, end, radius * thinner,
               axes.turned(-130 * degree).tilted(25 * degree), 0.7 * length, levels - 1);
}

/// Heights of a square of (2^levels + 1)^2 points whose corners are 0: midpoints are displaced by
/// ever less.
class Mountain {
 public:
  Mountain(int levels, double roughness)
      : side_(1 << levels), heights_(static_cast<std::size_t>((side_ + 1) * (side_ + 1))) {
    double most = roughness;
    for (int step = side_; step > 1; step /= 2, most *= 0.5) {
      const int half = step / 2;
      for (int i = half; i < side_; i += step)
        for (int k = half; k < side_; k += step) displace(i, k, half, half, half, -half, most);
      for (int i = 0; i <= side_; i += half)
        for (int k = i / half % 2 == 0 ? half : 0; k <= side_; k += step)
          displace(i, k, half, 0, 0, half, most * 0.7);
    }
  }

  double& height(int i, int k) { return heights_[static_cast<std::size_t>(i * (side_ + 1) + k)]; }
  int side() const { return side_; }

 private:
  /// From the mean of those of its four neighbours at (di, dk), (ei, ek) and opposite that exist.
  void displace(int i, int k, int di, int dk, int ei, int ek, double most) {
    const std::array<std::array<int, 2>, 4> around{{{di, dk}, {-di, -dk}, {ei, ek}, {-ei, -ek}}};
    double sum = 0;
    int count = 0;
    for (const auto& [a, b] : around) {
      if (i + a < 0 || i + a > side_ || k + b < 0 || k + b > side_) continue;
      sum += height(i + a, k + b);
      ++count;
    }
    height(i, k) = sum / count + dice_.within(-most, most);
  }

  int side_;
  std::vector<double> heights_;
  Dice dice_{7};
};

/// The corners of the six rings of a set, five each, around their centre, by their colours.
std::array<std::array<Vec3, 5>, 6> six_rings() {
  constexpr double radius = 0.930995;
  std::array<std::array<Vec3, 5>, 6> rings;
  for (std::size_t ring = 0; ring < 6; ++ring) {
    // Across the six diagonals of an icosahedron.
    const double azimuth = (36 + 72 * (static_cast<double>(ring) - 1)) * degree;
    const Vec3 first = ring == 0 ? Vec3{1, 0, 0} : polar(azimuth, 0);
    const Vec3 normal =
        ring == 0 ? Vec3{0, 0, 1} : polar(azimuth - 90 * degree, std::asin(1 / std::sqrt(5.0)));
    const Vec3 second = cross(normal, first);
    for (std::size_t i = 0; i < 5; ++i) {
      const double angle = 72 * degree * static_cast<double>(i);
      rings[ring][i] = (first * std::cos(angle) + second * std::sin(angle)) * radius;
    }
  }
  return rings;
}

/// A set of six is at the top of a pyramid of seven layers, that lies on its side.
std::vector<Vec3> centers_of_sets() {
  constexpr double between_layers = 2.613126;
  std::vector<Vec3> centers;
  for (int layer = 1; layer <= 7; ++layer)
    for (int i = 0; i < layer; ++i)
      for (int k = 0; k < layer; ++k)
        centers.push_back({2.0 * k - layer + 1, layer * between_layers, 2.0 * i - layer + 1});
  return centers;
}

}  // namespace

std::string haines_balls() {
  SpheresText spheres;
  add_ball(spheres, nine_directions(), {}, 0.5, {0, 0, 1}, 4);
  return haines_document(
      {{2.1, 1.3, 1.7}, {}}, {{4, 3, 2}, {1, -4, 4}, {-3, 1, 5}},
      {{.name = "floor", .color = {1, 0.75, 0.33}, .kd = 0.8},
       {.name = "ball", .color = {1, 0.9, 0.7}, .kd = 0.5, .ks = 0.5, .shine = 3.0827}},
      {haines_floor(12, -0.5, "floor"), spheres.object("ball")});
}

std::string haines_mount() {
  Mountain mountain(6, 0.8);
  MeshText mesh;
  const int side = mountain.side();
  const auto index = [&](int i, int k) { return i * (side + 1) + k; };
  for (int i = 0; i <= side; ++i)
    for (int k = 0; k <= side; ++k)
      mesh.add_vertex(mirrored({2.0 * i / side - 1, 2.0 * k / side - 1, mountain.height(i, k)}));
  for (int i = 0; i < side; ++i)
    for (int k = 0; k < side; ++k)
      mesh.add_quadrangle(index(i, k), index(i + 1, k), index(i + 1, k + 1), index(i, k + 1));
  SpheresText spheres;
  for (const Vec3& center :
       {Vec3{-0.8, 0.8, 1.20821}, Vec3{-0.661196, 0.661196, 0.930598},
        Vec3{-0.749194, 0.98961, 0.930598}, Vec3{-0.98961, 0.749194, 0.930598}})
    spheres.add(mirrored(center), 0.17);
  return haines_document({{-1.6, 1.6, 1.7}, {}}, {{-100, -100, 100}},
                         {{.name = "glass",
                           .color = {1, 1, 1},
                           .kd = 0.1,
                           .ks = 0.1,
                           .shine = 101.148,
                           .transmitted = 0.9,
                           .index = 1.5},
                          {.name = "rock", .color = {0.5, 0.45, 0.35}}},
                         {spheres.object("glass"), mesh.object("rock")});
}

std::string haines_rings() {
  constexpr double thickness = 0.07412;
  std::vector<HainesFill> fills{{.name = "wall", .color = {1, 1, 1}}};
  constexpr std::array<const char*, 6> names{"red", "green", "blue", "cyan", "magenta", "yellow"};
  constexpr std::array<Vec3, 6> colors{Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1},
                                       {0, 1, 1},     {1, 0, 1}, {1, 1, 0}};
  MeshText wall;
  for (const Vec3& corner : {Vec3{8.83895, 20.905, 10.3389}, Vec3{-10.8389, 20.905, 10.3389},
                             Vec3{-10.8389, 20.905, -9.33895}, Vec3{8.83895, 20.905, -9.33895}})
    wall.add_vertex(mirrored(corner));
  wall.add_quadrangle(0, 1, 2, 3);
  std::vector<std::string> objects{wall.object("wall")};
  const auto rings = six_rings();
  for (std::size_t color = 0; color < 6; ++color) {
    fills.push_back(
        {.name = names[color], .color = colors[color], .kd = 0.5, .ks = 0.2, .shine = 3.0827});
    TubesText tubes;
    SpheresText spheres;
    for (const Vec3& center : centers_of_sets()) {
      for (std::size_t i = 0; i < 5; ++i) {
        const Vec3 corner = center + rings[color][i];
        tubes.add(corner, thickness, center + rings[color][(i + 4) % 5], thickness);
        spheres.add(mirrored(corner), thickness);
      }
    }
    objects.push_back(tubes.cylinders(names[color]));
    objects.push_back(spheres.object(names[color]));
  }
  return haines_document({{-1, -2.61313, 0.5}, {-1, -1.61313, 0.5}},
                         {{3, -2.61313, 3}, {-4, -2.61313, 1}, {2, -2.61313, -4}}, fills, objects);
}

std::string haines_tree() {
  TubesText cones;
  SpheresText spheres;
  add_branches(cones, spheres, {}, 0.15, Axes3{}.turned(-90 * degree), 1, 11);
  return haines_document(
      {{4.5, 0.4, 2}, {0, 0, 1.5}},
      {{-5, 5, 50},
       {30, -30, 30},
       {-40, -30, 20},
       {10, 30, 40},
       {-30, 40, 10},
       {50, 25, 20},
       {-10, -60, 30}},
      {{.name = "lawn", .color = {0.2, 0.7, 0.2}}, {.name = "bark", .color = {0.55, 0.4, 0.2}}},
      {haines_floor(50, 0, "lawn"), cones.cones("bark"), spheres.object("bark")});
}

std::string haines_shells() {
  constexpr int count = 5000;
  SpheresText spheres;
  for (int i = 0; i < count; ++i) {
    const double grown = static_cast<double>(i) / count;
    const double size = 0.03 * std::exp(3.4 * grown);
    const double turn = 6 * std::numbers::pi * grown;
    spheres.add(
        mirrored({size * 1.6 * std::cos(turn), size * 1.6 * std::sin(turn), 1 - 2.2 * size}),
        0.7 * size);
  }
  return haines_document(
      {{3, -2.2, 1.6}, {0, 0, 0}}, {{10, -10, 10}, {-6, -8, 9}, {3, 9, 12}},
      {{.name = "floor", .color = {0.4, 0.6, 0.4}},
       {.name = "shell", .color = {0.9, 0.7, 0.6}, .kd = 0.7, .ks = 0.3, .shine = 8}},
      {haines_floor(12, -2.2, "floor"), spheres.object("shell")});
}

}  // namespace raytracer::measure
