#include "tests/measure/scenes/untuned_scenes.h"

#include <fmt/format.h>

#include <cstdint>
#include <iterator>

#include "tests/measure/scenes/dice.h"

namespace raytracer::measure {
namespace {

std::string text_of(const Vec3& point) {
  return fmt::format("[{:.6g},{:.6g},{:.6g}]", point.x, point.y, point.z);
}

/// A sun and a point light; the camera looks at the origin from 20 away.
std::string document(const std::string& materials, const std::string& objects) {
  return fmt::format(R"({{
  "camera": {{"origin": [0, 6, -20], "look_at": [0, 0, 0], "fov": 0.8, "width": 700, "height": 500}},
  "background": [0.3, 0.5, 0.7],
  "ambient": 0.1,
  "shadows": "ambient",
  "lights": [
    {{"type": "distant", "direction": [-0.5, -1, 0.8], "intensity": 0.8}},
    {{"type": "point", "position": [9, 12, -7], "color": [1, 0.9, 0.7], "intensity": 0.5}}
  ],
  "materials": {{{}}},
  "objects": [{}]
}})",
                     materials, objects);
}

constexpr const char* matt = R"("matt": {"color": [0.8, 0.7, 0.5]})";
constexpr const char* matt_plane =
    R"({"type": "plane", "point": [0, -4, 0], "normal": [0, 1, 0], "material": "matt"})";

/// `count` spheres in a cube, radii from `least` to `most`.
std::string soup(std::uint64_t seed, int count, double least, double most, const char* material) {
  Dice dice(seed);
  std::string centers;
  std::string radii;
  for (int i = 0; i < count; ++i) {
    const char* separator = i == 0 ? "" : ",";
    centers += separator + text_of(dice.point(6));
    fmt::format_to(std::back_inserter(radii), "{}{:.6g}", separator, dice.within(least, most));
  }
  return fmt::format(R"({{"type": "spheres", "centers": [{}], "radius": [{}], "material": "{}"}})",
                     centers, radii, material);
}

/// `count` triangles in a cube, every corner within `reach` of its middle.
std::string triangle_soup(std::uint64_t seed, int count, double reach) {
  Dice dice(seed);
  std::string vertices;
  std::string triangles;
  for (int i = 0; i < count; ++i) {
    const char* separator = i == 0 ? "" : ",";
    const Vec3 middle = dice.point(5);
    vertices += separator;
    for (int corner = 0; corner < 3; ++corner)
      vertices += (corner == 0 ? "" : ",") + text_of(middle + dice.point(reach));
    fmt::format_to(std::back_inserter(triangles), "{}[{},{},{}]", separator, 3 * i, 3 * i + 1,
                   3 * i + 2);
  }
  return fmt::format(
      R"({{"type": "mesh", "vertices": [{}], "triangles": [{}], "material": "matt"}})", vertices,
      triangles);
}

std::string sphere_soup() {
  return document(matt, soup(11, 400, 0.1, 0.9, "matt") + "," + matt_plane);
}

std::string glint_soup() {
  return document(
      std::string(matt) +
          R"(, "glossy": {"color": [0.3, 0.3, 0.4], "kd": 0.3, "ks": 1, "shininess": 3000})",
      soup(12, 250, 0.05, 0.7, "glossy") + "," + matt_plane);
}

std::string mirror_soup() {
  return document(std::string(matt) +
                      R"(, "mirror": {"color": [0.9, 0.9, 0.9], "kd": 0.1, "reflectivity": 0.8})",
                  soup(13, 60, 0.4, 1.5, "mirror") + "," + matt_plane);
}

/// Each a tenth to a half of a pixel wide at 175 x 125.
std::string dust() { return document(matt, soup(14, 3000, 0.004, 0.02, "matt")); }

/// Seen along its surface to the horizon; its spheres are smaller than a pixel.
std::string far_square() {
  return document(
      matt,
      R"({"type": "sphere_square", "center": [0, -4, 90], "radius": 0.02, "n": 5000, "axes": "xz", "material": "matt"})");
}

std::string few_triangles() { return document(matt, triangle_soup(15, 120, 2) + "," + matt_plane); }

/// Slivers and triangles of about a pixel.
std::string many_triangles() { return document(matt, triangle_soup(16, 2000, 0.25)); }

}  // namespace

std::vector<NamedScene> untuned_scenes() {
  return {{"sphere-soup", sphere_soup},      {"glint-soup", glint_soup},
          {"mirror-soup", mirror_soup},      {"dust", dust},
          {"far-square", far_square},        {"few-triangles", few_triangles},
          {"many-triangles", many_triangles}};
}

}  // namespace raytracer::measure
