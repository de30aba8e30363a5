#include "engine/pack/packed_scene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <variant>

#include "engine/scene/features.h"
#include "engine/scene/scene.h"

namespace raytracer {
namespace {

/// A quarter of the extent around the eye, which may be more than a double holds.
double quarter_extent(const Scene& scene, const Vec3& eye) {
  double extent = 0;
  const auto include = [&](const Vec3& point, double reach) {
    extent = std::max(extent, max_abs(point * 0.25 - eye * 0.25) + reach * 0.25);
  };
  for (const Object& object : scene.objects)
    std::visit([&](const auto& shape) { for_each_extent(shape, include); }, object.shape);
  for (const Light& light : scene.lights)
    std::visit([&](const auto& source) { for_each_extent(source, include); }, light.source);
  return extent;
}

/// Materials that differ from an object's by their colour, each once.
class ColoredMaterials {
 public:
  ColoredMaterials(const Material& like, std::vector<Material>& materials)
      : like_(like), materials_(materials) {}

  MaterialIndex operator()(const Rgb& color) {
    const auto [place, is_new] =
        indices_.try_emplace(color, static_cast<MaterialIndex>(materials_.size()));
    if (is_new) {
      materials_.push_back(like_);
      materials_.back().color = color;
    }
    return place->second;
  }

 private:
  Material like_;
  std::vector<Material>& materials_;
  std::map<Rgb, MaterialIndex> indices_;
};

void add_materials(const Object& object, PackedScene& packed) {
  const std::vector<Rgb>* colors = nullptr;
  std::visit(
      [&]<typename Document>(const Document& shape) {
        if constexpr (HasItemColors<Document>) colors = &shape.colors;
      },
      object.shape);
  if (colors == nullptr || colors->empty())
    return packed.material_index.add_object(object.material);
  ColoredMaterials colored(packed.materials[object.material], packed.materials);
  std::vector<MaterialIndex> materials;
  materials.reserve(colors->size());
  for (const Rgb& color : *colors) materials.push_back(colored(color));
  packed.material_index.add_object(materials);
}

/// By object; none if no object has any.
std::vector<CornerValues> find_corner_values(const Scene& scene) {
  std::vector<CornerValues> values;
  std::size_t count = 0;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const auto add = [&]<typename Document>(const Document& shape) {
      if constexpr (HasCornerValues<Document>) {
        if (!has_corner_normals(shape) && corner_colors(shape).empty()) return;
        values.resize(scene.objects.size());
        values[i] = corner_values(shape);
        values[i].first = count;
        count += values[i].corners.size();
      }
    };
    std::visit(add, scene.objects[i].shape);
  }
  return values;
}

}  // namespace

Frame make_frame(const Scene& scene) {
  const Vec3 eye = scene.camera.origin;
  const double extent = quarter_extent(scene, eye);
  if (extent == 0) return {eye, 0};
  return {eye, std::ilogb(extent) + 2};
}

PackedScene pack_scene(const Scene& scene, WorkerPool* pool) {
  PackedScene packed;
  packed.frame = make_frame(scene);
  packed.view = make_view(scene.camera);
  packed.materials.assign(scene.materials.begin(), scene.materials.end());
  packed.numbers.reserve(scene.objects.size());
  std::array<std::size_t, ObjectKinds::count> object_counts{};
  for (const Object& object : scene.objects) ++object_counts[kind_of(object.shape)];
  for_each_kind([&]<class Kind>(std::type_identity<Kind>) {
    of_kind<Kind>(packed.primitives).reserve(object_counts[kind_index<Kind>]);
  });
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    packed.numbers.add_object(primitive_count(object));
    add_materials(object, packed);
    std::visit(
        [&]<typename Document>(const Document& shape) {
          for_each_kind([&]<class Kind>(std::type_identity<Kind>) {
            if constexpr (Kind::Documents::template has<Document>) {
              Packing<typename Kind::Primitive> to{packed.frame, pool,
                                                   static_cast<std::uint32_t>(i),
                                                   of_kind<Kind>(packed.primitives), packed.lost};
              pack(shape, to);
            }
          });
        },
        object.shape);
  }
  packed.corner_values = find_corner_values(scene);
  for (const Light& light : lights_in_use(scene)) {
    const PackedLight packed_light = pack_light(light, packed.frame);
    if (packed_light.is_soft())
      packed.soft_lights.push_back(place_samples(packed_light, LightSampling{}));
    else
      packed.lights.push_back(packed_light);
  }
  packed.background = scene.background.value_or(Rgb{});
  packed.ambient = scene.ambient;
  packed.shadows = scene.shadows;
  packed.max_depth = scene.render.max_depth;
  packed.transmits = std::any_of(packed.materials.begin(), packed.materials.end(),
                                 [](const Material& m) { return m.transparency > 0; });
  return packed;
}

}  // namespace raytracer
