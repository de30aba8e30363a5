// Scene documents for tests, and what the engine makes of them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "engine/engine.h"

namespace raytracer::test {

using nlohmann::json;

inline json vector_json(const Vec3& v) { return {v.x, v.y, v.z}; }

/// A camera at the origin that looks along +z: x of the scene is x of the image.
inline json camera_json(int width = 1, int height = 1, double fov = 1,
                        const Vec3& origin = {0, 0, 0}, const Vec3& look_at = {0, 0, 1}) {
  return {{"origin", vector_json(origin)},
          {"look_at", vector_json(look_at)},
          {"fov", fov},
          {"width", width},
          {"height", height}};
}

inline json document(const json& camera = camera_json(), const std::vector<json>& objects = {},
                     const std::vector<json>& lights = {}) {
  return {{"camera", camera}, {"objects", objects}, {"lights", lights}};
}

inline json sphere_json(const Vec3& center, double radius, const json& material = json::object()) {
  return {{"type", "sphere"},
          {"center", vector_json(center)},
          {"radius", radius},
          {"material", material}};
}

inline json plane_json(const Vec3& point, const Vec3& normal,
                       const json& material = json::object()) {
  return {{"type", "plane"},
          {"point", vector_json(point)},
          {"normal", vector_json(normal)},
          {"material", material}};
}

inline json mesh_json(const std::vector<Vec3>& vertices,
                      const std::vector<std::array<int, 3>>& triangles,
                      const json& material = json::object()) {
  json points = json::array();
  for (const Vec3& vertex : vertices) points.push_back(vector_json(vertex));
  return {{"type", "mesh"}, {"vertices", points}, {"triangles", triangles}, {"material", material}};
}

inline json square_json(const Vec3& center, double radius, std::int64_t n, const char* axes = "xz",
                        const json& material = json::object()) {
  return {{"type", "sphere_square"},
          {"center", vector_json(center)},
          {"radius", radius},
          {"n", n},
          {"axes", axes},
          {"material", material}};
}

inline json cylinder_json(const Vec3& from, const Vec3& to, double radius, bool caps = true,
                          const json& material = json::object()) {
  return {{"type", "cylinder"},    {"from", vector_json(from)},
          {"to", vector_json(to)}, {"radius", radius},
          {"caps", caps},          {"material", material}};
}

inline json distant_json(const Vec3& direction, double intensity = 1,
                         const Vec3& color = {1, 1, 1}) {
  return {{"type", "distant"},
          {"direction", vector_json(direction)},
          {"color", vector_json(color)},
          {"intensity", intensity}};
}

inline json point_json(const Vec3& position, double intensity, const Vec3& color = {1, 1, 1}) {
  return {{"type", "point"},
          {"position", vector_json(position)},
          {"color", vector_json(color)},
          {"intensity", intensity}};
}

/// A material whose lit colour is `color` wherever a light of N.L > 0 reaches, under "black"
/// shadows and "ambient": 1.
inline json constant_material(const Vec3& color) {
  return {{"color", vector_json(color)}, {"ka", 1}, {"kd", 0}, {"ks", 0}};
}

inline json diffuse_material(const Vec3& color = {1, 1, 1}) {
  return {{"color", vector_json(color)}, {"ka", 0}, {"kd", 1}, {"ks", 0}};
}

/// The errors, one a line, for a failing test's message.
inline std::string describe(const std::vector<Error>& errors) {
  std::string text;
  for (const Error& error : errors) text += '"' + error.pointer + "\": " + error.detail + '\n';
  return text;
}

inline std::vector<Error> errors_of_text(std::string_view text, const Limits& limits = {},
                                         const Overrides& overrides = {}) {
  const Result<Scene> result = read_scene(text, limits, overrides);
  return result.ok() ? std::vector<Error>{} : result.errors();
}

inline std::vector<Error> errors_of(const json& document, const Limits& limits = {},
                                    const Overrides& overrides = {}) {
  return errors_of_text(document.dump(), limits, overrides);
}

/// The scene; throws if the document has errors.
inline Scene scene_of_text(std::string_view text, const Overrides& overrides = {}) {
  Result<Scene> result = read_scene(text, {}, overrides);
  if (!result.ok()) throw std::invalid_argument(describe(result.errors()));
  return std::move(result).value();
}

inline Scene scene_of(const json& document, const Overrides& overrides = {}) {
  return scene_of_text(document.dump(), overrides);
}

inline Image image_of(const Scene& scene, std::size_t threads = 2) {
  WorkerPool pool(threads);
  RenderProgress progress;
  return render(scene, Limits{}, pool, progress).image;
}

inline Image image_of(const json& document, std::size_t threads = 2) {
  return image_of(scene_of(document), threads);
}

/// The colour of the pixel (x, y), y = 0 on top.
inline Vec3 color_at(const Image& image, int x, int y) {
  const float* pixel = image.pixel(x, y);
  return {pixel[0], pixel[1], pixel[2]};
}

/// The only pixel of a document whose camera has one.
inline Vec3 only_color(const json& document) { return color_at(image_of(document), 0, 0); }

/// The largest difference of a channel of two colours.
inline double distance(const Vec3& a, const Vec3& b) { return max_abs(a - b); }

/// The largest difference of a channel anywhere; infinite for images of other sizes.
inline double distance(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height) return std::numeric_limits<double>::infinity();
  double largest = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i)
    largest = std::max(
        largest, std::abs(static_cast<double>(a.values[i]) - static_cast<double>(b.values[i])));
  return largest;
}

/// How many pixels have a channel that differs by more than `tolerance`.
inline int count_different(const Image& a, const Image& b, double tolerance = 0) {
  int count = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      if (!(distance(color_at(a, x, y), color_at(b, x, y)) <= tolerance)) ++count;
  return count;
}

/// How many pixels are not black.
inline int count_lit(const Image& image) {
  Image black(image.width, image.height);
  std::fill(black.values.begin(), black.values.end(), 0.0F);
  return count_different(image, black);
}

}  // namespace raytracer::test
