#include "client/formats/meshes/assimp_files.h"

#include <assimp/MemoryIOWrapper.h>

#include <charconv>
#include <cstdint>
#include <filesystem>

namespace raytracer::client {
namespace {

/// Of a URI, as RFC 3986 writes its octets (section 2.1).
std::string without_percents(std::string_view uri) {
  std::string plain;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned char octet = 0;
    const char* const digits = uri.data() + i + 1;
    const bool is_octet = uri[i] == '%' && i + 2 < uri.size() &&
                          std::from_chars(digits, digits + 2, octet, 16).ptr == digits + 2 &&
                          octet != 0;
    plain += is_octet ? static_cast<char>(octet) : uri[i];
    if (is_octet) i += 2;
  }
  return plain;
}

}  // namespace

bool AssimpFiles::Exists(const char* path) const {
  return path == name_ || (has_folder_ && DefaultIOSystem::Exists(path));
}

Assimp::IOStream* AssimpFiles::open_beside(const std::string& path, const char* mode) {
  std::error_code unknown;
  if (!has_folder_ || std::filesystem::is_directory(path, unknown)) return nullptr;
  return DefaultIOSystem::Open(path.c_str(), mode);
}

Assimp::IOStream* AssimpFiles::Open(const char* path, const char* mode) {
  if (path == name_)
    return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes_.data()),
                                      bytes_.size());
  Assimp::IOStream* file = open_beside(path, mode);
  if (!file) file = open_beside(beside(path), mode);
  if (!file) ++missing_;
  return file;
}

std::string AssimpFiles::beside(std::string_view path) const {
  const std::size_t folder = name_.rfind('/') + 1;
  if (!name_.ends_with(".gltf") || !path.starts_with(std::string_view(name_).substr(0, folder)))
    return std::string(path);
  return std::string(path.substr(0, folder)) + without_percents(path.substr(folder));
}

}  // namespace raytracer::client
