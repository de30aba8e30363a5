#include "client/formats/meshes/join_vertices.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "client/formats/vertex_hash.h"

namespace raytracer::client {

void join_vertices(model::Mesh& mesh) {
  const auto key_of = [&](std::size_t i) {
    std::array<double, 9> key{};
    std::copy(mesh.vertices[i].begin(), mesh.vertices[i].end(), key.begin());
    if (!mesh.normals.empty())
      std::copy(mesh.normals[i].begin(), mesh.normals[i].end(), key.begin() + 3);
    if (!mesh.colors.empty())
      std::copy(mesh.colors[i].begin(), mesh.colors[i].end(), key.begin() + 6);
    return key;
  };
  std::unordered_map<std::array<double, 9>, std::uint32_t, VertexHash> known(mesh.vertices.size());
  std::vector<std::uint32_t> place(mesh.vertices.size());
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < place.size(); ++i) {
    const auto [entry, is_new] = known.try_emplace(key_of(i), count);
    place[i] = entry->second;
    if (!is_new) continue;
    mesh.vertices[count] = mesh.vertices[i];
    if (!mesh.normals.empty()) mesh.normals[count] = mesh.normals[i];
    if (!mesh.colors.empty()) mesh.colors[count] = mesh.colors[i];
    ++count;
  }
  mesh.vertices.resize(count);
  if (!mesh.normals.empty()) mesh.normals.resize(count);
  if (!mesh.colors.empty()) mesh.colors.resize(count);
  for (auto& triangle : mesh.triangles)
    for (std::uint32_t& corner : triangle) corner = place[corner];
}

}  // namespace raytracer::client
