#include "engine/scene/scene_size.h"

#include <variant>
#include <vector>

namespace raytracer {
namespace {

template <typename Array>
std::size_t bytes_of_array(const Array& values) {
  return values.size() * sizeof *values.begin();
}

/// What a field has on the heap.
template <typename Value>
std::size_t bytes_of(const Value&) {
  return 0;
}
template <typename Value>
std::size_t bytes_of(const std::vector<Value>& values) {
  return bytes_of_array(values);
}

}  // namespace

std::int64_t count_objects(const Scene& scene) {
  std::int64_t count = 0;
  for (const Object& object : scene.objects)
    count += static_cast<std::int64_t>(primitive_count(object));
  return count;
}

std::size_t memory_bytes(const Scene& scene) {
  std::size_t bytes = sizeof scene + bytes_of_array(scene.lights) +
                      bytes_of_array(scene.materials) + bytes_of_array(scene.objects);
  for (const Object& object : scene.objects)
    std::visit(
        [&]<typename Document>(const Document& shape) {
          for_each_field(Document::fields,
                         [&](const auto& row) { bytes += bytes_of(shape.*row.member); });
        },
        object.shape);
  return bytes;
}

}  // namespace raytracer
