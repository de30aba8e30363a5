#include "client/formats/mesh_builder.h"

#include <algorithm>

namespace raytracer::client {

void MeshBuilder::add(const Triangulation& polygon, const std::vector<model::Triple>& corners,
                      const std::vector<model::Triple>& normals) {
  for (const auto& triangle : polygon.triangles) {
    std::array<std::uint32_t, 3> vertices{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t corner = triangle[i];
      vertices[i] = index_of(corners[corner], normals.empty() ? nullptr : &normals[corner]);
    }
    mesh_.triangles.push_back(vertices);
  }
}

std::uint32_t MeshBuilder::index_of(const model::Triple& corner, const model::Triple* normal) {
  Vertex vertex{corner[0], corner[1], corner[2]};
  if (normal) std::copy(normal->begin(), normal->end(), vertex.begin() + 3);
  const auto [entry, is_new] =
      indices_.try_emplace(vertex, static_cast<std::uint32_t>(mesh_.vertices.size()));
  if (is_new) {
    mesh_.vertices.push_back(corner);
    if (normal) mesh_.normals.push_back(*normal);
  }
  return entry->second;
}

}  // namespace raytracer::client
