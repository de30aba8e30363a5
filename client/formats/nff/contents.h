// What an NFF file says, gathered into a scene: one list for each material and kind of object, so
// that a file of 100,000 spheres is one object.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "client/formats/mesh_builder.h"
#include "client/formats/reading.h"

namespace raytracer::client {

/// A ball, or an end of a cone.
struct NffBall {
  model::Triple center;
  double radius;  ///< negative: what is seen from inside only
};

class NffContents {
 public:
  void set_view(const model::View& view) { reading_.scene.view = view; }
  void set_background(const model::Triple& color) { reading_.scene.background = color; }
  /// Without a colour it is white, and as strong as the number of lights makes it.
  void add_light(const model::Triple& position, const std::optional<model::Triple>& color);

  /// Of the objects that follow.
  void set_fill(const model::Material& fill);
  void add_sphere(int line, const NffBall& ball);
  void add_cone(int line, NffBall base, NffBall apex);
  /// `normals`: one for each corner, or none.
  void add_polygon(int line, const std::vector<model::Triple>& corners,
                   std::vector<model::Triple> normals);

  void omit(int line, std::string_view one, std::string_view many) {
    reading_.omit(line, one, many);
  }

  Reading take() &&;

 private:
  struct Light {
    model::Triple position;
    std::optional<model::Triple> color;
  };
  /// What has one material.
  struct Group {
    model::Spheres spheres;
    model::Cylinders cylinders;
    model::Cones cones;
    MeshBuilder polygons;
    MeshBuilder patches;
  };

  /// That of the current fill, for an object that stands there.
  Group& group(int line);
  void add_lights_to_scene();
  void add_objects_to_scene();

  Reading reading_;
  std::vector<Light> lights_;
  std::map<model::Material, std::size_t> fills_;  ///< with their places among the materials
  std::optional<std::size_t> fill_;
  std::map<std::optional<std::size_t>, Group> groups_;
};

}  // namespace raytracer::client
