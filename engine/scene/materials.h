// The materials of a scene while it is read: names resolved, equal ones kept once.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "engine/scene/fields.h"
#include "engine/scene/scene.h"

namespace raytracer {

/// Collects those materials that objects use.
class MaterialReader {
 public:
  MaterialReader() = default;
  /// Reads "materials": an object of named materials, each checked whether used or not.
  explicit MaterialReader(const Field& field);

  /// Reads an object's "material": a name, or a material in place.
  std::optional<MaterialIndex> read_use(const Field& field);

  /// The index of the material that an object without one has.
  MaterialIndex use_default() { return use(Material{}); }

  std::vector<Material> take() && { return std::move(used_); }

 private:
  struct Named {
    Material material;
    std::optional<MaterialIndex> index;  ///< once used
  };

  MaterialIndex use(const Material& material);
  /// Behind "there is no material NAME": what was meant, or what there is.
  std::string others(std::string_view name) const;

  std::unordered_map<std::string_view, Named> named_;
  std::vector<std::string_view> names_;
  std::map<Material, MaterialIndex> indices_;
  std::vector<Material> used_;
};

}  // namespace raytracer
