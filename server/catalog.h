// The shipped scenes, by name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace raytracer {

struct ShippedScene {
  std::string name;         ///< as in ?scene=NAME
  std::string title;        ///< the document's "name"
  std::string description;  ///< one line
  int width_px = 0;
  int height_px = 0;
  std::string_view document;  ///< its own bytes
};

class Catalog {
 public:
  /// Reads what the list says from the embedded documents, once.
  /// Throws std::logic_error if one lacks it: then the build is broken.
  Catalog();

  /// Ordered by name.
  const std::vector<ShippedScene>& scenes() const { return scenes_; }

  /// Throws HttpError 404 that suggests the nearest name.
  const ShippedScene& at(std::string_view name) const;

 private:
  std::vector<ShippedScene> scenes_;
};

}  // namespace raytracer
