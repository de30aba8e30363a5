// Where in a document the reader is: a chain of steps on the stack, spelled out only for an error.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace raytracer {

/// One step from a container to a value: a key of an object or an index of an array.
/// The root is a default-constructed Path. Parents must outlive their children.
struct Path {
  const Path* parent = nullptr;
  std::string_view key{};
  std::size_t index = 0;
  bool is_index = false;

  Path child(std::string_view child_key) const { return {this, child_key, 0, false}; }
  Path child(std::size_t child_index) const { return {this, {}, child_index, true}; }

  /// The JSON Pointer (RFC 6901): "" for the root.
  std::string pointer() const;

  /// About how long the pointer is in bytes, without making it.
  std::size_t pointer_size() const {
    return parent == nullptr ? 0 : parent->pointer_size() + 1 + key.size();
  }
};

}  // namespace raytracer
