// Those of triangles alone.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/measure/scenes/document_text.h"
#include "tests/measure/scenes/haines_document.h"
#include "tests/measure/scenes/haines_scenes.h"

namespace raytracer::measure {
namespace {

constexpr double pi = std::numbers::pi;

/// Radius and height along a goblet, from the middle of its foot to the middle of its cup.
struct Profile {
  double radius;
  double height;
};
Profile goblet_at(double share) {
  const double outside = std::min(1.0, share / 0.6);
  const double cup = 1.6 + 0.9 * std::sin(0.5 * pi * std::clamp((outside - 0.45) / 0.55, 0.0, 1.0));
  const double foot = 1.5 * std::exp(-30 * outside * outside);
  const double outer = std::max(0.0, (outside - 0.4) / 0.6);
  if (share <= 0.6)
    return {0.25 + foot + (cup - 0.25) * outer * outer * (3 - 2 * outer), 3.6 * outside};
  const double inside = (share - 0.6) / 0.4;
  return {2.4 * std::cos(0.5 * pi * inside), 3.6 - std::sin(0.5 * pi * inside)};
}

std::string goblet_mesh(int around, int along) {
  constexpr double small = 1e-4;
  MeshText mesh;
  for (int k = 0; k <= along; ++k) {
    const double share = static_cast<double>(k) / along;
    const Profile here = goblet_at(share);
    const Profile before = goblet_at(std::max(0.0, share - small));
    const Profile after = goblet_at(std::min(1.0, share + small));
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * pi * i / around;
      const Vec3 outward{std::cos(angle), std::sin(angle), 0};
      const Vec3 normal =
          outward * (after.height - before.height) + Vec3{0, 0, before.radius - after.radius};
      mesh.add_vertex(mirrored(outward * here.radius + Vec3{0, 0, here.height}),
                      mirrored(unit(normal)));
    }
  }
  for (int k = 0; k < along; ++k)
    for (int i = 0; i < around; ++i) {
      const int next = (i + 1) % around;
      mesh.add_quadrangle(k * around + i, (k + 1) * around + i, (k + 1) * around + next,
                          k * around + next);
    }
  return mesh.object("goblet");
}

/// The squares of one colour of a board of 6 x 6.
std::string board(int colour, const char* material) {
  constexpr double side = 4.0 / 3;
  MeshText mesh;
  for (int i = 0; i < 6; ++i)
    for (int k = 0; k < 6; ++k) {
      if ((i + k) % 2 != colour) continue;
      const double x = -4 + i * side;
      const double y = -4 + k * side;
      const int first = mesh.add_vertex(mirrored({x, y, 0}));
      mesh.add_vertex(mirrored({x + side, y, 0}));
      mesh.add_vertex(mirrored({x + side, y + side, 0}));
      mesh.add_vertex(mirrored({x, y + side, 0}));
      mesh.add_quadrangle(first, first + 1, first + 2, first + 3);
    }
  return mesh.object(material);
}

/// A wheel of 24 teeth with a hole, across y: 768 triangles.
void add_gear(MeshText& mesh, const Vec3& center, double turn) {
  constexpr int points = 4 * 24;
  constexpr double half_width = 0.2;
  std::array<int, 4 * points> corners{};  // outside in front and behind, inside likewise
  for (int i = 0; i < points; ++i) {
    const double angle = 2 * pi * (i + turn) / points;
    const double tip = i % 4 < 2 ? 1.04 : 0.9;
    const auto corner = [&](double radius, double y) {
      return mesh.add_vertex(
          mirrored(center + Vec3{radius * std::cos(angle), y, radius * std::sin(angle)}));
    };
    const auto at = static_cast<std::size_t>(i);
    corners[at] = corner(tip, -half_width);
    corners[points + at] = corner(tip, half_width);
    corners[2 * points + at] = corner(0.35, -half_width);
    corners[3 * points + at] = corner(0.35, half_width);
  }
  for (std::size_t i = 0; i < points; ++i) {
    const std::size_t next = (i + 1) % points;
    const auto add = [&](std::size_t a, std::size_t b) {
      mesh.add_quadrangle(corners[a * points + i], corners[a * points + next],
                          corners[b * points + next], corners[b * points + i]);
    };
    add(0, 1);
    add(1, 3);
    add(3, 2);
    add(2, 0);
  }
}

void add_tetrahedra(MeshText& mesh, const std::array<Vec3, 4>& corners, int levels) {
  if (levels == 0) {
    const int first = mesh.add_vertex(mirrored(corners[0]));
    for (std::size_t i = 1; i < 4; ++i) mesh.add_vertex(mirrored(corners[i]));
    mesh.add_triangle(first, first + 1, first + 2);
    mesh.add_triangle(first, first + 2, first + 3);
    mesh.add_triangle(first, first + 3, first + 1);
    mesh.add_triangle(first + 1, first + 3, first + 2);
    return;
  }
  for (const Vec3& kept : corners) {
    std::array<Vec3, 4> smaller;
    std::transform(corners.begin(), corners.end(), smaller.begin(),
                   [&](const Vec3& corner) { return (corner + kept) * 0.5; });
    add_tetrahedra(mesh, smaller, levels - 1);
  }
}

}  // namespace

std::string haines_goblet() {
  return haines_document(
      {{4.86, 7.2, 5.4}, {0, 0, 1.2}}, {{-3.1, 9.8, 12.1}, {11.3, 5.1, 8.8}},
      {{.name = "light square", .color = {1, 1, 1}, .kd = 0.5, .ks = 0.5, .shine = 4.81884},
       {.name = "dark square", .color = {0.5, 0.5, 0.5}, .kd = 0.5, .ks = 0.5, .shine = 4.81884},
       {.name = "goblet", .color = {1, 0.5, 0.1}, .kd = 0.75, .ks = 0.25, .shine = 3.0827}},
      {board(0, "light square"), board(1, "dark square"), goblet_mesh(48, 47)});
}

std::string haines_gears() {
  constexpr int side = 6;
  MeshText gears;
  for (int i = 0; i < side; ++i)
    for (int k = 0; k < side; ++k)
      add_gear(gears, {1.95 * (i - 2.5), 0.1 * ((i + k) % 2), 1.95 * (k - 2.5)},
               (i + k) % 2 == 0 ? 0 : 2);
  return haines_document(
      {{-5, -13, 6}, {0, 0, -0.3}},
      {{10, -20, 20}, {-20, -15, 10}, {5, -30, 3}, {-8, -12, 30}, {25, -10, 15}},
      {{.name = "floor", .color = {0.6, 0.6, 0.7}, .kd = 0.7, .ks = 0.2, .shine = 10},
       {.name = "gear", .color = {0.9, 0.7, 0.4}, .kd = 0.6, .ks = 0.3, .shine = 6}},
      {haines_floor(30, -6, "floor"), gears.object("gear")});
}

std::string haines_tetra() {
  MeshText mesh;
  add_tetrahedra(mesh, {Vec3{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, 5);
  return haines_document({{1.02, 3.2, 1.5}, {}}, {{1.9, 4.2, 3.9}},
                         {{.name = "tetra", .color = {1, 0.9, 0.7}, .kd = 0.8}},
                         {mesh.object("tetra")});
}

}  // namespace raytracer::measure
