#include "tests/measure/peers/povray_scene.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <numbers>
#include <stdexcept>

#include "tests/measure/peers/expanded_square.h"
#include "tests/measure/peers/eye_view.h"
#include "tests/measure/peers/scene_features.h"
#include "tests/measure/peers/smallest_feature.h"

namespace raytracer::peers {
namespace {

std::string povray_vector(const Vec3& v) {
  return fmt::format("<{:.17g},{:.17g},{:.17g}>", v.x, v.y, v.z);
}

class PovrayWriter {
 public:
  PovrayWriter(const Scene& scene, std::ostream& out)
      : scene_(scene),
        out_(out),
        scale_(10 / smallest_feature(scene)),
        no_shadow_(scene.shadows == Shadows::off ? " no_shadow" : "") {}

  void write() {
    fmt::print(out_,
               "#version 3.7;\n"
               "global_settings {{ assumed_gamma 1 max_trace_level {} adc_bailout 0 }}\n"
               "background {{ color rgb {} }}\n",
               scene_.render.max_depth + 1, povray_vector(scene_.background.value_or(Rgb{})));
    write_camera();
    for (const Light& light : scene_.lights) write_light(light);
    for (const Object& object : scene_.objects) {
      write_default_texture(scene_.materials[object.material]);
      std::visit([this](const auto& shape) { write(shape); }, object.shape);
    }
  }

 private:
  std::string point_text(const Vec3& point) const { return povray_vector(point * scale_); }

  void write_camera() {
    const EyeView view = make_eye_view(scene_.camera);
    fmt::print(out_, "camera {{ perspective location {} right {} up {} direction {} }}\n",
               point_text(scene_.camera.origin), povray_vector(view.right * 2),
               povray_vector(view.up * 2), povray_vector(view.forward));
  }

  void write_light(const Light& light) {
    if (const auto* point = std::get_if<PointLight>(&light.source)) {
      // 2 / (1 + (distance / fade)^2) of its colour: an inverse square far outside of `fade`.
      constexpr double fade = 1e-3;
      const double at_one = light.intensity * scale_ * scale_ / (4 * std::numbers::pi);
      fmt::print(out_, "light_source {{ {} color rgb {} fade_distance {:.17g} fade_power 2 }}\n",
                 point_text(point->position),
                 povray_vector(light.color * (at_one / (2 * fade * fade))), fade);
      return;
    }
    constexpr double outside = 1e6;  // of the scene; POV-Ray's rays end at 1e7
    const auto& distant = std::get<DistantLight>(light.source);
    fmt::print(out_, "light_source {{ {} color rgb {} parallel point_at <0,0,0> }}\n",
               povray_vector(unit(distant.direction) * -outside),
               povray_vector(light.color * light.intensity));
  }

  /// An object without a texture takes the default, without a copy of its own. What a default
  /// leaves out stays as the default before it had it.
  void write_default_texture(const Material& material) {
    const Rgb& color = material.color;
    fmt::print(out_,
               "#default {{ texture {{ pigment {{ color rgb {} }} finish {{ ambient {} diffuse {} "
               "specular {} roughness {:.17g} metallic {} reflection {} }} }} }}\n",
               povray_vector(color), material.ka * scene_.ambient, material.kd,
               is_grey(color) ? material.ks * color.x : material.ks,
               material.shininess > 0 ? 1 / material.shininess : 1, is_grey(color) ? 0 : 1,
               material.reflectivity);
  }

  void write(const Sphere& sphere) { write_sphere(sphere.center, sphere.radius); }
  void write(const Spheres& spheres) {
    for (std::size_t i = 0; i < spheres.centers.size(); ++i)
      write_sphere(spheres.centers[i], spheres.radius(i));
  }
  void write(const SphereSquare& square) { write(expanded(square)); }
  void write(const Cylinder& c) { write_cylinder(c.from, c.to, c.radius, c.caps); }
  void write(const Cylinders& cylinders) {
    for (std::size_t i = 0; i < cylinders.from.size(); ++i)
      write_cylinder(cylinders.from[i], cylinders.to[i], cylinders.radius(i), cylinders.caps);
  }

  void write(const Plane& plane) {
    const Vec3 normal = unit(plane.normal);
    fmt::print(out_, "plane {{ {}, {:.17g}{} }}\n", povray_vector(normal),
               dot(normal, plane.point) * scale_, no_shadow_);
  }

  void write(const Mesh& mesh) {
    fmt::print(out_, "mesh2 {{ vertex_vectors {{ {}", mesh.vertices.size());
    for (const Vec3& vertex : mesh.vertices) out_ << ',' << point_text(vertex);
    fmt::print(out_, " }} face_indices {{ {}", mesh.triangles.size());
    for (const auto& triangle : mesh.triangles)
      fmt::print(out_, ",<{},{},{}>", triangle[0], triangle[1], triangle[2]);
    fmt::print(out_, " }}{} }}\n", no_shadow_);
  }

  void write_sphere(const Vec3& center, double radius) {
    fmt::print(out_, "sphere {{ {}, {:.17g}{} }}\n", point_text(center), radius * scale_,
               no_shadow_);
  }

  void write_cylinder(const Vec3& from, const Vec3& to, double radius, bool caps) {
    fmt::print(out_, "cylinder {{ {}, {}, {:.17g}{}{} }}\n", point_text(from), point_text(to),
               radius * scale_, caps ? "" : " open", no_shadow_);
  }

  void write(const auto&) { throw std::logic_error("not a shape that the POV-Ray peer draws"); }

  const Scene& scene_;
  std::ostream& out_;
  double scale_;
  const char* no_shadow_;  ///< of each object: lights without shadows have no highlights there
};

}  // namespace

void write_povray_scene(const Scene& scene, std::ostream& out) { PovrayWriter(scene, out).write(); }

}  // namespace raytracer::peers
