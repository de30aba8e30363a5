// A vertex as a key: its place, and what else it has.
#pragma once

#include <array>
#include <cstddef>
#include <functional>

namespace raytracer::client {

struct VertexHash {
  template <std::size_t count>
  std::size_t operator()(const std::array<double, count>& vertex) const {
    std::size_t hash = 0;
    for (const double number : vertex)
      hash = (hash ^ std::hash<double>()(number)) * 0x9E3779B97F4A7C15U;  // 2^64 / golden ratio
    return hash;
  }
};

}  // namespace raytracer::client
