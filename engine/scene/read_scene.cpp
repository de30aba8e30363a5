#include "engine/scene/read_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "engine/scene/document.h"
#include "engine/scene/fields.h"
#include "engine/scene/materials.h"
#include "engine/scene/read_objects.h"
#include "engine/scene/read_typed.h"

namespace raytracer {
namespace {

/// Whether the angle modulo 2 pi is strictly between 0 and pi. The double nearest to pi (or to a
/// multiple of it) stands for that multiple, although it is a hair off.
bool is_field_of_view(double angle) {
  if (angle > 0 && angle < 1) return true;  // however small
  const double sine = std::sin(angle / 2);
  const double cosine = std::cos(angle / 2);
  const double spacing =
      std::nextafter(std::abs(angle), std::numeric_limits<double>::infinity()) - std::abs(angle);
  return sine * cosine > 0 && 2 * std::abs(sine) > spacing && 2 * std::abs(cosine) > spacing;
}

constexpr std::string_view fov_rule =
    "the field of view, taken modulo 2 pi, must lie strictly between 0 and pi";

std::optional<double> read_fov(const Field& field) {
  const std::optional<double> fov = read_number(field);
  if (!fov || is_field_of_view(*fov)) return fov;
  field.refuse(fmt::format("{} is out of range: {}", *fov, fov_rule));
  return {};
}

/// A count of pixels or samples: whatever fits an int; the limits are judged later.
std::optional<std::int64_t> read_count(const Field& field) {
  const auto count = read_integer(field, 1, 1LL << 53);
  if (!count) return {};
  return std::min<std::int64_t>(*count, std::numeric_limits<int>::max());
}

std::optional<int> read_max_depth(const Field& field) {
  // Any integer is valid; deeper than an int counts, no ray is ever followed.
  constexpr auto most = std::numeric_limits<int>::max();
  const std::optional<double> depth = read_number(field, not_negative);
  if (!depth) return {};
  if (*depth == std::floor(*depth)) return static_cast<int>(std::min<double>(*depth, most));
  field.refuse(fmt::format("{} must be an integer", *depth));
  return {};
}

constexpr std::string_view look_at_rule = "must differ from origin: the camera has no direction";

Camera read_camera(const Field& field) {
  const ObjectReader object(field, {"origin", "look_at", "up", "fov", "width", "height"});
  Camera camera;
  std::optional<Vec3> origin;
  object.required("origin", origin, read_point);
  object.required("look_at", camera.look_at, [&](const Field& f) -> std::optional<Vec3> {
    const std::optional<Vec3> look_at = read_point(f);
    if (!look_at || look_at != origin) return look_at;
    f.refuse(std::string(look_at_rule));
    return {};
  });
  camera.origin = origin.value_or(Vec3{});
  object.optional("up", camera.up, read_direction);
  object.required("fov", camera.fov, read_fov);
  object.required("width", camera.width, read_count);
  object.required("height", camera.height, read_count);
  return camera;
}

using LightSource = decltype(Light::source);

/// The keys that every light has.
void read_emission(const ObjectReader& object, Light& light) {
  object.optional("color", light.color, read_color);
  object.optional("intensity", light.intensity,
                  [](const Field& f) { return read_number(f, not_negative); });
}

Light read_distant_light(const Field& field) {
  const ObjectReader object(field, {"type", "direction", "color", "intensity"});
  Light light;
  DistantLight source;
  object.required("direction", source.direction, read_direction);
  read_emission(object, light);
  light.source = source;
  return light;
}

Light read_point_light(const Field& field) {
  const ObjectReader object(field, {"type", "position", "color", "intensity"});
  Light light;
  PointLight source;
  object.required("position", source.position, read_point);
  read_emission(object, light);
  light.source = source;
  return light;
}

std::vector<Light> read_lights(const Field& field) {
  static constexpr TypedReaders<Light, 2> readers{
      {{"distant", read_distant_light}, {"point", read_point_light}}};
  std::vector<Light> lights;
  if (!expect_array(field)) return lights;
  read_elements(field, [&](const Field& element) {
    if (auto light = read_typed(element, readers)) lights.push_back(*light);
  });
  return lights;
}

RenderSettings read_render(const Field& field) {
  static constexpr std::array<std::string_view, 3> precision_words{"auto", "single", "double"};
  static constexpr std::array<std::string_view, 2> transfer_words{"linear", "srgb"};
  const ObjectReader object(
      field, {"samples", "target_rmse", "budget_ms", "precision", "max_depth", "transfer"});
  const auto read_bound = [](const Field& f) { return read_number(f, positive); };
  RenderSettings render;
  object.optional("samples", render.samples, read_count);
  object.optional("target_rmse", render.target_rmse, read_bound);
  object.optional("budget_ms", render.budget_ms, read_bound);
  object.optional("precision", render.precision,
                  [](const Field& f) { return read_choice(f, precision_words); });
  object.optional("max_depth", render.max_depth, read_max_depth);
  object.optional("transfer", render.transfer,
                  [](const Field& f) { return read_choice(f, transfer_words); });
  const auto has = [&](std::string_view key) {
    return field.value.kind() == JsonKind::object && field.value.member(key);
  };
  for (const std::string_view contract : {"target_rmse", "budget_ms"}) {
    if (!has("samples") || !has(contract)) continue;
    field.errors.add(ErrorKind::invalid, field.path.child(contract),
                     fmt::format("\"{}\" does not go with \"samples\": leave one out", contract));
  }
  return render;
}

/// The whole document but for what depends on several of its parts.
Scene read_document(const Field& root) {
  static constexpr std::array<std::string_view, 3> shadows_words{"black", "ambient", "off"};
  const ObjectReader object(
      root, {"camera", "background", "ambient", "shadows", "lights", "materials", "objects",
             "render", "name", "description", "$schema"});
  Scene scene;
  MaterialReader materials;
  const auto read_part = [](auto read) {
    return [read](const Field& f) { return std::optional(read(f)); };
  };
  object.required("camera", scene.camera, read_part(read_camera));
  object.optional("background", scene.background, read_color);
  object.optional("ambient", scene.ambient,
                  [](const Field& f) { return read_number(f, not_negative); });
  object.optional("shadows", scene.shadows,
                  [](const Field& f) { return read_choice(f, shadows_words); });
  object.optional("lights", scene.lights, read_part(read_lights));
  bool has_materials = false;
  object.optional("materials", has_materials, read_part([&](const Field& f) {
                    materials.read_named(f);
                    return true;
                  }));
  object.optional("objects", scene.objects,
                  read_part([&](const Field& f) { return read_objects(f, materials); }));
  object.optional("render", scene.render, read_part(read_render));
  for (const std::string_view key : {"name", "description", "$schema"}) {
    std::string_view text;  // for people
    object.optional(key, text, read_string);
  }
  scene.materials = std::move(materials).take();
  return scene;
}

template <typename T>
void override_with(T& value, const std::optional<T>& over) {
  if (over) value = *over;
}

template <typename T>
void override_with(std::optional<T>& value, const std::optional<T>& over) {
  if (over) value = over;
}

Scene with_overrides(Scene scene, const Overrides& over) {
  override_with(scene.camera.width, over.width);
  override_with(scene.camera.height, over.height);
  override_with(scene.camera.origin, over.origin);
  override_with(scene.camera.look_at, over.look_at);
  override_with(scene.camera.up, over.up);
  override_with(scene.camera.fov, over.fov);
  RenderSettings& render = scene.render;
  override_with(render.precision, over.precision);
  override_with(render.transfer, over.transfer);
  override_with(render.max_depth, over.max_depth);
  // A query that names its own bound replaces the document's kind of bound altogether.
  if (over.samples) {
    render.samples = over.samples;
    render.target_rmse.reset();
    render.budget_ms.reset();
  } else if (over.target_rmse || over.budget_ms) {
    render.samples.reset();
    override_with(render.target_rmse, over.target_rmse);
    override_with(render.budget_ms, over.budget_ms);
  }
  return scene;
}

/// The document's rules again for the values that the query may have replaced.
void check_overridden(const Scene& scene, ErrorList& errors) {
  const Path root;
  const Path camera_path = root.child("camera");
  const Path render_path = root.child("render");
  const auto demand = [&](bool holds, const Path& parent, std::string_view key,
                          std::string_view rule) {
    if (!holds) errors.add(ErrorKind::invalid, parent.child(key), std::string(rule));
  };
  const Camera& camera = scene.camera;
  demand(camera.width >= 1, camera_path, "width", "must be at least 1");
  demand(camera.height >= 1, camera_path, "height", "must be at least 1");
  const auto is_finite = [](const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  };
  constexpr std::string_view finite_rule = "must be three finite numbers";
  demand(is_finite(camera.origin), camera_path, "origin", finite_rule);
  demand(is_finite(camera.look_at), camera_path, "look_at", finite_rule);
  demand(is_finite(camera.up), camera_path, "up", finite_rule);
  demand(camera.origin != camera.look_at, camera_path, "look_at", look_at_rule);
  demand(camera.up != Vec3{}, camera_path, "up", "the zero vector has no direction");
  demand(is_field_of_view(camera.fov), camera_path, "fov", fov_rule);
  const RenderSettings& render = scene.render;
  demand(render.samples.value_or(1) >= 1, render_path, "samples", "must be at least 1");
  demand(render.target_rmse.value_or(1) > 0, render_path, "target_rmse", "must be above 0");
  demand(render.budget_ms.value_or(1) > 0, render_path, "budget_ms", "must be above 0");
  demand(render.max_depth >= 0, render_path, "max_depth", "must be at least 0");
}

bool reflects(const Scene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const Material& material) { return material.reflectivity > 0; });
}

void check_limits(const Scene& scene, const Limits& limits, ErrorList& errors) {
  const Path root;
  const Path camera = root.child("camera");
  const Path render = root.child("render");
  const auto at_most = [&](double count, std::int64_t Limits::*limit, const Path& path) {
    const LimitRow& row = row_of(limit);
    if (count <= static_cast<double>(limits.*limit)) return;
    errors.add(ErrorKind::limit, path,
               fmt::format("asks for {} {}, but this service accepts {} ({})", count, row.meaning,
                           limits.*limit, row.flag));
  };
  at_most(static_cast<double>(scene.camera.width) * scene.camera.height, &Limits::pixels, camera);
  at_most(scene.render.samples.value_or(1), &Limits::samples, render.child("samples"));
  at_most(static_cast<double>(count_objects(scene.objects)), &Limits::objects,
          root.child("objects"));
  at_most(count_rays(scene, scene.render.samples.value_or(1)), &Limits::work, render);
}

}  // namespace

SphereSquare make_sphere_square(const Vec3& center, double radius, std::int64_t n, Axes axes) {
  return {center, radius, n, axes};
}

double count_rays(const Scene& scene, int samples) {
  const double bounces = reflects(scene) ? 1.0 + scene.render.max_depth : 1.0;
  return static_cast<double>(scene.camera.width) * scene.camera.height * samples * bounces;
}

Result<Scene> read_scene(std::string_view text, const Limits& limits, const Overrides& overrides) {
  Result<Document> parsed = parse_document(text);
  if (!parsed.ok()) return parsed.errors();
  Document document = std::move(parsed).value();

  ErrorList errors = std::move(document.errors);
  const Path root;
  Scene scene = read_document({JsonValue(document), root, errors});
  const bool document_is_valid = errors.empty();

  scene = with_overrides(std::move(scene), overrides);
  if (document_is_valid) check_overridden(scene, errors);
  check_limits(scene, limits, errors);
  if (!errors.empty()) return std::move(errors).take();
  return scene;
}

}  // namespace raytracer
