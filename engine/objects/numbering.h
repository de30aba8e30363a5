// One number for each primitive of a scene.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/math/ray.h"

namespace raytracer {

/// Numbers rise in the document's order, so that of two hits equally far the first can be told.
/// Some may be nobody's.
class Numbering {
 public:
  void reserve(std::size_t object_count) { first_.reserve(object_count); }

  /// The next object is so many primitives.
  void add_object(std::size_t primitive_count) {
    first_.push_back(static_cast<std::uint32_t>(count_));
    count_ += primitive_count;
  }

  std::int32_t operator()(const PrimitiveId& id) const {
    return static_cast<std::int32_t>(first_[id.object] + id.item);
  }

  /// All numbers are less.
  std::size_t count() const { return count_; }

 private:
  std::vector<std::uint32_t> first_;
  std::size_t count_ = 0;
};

}  // namespace raytracer
