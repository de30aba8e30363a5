#include "tests/measure/contracts/random_objects.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace raytracer::published {
namespace {

using nlohmann::json;

constexpr int most_spheres = 2000;
constexpr int most_triangles = 2000;
constexpr int most_cylinders = 1000;

RandomObject sphere(Dice& dice, double half) {
  const double radius = half * dice.of_any_size(0.04, 0.7);
  return {{{"type", "sphere"}, {"center", json_of(dice.point(half))}, {"radius", json_of(radius)}},
          fmt::format("sphere of radius {:.2g}", radius / half)};
}

/// In the whole cube or in one layer of it, of one radius or of many.
RandomObject spheres(Dice& dice, double half) {
  const int count = dice.count_of_any_size(3, most_spheres);
  const bool is_layer = dice.happens(0.3);
  const double spacing = 2 * half / std::pow(count, is_layer ? 1.0 / 2 : 1.0 / 3);
  const double radius = spacing * dice.of_any_size(0.05, 0.6);
  const double layer = dice.within(-half, half);
  const double smallest = dice.within(0.1, 0.9);
  json centers = json::array();
  json radii = json::array();
  for (int i = 0; i < count; ++i) {
    Vec3 center = dice.point(half);
    if (is_layer) center.y = layer;
    centers.push_back(json_of(center));
    radii.push_back(json_of(radius * dice.within(smallest, 2 - smallest)));
  }
  const bool is_uniform = dice.happens(0.3);
  return {{{"type", "spheres"},
           {"centers", std::move(centers)},
           {"radius", is_uniform ? json_of(radius) : std::move(radii)}},
          fmt::format("{} spheres of radius {:.2g}{}", count, radius / half,
                      is_layer ? " in a layer" : "")};
}

RandomObject sphere_square(Dice& dice, double half) {
  constexpr std::array axes{"xz", "xy", "yz"};
  const int n = dice.count_of_any_size(1, 60);
  const double radius = half * dice.within(0.3, 1.2) / (2 * n);
  const char* const span = axes[static_cast<std::size_t>(dice.count(0, 2))];
  return {{{"type", "sphere_square"},
           {"center", json_of(dice.point(0.7 * half))},
           {"radius", json_of(radius)},
           {"n", n},
           {"axes", span}},
          fmt::format("sphere_square of n {} in {}", n, span)};
}

RandomObject cylinder(Dice& dice, double half) {
  const Vec3 from = dice.point(half);
  const Vec3 to = from + half * dice.of_any_size(0.05, 1.5) * dice.direction();
  const double radius = half * dice.of_any_size(0.02, 0.5);
  const bool caps = dice.happens(0.6);
  return {{{"type", "cylinder"},
           {"from", json_of(from)},
           {"to", json_of(to)},
           {"radius", json_of(radius)},
           {"caps", caps}},
          fmt::format("{} cylinder of radius {:.2g}", caps ? "closed" : "open", radius / half)};
}

/// Sticks of any direction or columns, of one radius or of many, of the material's colour or of
/// their own.
RandomObject cylinders(Dice& dice, double half) {
  const int count = dice.count_of_any_size(3, most_cylinders);
  const double spacing = 2 * half / std::cbrt(count);
  const double length = spacing * dice.of_any_size(0.2, 3);
  const double radius = spacing * dice.of_any_size(0.02, 0.4);
  const bool are_upright = dice.happens(0.3);
  const bool is_uniform = dice.happens(0.3);
  const bool caps = dice.happens(0.6);
  const bool has_colors = dice.happens(0.5);
  json from = json::array();
  json to = json::array();
  json radii = json::array();
  json colors = json::array();
  for (int i = 0; i < count; ++i) {
    const Vec3 end = dice.point(half);
    const Vec3 direction = are_upright ? Vec3{0, 1, 0} : dice.direction();
    from.push_back(json_of(end));
    to.push_back(json_of(end + length * dice.within(0.3, 1.7) * direction));
    radii.push_back(json_of(radius * dice.within(0.4, 1.6)));
    colors.push_back(json_of(dice.point(0.5) + Vec3{0.5, 0.5, 0.5}));
  }
  json object{{"type", "cylinders"},
              {"from", std::move(from)},
              {"to", std::move(to)},
              {"radius", is_uniform ? json_of(radius) : std::move(radii)},
              {"caps", caps}};
  if (has_colors) object["colors"] = std::move(colors);
  return {std::move(object),
          fmt::format("{} {} cylinders of radius {:.2g}{}", count, caps ? "closed" : "open",
                      radius / half, has_colors ? " in colors" : "")};
}

/// Also those that end in a point.
RandomObject cone(Dice& dice, double half) {
  const Vec3 from = dice.point(half);
  const Vec3 to = from + half * dice.of_any_size(0.05, 1.5) * dice.direction();
  const double radius = half * dice.of_any_size(0.02, 0.5);
  const double other = dice.happens(0.5) ? 0 : radius * dice.within(0, 1.5);
  const bool caps = dice.happens(0.6);
  return {{{"type", "cone"},
           {"from", json_of(from)},
           {"to", json_of(to)},
           {"radius_from", json_of(radius)},
           {"radius_to", json_of(other)},
           {"caps", caps}},
          fmt::format("{} cone of radius {:.2g}", caps ? "closed" : "open", radius / half)};
}

/// Spikes or frusta, of the material's colour or of their own.
RandomObject cones(Dice& dice, double half) {
  const int count = dice.count_of_any_size(3, most_cylinders);
  const double spacing = 2 * half / std::cbrt(count);
  const double length = spacing * dice.of_any_size(0.2, 3);
  const double radius = spacing * dice.of_any_size(0.02, 0.4);
  const bool are_pointed = dice.happens(0.5);
  const bool caps = dice.happens(0.6);
  const bool has_colors = dice.happens(0.5);
  json from = json::array();
  json to = json::array();
  json radii_from = json::array();
  json radii_to = json::array();
  json colors = json::array();
  for (int i = 0; i < count; ++i) {
    const Vec3 end = dice.point(half);
    from.push_back(json_of(end));
    to.push_back(json_of(end + length * dice.within(0.3, 1.7) * dice.direction()));
    radii_from.push_back(json_of(radius * dice.within(0.4, 1.6)));
    radii_to.push_back(json_of(are_pointed ? 0 : radius * dice.within(0, 1.6)));
    colors.push_back(json_of(dice.point(0.5) + Vec3{0.5, 0.5, 0.5}));
  }
  json object{{"type", "cones"},
              {"from", std::move(from)},
              {"to", std::move(to)},
              {"radius_from", std::move(radii_from)},
              {"radius_to", std::move(radii_to)},
              {"caps", caps}};
  if (has_colors) object["colors"] = std::move(colors);
  return {std::move(object), fmt::format("{} {} {}cones of radius {:.2g}{}", count,
                                         caps ? "closed" : "open", are_pointed ? "pointed " : "",
                                         radius / half, has_colors ? " in colors" : "")};
}

/// A floor or a wall, or anywhere.
RandomObject plane(Dice& dice, double half) {
  const double away = half * dice.within(0.8, 1.3);
  const double angle = dice.within(0, 2 * std::numbers::pi);
  const bool is_floor = dice.happens(0.6);
  const bool is_wall = dice.happens(0.5);
  Vec3 normal = dice.direction();
  const char* words = "tilted plane";
  if (is_floor) {
    normal = Vec3{0, 1, 0};
    words = "plane as floor";
  } else if (is_wall) {
    normal = Vec3{std::cos(angle), 0, std::sin(angle)};
    words = "plane as wall";
  }
  return {{{"type", "plane"}, {"point", json_of(-away * normal)}, {"normal", json_of(normal)}},
          words};
}

struct MeshJson {
  json vertices = json::array();
  json triangles = json::array();

  std::size_t add_vertex(const Vec3& point) {
    vertices.push_back(json_of(point));
    return vertices.size() - 1;
  }
  void add_triangle(std::size_t a, std::size_t b, std::size_t c) {
    triangles.push_back(json::array({a, b, c}));
  }
  RandomObject done(const char* what) && {
    const std::size_t count = triangles.size();
    return {
        {{"type", "mesh"}, {"vertices", std::move(vertices)}, {"triangles", std::move(triangles)}},
        fmt::format("{} of {}", what, count)};
  }
};

RandomObject triangles(Dice& dice, double half) {
  const int count = dice.count_of_any_size(1, most_triangles);
  const double reach = 2 * half / std::cbrt(count) * dice.of_any_size(0.3, 2);
  MeshJson mesh;
  for (int i = 0; i < count; ++i) {
    const Vec3 middle = dice.point(half);
    const std::size_t a = mesh.add_vertex(middle + dice.point(reach));
    const std::size_t b = mesh.add_vertex(middle + dice.point(reach));
    mesh.add_triangle(a, b, mesh.add_vertex(middle + dice.point(reach)));
  }
  return std::move(mesh).done("triangles");
}

/// Waves in two directions, and a share of chance; flat or smoothly shaded, in one colour or many.
RandomObject bumpy_grid(Dice& dice, double half) {
  const int across = dice.count_of_any_size(1, 31);
  const int along = dice.count_of_any_size(1, 31);
  const double side = half * dice.within(0.6, 1.4);
  const double height = half * dice.within(0, 0.3);
  const double roughness = half * dice.within(0, 0.1);
  const double level = half * dice.within(-0.9, 0.5);
  const Vec3 waves{dice.within(0.5, 6), dice.within(0, 6), dice.within(0.5, 6)};
  const bool is_smooth = dice.happens(0.4);
  const bool has_colors = dice.happens(0.3);
  json normals = json::array();
  json colors = json::array();
  MeshJson mesh;
  for (int row = 0; row <= along; ++row)
    for (int column = 0; column <= across; ++column) {
      const double u = 2.0 * column / across - 1;
      const double v = 2.0 * row / along - 1;
      const double bump = height * std::sin(waves.x * u + waves.y) * std::cos(waves.z * v);
      mesh.add_vertex({side * u, level + bump + roughness * dice.within(-1, 1), side * v});
      const double slope_u =
          height * waves.x * std::cos(waves.x * u + waves.y) * std::cos(waves.z * v);
      const double slope_v =
          -height * waves.z * std::sin(waves.x * u + waves.y) * std::sin(waves.z * v);
      normals.push_back(json_of(unit(Vec3{-slope_u / side, 1, -slope_v / side})));
      colors.push_back(json_of(dice.point(0.5) + Vec3{0.5, 0.5, 0.5}));
    }
  const auto index = [&](int column, int row) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(across + 1) +
           static_cast<std::size_t>(column);
  };
  for (int row = 0; row < along; ++row)
    for (int column = 0; column < across; ++column) {
      mesh.add_triangle(index(column, row), index(column + 1, row), index(column, row + 1));
      mesh.add_triangle(index(column + 1, row + 1), index(column, row + 1), index(column + 1, row));
    }
  RandomObject grid = std::move(mesh).done("bumpy grid");
  if (is_smooth) grid.object["normals"] = std::move(normals);
  if (has_colors) grid.object["colors"] = std::move(colors);
  if (is_smooth) grid.words += ", smooth";
  if (has_colors) grid.words += ", in colors";
  return grid;
}

/// Straight, or each turned by an angle about the vertical.
RandomObject boxes(Dice& dice, double half) {
  constexpr std::array<std::array<std::size_t, 4>, 6> sides{
      {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};
  const int count = dice.count_of_any_size(1, most_triangles / 12);
  const double size = half / std::cbrt(count) * dice.within(0.2, 0.8);
  const bool are_turned = dice.happens(0.6);
  MeshJson mesh;
  for (int i = 0; i < count; ++i) {
    const Vec3 middle = dice.point(half);
    const Vec3 reach = Vec3{1, 1, 1} * (0.7 * size) + dice.point(0.5 * size);
    const double angle = are_turned ? dice.within(0, std::numbers::pi) : 0;
    const std::size_t first = mesh.vertices.size();
    for (int corner = 0; corner < 8; ++corner) {
      const double x = (corner & 1) != 0 ? reach.x : -reach.x;
      const double y = (corner & 2) != 0 ? reach.y : -reach.y;
      const double z = (corner & 4) != 0 ? reach.z : -reach.z;
      mesh.add_vertex(middle + Vec3{x * std::cos(angle) - z * std::sin(angle), y,
                                    x * std::sin(angle) + z * std::cos(angle)});
    }
    for (const auto& side : sides) {
      mesh.add_triangle(first + side[0], first + side[1], first + side[2]);
      mesh.add_triangle(first + side[0], first + side[2], first + side[3]);
    }
  }
  return std::move(mesh).done("boxes");
}

}  // namespace

std::span<const ObjectKind> object_kinds() {
  static constexpr std::array<ObjectKind, 11> kinds{{{"sphere of", sphere},
                                                     {"spheres", spheres},
                                                     {"sphere_square", sphere_square},
                                                     {"cylinder of", cylinder},
                                                     {"cylinders", cylinders},
                                                     {"cone of", cone},
                                                     {"cones", cones},
                                                     {"plane", plane},
                                                     {"triangles", triangles},
                                                     {"bumpy grid", bumpy_grid},
                                                     {"boxes", boxes}}};
  return kinds;
}

nlohmann::json json_of(double number) { return std::round(number * 1e6) / 1e6; }

nlohmann::json json_of(const Vec3& point) {
  return json::array({json_of(point.x), json_of(point.y), json_of(point.z)});
}

}  // namespace raytracer::published
