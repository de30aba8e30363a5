// Pieces of the documents that are made here.
#pragma once

#include <fmt/format.h>

#include <string>

#include "engine/math/vec.h"

namespace raytracer::measure {

/// A JSON array of points, numbers or anything that is text already, as it grows.
class ListText {
 public:
  void add(const Vec3& point) {
    append(fmt::format("[{:.6g},{:.6g},{:.6g}]", point.x, point.y, point.z));
  }
  void add(double number) { append(fmt::format("{:.6g}", number)); }
  void add(int a, int b, int c) { append(fmt::format("[{},{},{}]", a, b, c)); }
  void append(const std::string& element) {
    if (!elements_.empty()) elements_ += ',';
    elements_ += element;
  }

  std::string text() const { return '[' + elements_ + ']'; }

 private:
  std::string elements_;
};

/// One `spheres` object.
class SpheresText {
 public:
  void add(const Vec3& center, double radius) {
    centers_.add(center);
    radii_.add(radius);
  }

  std::string object(const std::string& material) const {
    return fmt::format(
        R"(    {{"type": "spheres", "centers": {}, "radius": {}, "material": "{}"}})",
        centers_.text(), radii_.text(), material);
  }

 private:
  ListText centers_;
  ListText radii_;
};

/// One `mesh` object.
class MeshText {
 public:
  /// Returns its index.
  int add_vertex(const Vec3& point) {
    vertices_.add(point);
    return vertex_count_++;
  }
  /// With a normal, as then all have.
  int add_vertex(const Vec3& point, const Vec3& normal) {
    normals_.add(normal);
    return add_vertex(point);
  }
  void add_triangle(int a, int b, int c) { triangles_.add(a, b, c); }
  void add_quadrangle(int a, int b, int c, int d) {
    add_triangle(a, b, c);
    add_triangle(a, c, d);
  }

  std::string object(const std::string& material) const {
    const std::string normals =
        normals_.text() == "[]" ? "" : fmt::format(R"("normals": {}, )", normals_.text());
    return fmt::format(
        R"(    {{"type": "mesh", "vertices": {}, "triangles": {}, {}"material": "{}"}})",
        vertices_.text(), triangles_.text(), normals, material);
  }

 private:
  ListText vertices_;
  ListText normals_;
  ListText triangles_;
  int vertex_count_ = 0;
};

}  // namespace raytracer::measure
