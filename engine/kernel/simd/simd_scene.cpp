#include "engine/kernel/simd/simd_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "engine/accel/lit_sphere.h"
#include "engine/kernel/simd/plain_light.h"
#include "engine/parallel/chunks.h"

namespace raytracer {
namespace {

double component(const Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

template <typename T>
Triple<T> narrowed(const Vec3& v) {
  return {static_cast<T>(v.x), static_cast<T>(v.y), static_cast<T>(v.z)};
}

/// So small that the sum over all lights, times any share, stays finite.
template <typename T>
T saturated(double channel) {
  constexpr double most = std::numeric_limits<T>::max() / 1e6;
  return static_cast<T>(std::min(channel, most));
}
template <typename T>
Triple<T> saturated(const Rgb& emission) {
  return {saturated<T>(emission.x), saturated<T>(emission.y), saturated<T>(emission.z)};
}

template <typename T>
SimdSphere<T> pack(const PackedSphere& sphere, std::int32_t number) {
  return {narrowed<T>(sphere.center), static_cast<T>(sphere.radius * sphere.radius),
          static_cast<T>(number)};
}

template <typename T>
SimdPlane<T> pack_plane(const Vec3& normal, const Vec3& point, std::int32_t number) {
  return {narrowed<T>(normal), static_cast<T>(dot(normal, point)), static_cast<T>(number)};
}

template <typename T>
SimdSquare<T> pack(const PackedSquare& square, std::int32_t number) {
  const double cell = 2 * square.radius;
  const auto half = static_cast<double>(square.side) / 2;
  // In cells from the corner; cell i is centred on i + 1/2.
  const double first = -component(square.center, square.first_axis) / cell + half;
  const double second = -component(square.center, square.second_axis) / cell + half;
  const double first_cell = std::floor(first);
  const double second_cell = std::floor(second);
  const auto last = static_cast<double>(square.side - 1);
  return {{square.first_axis, square.across, square.second_axis},
          {static_cast<T>(first - first_cell - 0.5),
           static_cast<T>(-component(square.center, square.across) / cell),
           static_cast<T>(second - second_cell - 0.5)},
          static_cast<T>(-first_cell),
          static_cast<T>(last - first_cell),
          static_cast<T>(-second_cell),
          static_cast<T>(last - second_cell),
          static_cast<T>(1 / cell),
          static_cast<T>(cell),
          static_cast<T>(number)};
}

/// The cells whose spheres come within a diameter of the line from a sphere's centre towards the
/// light: only they can stand between a point of that sphere and the light.
template <typename T>
Stencil<T> make_stencil(const Vec3& towards, const PackedSquare& square) {
  constexpr int most_cells = 17;  // 1 / lowest_stencil_slope
  const double first = component(towards, square.first_axis);
  const double second = component(towards, square.second_axis);
  const double across = std::abs(component(towards, square.across));
  if (across < lowest_stencil_slope) return {{}, 0, false};
  Stencil<T> stencil{{}, 0, true};
  for (int i = -most_cells; i <= most_cells; ++i) {
    for (int k = -most_cells; k <= most_cells; ++k) {
      if (i == 0 && k == 0) continue;
      const double forward = i * first + k * second;
      const double distance2 = i * i + k * k - forward * forward;
      if (!(forward > 0 && distance2 < 1)) continue;
      stencil.cells.push_back({static_cast<T>(i), static_cast<T>(k), static_cast<T>(i * i + k * k),
                               static_cast<T>(forward)});
      stencil.reach = std::max(stencil.reach, static_cast<T>(std::max(std::abs(i), std::abs(k))));
    }
  }
  return stencil;
}

template <typename T>
T finite(double value) {
  return static_cast<T>(std::min<double>(value, std::numeric_limits<T>::max()));
}

template <typename T>
MaterialTable<T> pack_materials(const PackedScene& scene) {
  MaterialTable<T> table;
  table.memory.share_out(scene.materials.size(),
                         {&table.red, &table.green, &table.blue, &table.ambient, &table.kd,
                          &table.ks, &table.shininess, &table.reflectivity});
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& m = scene.materials[i];
    table.red[i] = finite<T>(m.color.x);
    table.green[i] = finite<T>(m.color.y);
    table.blue[i] = finite<T>(m.color.z);
    table.ambient[i] = saturated<T>(m.ka * scene.ambient);
    table.kd[i] = finite<T>(m.kd);
    table.ks[i] = finite<T>(m.ks);
    table.shininess[i] = finite<T>(m.shininess);
    table.reflectivity[i] = finite<T>(m.reflectivity);
  }
  return table;
}

/// Notes what is needed of each primitive, by their numbers.
template <typename T>
class PrimitiveNotes {
 public:
  PrimitiveNotes(const PackedScene& scene, PrimitiveTable<T>& table)
      : scene_(scene), table_(table) {
    table.values.resize(Table::row_size * scene.numbers.count());
  }

  std::int32_t note(const PackedSphere& s) {
    const double distance = length(s.center);
    return note(s.id, s.center, s.radius, (distance - s.radius) * (distance + s.radius));
  }
  std::int32_t note(const PackedPlane& p) { return note(p.id, -p.normal); }
  std::int32_t note(const PackedTriangle& t) { return note(t.id, -t.normal); }
  std::int32_t note(const PackedSquare& s) { return note({s.object, 0}, s.center, s.radius, 0); }

 private:
  using Table = PrimitiveTable<T>;

  std::int32_t note(const PrimitiveId& id, const Vec3& place,
                    double radius = std::numeric_limits<double>::infinity(), double eye_c = 0) {
    const std::int32_t number = scene_.numbers(id);
    T* const row = table_.values.data() + Table::row_size * static_cast<std::size_t>(number);
    row[Table::x] = static_cast<T>(place.x);
    row[Table::y] = static_cast<T>(place.y);
    row[Table::z] = static_cast<T>(place.z);
    row[Table::curvature] = finite<T>(1 / radius);
    row[Table::material] = static_cast<T>(scene_.material_of_object[id.object]);
    row[Table::radius2] = finite<T>(radius * radius);
    row[Table::eye_c] = static_cast<T>(eye_c);
    return number;
  }

  const PackedScene& scene_;
  PrimitiveTable<T>& table_;
};

template <typename T>
SimdTriangle<T> pack_triangle(const PackedTriangle& triangle, std::int32_t id) {
  const auto& [a, b, c] = triangle.vertices;
  return {{narrowed<T>(a), narrowed<T>(b), narrowed<T>(c)}, pack_plane<T>(triangle.normal, a, id)};
}

/// In double up to the last step: corners near each other as seen from the eye give a side's plane
/// all its digits.
template <typename T>
TriangleCone<T> eye_cone(const PackedTriangle& triangle) {
  const auto& [a, b, c] = triangle.vertices;
  const double sign = dot(cross(a, b), c) < 0 ? -1 : 1;
  return {narrowed<T>(sign * unit(cross(a, b))), narrowed<T>(sign * unit(cross(b, c))),
          narrowed<T>(sign * unit(cross(c, a)))};
}

template <typename T>
void pack_primitives(const PackedScene& scene, const Structures& structures, WorkerPool& pool,
                     SimdScene<T>& packed) {
  PrimitiveNotes<T> notes(scene, packed.primitives);
  for_each_range(scene.spheres.size(), pool, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) notes.note(scene.spheres[i]);
  });
  packed.has_spheres = !scene.spheres.empty();
  if (structures.each_sphere)
    for (const PackedSphere& sphere : scene.spheres)
      packed.spheres.push_back(pack<T>(sphere, scene.numbers(sphere.id)));
  for (const PackedSquare& square : scene.squares)
    packed.squares.push_back(pack<T>(square, notes.note(square)));
  for (const PackedPlane& plane : scene.planes)
    packed.planes.push_back(pack_plane<T>(plane.normal, plane.point, notes.note(plane)));

  const bool finds_triangles = structures.triangle_bins || structures.triangle_grids;
  if (finds_triangles) packed.triangles.resize(scene.triangles.size());
  if (structures.triangle_bins) packed.eye_cones.resize(scene.triangles.size());
  for_each_range(scene.triangles.size(), pool, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const PackedTriangle& triangle = scene.triangles[i];
      const std::int32_t number = notes.note(triangle);
      if (finds_triangles) packed.triangles[i] = pack_triangle<T>(triangle, number);
      if (structures.triangle_bins) packed.eye_cones[i] = eye_cone<T>(triangle);
    }
  });
}

template <typename T>
std::vector<LightBall<T>> pack_balls(const Vec3& light, bool is_far, const PackedScene& scene) {
  std::vector<LightBall<T>> balls;
  balls.reserve(scene.spheres.size());
  for (const PackedSphere& sphere : scene.spheres) {
    const auto lit = LitSphere::seen_from<T>(light, is_far, sphere);
    balls.push_back({narrowed<T>(lit.center), static_cast<T>(lit.radius2),
                     static_cast<T>(lit.nearest), static_cast<T>(scene.numbers(sphere.id))});
  }
  return balls;
}

/// By its exact height over the plane: from what T holds of a plane near the eye that of a light
/// far away is rounding alone.
template <typename T>
T side_of(const Vec3& light, const PackedPlane& plane) {
  constexpr double noise = 64 * std::numeric_limits<double>::epsilon();
  const double height = dot(plane.normal, light - plane.point);
  if (std::abs(height) <= noise * (max_abs(light) + max_abs(plane.point))) return 0;
  return height > 0 ? T(1) : T(-1);
}

/// Whether distant lights' grids are larger than what a processor's caches keep of them. Where they
/// are, cells fetched ahead save time: 250,000 spheres in two grids of 10 MB trace in 0.94 of it,
/// 1,000,000 in 0.74. Where they are not it is wasted: 100,000 take 1.04, 1,000 take 1.5 of it.
template <typename T>
bool exceed_caches(const std::vector<SimdLight<T>>& lights) {
  constexpr std::size_t caches = std::size_t{10} << 20;
  std::size_t bytes = 0;
  for (const SimdLight<T>& light : lights) bytes += sizeof(T) * light.grid.discs.values.size();
  return bytes > caches;
}

}  // namespace

template <typename T>
SimdScene<T> make_simd_scene(const PackedScene& scene, const Features& features,
                             const Structures& structures, WorkerPool& pool) {
  SimdScene<T> packed{};
  packed.view = scene.view;
  packed.forward = narrowed<T>(scene.view.forward);
  packed.right = narrowed<T>(scene.view.right);
  packed.up = narrowed<T>(scene.view.up);
  pack_primitives(scene, structures, pool, packed);
  packed.has_triangles = !scene.triangles.empty();
  packed.bins = build_screen_bins(
      scene.view,
      structures.sphere_bins ? std::span(scene.spheres) : std::span<const PackedSphere>(),
      scene.numbers, scene.squares,
      structures.triangle_bins ? std::span(scene.triangles) : std::span<const PackedTriangle>(),
      pool);
  packed.has_sphere_bins = structures.sphere_bins;
  // There may be none left of those that the structures were chosen for.
  packed.has_light_grids = structures.light_grids && packed.has_spheres;
  if (structures.sphere_tree && packed.has_spheres)
    packed.sphere_tree = make_sphere_tree<T>(scene.spheres, scene.numbers, pool);
  if (structures.triangle_tree && packed.has_triangles)
    packed.triangle_tree = make_triangle_tree<T>(scene.triangles, scene.numbers, pool);
  packed.has_triangle_bins = structures.triangle_bins;
  for (const PackedLight& light : scene.lights) {
    SimdLight<T> simd{};
    simd.is_distant = light.is_distant;
    simd.place = narrowed<T>(light.place);
    simd.emission = saturated<T>(light.emission);
    if (packed.has_light_grids && light.is_distant)
      simd.grid = build_distant_grid<T>(light.place, scene.spheres, scene.numbers, pool);
    if (packed.has_light_grids && !light.is_distant)
      simd.point_grid = build_point_grid<T>(light.place, scene.spheres, scene.numbers, pool);
    if (features.casts_shadows && !packed.has_light_grids && !light.is_distant) {
      simd.is_far = is_far_light(light.place, scene.spheres);
      simd.balls = pack_balls<T>(light.place, simd.is_far, scene);
    }
    for (const PackedPlane& plane : scene.planes)
      simd.plane_sides.push_back(light.is_distant ? 0 : side_of<T>(light.place, plane));
    if (structures.triangle_grids && light.is_distant)
      simd.triangle_grid = build_triangle_grid<T>(light.place, scene.triangles, pool);
    for (const PackedSquare& square : scene.squares)
      simd.stencils.push_back(light.is_distant ? make_stencil<T>(light.place, square)
                                               : Stencil<T>{{}, 0, false});
    packed.lights.push_back(std::move(simd));
  }
  packed.fetches_light_cells = exceed_caches(packed.lights);
  packed.background = narrowed<T>(scene.background);
  packed.shadows = scene.shadows;
  packed.materials = pack_materials<T>(scene);
  packed.has_specular = features.has_specular;
  packed.uniform_shininess = features.uniform_shininess;
  packed.reflects = features.reflects;
  packed.max_depth = features.max_depth;
  prepare_plain_light(scene, packed);
  return packed;
}

template SimdScene<float> make_simd_scene<float>(const PackedScene&, const Features&,
                                                 const Structures&, WorkerPool&);
template SimdScene<double> make_simd_scene<double>(const PackedScene&, const Features&,
                                                   const Structures&, WorkerPool&);

}  // namespace raytracer
