// What a scene says: plain values, complete and valid once read_scene has made them.
//
// Lengths are in the scene's own unit, angles in radians, colours linear in [0, 1]. Nothing here
// knows how a picture is made, and nothing changes a Scene after it was read. Copies share the
// large arrays: another view of a scene costs its camera only.
#pragma once

#include <cstdint>
#include <optional>
#include <tuple>

#include "engine/fields/field_table.h"
#include "engine/lights/lights.h"
#include "engine/materials/materials.h"
#include "engine/math/transfer.h"
#include "engine/memory/shared_array.h"
#include "engine/objects/objects.h"
#include "engine/scene/camera.h"

namespace raytracer {

struct Object {
  Shape shape;
  MaterialIndex material = 0;
};

/// How many primitives of its kind an object is: the spheres of a set, the triangles of a mesh,
/// else 1.
inline std::size_t primitive_count(const Object& object) {
  return std::visit([](const auto& shape) { return item_count(shape); }, object.shape);
}

enum class Precision : std::uint8_t {
  automatic,
  single_precision,
  double_precision,
  mixed  ///< only chosen: single, and double for what magnifies its errors
};

struct RenderSettings {
  std::optional<int> samples;         ///< per pixel; never together with the two contracts
  std::optional<double> target_rmse;  ///< the error not to exceed
  std::optional<double> budget_ms;    ///< the time for tracing
  Precision precision = Precision::automatic;
  int max_depth = 5;  ///< how many times a ray may be reflected or refracted
  Transfer transfer = Transfer::linear;

  static constexpr auto fields = std::tuple(
      optional("samples", &RenderSettings::samples, CountRule{1},
               "Per pixel, 1 by default; not together with target_rmse or budget_ms."),
      optional("target_rmse", &RenderSettings::target_rmse, NumberRule{positive},
               "The error not to exceed: root mean square over pixels and channels."),
      optional("budget_ms", &RenderSettings::budget_ms, NumberRule{positive},
               "The time that tracing may take, in milliseconds."),
      optional("precision", &RenderSettings::precision, ChoiceRule{"auto", "single", "double"}),
      optional("max_depth", &RenderSettings::max_depth, CountRule{0},
               "How many times a ray may be reflected or refracted."),
      optional("transfer", &RenderSettings::transfer, ChoiceRule{"linear", "srgb"}));
};

struct Scene {
  Camera camera;
  std::optional<Rgb> background = Rgb{};  ///< none: transparent, and black to whatever looks at it
  double ambient = 0.2;
  Shadows shadows = Shadows::black;
  SharedArray<Light> lights;
  SharedArray<Material> materials;  ///< those that objects use, without repetition
  SharedArray<Object> objects;      ///< in the document's order, which decides ties
  RenderSettings render;

  /// Those that are no structures of their own.
  static constexpr auto fields = std::tuple(
      optional("background", &Scene::background, BackgroundRule{},
               "What a ray sees that meets no object. \"transparent\": black, and the image has a "
               "fourth channel, the share of a pixel's samples that meet an object."),
      optional("ambient", &Scene::ambient, NumberRule{not_negative},
               "Constant light, everywhere and from everywhere."),
      optional("shadows", &Scene::shadows, ChoiceRule{"black", "ambient", "off"},
               "What a surface that a light does not reach shows of that light's ambient part: "
               "nothing, all of it, or as if nothing were in the way."));
};

/// Of the scene's image: the fourth is its cover (engine/image/image.h).
inline int channel_count(const Scene& scene) { return scene.background ? 3 : 4; }

}  // namespace raytracer
