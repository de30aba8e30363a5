#include "tests/measure/peers/povray_scene.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
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

constexpr double least_weight = 0x1p-14;  // of rays that documents want followed
constexpr double most_transmitted = 0.999;

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
               "global_settings {{ assumed_gamma 1 max_trace_level {} adc_bailout {:.17g} }}\n"
               "background {{ color rgb {} }}\n",
               scene_.render.max_depth + 1, least_weight,
               povray_vector(scene_.background.value_or(Rgb{})));
    write_camera();
    for (const Light& light : scene_.lights) write_light(light);
    for (const Object& object : scene_.objects) {
      material_ = &scene_.materials[object.material];
      write_default_texture(*material_);
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
    const auto* point = std::get_if<PointLight>(&light.source);
    if (point && point->falloff == Falloff::none) {
      fmt::print(out_, "light_source {{ {} color rgb {} }}\n", point_text(point->position),
                 povray_vector(light.color * light.intensity));
      return;
    }
    if (point) {
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
    // What it lets through weakens its own light there: the inverse here.
    const double transmitted = std::min(material.transparency, most_transmitted);
    const double own = 1 / (1 - transmitted);
    fmt::print(out_,
               "#default {{ texture {{ pigment {{ color rgb {} transmit {:.17g} }} finish {{ "
               "ambient {:.17g} diffuse {:.17g} specular {} roughness {:.17g} metallic {} {} }} }} "
               "}}\n",
               povray_vector(color), transmitted, material.ka * scene_.ambient * own,
               material.kd * own, is_grey(color) ? material.ks * color.x : material.ks,
               material.shininess > 0 ? 1 / material.shininess : 1, is_grey(color) ? 0 : 1,
               reflection_text(material));
  }

  static std::string reflection_text(const Material& material) {
    if (material.transparency == 0 || !material.fresnel)
      return fmt::format("reflection {}", material.reflectivity);
    return fmt::format("reflection {{ {} {} fresnel on }} conserve_energy", material.reflectivity,
                       material.reflectivity + material.transparency);
  }

  /// What ends every object: its inside, if it has one, and its colour where that is its own.
  std::string ending(bool has_inside, const Rgb* color = nullptr) const {
    std::string text = no_shadow_;
    if (color)
      text += fmt::format(" pigment {{ color rgb {} transmit {:.17g} }}", povray_vector(*color),
                          std::min(material_->transparency, most_transmitted));
    if (has_inside && material_->transparency > 0)
      text += fmt::format(" interior {{ ior {:.17g} }}", material_->ior);
    return text;
  }

  void write(const Sphere& sphere) { write_sphere(sphere.center, sphere.radius, nullptr); }
  void write(const Spheres& spheres) {
    for (std::size_t i = 0; i < spheres.centers.size(); ++i)
      write_sphere(spheres.centers[i], spheres.radius(i), color_of(spheres, i));
  }
  void write(const SphereSquare& square) { write(expanded(square)); }
  void write(const Cylinder& c) { write_cylinder(c.from, c.to, c.radius, c.caps, nullptr); }
  void write(const Cylinders& c) {
    for (std::size_t i = 0; i < c.from.size(); ++i)
      write_cylinder(c.from[i], c.to[i], c.radius(i), c.caps, color_of(c, i));
  }
  void write(const Cone& c) {
    write_cone(c.from, c.radius_from, c.to, c.radius_to, c.caps, nullptr);
  }
  void write(const Cones& c) {
    for (std::size_t i = 0; i < c.from.size(); ++i)
      write_cone(c.from[i], c.radius_from(i), c.to[i], c.radius_to(i), c.caps, color_of(c, i));
  }

  void write(const Plane& plane) {
    const Vec3 normal = unit(plane.normal);
    fmt::print(out_, "plane {{ {}, {:.17g}{} }}\n", povray_vector(normal),
               dot(normal, plane.point) * scale_, ending(true));
  }

  void write(const Mesh& mesh) {
    fmt::print(out_, "mesh2 {{ vertex_vectors {{ {}", mesh.vertices.size());
    for (const Vec3& vertex : mesh.vertices) out_ << ',' << point_text(vertex);
    out_ << " }";
    if (!mesh.normals.empty()) {
      fmt::print(out_, " normal_vectors {{ {}", mesh.normals.size());
      for (const Vec3& normal : mesh.normals) out_ << ',' << povray_vector(unit(normal));
      out_ << " }";
    }
    write_vertex_textures(mesh);
    fmt::print(out_, " face_indices {{ {}", mesh.triangles.size());
    for (const auto& [a, b, c] : mesh.triangles) {
      fmt::print(out_, ",<{},{},{}>", a, b, c);
      if (!mesh.vertex_colors.empty()) fmt::print(out_, ",{},{},{}", a, b, c);
    }
    fmt::print(out_, " }}{} }}\n", ending(true));
  }

  void write_vertex_textures(const Mesh& mesh) {
    if (mesh.vertex_colors.empty()) return;
    fmt::print(out_, " texture_list {{ {}", mesh.vertex_colors.size());
    for (const Rgb& color : mesh.vertex_colors)
      fmt::print(out_, ",texture {{ pigment {{ color rgb {} transmit {:.17g} }} }}",
                 povray_vector(color), std::min(material_->transparency, most_transmitted));
    out_ << " }";
  }

  static const Rgb* color_of(const auto& items, std::size_t i) {
    return items.colors.empty() ? nullptr : &items.colors[i];
  }

  void write_sphere(const Vec3& center, double radius, const Rgb* color) {
    fmt::print(out_, "sphere {{ {}, {:.17g}{} }}\n", point_text(center), radius * scale_,
               ending(true, color));
  }

  void write_cylinder(const Vec3& from, const Vec3& to, double radius, bool caps,
                      const Rgb* color) {
    fmt::print(out_, "cylinder {{ {}, {}, {:.17g}{}{} }}\n", point_text(from), point_text(to),
               radius * scale_, caps ? "" : " open", ending(caps, color));
  }

  void write_cone(const Vec3& from, double radius_from, const Vec3& to, double radius_to, bool caps,
                  const Rgb* color) {
    fmt::print(out_, "cone {{ {}, {:.17g}, {}, {:.17g}{}{} }}\n", point_text(from),
               radius_from * scale_, point_text(to), radius_to * scale_, caps ? "" : " open",
               ending(caps, color));
  }

  void write(const auto&) { throw std::logic_error("not a shape that the POV-Ray peer draws"); }

  const Scene& scene_;
  std::ostream& out_;
  double scale_;
  const Material* material_ = nullptr;  ///< of the object that is written
  const char* no_shadow_;  ///< of each object: lights without shadows have no highlights there
};

}  // namespace

void write_povray_scene(const Scene& scene, std::ostream& out) { PovrayWriter(scene, out).write(); }

}  // namespace raytracer::peers
