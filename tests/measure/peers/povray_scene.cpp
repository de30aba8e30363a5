#include "tests/measure/peers/povray_scene.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "tests/measure/peers/expanded_square.h"
#include "tests/measure/peers/eye_view.h"

namespace raytracer::bench {
namespace {

std::string vector_text(const Vec3& v) {
  return fmt::format("<{:.17g},{:.17g},{:.17g}>", v.x, v.y, v.z);
}

/// The length that POV-Ray's tolerances have to be small against.
double smallest_feature(const Scene& scene) {
  struct Visitor {
    double operator()(const Sphere& sphere) const { return sphere.radius; }
    double operator()(const Spheres& spheres) const {
      return *std::min_element(spheres.radii.begin(), spheres.radii.end());
    }
    double operator()(const SphereSquare& square) const { return square.radius; }
    double operator()(const Cylinder& cylinder) const {
      return of(cylinder.from, cylinder.to, cylinder.radius);
    }
    double operator()(const Cylinders& cylinders) const {
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < cylinders.from.size(); ++i)
        least = std::min(least, of(cylinders.from[i], cylinders.to[i], cylinders.radius(i)));
      return least;
    }
    static double of(const Vec3& from, const Vec3& to, double radius) {
      return std::min(radius, length(to - from));
    }
    double operator()(const Plane&) const { return std::numeric_limits<double>::infinity(); }
    double operator()(const Mesh& mesh) const {
      double extent = 0;
      for (const Vec3& vertex : mesh.vertices) extent = std::max(extent, max_abs(vertex));
      return extent / 100;
    }
  };
  double smallest = 1;
  for (const Object& object : scene.objects)
    smallest = std::min(smallest, std::visit(Visitor{}, object.shape));
  return smallest;
}

class Writer {
 public:
  Writer(const Scene& scene, std::ostream& out)
      : scene_(scene), out_(out), scale_(10 / smallest_feature(scene)) {}

  void write() {
    fmt::print(out_,
               "#version 3.7;\n"
               "global_settings {{ assumed_gamma 1 max_trace_level {} adc_bailout 0 }}\n"
               "background {{ color rgb {} }}\n",
               scene_.render.max_depth + 1, vector_text(scene_.background));
    write_camera();
    for (const Light& light : scene_.lights) write_light(light);
    for (const Object& object : scene_.objects) {
      write_default_texture(scene_.materials[object.material]);
      std::visit([this](const auto& shape) { write(shape); }, object.shape);
    }
  }

 private:
  std::string point_text(const Vec3& point) const { return vector_text(point * scale_); }

  void write_camera() {
    const EyeView view = make_eye_view(scene_.camera);
    fmt::print(out_, "camera {{ perspective location {} right {} up {} direction {} }}\n",
               point_text(scene_.camera.origin), vector_text(view.right * 2),
               vector_text(view.up * 2), vector_text(view.forward));
  }

  void write_light(const Light& light) {
    const auto* distant = std::get_if<DistantLight>(&light.source);
    if (!distant) throw std::runtime_error("the POV-Ray peer draws distant lights only");
    constexpr double outside = 1e6;  // of the scene; POV-Ray's rays end at 1e7
    fmt::print(out_, "light_source {{ {} color rgb {} parallel point_at <0,0,0> }}\n",
               vector_text(unit(distant->direction) * -outside),
               vector_text(light.color * light.intensity));
  }

  /// An object without a texture takes the default, without a copy of its own. What a default
  /// leaves out stays as the default before it had it.
  void write_default_texture(const Material& material) {
    if (!(material.shininess > 0))
      throw std::runtime_error("the POV-Ray peer draws no highlights of shininess 0");
    const Rgb& color = material.color;
    const bool is_grey = color.x == color.y && color.y == color.z;
    fmt::print(out_,
               "#default {{ texture {{ pigment {{ color rgb {} }} finish {{ ambient 0 diffuse {} "
               "specular {} roughness {:.17g} metallic {} reflection {} }} }} }}\n",
               vector_text(color), material.kd, is_grey ? material.ks * color.x : material.ks,
               1 / material.shininess, is_grey ? 0 : 1, material.reflectivity);
  }

  void write(const Sphere& sphere) { write_sphere(sphere.center, sphere.radius); }
  void write(const Spheres& spheres) {
    refuse_colors(spheres.colors);
    for (std::size_t i = 0; i < spheres.centers.size(); ++i)
      write_sphere(spheres.centers[i], spheres.radius(i));
  }
  void write(const SphereSquare& square) { write(expanded(square)); }
  void write(const Cylinder& c) { write_cylinder(c.from, c.to, c.radius, c.caps); }
  void write(const Cylinders& cylinders) {
    refuse_colors(cylinders.colors);
    for (std::size_t i = 0; i < cylinders.from.size(); ++i)
      write_cylinder(cylinders.from[i], cylinders.to[i], cylinders.radius(i), cylinders.caps);
  }

  void write(const Plane& plane) {
    const Vec3 normal = unit(plane.normal);
    fmt::print(out_, "plane {{ {}, {:.17g} }}\n", vector_text(normal),
               dot(normal, plane.point) * scale_);
  }

  void write(const Mesh& mesh) {
    fmt::print(out_, "mesh2 {{ vertex_vectors {{ {}", mesh.vertices.size());
    for (const Vec3& vertex : mesh.vertices) out_ << ',' << point_text(vertex);
    fmt::print(out_, " }} face_indices {{ {}", mesh.triangles.size());
    for (const auto& triangle : mesh.triangles)
      fmt::print(out_, ",<{},{},{}>", triangle[0], triangle[1], triangle[2]);
    out_ << " } }\n";
  }

  void write_sphere(const Vec3& center, double radius) {
    fmt::print(out_, "sphere {{ {}, {:.17g} }}\n", point_text(center), radius * scale_);
  }

  void write_cylinder(const Vec3& from, const Vec3& to, double radius, bool caps) {
    fmt::print(out_, "cylinder {{ {}, {}, {:.17g}{} }}\n", point_text(from), point_text(to),
               radius * scale_, caps ? "" : " open");
  }

  static void refuse_colors(const std::vector<Rgb>& colors) {
    if (!colors.empty()) throw std::runtime_error("the POV-Ray peer draws sets of one colour only");
  }

  const Scene& scene_;
  std::ostream& out_;
  double scale_;
};

}  // namespace

void write_povray_scene(const Scene& scene, std::ostream& out) {
  if (scene.shadows == Shadows::off || scene.render.transfer != Transfer::linear)
    throw std::runtime_error("the POV-Ray peer draws shadows and the linear transfer only");
  Writer(scene, out).write();
}

}  // namespace raytracer::bench
