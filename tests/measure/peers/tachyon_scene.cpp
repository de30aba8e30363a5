#include "tests/measure/peers/tachyon_scene.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <numbers>
#include <stdexcept>
#include <string>

#include "tests/measure/peers/expanded_square.h"
#include "tests/measure/peers/eye_view.h"
#include "tests/measure/peers/scene_features.h"
#include "tests/measure/peers/smallest_feature.h"

namespace raytracer::peers {
namespace {

std::string tachyon_vector(const Vec3& v) {
  return fmt::format("{:.9g} {:.9g} {:.9g}", v.x, v.y, v.z);
}

class TachyonWriter {
 public:
  TachyonWriter(const Scene& scene, std::ostream& out)
      : scene_(scene), out_(out), scale_(10 / smallest_feature(scene)) {}

  void write() {
    fmt::print(out_, "BEGIN_SCENE\nRESOLUTION {} {}\n", scene_.camera.width, scene_.camera.height);
    write_sky();
    write_camera();
    fmt::print(out_, "BACKGROUND {}\n", tachyon_vector(scene_.background.value_or(Rgb{})));
    for (const Light& light : scene_.lights) write_light(light);
    for (std::size_t i = 0; i < scene_.materials.size(); ++i) write_texture(i, scene_.materials[i]);
    for (const Object& object : scene_.objects) {
      texture_ = texture_name(object.material);
      std::visit([this](const auto& shape) { write(shape); }, object.shape);
    }
    out_ << "END_SCENE\n";
  }

 private:
  static std::string texture_name(std::size_t material) { return fmt::format("m{}", material); }

  std::string point_text(const Vec3& point) const {
    return tachyon_vector((point - scene_.camera.origin) * scale_);
  }

  void write_camera() {
    const EyeView view = make_eye_view(scene_.camera);
    const double half_width = length(view.right);
    const double half_height = length(view.up);
    const double half_pixel = half_width / scene_.camera.width;
    fmt::print(out_,
               "CAMERA ZOOM 1.0 ASPECTRATIO 1.0 ANTIALIASING 0 RAYDEPTH {} CENTER 0 0 0 "
               "VIEWDIR {} UPDIR {} FRUSTUM {:.9g} {:.9g} {:.9g} {:.9g} END_CAMERA\n",
               scene_.render.max_depth + 1, tachyon_vector(view.forward),
               tachyon_vector(unit(view.up)), -half_width - half_pixel, half_width - half_pixel,
               -half_height - half_pixel, half_height - half_pixel);
  }

  /// Its ambient occlusion, which stands before the camera.
  void write_sky() {
    for (const Light& light : scene_.lights)
      if (std::holds_alternative<SkyLight>(light.source))
        fmt::print(out_,
                   "SHADER_MODE FULL AMBIENT_OCCLUSION AMBIENT_COLOR {} RESCALE_DIRECT 1 SAMPLES "
                   "64 END_SHADER_MODE\n",
                   tachyon_vector(light.color * light.intensity));
  }

  void write_light(const Light& light) {
    if (std::holds_alternative<SkyLight>(light.source)) return;
    const auto* point = std::get_if<PointLight>(&light.source);
    if (point && point->falloff == Falloff::none) {
      fmt::print(out_, "LIGHT CENTER {} RAD 0 COLOR {}\n", point_text(point->position),
                 tachyon_vector(light.color * light.intensity));
      return;
    }
    if (point) {
      // The intensity is in the attenuation: what is below 0.002 before the colour is left out.
      const double quadratic = 4 * std::numbers::pi / (light.intensity * scale_ * scale_);
      if (light.intensity > 0)
        fmt::print(
            out_,
            "LIGHT CENTER {} RAD 0 ATTENUATION CONSTANT 0 LINEAR 0 QUADRATIC {:.9g} COLOR {}\n",
            point_text(point->position), quadratic, tachyon_vector(light.color));
      return;
    }
    fmt::print(out_, "DIRECTIONAL_LIGHT DIRECTION {} COLOR {}\n",
               tachyon_vector(unit(std::get<DistantLight>(light.source).direction)),
               tachyon_vector(light.color * light.intensity));
  }

  void write_texture(std::size_t index, const Material& material) {
    const bool grey = is_grey(material.color);
    fmt::print(out_,
               "TEXDEF {} AMBIENT {:.9g} DIFFUSE {:.9g} SPECULAR {:.9g} OPACITY 1 PHONG {} {:.9g} "
               "PHONG_SIZE {:.9g} COLOR {} TEXFUNC 0\n",
               texture_name(index), material.ka * scene_.ambient, material.kd,
               scene_.render.max_depth > 0 ? material.reflectivity : 0, grey ? "PLASTIC" : "METAL",
               material.ks * (grey ? material.color.x : mean_intensity()), material.shininess,
               tachyon_vector(material.color));
  }

  /// Of all lights.
  double mean_intensity() const {
    if (scene_.lights.empty()) return 0;
    Rgb sum;
    for (const Light& light : scene_.lights) sum = sum + light.color * light.intensity;
    return (sum.x + sum.y + sum.z) / static_cast<double>(3 * scene_.lights.size());
  }

  void write(const Sphere& sphere) { write_sphere(sphere.center, sphere.radius); }
  void write(const Spheres& spheres) {
    for (std::size_t i = 0; i < spheres.centers.size(); ++i)
      write_sphere(spheres.centers[i], spheres.radius(i));
  }
  void write(const SphereSquare& square) { write(expanded(square)); }
  void write(const Cylinder& c) { write_cylinder(c.from, c.to, c.radius, c.caps); }
  void write(const Cylinders& c) {
    for (std::size_t i = 0; i < c.from.size(); ++i)
      write_cylinder(c.from[i], c.to[i], c.radius(i), c.caps);
  }
  void write(const Plane& plane) {
    fmt::print(out_, "PLANE CENTER {} NORMAL {} {}\n", point_text(plane.point),
               tachyon_vector(unit(plane.normal)), texture_);
  }
  void write(const Mesh& mesh) {
    for (const auto& triangle : mesh.triangles) {
      out_ << (mesh.normals.empty() ? "TRI" : "STRI");
      for (std::size_t k = 0; k < 3; ++k)
        fmt::print(out_, " V{} {}", k, point_text(mesh.vertices[triangle[k]]));
      for (std::size_t k = 0; k < 3 && !mesh.normals.empty(); ++k)
        fmt::print(out_, " N{} {}", k, tachyon_vector(unit(mesh.normals[triangle[k]])));
      fmt::print(out_, " {}\n", texture_);
    }
  }
  void write(const auto&) { throw std::logic_error("not a shape that the Tachyon peer draws"); }

  void write_sphere(const Vec3& center, double radius) {
    fmt::print(out_, "SPHERE CENTER {} RAD {:.9g} {}\n", point_text(center), radius * scale_,
               texture_);
  }

  void write_cylinder(const Vec3& from, const Vec3& to, double radius, bool caps) {
    fmt::print(out_, "FCYLINDER BASE {} APEX {} RAD {:.9g} {}\n", point_text(from), point_text(to),
               radius * scale_, texture_);
    if (!caps) return;
    for (const Vec3& end : {from, to})
      fmt::print(out_, "RING CENTER {} NORMAL {} INNER 0 OUTER {:.9g} {}\n", point_text(end),
                 tachyon_vector(unit(to - from)), radius * scale_, texture_);
  }

  const Scene& scene_;
  std::ostream& out_;
  double scale_;
  std::string texture_;
};

}  // namespace

void write_tachyon_scene(const Scene& scene, std::ostream& out) {
  TachyonWriter(scene, out).write();
}

}  // namespace raytracer::peers
