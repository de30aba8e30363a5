// What a scene says: plain values, complete and valid once read_scene has made them.
//
// Lengths are in the scene's own unit, angles in radians, colours linear in [0, 1]. Nothing here
// knows how a picture is made, and nothing changes a Scene after it was read. Copies share the
// large arrays: another view of a scene costs its camera only.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/math/vec.h"
#include "engine/memory/shared_array.h"

namespace raytracer {

struct Camera {
  Vec3 origin;
  Vec3 look_at;  ///< differs from origin
  Vec3 up{0, 1, 0};
  double fov = 0;  ///< between the left and the right side; modulo 2 pi inside (0, pi)
  int width = 0;   ///< pixels
  int height = 0;  ///< pixels
};

/// How a Blinn-Phong surface answers light; ka, kd, ks and reflectivity are in [0, 1].
struct Material {
  Rgb color{1, 1, 1};
  double ka = 1;
  double kd = 0.7;
  double ks = 0.3;
  double shininess = 50;  ///< >= 0
  double reflectivity = 0;

  friend bool operator==(const Material&, const Material&) = default;
};

/// An index into Scene::materials.
using MaterialIndex = std::uint32_t;

struct Sphere {
  Vec3 center;
  double radius = 0;
};

/// Many spheres of one material, in order.
struct Spheres {
  std::vector<Vec3> centers;
  std::vector<double> radii;  ///< one for all, or one for each centre

  double radius(std::size_t i) const { return radii.size() == 1 ? radii[0] : radii[i]; }
};

/// The two coordinates that span a square: indices into {x, y, z}.
enum class Axes : std::uint8_t { xz, xy, yz };

/// The square of 2n x 2n touching spheres around a centre: one object, whatever n.
struct SphereSquare {
  Vec3 center;
  double radius = 0;
  std::int64_t n = 1;  ///< 1 to 1e9
  Axes axes = Axes::xz;
};

/// The unit vector along the coordinate that does not span the square.
constexpr Vec3 axis_across(const SphereSquare& square) {
  if (square.axes == Axes::xz) return {0, 1, 0};
  if (square.axes == Axes::xy) return {0, 0, 1};
  return {1, 0, 0};
}

struct Plane {
  Vec3 point;
  Vec3 normal;  ///< not zero, any length
};

struct Mesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices into vertices
};

struct Object {
  std::variant<Sphere, Spheres, SphereSquare, Plane, Mesh> shape;
  MaterialIndex material = 0;
};

/// Light from infinitely far away, travelling along `direction`.
struct DistantLight {
  Vec3 direction;  ///< not zero, any length
};

/// Light from a point; its intensity is spread over 4 pi distance^2.
struct PointLight {
  Vec3 position;
};

struct Light {
  std::variant<DistantLight, PointLight> source;
  Rgb color{1, 1, 1};
  double intensity = 1;  ///< >= 0
};

/// What a surface that a light does not reach shows of that light's ambient part.
enum class Shadows : std::uint8_t { black, ambient, off };

enum class Precision : std::uint8_t { automatic, single_precision, double_precision };

enum class Transfer : std::uint8_t { linear, srgb };

struct RenderSettings {
  std::optional<int> samples;         ///< per pixel; never together with the two contracts
  std::optional<double> target_rmse;  ///< the error not to exceed
  std::optional<double> budget_ms;    ///< the time for tracing
  Precision precision = Precision::automatic;
  int max_depth = 5;  ///< how many times a ray may be reflected
  Transfer transfer = Transfer::linear;
};

struct Scene {
  Camera camera;
  Rgb background;
  double ambient = 0.2;
  Shadows shadows = Shadows::black;
  SharedArray<Light> lights;
  SharedArray<Material> materials;  ///< those that objects use, without repetition
  SharedArray<Object> objects;      ///< in the document's order, which decides ties
  RenderSettings render;
};

}  // namespace raytracer
