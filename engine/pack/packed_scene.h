// The scene as plans and kernels see it: arrays of plain values in frame coordinates.
#pragma once

#include <vector>

#include "engine/lights/light_places.h"
#include "engine/lights/lights.h"
#include "engine/materials/materials.h"
#include "engine/math/frame.h"
#include "engine/math/view.h"
#include "engine/objects/corner_values.h"
#include "engine/objects/numbering.h"
#include "engine/objects/objects.h"
#include "engine/parallel/worker_pool.h"

namespace raytracer {

struct Scene;

/// The materials of primitives: one for all of an object, or one for each of its items.
class PrimitiveMaterials {
 public:
  void add_object(MaterialIndex material) { objects_.push_back({material, one_for_all}); }
  /// One for each of the next object's items.
  void add_object(const std::vector<MaterialIndex>& materials) {
    objects_.push_back({0, items_.size()});
    items_.insert(items_.end(), materials.begin(), materials.end());
  }

  MaterialIndex operator()(const PrimitiveId& id) const {
    const OfObject& object = objects_[id.object];
    return object.first_item == one_for_all ? object.material : items_[object.first_item + id.item];
  }

 private:
  static constexpr std::size_t one_for_all = ~std::size_t{0};
  struct OfObject {
    MaterialIndex material;
    std::size_t first_item;  ///< in `items_`
  };
  std::vector<OfObject> objects_;
  std::vector<MaterialIndex> items_;
};

/// Everything that a ray may need, and nothing of how the document said it.
struct PackedScene {
  Frame frame;
  View view;
  Primitives primitives;  ///< without what the frame does not carry, and triangles of no area
  double lost = 0;        ///< those that the frame does not carry
  Numbering numbers;
  PrimitiveMaterials material_index;
  std::vector<CornerValues> corner_values;  ///< by object; none if no object has any
  std::vector<Material> materials;
  std::vector<PackedLight> lights;     ///< that can change a colour, and are points
  std::vector<SoftLight> soft_lights;  ///< that can, and are larger
  int light_sets = 1;                  ///< of places on these
  int sets_to_be_sure = 1;             ///< as LightSampling has it
  Rgb background;
  double ambient = 0;
  Shadows shadows = Shadows::black;
  int max_depth = 0;
  bool transmits = false;  ///< some material lets rays through

  /// What the corners of an object's items tell, if they do.
  const CornerValues* corner_values_of(const PrimitiveId& id) const {
    if (corner_values.empty() || corner_values[id.object].empty()) return nullptr;
    return &corner_values[id.object];
  }
  const Material& material_of(const PrimitiveId& id) const { return materials[material_index(id)]; }
};

/// The frame that suits a scene: the eye at the origin, the farthest thing about 1 away.
Frame make_frame(const Scene& scene);

/// `pool`: whose threads help where there is much to do, if there is one; the result is the same.
/// Soft lights get 64 places.
PackedScene pack_scene(const Scene& scene, WorkerPool* pool);

}  // namespace raytracer
