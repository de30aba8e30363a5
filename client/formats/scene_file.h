// A file that is being read: a scene for each of its frames, one after the other.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "client/formats/import_options.h"
#include "client/formats/reading.h"
#include "client/formats/text_source.h"

namespace raytracer::client {

class SceneFile {
 public:
  SceneFile() = default;
  virtual ~SceneFile() = default;
  SceneFile(const SceneFile&) = delete;
  SceneFile& operator=(const SceneFile&) = delete;

  /// The next frame's scene, or its errors, after which nothing follows; none at the end. There is
  /// one at least. Throws InputError, without the file's name, for what has no line.
  virtual std::optional<Reading> next_frame() = 0;

  /// Whether another frame follows, as far as can be told without reading it.
  virtual bool has_more() const = 0;
};

/// What a file is read from.
struct FileInput {
  std::unique_ptr<TextSource> source;
  std::string path;  ///< beside which other files may lie; empty: none
};

}  // namespace raytracer::client
