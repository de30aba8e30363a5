// The shipped scenes, by name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace raytracer {

/// A scene that is compiled in.
struct ShippedScene {
  std::string name;           ///< as in ?scene=NAME
  std::string_view document;  ///< its own bytes
};

/// What a scene's document says about it.
struct SceneDescription {
  std::string title;
  std::string description;  ///< one line
  int width_px = 0;
  int height_px = 0;
};

/// Throws std::logic_error if the document lacks something: then the build is broken.
SceneDescription describe(const ShippedScene& scene);

/// All shipped scenes.
class Catalog {
 public:
  /// Reads no document: most servers of a client's own render one scene of its.
  Catalog();

  /// Ordered by name.
  const std::vector<ShippedScene>& scenes() const { return scenes_; }

  /// Throws HttpError 404 that suggests the nearest name.
  const ShippedScene& at(std::string_view name) const;

 private:
  std::vector<ShippedScene> scenes_;
};

}  // namespace raytracer
