// What assimp opens: a file that is in memory, and those beside it that it names.
#pragma once

#include <assimp/DefaultIOSystem.h>

#include <string>
#include <string_view>

namespace raytracer::client {

class AssimpFiles : public Assimp::DefaultIOSystem {
 public:
  /// `name`: the file's, of these bytes; without a folder there are no others. `missing` outlives
  /// this: it counts the files that cannot be opened.
  AssimpFiles(std::string name, std::string_view bytes, bool has_folder, unsigned& missing)
      : name_(std::move(name)), bytes_(bytes), has_folder_(has_folder), missing_(missing) {}

  bool Exists(const char* path) const override;
  Assimp::IOStream* Open(const char* path, const char* mode) override;

 private:
  /// Null: it cannot be opened, or is a folder.
  Assimp::IOStream* open_beside(const std::string& path, const char* mode);
  /// What a URI of glTF, in which a blank is %20, means beside the file.
  std::string beside(std::string_view path) const;

  std::string name_;
  std::string_view bytes_;
  bool has_folder_;
  unsigned& missing_;
};

}  // namespace raytracer::client
