// A scene as readers of all formats fill it, and the document that says it.
//
// Files count in right-handed coordinates, scenes in left-handed ones (u = up x d points to the
// right of the image). So the document has every x with its sign changed and the corners of every
// triangle in the other order: the image is the file's, and upward stays upward.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace raytracer::client::model {

using Triple = std::array<double, 3>;

struct View {
  Triple from;
  Triple at;
  Triple up;
  double fov;  ///< between the left and the right side of the image, in radians
  int width_px;
  int height_px;
};

/// Of a file that does not know how wide the image will be.
struct Camera {
  Triple from;
  Triple ahead;  ///< a direction, as is up
  Triple up;
  double fov;  ///< between the lower and the upper side of the image, in radians
};

/// A point that shines.
struct Lamp {
  Triple position;
  Triple color;  ///< in [0, 1]
  double intensity;
  /// With the square of the distance d, to intensity / (4 pi d^2); else it is equal far and near.
  bool falls_off = false;
};

/// Shines from so far away that it has a direction only.
struct Sun {
  Triple direction;  ///< in which its light goes
  Triple color;      ///< in [0, 1]
  double intensity;
};

/// Shines from everywhere.
struct Sky {
  Triple color;  ///< in [0, 1]
  double intensity;
};

using Light = std::variant<Lamp, Sun, Sky>;

/// Nothing: transparent.
using Background = std::optional<Triple>;

struct Material {
  Triple color;
  double kd;
  double ks;
  double shininess;  ///< of Blinn and Phong
  double reflectivity;
  double transparency;
  double ior;          ///< counts with transparency only
  std::string name{};  ///< letters and digits, and no other material's; empty: its number

  auto operator<=>(const Material&) const = default;
};

/// A colour of which a scene may have millions.
using Rgb = std::array<float, 3>;

struct Spheres {
  std::vector<Triple> centers;
  std::vector<double> radii;  ///< one for each centre
  std::vector<Rgb> colors{};  ///< none, or one for each centre, in place of the material's
};

/// Without caps.
struct Cylinders {
  std::vector<Triple> from;
  std::vector<Triple> to;
  std::vector<double> radii;
  std::vector<Rgb> colors{};  ///< none, or one for each
};

/// Without caps.
struct Cones {
  std::vector<Triple> from;
  std::vector<Triple> to;
  std::vector<double> radii_from;
  std::vector<double> radii_to;
};

struct Mesh {
  std::vector<Triple> vertices;
  std::vector<Triple> normals;  ///< none, or one for each vertex
  std::vector<Rgb> colors{};    ///< none, or one for each vertex
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// All that are of one kind and material: at least one.
struct Objects {
  std::variant<Spheres, Cylinders, Cones, Mesh> shape;
  std::optional<std::size_t> material;  ///< which of the scene's; none: the document's default
};

struct Scene {
  View view = {};
  std::optional<Camera> camera{};  ///< the file's own, of which the view is made
  Background background = Triple{0, 0, 0};
  double ambient = 0;
  bool is_shadow_black = true;  ///< where no light comes nothing is seen, ambient light neither
  std::vector<Light> lights;
  std::vector<Material> materials;
  std::vector<Objects> objects;
  int samples = 0;       ///< 0: the document does not say it
  bool is_srgb = false;  ///< the image is encoded as sRGB
};

/// As JSON. Lists have an item on each line.
std::string to_document(const Scene& scene);

}  // namespace raytracer::client::model
