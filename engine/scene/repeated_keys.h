// Keys that stand twice in the same object.
#pragma once

#include <cstdint>
#include <string_view>
#include <unordered_set>

#include "engine/scene/document.h"

namespace raytracer {

/// Calls visit(node) for every key that stood before, in the object whose first key is at node
/// `first` and which the document's last node ends.
template <typename Visit>
void for_each_repeated_key(const Document& document, std::uint32_t first, Visit visit) {
  // A set costs an allocation a key: most objects have few keys, and there are many of them.
  constexpr std::uint32_t few = 16;
  const auto& nodes = document.nodes;
  const auto key_at = [&](std::uint32_t node) { return document.string(nodes[node].string); };
  const auto next = [&](std::uint32_t node) { return nodes[node + 1].end; };
  std::unordered_set<std::string_view> seen;
  std::uint32_t count = 0;
  for (std::uint32_t i = first; i < nodes.size(); i = next(i), ++count) {
    const std::string_view key = key_at(i);
    bool is_repeated = false;
    if (count < few) {
      for (std::uint32_t j = first; j < i && !is_repeated; j = next(j))
        is_repeated = key_at(j) == key;
    } else {
      if (seen.empty())
        for (std::uint32_t j = first; j < i; j = next(j)) seen.insert(key_at(j));
      is_repeated = !seen.insert(key).second;
    }
    if (is_repeated) visit(i);
  }
}

}  // namespace raytracer
