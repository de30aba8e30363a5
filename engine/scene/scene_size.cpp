#include "engine/scene/scene_size.h"

#include <variant>

namespace raytracer {
namespace {

/// What a list has on the heap; 0 of other values.
template <typename Value>
std::size_t heap_bytes(const Value& value) {
  if constexpr (requires { value.begin(); })
    return value.size() * sizeof *value.begin();
  else
    return 0;
}

}  // namespace

std::int64_t count_objects(const Scene& scene) {
  std::int64_t count = 0;
  for (const Object& object : scene.objects)
    count += static_cast<std::int64_t>(primitive_count(object));
  return count;
}

std::size_t memory_bytes(const Scene& scene) {
  std::size_t bytes = sizeof scene + heap_bytes(scene.lights) + heap_bytes(scene.materials) +
                      heap_bytes(scene.objects);
  for (const Object& object : scene.objects)
    std::visit(
        [&]<typename Document>(const Document& shape) {
          for_each_field(Document::fields,
                         [&](const auto& row) { bytes += heap_bytes(shape.*row.member); });
        },
        object.shape);
  return bytes;
}

}  // namespace raytracer
