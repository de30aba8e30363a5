#include "engine/scene/read_objects.h"

#include "engine/scene/read_typed.h"

namespace raytracer {

std::vector<Object> read_objects(const Field& field, MaterialReader& materials) {
  static constexpr std::array<std::string_view, 1> also{"material"};
  std::vector<Object> objects;
  if (!expect_array(field)) return objects;
  constexpr std::size_t fewest_nodes = 7;  // of an object: it, a type and two arrays or numbers
  objects.reserve(field.value.node_count() / fewest_nodes);
  read_elements(field, [&](const Field& element) {
    std::optional<Shape> shape = read_typed<Shape>(element, ObjectDocuments{}, also);
    if (element.value.kind() != JsonKind::object) return;
    MaterialIndex material = 0;
    if (const auto use = element.value.member("material")) {
      const Path path = element.path.child("material");
      material = materials.read_use({*use, path, element.errors}).value_or(0);
    } else {
      material = materials.use_default();
    }
    if (shape) objects.push_back({std::move(*shape), material});
  });
  return objects;
}

}  // namespace raytracer
