#include "tests/measure/scenes/haines_document.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numbers>

#include "tests/measure/scenes/document_text.h"

namespace raytracer::measure {
namespace {

// Phong's exponent, by which his files tell a highlight, to Blinn's: about as wide.
constexpr double blinn_per_phong = 4;

std::string vector_text(const Vec3& v) { return fmt::format("[{}, {}, {}]", v.x, v.y, v.z); }

}  // namespace

std::string haines_document(const HainesView& view, const std::vector<Vec3>& lights,
                            const std::vector<HainesFill>& fills,
                            const std::vector<std::string>& objects) {
  std::vector<std::string> light_texts;
  for (const Vec3& light : lights)
    light_texts.push_back(fmt::format(
        R"(    {{"type": "point", "position": {}, "intensity": {:.6g}, "falloff": "none"}})",
        vector_text(mirrored(light)), 1 / std::sqrt(static_cast<double>(lights.size()))));
  std::vector<std::string> materials;
  for (const HainesFill& fill : fills)
    materials.push_back(fmt::format(
        R"(    "{}": {{"color": {}, "kd": {}, "ks": {}, "shininess": {:.6g}, "reflectivity": {}, "transparency": {}, "ior": {}}})",
        fill.name, vector_text(fill.color), fill.kd, fill.ks, blinn_per_phong * fill.shine, fill.ks,
        fill.transmitted, fill.index));
  return fmt::format(R"({{
  "camera": {{"origin": {}, "look_at": {}, "up": [0, 0, 1], "fov": {:.17g}, "width": 512, "height": 512}},
  "background": [0.078, 0.361, 0.753],
  "ambient": 0,
  "lights": [
{}
  ],
  "materials": {{
{}
  }},
  "objects": [
{}
  ]
}}
)",
                     vector_text(mirrored(view.from)), vector_text(mirrored(view.at)),
                     std::numbers::pi / 4, fmt::join(light_texts, ",\n"),
                     fmt::join(materials, ",\n"), fmt::join(objects, ",\n"));
}

std::string haines_floor(double half_width, double z, const std::string& material) {
  MeshText floor;
  const double h = half_width;
  for (const Vec3& corner : {Vec3{h, h, z}, {-h, h, z}, {-h, -h, z}, {h, -h, z}})
    floor.add_vertex(mirrored(corner));
  floor.add_quadrangle(0, 1, 2, 3);
  return floor.object(material);
}

}  // namespace raytracer::measure
