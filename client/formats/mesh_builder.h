// Polygons gathered into one mesh, in which corners that are the same are one vertex.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "client/formats/scene_model.h"
#include "client/formats/triangulate.h"
#include "client/formats/vertex_hash.h"

namespace raytracer::client {

class MeshBuilder {
 public:
  /// `normals`: none, or one for each corner, and then always.
  void add(const Triangulation& polygon, const std::vector<model::Triple>& corners,
           const std::vector<model::Triple>& normals);

  model::Mesh take() && { return std::move(mesh_); }

 private:
  /// A place, and a normal or zeros.
  using Vertex = std::array<double, 6>;

  std::uint32_t index_of(const model::Triple& corner, const model::Triple* normal);

  std::unordered_map<Vertex, std::uint32_t, VertexHash> indices_;
  model::Mesh mesh_;
};

}  // namespace raytracer::client
