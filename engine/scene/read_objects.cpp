#include "engine/scene/read_objects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "engine/scene/read_typed.h"

namespace raytracer {
namespace {

constexpr std::int64_t most_spheres_per_half_side = 1'000'000'000;

std::optional<double> read_radius(const Field& field) { return read_number(field, positive); }

std::optional<std::vector<Vec3>> read_points(const Field& field) {
  if (!expect_array(field)) return {};
  std::vector<Vec3> points;
  points.reserve(field.value.node_count());  // of points that are arrays of numbers, one each
  read_elements(
      field, [&](const Field& element) { points.push_back(read_point(element).value_or(Vec3{})); });
  return points;
}

Sphere read_sphere(const Field& field) {
  const ObjectReader object(field, {"type", "material", "center", "radius"});
  Sphere sphere;
  object.required("center", sphere.center, read_point);
  object.required("radius", sphere.radius, read_radius);
  return sphere;
}

/// One radius for all, or as many as there are centres, where these are known.
std::optional<std::vector<double>> read_radii(const Field& field,
                                              std::optional<std::size_t> center_count) {
  if (field.value.kind() != JsonKind::array) {
    const std::optional<double> radius = read_radius(field);
    if (!radius) return {};
    return std::vector{*radius};
  }
  const std::span<const double> valid = numbers_within(field.value, positive);
  std::vector<double> radii(valid.begin(), valid.end());
  if (radii.empty())
    read_elements(field,
                  [&](const Field& element) { radii.push_back(read_radius(element).value_or(1)); });
  if (center_count && radii.size() != *center_count) {
    field.refuse(fmt::format("{} radii for {} centers: give one number, or one for each center",
                             radii.size(), *center_count));
    return {};
  }
  const bool all_equal = std::all_of(radii.begin(), radii.end(),
                                     [&](double radius) { return radius == radii.front(); });
  if (all_equal && !radii.empty()) radii.resize(1);
  return radii;
}

Spheres read_spheres(const Field& field) {
  const ObjectReader object(field, {"type", "material", "centers", "radius"});
  Spheres spheres;
  std::optional<std::vector<Vec3>> centers;
  object.required("centers", centers, read_points);
  object.required("radius", spheres.radii, [&](const Field& f) {
    return read_radii(f, centers ? std::optional(centers->size()) : std::nullopt);
  });
  if (centers) spheres.centers = *std::move(centers);
  return spheres;
}

SphereSquare read_sphere_square(const Field& field) {
  static constexpr std::array<std::string_view, 3> axes_words{"xz", "xy", "yz"};
  const ObjectReader object(field, {"type", "material", "center", "radius", "n", "axes"});
  SphereSquare square;
  object.required("center", square.center, read_point);
  object.required("radius", square.radius, read_radius);
  object.required("n", square.n,
                  [](const Field& f) { return read_integer(f, 1, most_spheres_per_half_side); });
  object.optional("axes", square.axes, [](const Field& f) { return read_choice(f, axes_words); });
  return square;
}

Plane read_plane(const Field& field) {
  const ObjectReader object(field, {"type", "material", "point", "normal"});
  Plane plane;
  object.required("point", plane.point, read_point);
  object.required("normal", plane.normal, read_direction);
  return plane;
}

/// Triples of indices into the vertices, where their number is known.
std::optional<std::vector<std::array<std::uint32_t, 3>>> read_triangles(
    const Field& field, std::optional<std::size_t> vertex_count) {
  constexpr std::int64_t largest_index = std::numeric_limits<std::uint32_t>::max();
  const std::int64_t last_vertex =
      vertex_count ? static_cast<std::int64_t>(*vertex_count) - 1 : largest_index;
  if (!expect_array(field)) return {};
  if (vertex_count == 0 && field.value.node_count() > 0) {
    field.refuse("must be empty: the mesh has no vertices");
    return {};
  }
  std::vector<std::array<std::uint32_t, 3>> triangles;
  triangles.reserve(field.value.node_count());
  const ValueRange valid_index{.least = 0, .most = static_cast<double>(last_vertex)};
  const auto is_integer = [](double number) { return number == std::floor(number); };
  read_elements(field, [&](const Field& element) {
    std::array<std::uint32_t, 3> triangle{};
    const std::span<const double> valid = numbers_within(element.value, valid_index);
    if (valid.size() == 3 && std::all_of(valid.begin(), valid.end(), is_integer)) {
      std::transform(valid.begin(), valid.end(), triangle.begin(),
                     [](double index) { return static_cast<std::uint32_t>(index); });
      triangles.push_back(triangle);
      return;
    }
    std::size_t count = 0;
    if (!expect_array(element)) return;
    read_elements(element, [&](const Field& corner) {
      const auto index = read_integer(corner, 0, last_vertex);
      if (index && count < 3) triangle[count] = static_cast<std::uint32_t>(*index);
      ++count;
    });
    if (count != 3) element.refuse(fmt::format("must be three indices, not {} values", count));
    triangles.push_back(triangle);
  });
  return triangles;
}

Mesh read_mesh(const Field& field) {
  const ObjectReader object(field, {"type", "material", "vertices", "triangles"});
  Mesh mesh;
  std::optional<std::vector<Vec3>> vertices;
  object.required("vertices", vertices, read_points);
  object.required("triangles", mesh.triangles, [&](const Field& f) {
    return read_triangles(f, vertices ? std::optional(vertices->size()) : std::nullopt);
  });
  if (vertices) mesh.vertices = *std::move(vertices);
  return mesh;
}

}  // namespace

std::vector<Object> read_objects(const Field& field, MaterialReader& materials) {
  using Shape = decltype(Object::shape);
  static constexpr TypedReaders<Shape, 5> readers{{
      {"sphere", [](const Field& f) -> Shape { return read_sphere(f); }},
      {"spheres", [](const Field& f) -> Shape { return read_spheres(f); }},
      {"sphere_square", [](const Field& f) -> Shape { return read_sphere_square(f); }},
      {"plane", [](const Field& f) -> Shape { return read_plane(f); }},
      {"mesh", [](const Field& f) -> Shape { return read_mesh(f); }},
  }};
  std::vector<Object> objects;
  if (!expect_array(field)) return objects;
  constexpr std::size_t fewest_nodes = 7;  // of an object: it, a type and two arrays or numbers
  objects.reserve(field.value.node_count() / fewest_nodes);
  read_elements(field, [&](const Field& element) {
    std::optional<Shape> shape = read_typed(element, readers);
    if (element.value.kind() != JsonKind::object) return;
    MaterialIndex material = 0;
    if (const auto use = element.value.member("material")) {
      const Path path = element.path.child("material");
      material = materials.read_use({*use, path, element.errors}).value_or(0);
    } else {
      material = materials.use_default();
    }
    if (shape) objects.push_back({std::move(*shape), material});
  });
  return objects;
}

}  // namespace raytracer
